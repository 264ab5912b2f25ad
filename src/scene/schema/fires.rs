//! The tables of fires. A row is as in the other tables.

use super::rows::{
    DIRECTION, PLACE, default, keyed, numbers, optional, required, spread, text, whole,
};
use super::spread::SPREAD;
use super::{Field, Kind, Variant};

/// Keys of each `[[fire]]` (Perry 1994, 3.2).
#[rustfmt::skip] // one row a line
pub const FIRE: &[Field] = &[
    required("name", Kind::Name { reserved: &[] }, "\"candle\"", "", "unique among fires; a part of every flame's identity", ""),
    keyed(default("position", PLACE, "[0, 0, 0]", "world units", "the fire's origin; where it moves, its flames feel the wind of that", "Perry 3.4")),
    keyed(default("rotation_degrees", numbers(2, -36_000.0, 36_000.0), "[0, 0]", "degrees", "turns about x, then about y", "")),
    default("roots", Kind::Variants(ROOTS), "{ kind = \"listed\" }", "", "where flames stand", "Perry 3.4"),
    default("flame", Kind::Tables { fields: FLAME, max: 1024 }, "[]", "", "flames that are told by themselves, one `[[fire.flame]]` each; they come before those of `roots`", "Perry 1.2"),
    keyed(default("height", spread((1e-6, 1e4), (0.0, 1e4)), "{ mean = 1 }", "world units", "how high a flame that starts upward is in still air: 24 steps", "Perry 3.2.2")),
    keyed(default("width", spread((1e-6, 1e4), (0.0, 1e4)), "{ mean = 0.25 }", "world units", "how wide its particle is at scale 1", "Perry 3.2.2")),
    default("base_width", numbers(1, 0.0, 100.0), "0.67", "a share of the width", "scale of the width at both ends", "Perry 3.2.2"),
    default("swell", numbers(1, 0.0, 100.0), "0.4", "a share of the width", "what a half sine over the 25 steps adds to that", "Perry 3.2.2"),
    default("base_height", numbers(1, 0.001, 100.0), "0.3", "a share of the width", "scale of a particle's height at the root", "Perry 3.2.2"),
    default("height_growth", numbers(1, 0.0, 10.0), "0.032", "a share of the width", "what each step adds to that", "Perry 3.2.2"),
    default("profile", Kind::Tables { fields: PROFILE, max: 16 }, "[]", "", "scales of a particle by age, one `[[fire.profile]]` each, in ascending order of ages, linear between them; those of the four keys before this count where there is none", "Perry 3.2.1"),
    default("speed", Kind::Choice(&["normalised", "free"]), "\"normalised\"", "", "whether all steps of a flame are of one length, as in fires, or not, as in candles", "Perry 3.2.3"),
    default("start_speed", numbers(1, 0.0, 1e4), "1", "steps", "how fast a flame leaves its root, along the normal, where speeds are free", "Perry 3.2.3"),
    keyed(default("buoyancy", numbers(1, -1e4, 1e4), "1", "", "k_g, how strongly hot air rises", "Perry 3.2.3")),
    default("gravity", DIRECTION, "[0, -1, 0]", "world space", "which way things fall", "Perry 3.2.3"),
    keyed(default("noisiness", numbers(1, 0.0, 1e3), "0.04", "", "C, how strongly noise bends a flame, more the higher above its root", "Perry 3.2.3")),
    default("sampling", numbers(1, -1e3, 1e3), "0.05", "noise cells a frame", "k_s, how fast disturbances rise", "Perry 3.2.3"),
    default("inverse_cohesion", numbers(1, 0.0, 1e4), "1", "noise cells a world unit", "k_p: flames nearer to each other than about 1/k_p move together; 0: all alike", "Perry 3.4"),
    keyed(default("wind_factor", numbers(1, 0.0, 1e4), "1", "", "what a wind of one world unit a frame counts, where hot air's rise counts k_g", "Perry 3.2.3")),
    keyed(default("brightness", numbers(1, 0.0, 1e3), "1", "", "factor of its light", "")),
    keyed(default("color_noise", numbers(1, 0.0, 10.0), "0", "a share of the ramp", "C_noise, how far noise moves particles along the ramp: flames get streaks, and tips that part", "Perry 4.2")),
    default("color_noise_scale", numbers(1, 0.0, 1e4), "4", "noise cells a world unit", "how fine that noise is", "Perry 4.2"),
    default("inner_radius", numbers(1, 0.01, 1.0), "0.5", "a share of the radius", "how large the inner of two layers of a particle's triangles is", "Perry 4.1"),
    keyed(default("inner_alpha", numbers(1, 0.0, 100.0), "0", "a share of the opacity", "how opaque its centre is; 0: there is one layer", "Perry 4.1")),
    default("details", whole(0, 4), "0", "octaves", "smaller particles beside the way of each flame: in each octave half as large and twice as many; they come in where they are some pixels wide", "Perry 4.1"),
    keyed(default("detail_spread", numbers(1, 0.0, 100.0), "1", "a share of their width", "how far noise carries them off those twice as large", "Perry 4.1")),
    keyed(default("detail_alpha", numbers(1, 0.0, 2.0), "0.5", "a share of the opacity", "how opaque they are beside those twice as large, which shine that much less: at 2, all of the light is theirs", "Perry 4.1")),
    default("form", Kind::Choice(&["particles", "strip", "line"]), "\"particles\"", "", "what is drawn along a flame: the particle at each of its 25 places, or a strip through them that faces the viewer, textured in every frame by a slice through noise; or a line through them, with no texture", "Perry 4.2"),
    default("strip_cells", numbers(2, 0.0, 1e3), "[2, 5]", "noise cells", "of a strip's texture, over the width and along the flame", "Perry 4.2"),
    keyed(default("strip_contrast", numbers(1, 0.0, 10.0), "0.6", "a share of the half-width", "how far noise eats into a strip's edges, more the higher above the root", "Perry 4.2")),
    default("particle_matrix", numbers(16, -100.0, 100.0), "[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]", "four rows", "the 4 x 4 matrix that each particle is multiplied by when it faces the viewer, in half-widths: x to the right, y up, z towards the viewer, where particles have none; what comes of it is divided by the fourth row's, which is positive at the centre. Surfaces hide a particle as if it were not moved", "Perry 3.2.1"),
    keyed(default("matrix_noise", numbers(1, 0.0, 10.0), "0", "", "how far noise where a particle is changes its matrix", "Perry 3.2.1")),
    keyed(default("light", numbers(1, 0.0, 1e6), "1", "", "factor of the light that it throws on surfaces: 1 is what it sends to the picture", "Perry 3.2.4")),
    default("lights", whole(0, 64), "1", "", "point lights that stand for its flames, each for those nearest to it; fires have 64 in all, at most", "Perry 3.2.4"),
    default("light_from", Kind::Choice(&["mean", "middle", "tip"]), "\"mean\"", "", "where the light of a flame is: the mean of its 25 places, the middle one, or the last", "Perry 3.2.4"),
    default("ramp", Kind::Tables { fields: RAMP, max: 16 }, "[\
        { age = 0, center = [1, 0.45, 0.2], rim = [1, 0.25, 0.08], alpha = 0.1 }, \
        { age = 0.2, center = [1, 0.7, 0.32], rim = [1, 0.34, 0.06], alpha = 0.3 }, \
        { age = 0.6, center = [1, 0.62, 0.24], rim = [1, 0.3, 0.04], alpha = 0.26 }, \
        { age = 1, center = [1, 0.42, 0.1], rim = [1, 0.2, 0.02], alpha = 0 }]", "", "colours and opacity along a flame, one `[[fire.ramp]]` each, in ascending order of ages; linear between them", "Perry 3.2.2"),
    optional("blackbody", numbers(2, 1e3, 2e4), "[2000, 1400]", "kelvin", "temperatures at root and tip; colours are those of bodies so hot, and the ramp's count no more, only its opacities", "Perry 4.2"),
    default("blackbody_rim", numbers(1, 0.1, 1.0), "0.8", "a share of the temperature", "how hot the rim of a particle is; 1,000 kelvin at least", "Perry 4.2"),
    default("first_frame", whole(-65_000, 1_000_000), "0", "frames", "when flames begin", "Perry 3.4"),
    default("kindling_frames", whole(0, 1_000_000), "0", "frames", "how long it takes until all of `roots` burn, one after the other", ""),
    optional("lifetime", whole(1, 1_000_000), "60", "frames", "how long a flame burns; for ever if left out", "Perry 3.4"),
    default("growth_frames", whole(0, 1_000_000), "0", "frames", "how long a flame takes to grow, and to shrink at the end of its life", ""),
    optional("spread", Kind::Table(SPREAD), "{ mesh = \"cube\", ignition = [{ position = [0, 0, 1] }] }", "", "how it spreads over a mesh, which moves and turns with the fire", "Perry 3.3"),
];

/// Keys of each `[[fire.flame]]`.
#[rustfmt::skip] // one row a line
pub const FLAME: &[Field] = &[
    required("position", PLACE, "[0, 0, 0]", "world units", "its root in the fire's space", "Perry 1.2"),
    default("normal", DIRECTION, "[0, 1, 0]", "the fire's space", "the way it leaves its root", "Perry 3.4"),
    optional("height", EXTENT, "1", "world units", "its own height; as the fire has it if left out", "Perry 1.2"),
    optional("width", EXTENT, "0.25", "world units", "its own width; as the fire has it if left out", "Perry 1.2"),
    default("brightness", numbers(1, 0.0, 1e3), "1", "", "factor of its light besides the fire's", "Perry 1.2"),
    optional("first_frame", whole(-65_000, 1_000_000), "10", "frames", "when it begins; with the fire if left out", "Perry 1.2"),
];

/// What a fire's `roots` can be.
#[rustfmt::skip] // one row a line
pub const ROOTS: &[Variant] = &[
    Variant { name: "listed", about: "flames stand only where they are listed", fields: &[] },
    Variant { name: "line", about: "flames stand evenly along the x axis, its middle at the origin", fields: &[
        required("length", EXTENT, "2", "world units", "of the line", ""),
        required("count", COUNT, "20", "flames", "how many", ""),
    ] },
    Variant { name: "circle", about: "flames stand evenly on a circle around the y axis", fields: &[
        required("radius", EXTENT, "1", "world units", "of the circle", ""),
        required("count", COUNT, "20", "flames", "how many", ""),
    ] },
    Variant { name: "disc", about: "flames stand anywhere in a disc around the y axis", fields: &[
        required("radius", EXTENT, "1", "world units", "of the disc", ""),
        required("count", COUNT, "20", "flames", "how many", ""),
    ] },
    Variant { name: "mesh", about: "flames stand anywhere on the faces of a mesh, along their normals", fields: &[
        required("mesh", text(1000, false), "\"sphere\"", "", "a file in the scene's folder that ends in .obj, .ply, .gltf or .glb; or cube, cylinder, plane, sphere, torus or letters:TEXT, which need none", "Perry 3.4"),
        default("scale", EXTENT, "1", "world units", "what a unit of the mesh is", ""),
        required("count", COUNT, "200", "flames", "how many", ""),
    ] },
];

/// Keys of each `[[fire.ramp]]`.
#[rustfmt::skip] // one row a line
pub const RAMP: &[Field] = &[
    required("age", numbers(1, 0.0, 1.0), "0.5", "a share of the trajectory", "where along the flame this holds", "Perry 3.2.2"),
    required("center", LIGHT, "[1, 0.6, 0.2]", "red, green, blue", "colour of a particle's centre", "Perry 3.2.1"),
    required("rim", LIGHT, "[1, 0.3, 0.05]", "red, green, blue", "colour of its rim", "Perry 3.2.1"),
    required("alpha", numbers(1, 0.0, 1.0), "0.25", "0 invisible, 1 opaque", "opacity of the centre; light adds up to saturation", "Perry 3.2.2"),
    default("rim_alpha", numbers(1, 0.0, 1.0), "0", "0 invisible, 1 opaque", "opacity of the rim", "Perry 3.2.1"),
];

/// Keys of each `[[fire.profile]]`.
#[rustfmt::skip] // one row a line
pub const PROFILE: &[Field] = &[
    required("age", numbers(1, 0.0, 1.0), "0.5", "a share of the trajectory", "where along the flame this holds", "Perry 3.2.1"),
    required("width", numbers(1, 0.0, 100.0), "1.07", "a share of the width", "scale of a particle's width", "Perry 3.2.1"),
    required("height", numbers(1, 0.001, 100.0), "0.7", "a share of the width", "scale of its height", "Perry 3.2.1"),
];

const EXTENT: Kind = numbers(1, 1e-6, 1e4);
const COUNT: Kind = whole(1, 1_000_000);
const LIGHT: Kind = numbers(3, 0.0, 1e3);
