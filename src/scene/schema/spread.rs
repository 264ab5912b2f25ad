//! The tables of fires that spread. A row is as in the other tables.

use super::rows::{DIRECTION, PLACE, default, keyed, numbers, optional, required, text, whole};
use super::{Field, Kind};

/// Keys of `[fire.spread]` (Perry 1994, 3.3; ranges of Table 3.1 are for edges of 0.5).
#[rustfmt::skip] // one row a line
pub const SPREAD: &[Field] = &[
    required("mesh", text(1000, false), "\"cube\"", "", "what burns: a file in the scene's folder that ends in .obj, .ply, .gltf or .glb; or cube, cylinder, plane, sphere, torus or letters:TEXT, which need none", "Perry 3.3.2"),
    default("scale", numbers(1, 1e-6, 1e4), "1", "world units", "what a unit of the mesh is", ""),
    required("ignition", Kind::Tables { fields: IGNITION, max: 256 }, "[{ position = [0, 0, 1] }]", "", "where and when it begins to burn, one `[[fire.spread.ignition]]` each", "Perry 3.3.2"),
    optional("catch_points", whole(3, 256), "16", "points", "how many control points a piece of the mesh begins with that does not burn yet, where first the way of a flame of any fire meets it; none catches fire so if left out", "Perry 4.6"),
    keyed(default("time_scale", numbers(1, 0.0, 1e3), "0.04", "", "K, factor of all speeds; the thesis' slider goes from 0.004 to 0.4; where there is a `formula`, the world units that a metre a second goes in a frame: 0.04 where a unit is a metre and a frame a 25th of a second", "Perry 3.5.1")),
    keyed(default("opposed_flux", numbers(1, 0.0, 1e9), "0.09", "", "q_o, heat that reaches the fuel whichever way the wind is", "Perry 3.3.1")),
    keyed(default("concurrent_flux", numbers(1, 0.0, 1e9), "0.13", "", "q_c, heat that reaches it besides where the wind lays flames over it", "Perry 3.3.1")),
    keyed(default("ignition_heat", numbers(1, 1e-6, 1e12), "0.5", "", "rho dh, heat that it takes to burn; pi times that is the K below equation 3.4; a `formula` has its own, in SI units", "Perry 3.3.1")),
    optional("formula", Kind::Table(FORMULA), "{ thickness = 0.002 }", "", "what opposed_flux, concurrent_flux and ignition_heat are computed from, instead of those", "Perry 3.3.1"),
    keyed(optional("drop_distance", DISTANCE, "0.1", "world units", "d_d, how far a control point goes from one flame that it drops to the next; the thesis' slider goes from 0.01 to 1; a fifth of the mean edge if left out", "Perry 3.4")),
    keyed(optional("separation", DISTANCE, "0.05", "world units", "d_s, how far apart neighbours are when a point comes between, one in each frame; the thesis' slider goes from 0.01 to 0.2; a tenth of the mean edge if left out", "Perry 3.3.2")),
    keyed(optional("curvature_distance", DISTANCE, "0.05", "world units", "d_t, how near an edge has to be to count; the thesis' slider goes from 0.01 to 0.5; a tenth of the mean edge if left out", "Perry 3.3.1")),
    default("law", Kind::Choice(&["fire", "spill", "stain"]), "\"fire\"", "", "whether it burns; or nothing burns, and it runs downhill, by concurrent_flux times the sine of the slope; or it is soaked up, by opposed_flux times the root of the frames", "Perry 3.3.3"),
    default("material", Kind::Tables { fields: MATERIAL, max: 64 }, "[]", "", "parts of the mesh that burn otherwise than the rest, one `[[fire.spread.material]]` each; of two of one part the later counts", "Perry 4.7"),
    optional("grain", Kind::Table(GRAIN), "{ pattern = \"rings\", scale = 8 }", "", "what makes it slower here and there, as in wood; none if left out", "Perry 4.4"),
    default("curvature", Kind::Choice(&["exposed", "literal", "ignored"]), "\"exposed\"", "", "whether fire is faster at outer edges and slower at inner ones by the angle of exposed air; as equation 3.4 is written, by which nothing burns where it is flat; or no edge counts", "Perry 3.3.1"),
    default("heading", Kind::Choice(&["ray", "normal"]), "\"ray\"", "", "whether control points keep their headings, or head along the front's normal", "Perry 3.3.2"),
    default("insertion", Kind::Choice(&["arc", "midpoint"]), "\"arc\"", "", "whether a point comes onto the arc that its neighbours' headings span, or halfway between them", "Perry 3.3.2"),
    default("double_burning", Kind::Choice(&["prevented", "ignored"]), "\"prevented\"", "", "whether control points stop where they meet what has burnt; on a plane with one ignition that never happens", "Perry 3.3.2"),
    default("drop_counter", Kind::Choice(&["reset", "carry"]), "\"reset\"", "", "whether a point begins anew when it drops a flame, or what it has come beyond drop_distance counts for the next; it drops one in a frame at most", "Perry 3.4"),
    default("max_flames", whole(0, 60_000), "2000", "flames", "most dropped flames that burn at once, each as long as the fire's lifetime says; what has no room is counted as dropped; 0 for a fire that spreads without flames", "Perry 3.4"),
    optional("char", Kind::Table(CHAR), "{}", "", "the marks that its flames leave where they have gone out; none if left out", "Perry 3.4.1"),
    optional("smoke", Kind::Table(SMOKE), "{}", "", "the smoke that rises where its flames have gone out; none if left out", "Perry 4.6"),
    optional("line", Kind::Table(LINE), "{ width = 0.02 }", "", "the front as a line; none if left out", "Perry 4.7"),
    default("max_points", whole(8, 1_000_000), "20_000", "points", "most control points; what has no room is counted as dropped", ""),
];

/// Keys of each `[[fire.spread.ignition]]`.
#[rustfmt::skip] // one row a line
pub const IGNITION: &[Field] = &[
    required("position", PLACE, "[0, 0, 1]", "world units", "where, in the fire's space; the nearest place of the surface is meant", "Perry 3.3.2"),
    default("first_frame", whole(0, 1_000_000), "0", "frames", "when", ""),
    default("points", whole(3, 4096), "16", "points", "how many control points it begins with; the thesis has eight or more", "Perry 3.3.2"),
];

/// Keys of each `[[fire.spread.material]]`.
#[rustfmt::skip] // one row a line
pub const MATERIAL: &[Field] = &[
    required("part", text(256, false), "\"+z\"", "", "a group or a material of the mesh, by its name there", "Perry 4.7"),
    default("speed", numbers(1, 0.0, 1e3), "1", "", "factor of the speed on it", "Perry 4.7"),
    optional("thickness", numbers(1, 1e-6, 1e3), "0.004", "metres", "L of its fuel instead of that of the `formula`, which there has to be; twice as thick is half as fast", "Perry 3.3.1"),
    optional("conductivity", numbers(1, 0.0, 1e4), "0.2", "watts a metre and kelvin", "instead of that of the `formula`, which there has to be: lambda_s of what is thick", "Perry 3.3.1"),
    optional("lifetime", whole(1, 1_000_000), "30", "frames", "how long flames burn that are dropped on it; as the fire's others if left out", "Perry 3.4"),
];

/// Keys of `[fire.spread.formula]`.
#[rustfmt::skip] // one row a line
pub const FORMULA: &[Field] = &[
    default("flame_temperature", numbers(1, 1.0, 1e4), "1500", "kelvin", "T_f", "Perry 3.3.1"),
    default("fuel_temperature", numbers(1, 0.0, 1e4), "300", "kelvin", "T_i", "Perry 3.3.1"),
    default("conductivity", numbers(1, 0.0, 1e4), "0.05", "watts a metre and kelvin", "lambda_g of the gas; where fuel is thick, lambda_s of the solid", "Perry 3.3.1"),
    default("emissivity", numbers(1, 0.0, 1.0), "0.1", "", "epsilon_f of the flame", "Perry 3.3.1"),
    default("flame_length", numbers(1, 0.0, 1e3), "0.05", "metres", "h_f", "Perry 3.3.1"),
    default("flame_angle_degrees", numbers(1, 0.0, 180.0), "30", "degrees", "Theta_f, between the flame and the surface", "Perry 3.3.1"),
    required("thickness", numbers(1, 1e-6, 1e3), "0.002", "metres", "L, of the fuel", "Perry 3.3.1"),
    default("density", numbers(1, 1e-3, 1e6), "600", "kilograms a cubic metre", "rho of the fuel: some 600 for wood and paper", "Perry 3.3.1"),
    default("enthalpy", numbers(1, 1e-3, 1e9), "500_000", "joules a kilogram", "dh, heat that a kilogram of it takes until it burns: what warms it by the 300 kelvin that wood lacks, and what dries it", "Perry 3.3.1"),
];

/// Keys of `[fire.spread.grain]`.
#[rustfmt::skip] // one row a line
pub const GRAIN: &[Field] = &[
    default("pattern", Kind::Choice(&["stripes", "rings"]), "\"rings\"", "", "slabs across a direction, every other half of a period; or rings around it, through the origin, of late wood that fades into early wood", "Perry 4.4"),
    default("direction", DIRECTION, "[0, 1, 0]", "the object's space", "that direction", "Perry 4.4"),
    required("scale", numbers(1, 0.0, 1e4), "8", "periods a world unit", "how fine it is", "Perry 4.4"),
    default("strength", numbers(1, 0.0, 1.0), "0.5", "a share", "what it takes away where it is densest: of the speed, or of the colour", "Perry 4.4"),
    default("shift", numbers(1, 0.0, 1e3), "0", "periods", "how far noise shifts it", "Perry 4.4"),
    default("noise_scale", numbers(1, 0.0, 1e4), "1", "noise cells a world unit", "how fine that noise is", "Perry 4.4"),
];

/// Keys of `[fire.spread.char]`.
#[rustfmt::skip] // one row a line
pub const CHAR: &[Field] = &[
    optional("size", numbers(1, 1e-6, 1e4), "0.25", "world units", "how wide a mark is; as a flame if left out", "Perry 3.4.1"),
    default("opacity", numbers(1, 0.0, 1.0), "0.5", "", "how much it hides at its middle", "Perry 3.4.1"),
    default("edge_softness", numbers(1, 0.0, 1.0), "1", "a share of the radius", "how soft its edge is", "Perry 3.4.1"),
    default("glow", numbers(3, 0.0, 1e3), "[1, 0.2, 0.02]", "", "red, green and blue of the ember that it is at first", "Perry 4.6"),
    default("glow_frames", numbers(1, 1.0, 1e6), "60", "frames", "how long it takes until it is black", "Perry 4.6"),
    default("appear_frames", numbers(1, 1.0, 1e6), "6", "frames", "how long it takes until it is as opaque as it will be", ""),
    default("max_marks", whole(1, 200_000), "10_000", "marks", "most marks of all fires, for each that leaves any; the oldest make room for new ones", ""),
];

/// Keys of `[fire.spread.smoke]`.
#[rustfmt::skip] // one row a line
pub const SMOKE: &[Field] = &[
    default("speed", numbers(1, 0.0, 1e4), "0.02", "world units a frame", "how fast a puff goes in a wind that bends flames as k_g = 1 does: the wind that they are in, too", "Perry 4.6"),
    default("frames", numbers(1, 1.0, 1e6), "60", "frames", "how long it takes to vanish", "Perry 4.6"),
    default("size", numbers(1, 1e-6, 1e4), "0.1", "world units", "how wide it is at first", "Perry 4.6"),
    default("growth", numbers(1, 0.0, 1e3), "4", "", "how many times as wide it is in the end", "Perry 4.6"),
    default("color", numbers(3, 0.0, 1e3), "[0.1, 0.1, 0.11]", "", "red, green and blue", "Perry 4.6"),
    default("opacity", numbers(1, 0.0, 1.0), "0.15", "", "how much its middle hides at most", "Perry 4.6"),
    default("max_puffs", whole(1, 200_000), "10_000", "puffs", "most puffs of all fires, for each that smokes; the oldest make room for new ones; marks of char have these places, too", ""),
];

/// Keys of `[fire.spread.line]`.
#[rustfmt::skip] // one row a line
pub const LINE: &[Field] = &[
    required("width", numbers(1, 0.0, 1e4), "0.02", "world units", "how wide it is", "Perry 4.7"),
    default("color", numbers(3, 0.0, 1e3), "[1, 0.5, 0.1]", "", "red, green and blue", ""),
    default("opacity", numbers(1, 0.0, 1.0), "1", "", "how much it hides", ""),
];

const DISTANCE: Kind = numbers(1, 1e-6, 1e4);
