//! The tables themselves. A row: key, kind, default or example, unit, meaning, and the
//! section of the paper that it comes from. Rows in `keyed` may change with the frame.

use super::fires::FIRE;
use super::flocks::FLOCK;
use super::kinds::{EXTINCTIONS, GENERATION_SHAPES, WINDS};
use super::rows::{
    DIRECTION, PLACE, changing, default, keyed, numbers, optional, required, spread, text, whole,
};
use super::spread::GRAIN;
use super::{Field, Kind};

/// Keys at the top of a scene file.
#[rustfmt::skip] // one row a line
pub const SCENE: &[Field] = &[
    optional("title", TITLE, "\"A fountain\"", "", "one line for people; the scene's name if left out", ""),
    default("description", DESCRIPTION, "\"\"", "", "a few sentences for people", ""),
    default("frames", whole(1, 1_000_000), "120", "frames", "how long the scene lasts when nobody says otherwise", ""),
    default("frame_rate", whole(1, 240), "24", "frames a second", "the speed of animated files", "Reeves 3"),
    default("seed", whole(0, i64::MAX), "1", "", "decides every random number", "Reeves 3"),
    optional("capacity", whole(1, 1_000_000_000), "200_000", "particles", "most particles alive at once; computed from births and lifetimes if left out", ""),
    optional("max_systems", whole(1, 16_384), "400", "systems", "most systems that others bear at once, those included whose particles still live; computed from births and lifetimes if left out", "Reeves 2.6"),
    optional("steady_particles", whole(1, 1_000_000_000), "1_000_000", "particles", "how many are alive once births and deaths balance; `motes bench --particles` scales all births by it to reach other counts; scenes without it have one count only, but for those of flocks alone, which scale by their boids, and of fires alone, by their flames", ""),
    default("image", Kind::Table(IMAGE), "{}", "", "the picture that frames are drawn into", ""),
    required("camera", Kind::Table(CAMERA), "{ position = [0, 1, 5], target = [0, 0, 0] }", "", "the viewer", ""),
    optional("system", Kind::Tables { fields: SYSTEM, max: 1024 }, "[{ name = \"jet\", initial_mean_parts = 100, generation_shape = { kind = \"sphere\", radius = 1 }, speed = 0.1, lifetime = 60, color = [0.4, 0.1, 0.02], size = 0.02 }]", "", "the particle systems, one `[[system]]` each; a scene without a flock or a fire has at least one", "Reeves 2"),
    default("flock", Kind::Tables { fields: FLOCK, max: 64 }, "[]", "", "the flocks, one `[[flock]]` each", ""),
    default("fire", Kind::Tables { fields: FIRE, max: 64 }, "[]", "", "the fires, one `[[fire]]` each", "Perry 3.2"),
    default("light", Kind::Table(LIGHT), "{}", "", "the light that the planet, the ground, surfaces and strokes reflect, and particles which cover and are shaded", "Reeves 5"),
    optional("planet", Kind::Table(PLANET), "{ radius = 10 }", "", "a ball with a surface: it hides what is behind it, and is lit", "Reeves 3"),
    default("lamp", Kind::Tables { fields: LAMP, max: 16 }, "[]", "", "lights near the planet, the ground, surfaces and strokes, one `[[lamp]]` each", "Reeves 3"),
    optional("ground", Kind::Table(GROUND), "{ radius = 10 }", "", "a plane behind everything that light falls on, that of flames too", "Perry 3.2.4"),
    default("pillar", Kind::Tables { fields: PILLAR, max: 16 }, "[]", "", "upright cylinders, such as candles, one `[[pillar]]` each: they hide what is behind them", "Perry 3.2.4"),
    default("surface", Kind::Tables { fields: SURFACE, max: 64 }, "[]", "", "meshes that are seen, one `[[surface]]` each: they hide what is behind them, and are lit", "Reeves 3"),
    default("wind", Kind::List { variants: WINDS, max: 16 }, "[]", "", "the parts of the wind, one `[[wind]]` each: it is their sum, and drag makes particles follow it", "Perry 3.2.3"),
    default("layer", Kind::Tables { fields: LAYER, max: 8 }, "[]", "", "planes that split the picture into layers, one `[[layer]]` each", "Reeves 2.5"),
];

/// Keys of `[image]`.
#[rustfmt::skip] // one row a line
pub const IMAGE: &[Field] = &[
    default("width", whole(1, 4096), "1280", "pixels", "across", ""),
    default("height", whole(1, 4096), "720", "pixels", "down", ""),
    keyed(default("background", numbers(3, 0.0, 1.0), "[0, 0, 0]", "display-referred red, green, blue", "colour behind everything", "")),
    default("shutter", numbers(1, 0.0, 1.0), "0.5", "frames", "how much of a frame the shutter is open, so how long streaks are", "Reeves 3"),
    default("shutter_weighting", Kind::Choice(&["camera", "eye"]), "\"camera\"", "", "whether light counts alike while the shutter is open, or the later the more", "Reeves 3"),
    keyed(default("exposure", numbers(1, 0.0, 1e3), "1", "", "factor of the light of all particles", "")),
];

/// Keys of `[light]`.
#[rustfmt::skip] // one row a line
pub const LIGHT: &[Field] = &[
    default("direction", DIRECTION, "[0.4, 0.8, 0.5]", "world space", "where the light comes from", "Reeves 5"),
    default("color", numbers(3, 0.0, 1e3), "[1, 1, 1]", "red, green, blue", "what it makes of white that it falls on straight", "Reeves 5"),
    default("ambient", numbers(3, 0.0, 1e3), "[0.2, 0.2, 0.2]", "red, green, blue", "light from everywhere, which makes no shades", "Reeves 5"),
    default("shadow_center", PLACE, "[0, 0, 0]", "world units", "the middle of the box in which clouds throw shadows on themselves", "Reeves 5"),
    optional("shadow_radius", numbers(1, 1e-3, 1e6), "10", "world units", "half how wide that box is; clouds throw none if left out", "Reeves 5"),
    default("shadow_cells", whole(4, 96), "32", "cells", "how finely that is told, along each side of the box", "Reeves 5"),
];

/// Keys of `[planet]` (Reeves 1983, section 3).
#[rustfmt::skip] // one row a line
pub const PLANET: &[Field] = &[
    default("center", PLACE, "[0, 0, 0]", "world units", "its centre", "Reeves 3"),
    required("radius", numbers(1, 1e-3, 1e6), "10", "world units", "its radius; the camera is outside", "Reeves 3"),
    default("color", numbers(3, 0.0, 1.0), "[0.3, 0.3, 0.3]", "red, green, blue", "the part of the light that it reflects", "Reeves 3"),
    default("relief", numbers(1, 0.0, 10.0), "0", "slope", "how rough its ground looks", "Reeves 3"),
    default("contrast", numbers(1, 0.0, 1.0), "0", "a share of the colour", "how much darker and lighter its ground is here and there", "Reeves 3"),
    default("scale", numbers(1, 0.0, 1e4), "1", "noise cells a world unit", "how fine that is", "Reeves 3"),
    default("octaves", whole(1, 8), "5", "", "how many finer patterns are on top of each other, each of twice the frequency", "Reeves 3"),
];

/// Keys of `[ground]` (Perry 1994, 3.2.4: flames light surfaces).
#[rustfmt::skip] // one row a line
pub const GROUND: &[Field] = &[
    default("position", PLACE, "[0, 0, 0]", "world units", "a point of the plane, around which it is seen", "Perry 3.2.4"),
    default("normal", DIRECTION, "[0, 1, 0]", "world space", "where it faces", "Perry 3.2.4"),
    required("radius", numbers(1, 1e-3, 1e6), "10", "world units", "how far from there it fades away", ""),
    default("color", numbers(3, 0.0, 1.0), "[0.3, 0.3, 0.3]", "red, green, blue", "the part of the light that it reflects", "Perry 3.2.4"),
    default("contrast", numbers(1, 0.0, 1.0), "0", "a share of the colour", "how much darker and lighter it is here and there", ""),
    default("scale", numbers(1, 0.0, 1e4), "1", "noise cells a world unit", "how fine that is", ""),
    default("octaves", whole(1, 8), "4", "", "how many finer patterns are on top of each other, each of twice the frequency", ""),
];

/// Keys of each `[[pillar]]`.
#[rustfmt::skip] // one row a line
pub const PILLAR: &[Field] = &[
    default("position", PLACE, "[0, 0, 0]", "world units", "the middle of its foot; it stands along y", "Perry 3.2.2"),
    required("radius", numbers(1, 1e-3, 1e4), "0.2", "world units", "of the cylinder", "Perry 3.2.2"),
    required("height", numbers(1, 1e-3, 1e4), "1", "world units", "from foot to top", "Perry 3.2.2"),
    default("color", numbers(3, 0.0, 1.0), "[0.3, 0.3, 0.3]", "red, green, blue", "the part of the light that it reflects", "Perry 3.2.4"),
    default("translucence", numbers(1, 0.0, 100.0), "0", "a share of the light", "what of the light of flames it lets through to its surface, as wax does", ""),
    default("depth", numbers(1, 1e-3, 1e4), "0.3", "world units", "how far that light comes", ""),
];

/// Keys of each `[[surface]]`.
#[rustfmt::skip] // one row a line
pub const SURFACE: &[Field] = &[
    required("mesh", text(1000, false), "\"torus\"", "", "a file in the scene's folder that ends in .obj, .ply, .gltf or .glb; or cube, cylinder, plane, sphere, torus or letters:TEXT, which need none", ""),
    keyed(default("position", PLACE, "[0, 0, 0]", "world units", "where its origin is", "")),
    keyed(default("rotation_degrees", numbers(2, -36_000.0, 36_000.0), "[0, 0]", "degrees", "turns about x, then about y", "")),
    keyed(default("scale", numbers(1, 0.0, 1e3), "1", "world units", "what a unit of the mesh's coordinates becomes", "")),
    keyed(default("color", numbers(3, 0.0, 1.0), "[0.3, 0.3, 0.3]", "red, green, blue", "the part of the light that it reflects", "Reeves 3")),
    optional("grain", Kind::Table(GRAIN), "{ pattern = \"rings\", scale = 8 }", "", "what makes it darker here and there, as in wood; none if left out", "Perry 4.4"),
    default("crease_degrees", numbers(1, 0.0, 180.0), "40", "degrees", "triangles that meet at less than this angle look as one curved surface", ""),
];

/// Keys of each `[[lamp]]`.
#[rustfmt::skip] // one row a line
pub const LAMP: &[Field] = &[
    keyed(required("position", PLACE, "[0, 0, 12]", "world units", "where it is", "Reeves 3")),
    keyed(default("color", numbers(3, 0.0, 1e6), "[1, 1, 1]", "red, green, blue", "what it makes of white that it falls on straight, at its distance", "Reeves 3")),
    default("distance", numbers(1, 1e-3, 1e6), "1", "world units", "how far away light is as the colour says; it falls with the squared distance", "Reeves 3"),
];

/// Keys of each `[[layer]]`.
#[rustfmt::skip] // one row a line
pub const LAYER: &[Field] = &[
    required("name", Kind::Name { reserved: &["rest", "particles", "surfaces"] }, "\"behind\"", "", "unique, a part of file names; rest, particles and surfaces are layers of their own", ""),
    required("point", PLACE, "[0, 0, 0]", "world units", "a point of the plane", "Reeves 2.5"),
    required("normal", DIRECTION, "[0, 0, 1]", "world space", "where the plane faces; the layer is what is behind it and in no layer before", "Reeves 2.5"),
];

/// Keys of `[camera]`.
#[rustfmt::skip] // one row a line
pub const CAMERA: &[Field] = &[
    keyed(required("position", PLACE, "[0, 1, 5]", "world units", "where it stands", "Reeves 2.5")),
    keyed(required("target", PLACE, "[0, 0, 0]", "world units", "what it looks at", "Reeves 2.5")),
    keyed(default("up", PLACE, "[0, 1, 0]", "world space", "which way is up in the picture", "")),
    default("projection", Kind::Choice(&["perspective", "orthographic"]), "\"perspective\"", "", "whether what is farther is smaller", ""),
    keyed(default("view_height", numbers(1, 1e-6, 1e6), "4", "world units", "from the picture's bottom to its top, if orthographic", "")),
    keyed(default("vertical_fov_degrees", numbers(1, 1.0, 170.0), "45", "degrees", "the whole vertical angle of view", "")),
    default("near", numbers(1, 1e-6, 1e6), "0.1", "world units", "nothing nearer is drawn", ""),
];

/// Keys of each `[[system]]` (Reeves 1983, section 2).
#[rustfmt::skip] // one row a line
pub const SYSTEM: &[Field] = &[
    required("name", Kind::Name { reserved: &[] }, "\"jet\"", "", "unique; a part of every particle's identity", ""),
    optional("parent", Kind::Name { reserved: &[] }, "\"rings\"", "", "the system that bears systems of this kind instead of particles: each is born, placed, moved and ended as a particle of it, and this one is there for them alone", "Reeves 2.6"),
    default("child_up", Kind::Choice(&["parent", "outward"]), "\"parent\"", "", "of a system with a parent: whether its up is the parent's, or away from the parent's generation shape where it is born, as it always is on rings and meshes", "Reeves 3"),
    default("inherit", Kind::Table(INHERIT), "{}", "", "of a system with a parent: how much those of its kind differ", "Reeves 2.6"),
    keyed(default("position", PLACE, "[0, 0, 0]", "world units", "the system's origin", "Reeves 2.2")),
    keyed(default("rotation_degrees", numbers(2, -36_000.0, 36_000.0), "[0, 0]", "degrees", "turns about x, then about y; local +z is the system's up", "Reeves 2.2")),
    default("first_frame", whole(-65_000, 1_000_000), "0", "frames", "the first frame with births; below 0, the system is under way when the scene begins", "Reeves 2.1"),
    optional("end_frame", whole(-64_999, 1_000_000), "60", "frames", "the first frame without births again; never if left out", ""),
    default("trigger_frames", Kind::Wholes { min: -65_000, max: 1_000_000, most: 256 }, "[]", "frames", "when the system begins: nobody is born before the first of these, and first_frame, end_frame and bursts count from the last one", ""),
    default("burst", Kind::Tables { fields: BURST, max: 64 }, "[]", "", "births all at once, besides the others", ""),
    default("birth_moment", Kind::Choice(&["frame_start", "within_frame"]), "\"frame_start\"", "", "whether particles are born at a frame's start, or at any moment of it, so that jets and moving systems leave no gaps", ""),
    default("particle_space", Kind::Choice(&["system", "world"]), "\"system\"", "", "whether the living move and turn with their system, or stay behind", "Reeves 2.6"),
    keyed(optional("initial_mean_parts", PARTS, "1000", "particles a frame", "mean births in the first frame", "Reeves 2.1")),
    default("delta_mean_parts", PARTS_CHANGE, "0", "particles a frame", "added to the mean each frame", "Reeves 2.1"),
    default("quadratic_mean_parts", PARTS_CHANGE, "0", "particles a frame", "times the squared number of frames since the first", "Reeves 2.1"),
    default("cubic_mean_parts", PARTS_CHANGE, "0", "particles a frame", "times the cubed number of frames since the first", "Reeves 2.1"),
    keyed(default("var_parts", PARTS, "0", "particles a frame", "half the width of the range around the mean", "Reeves 2.1")),
    default("delta_var_parts", PARTS_CHANGE, "0", "particles a frame", "added to the half-width each frame", "Reeves 2.1"),
    default("quadratic_var_parts", PARTS_CHANGE, "0", "particles a frame", "times the squared number of frames since the first", "Reeves 2.1"),
    default("cubic_var_parts", PARTS_CHANGE, "0", "particles a frame", "times the cubed number of frames since the first", "Reeves 2.1"),
    keyed(optional("initial_mean_parts_per_area", DENSITY, "0.5", "particles a frame and pixel of screen area", "mean births in the first frame", "Reeves 2.1")),
    default("delta_mean_parts_per_area", DENSITY_CHANGE, "0", "particles a frame and pixel of screen area", "added to the mean each frame", "Reeves 2.1"),
    default("quadratic_mean_parts_per_area", DENSITY_CHANGE, "0", "particles a frame and pixel of screen area", "times the squared number of frames since the first", "Reeves 2.1"),
    default("cubic_mean_parts_per_area", DENSITY_CHANGE, "0", "particles a frame and pixel of screen area", "times the cubed number of frames since the first", "Reeves 2.1"),
    keyed(default("var_parts_per_area", DENSITY, "0", "particles a frame and pixel of screen area", "half the width of the range around the mean", "Reeves 2.1")),
    default("delta_var_parts_per_area", DENSITY_CHANGE, "0", "particles a frame and pixel of screen area", "added to the half-width each frame", "Reeves 2.1"),
    default("quadratic_var_parts_per_area", DENSITY_CHANGE, "0", "particles a frame and pixel of screen area", "times the squared number of frames since the first", "Reeves 2.1"),
    default("cubic_var_parts_per_area", DENSITY_CHANGE, "0", "particles a frame and pixel of screen area", "times the cubed number of frames since the first", "Reeves 2.1"),
    default("mean_parts_wander", numbers(1, 0.0, 1.0), "0", "a share of the mean", "how far the mean strays at random, slowly", "Reeves 2.1"),
    default("mean_parts_wander_frames", numbers(1, 1.0, 1e6), "24", "frames", "over how many frames it does", "Reeves 2.1"),
    default("birth_rounding", Kind::Choice(&["stochastic", "nearest"]), "\"stochastic\"", "", "how a fractional number of births becomes a whole one", "Reeves 2.1"),
    required("generation_shape", Kind::Variants(GENERATION_SHAPES), "{ kind = \"sphere\", radius = 1 }", "", "where particles are born", "Reeves 2.2"),
    optional("ejection_axis", Kind::Choice(&["up", "outward", "around"]), "\"up\"", "", "the axis of the cone that particles leave within; outward for sphere, cone and mesh, along the curve for an attractor and up for the others if left out", "Reeves 2.2"),
    keyed(default("ejection_angle_degrees", numbers(1, 0.0, 180.0), "0", "degrees", "half-angle of that cone", "Reeves 2.2")),
    default("ejection_spread", Kind::Choice(&["solid_angle", "angle"]), "\"solid_angle\"", "", "what is uniform in that cone", "Reeves 2.2"),
    keyed(required("speed", spread((-1e4, 1e4), (0.0, 1e4)), "{ mean = 0.1, var = 0.02 }", "world units a frame", "initial speed", "Reeves 2.2")),
    keyed(optional("lifetime", spread((1.0, 65_000.0), (0.0, 65_000.0)), "{ mean = 60, var = 10 }", "frames", "how long particles live; age kills nobody if left out", "Reeves 2.4")),
    keyed(required("color", changing(3, (0.0, 1e3), 1e3), "{ mean = [0.4, 0.1, 0.02] }", "light of a fully covered pixel in red, green, blue", "colour", "Reeves 2.2, 2.3")),
    keyed(default("transparency", changing(1, (0.0, 1.0), 1.0), "{ mean = 0 }", "0 opaque, 1 invisible", "light is scaled by 1 - transparency", "Reeves 2.2, 2.3")),
    keyed(required("size", changing(1, (1e-6, 1e4), 1e4), "{ mean = 0.02 }", "world units", "radius, or half the width of a rectangle", "Reeves 2.2, 2.3")),
    keyed(default("acceleration", numbers(3, -1e4, 1e4), "[0, 0, 0]", "world units a frame squared, world space", "added to the velocity each frame", "Reeves 2.3")),
    default("acceleration_space", Kind::Choice(&["world", "system"]), "\"world\"", "", "whether the acceleration has a direction of the world, or turns with the system", "Reeves 3"),
    keyed(default("drag", numbers(1, 0.0, 1.0), "0", "a share of the velocity", "how much of its velocity against the wind a particle loses each frame", "")),
    default("integration", Kind::Choice(&["euler", "parabola"]), "\"euler\"", "", "whether velocities are those at the start of a frame, or halfway through it, which puts particles on exact parabolas", "Reeves 2.3"),
    default("particle_shape", Kind::Choice(&["sphere", "rectangle", "streak", "stroke"]), "\"sphere\"", "", "what a particle looks like; a stroke is its whole trajectory, drawn at once, lit by the scene's light and lamps, as a blade of grass: it covers, and stays for as long as the scene lasts", "Reeves 2.2, 4.3"),
    default("blend", Kind::Choice(&["add", "over"]), "\"add\"", "", "whether particles add their light to what is behind them, or cover it; the same for a whole run", "Reeves 2.5, 5"),
    default("shading", Kind::Choice(&["flat", "lit_sphere", "lit_cloud"]), "\"flat\"", "", "whether particles that cover have their colour all over, reflect the scene's light in it as balls, or all over as parts of a cloud, as far as the light comes through the others (`shadow_radius` of `[light]`)", "Reeves 5"),
    default("edge_softness", numbers(1, 0.0, 1.0), "0", "a share of the radius", "how wide the edge of a disc that covers is", ""),
    default("streak_light", Kind::Choice(&["conserved", "constant"]), "\"conserved\"", "", "whether a streak's light is spread along it, or full everywhere", "Reeves 3"),
    default("stroke_taper", numbers(1, 0.0, 1.0), "1", "a share of the width", "how much narrower a stroke is where its particle's life ends", "Reeves 4.3"),
    default("stroke_pieces", whole(1, 64), "16", "", "of how many straight pieces a stroke is drawn at most; of fewer where those stay within a quarter of a pixel", "Reeves 4.3"),
    default("stroke_shadow", numbers(1, 0.0, 1.0), "0", "a share of the light", "how dark the shadows of strokes are on the ground, which the scene's light throws", "Reeves 4.3"),
    keyed(optional("intensity_threshold", numbers(1, 0.0, 1e3), "0.01", "light", "a particle dimmer than this is killed; never if left out", "Reeves 2.4")),
    default("intensity", Kind::Choice(&["brightest", "luminance"]), "\"brightest\"", "", "what intensity is: 1 - transparency times the brightest channel, or times the luminance", "Reeves 2.4"),
    default("extinction", Kind::List { variants: EXTINCTIONS, max: 16 }, "[]", "", "where particles may not be, one `[[system.extinction]]` each", "Reeves 2.4"),
    keyed(optional("light_distance", numbers(1, 1e-6, 1e6), "10", "world units", "where light is as the colour says; it falls with the squared distance from the eye, or not at all if left out", "Reeves 2.5")),
    keyed(default("light", numbers(1, 0.0, 1e6), "0", "", "factor of the light that its particles throw on the planet, the ground and surfaces, gathered to at most 512 point lights: 1 is what they send to the picture", "Reeves 3")),
];

/// Keys of `[system.inherit]` (Reeves 1983, 2.6 and section 3).
#[rustfmt::skip] // one row a line
pub const INHERIT: &[Field] = &[
    default("mean_parts", PARTS, "0", "as the mean's", "half the width of the range of mean births", "Reeves 3"),
    default("var_parts", PARTS, "0", "as the mean's", "half the width of the range of half-widths of births", "Reeves 2.6"),
    default("generation_scale", numbers(1, 0.0, 1.0), "0", "a share of the shape's extents", "half the width of the range of sizes of the generation shape", "Reeves 3"),
    default("ejection_angle_degrees", numbers(1, 0.0, 180.0), "0", "degrees", "half the width of the range of ejection angles", "Reeves 3"),
    default("speed", spread((0.0, 1e4), (0.0, 1e4)), "{ mean = 0 }", "world units a frame", "half the widths of the ranges of means and of half-widths", "Reeves 3"),
    default("lifetime", spread((0.0, 65_000.0), (0.0, 65_000.0)), "{ mean = 0 }", "frames", "the same", "Reeves 3"),
    default("color", changing(3, (0.0, 1e3), 1e3), "{ mean = [0, 0, 0] }", "light of a fully covered pixel in red, green, blue", "the same, and of rates", "Reeves 2.6"),
    default("transparency", changing(1, (0.0, 1.0), 1.0), "{ mean = 0 }", "0 opaque, 1 invisible", "the same, and of rates", "Reeves 3"),
    default("size", changing(1, (0.0, 1e4), 1e4), "{ mean = 0 }", "world units", "the same, and of rates", "Reeves 3"),
];

/// Keys of each `[[system.burst]]`.
#[rustfmt::skip] // one row a line
pub const BURST: &[Field] = &[
    required("frame", whole(-65_000, 1_000_000), "10", "frames", "when, from frame 0 or the last trigger", ""),
    required("parts", spread((0.0, 16e6), (0.0, 16e6)), "{ mean = 1000, var = 100 }", "particles", "how many", ""),
];

const TITLE: Kind = text(200, false);
const DESCRIPTION: Kind = text(10_000, true);
const PARTS: Kind = numbers(1, 0.0, 16e6);
const PARTS_CHANGE: Kind = numbers(1, -16e6, 16e6);
const DENSITY: Kind = numbers(1, 0.0, 1e3);
const DENSITY_CHANGE: Kind = numbers(1, -1e3, 1e3);
