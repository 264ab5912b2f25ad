//! Scene texts for tests, and ways to spoil them.

use motes::scene::schema::{self, Field};
use motes::scene::{Scene, SceneError, parse};

/// What the tests call the file.
pub(crate) const FILE: &str = "scenes/some.toml";

/// The least that is a scene.
pub(crate) const MINIMAL: &str = r#"
[camera]
position = [0, 1, 5]
target = [0, 0, 0]
[[system]]
name = "only"
initial_mean_parts = 100
generation_shape = { kind = "sphere", radius = 1 }
speed = 0.1
lifetime = 60
color = [0.4, 0.1, 0.02]
size = 0.02
"#;

/// A scene with every key, each on a line of its own.
pub(crate) const FULL: &str = r#"title = "All of it"
description = """Two lines:\nof text."""
frames = 10
frame_rate = 30
seed = 0xfeed
capacity = 200_000
max_systems = 300
steady_particles = 150_000
[image]
width = 640
height = 360
background = [0, 0.5, 1]
shutter = 0.48
shutter_weighting = "eye"
exposure = 1.5
[camera]
position = [0, 1, 5]
target = [0, 0, 0]
up = [0.5, 1, 0]
projection = "orthographic"
view_height = 3.5
vertical_fov_degrees = 60
near = 0.01
[light]
direction = [-1, 2, 0.5]
color = [1, 0.9, 0.8]
ambient = [0.05, 0.06, 0.07]
shadow_center = [1, 2, 0.5]
shadow_radius = 3.5
shadow_cells = 5
[planet]
center = [1, 2, 3]
radius = 0.5
color = [0.2, 0.3, 0.4]
relief = 0.6
contrast = 0.7
scale = 8
octaves = 3
[ground]
position = [1, -2, 3]
normal = [0, 1, 0.5]
radius = 12
color = [0.3, 0.2, 0.1]
contrast = 0.25
scale = 6
octaves = 2
[[pillar]]
position = [2, 3, 4]
radius = 0.25
height = 1.5
color = [0.6, 0.5, 0.4]
translucence = 0.75
depth = 0.4
[[surface]]
mesh = "cube"
position = [3, 4, 5]
rotation_degrees = [15, -25]
scale = 2.5
color = [0.4, 0.6, 0.2]
crease_degrees = 75
grain = { pattern = "stripes", scale = 3 }
[[lamp]]
position = [4, 5, 6]
color = [3, 2, 1]
distance = 2.5
[[system]]
name = "first"
position = [1, 2, 3]
rotation_degrees = [-90, 45.5]
first_frame = 3
end_frame = 9
trigger_frames = [-5, 0, 40]
birth_moment = "within_frame"
particle_space = "world"
initial_mean_parts = 100.5
delta_mean_parts = -2
quadratic_mean_parts = 0.5
cubic_mean_parts = -0.25
var_parts = 20
delta_var_parts = 1.5
quadratic_var_parts = -0.75
cubic_var_parts = 0.125
mean_parts_wander = 0.3
mean_parts_wander_frames = 12
birth_rounding = "nearest"
generation_shape = { kind = "rectangle", length = 2, width = 0.5 }
ejection_axis = "around"
ejection_angle_degrees = 30
ejection_spread = "angle"
speed = { mean = -0.1, var = 0.02 }
lifetime = { mean = 60, var = 10 }
color = { mean = [0.4, 0.1, 0.02], var = [0.1, 0, 0], rate = [0, -0.01, 0.01], rate_var = [0, 0, 0.005] }
transparency = { mean = 0.25, var = 0.125, rate = 0.5, rate_var = 0.0625 }
size = { mean = 0.02, var = 0.01, rate = -0.001, rate_var = 0.0005 }
acceleration = [0, -0.01, 0]
drag = 0.05
integration = "parabola"
particle_shape = "streak"
blend = "over"
shading = "lit_sphere"
edge_softness = 0.75
streak_light = "constant"
stroke_taper = 0.25
stroke_pieces = 5
stroke_shadow = 0.125
intensity_threshold = 0.01
intensity = "luminance"
light_distance = 7.5
light = 2.5
[[system.burst]]
frame = 13
parts = { mean = 500, var = 50 }
[[system.burst]]
frame = 4
parts = 7
[[system.extinction]]
kind = "distance"
direction = [0, 3, 4]
distance = -2
[[system.extinction]]
kind = "plane"
point = [1, 0, 0]
normal = [0, 2, 0]
[[system.extinction]]
kind = "sphere"
center = [0, 1, 2]
radius = 0.5
kills = "inside"
[[system.extinction]]
kind = "box"
min = [-1, -2, -3]
max = [1, 2, -0.5]
kills = "outside"
[[system]]
name = "second"
parent = "rings"
child_up = "outward"
acceleration_space = "system"
initial_mean_parts_per_area = 0.5
delta_mean_parts_per_area = 0.1
quadratic_mean_parts_per_area = 0.01
cubic_mean_parts_per_area = -0.001
var_parts_per_area = 0.25
delta_var_parts_per_area = 0.02
quadratic_var_parts_per_area = -0.002
cubic_var_parts_per_area = 0.0002
generation_shape = { kind = "circle", radius = 3 }
speed = 1
lifetime = 2
color = [1, 1, 1]
size = 1
[system.inherit]
mean_parts = 0.5
var_parts = 0.25
generation_scale = 0.125
ejection_angle_degrees = 4
speed = { mean = 0.1, var = 0.2 }
lifetime = { mean = 3, var = 4 }
color = { mean = [0.1, 0.2, 0.3], var = [0.4, 0.5, 0.6], rate = [0.01, 0.02, 0.03], rate_var = [0.04, 0.05, 0.06] }
transparency = { mean = 0.11, var = 0.12, rate = 0.13, rate_var = 0.14 }
size = { mean = 0.21, var = 0.22, rate = 0.23, rate_var = 0.24 }
[[system]]
name = "rings"
initial_mean_parts = 2
generation_shape = { kind = "circle", radius = 1 }
speed = 0
color = [0, 0, 0]
size = 1
[[flock]]
name = "flock"
count = 30
dimensions = 3
start_speed = 0.5
max_speed = 1.5
mass = 2
force = [0, 0.1, -0.1]
perception_radius = 25
edges = { kind = "wrap", min = [-1, -2, -3], max = [1, 2, 3] }
shape = "disc"
size = 4
color = [0.1, 0.2, 0.3]
drag = 0.25
opacity = 0.6
trail_frames = 12
mirrored = true
[flock.region]
min = [0, 1, -2]
max = [3, 4, 5]
[flock.goal]
position = [7, 8, 9]
weight = 0.25
speed = 3
limit = 0.7
slowing_radius = 11
[[flock.obstacle]]
kind = "sphere"
center = [1, 2, -3]
radius = 4
stay = "inside"
margin = 6
limit = 0.9
[[flock.obstacle]]
kind = "plane"
point = [0, -1, 2]
normal = [3, 0, 1]
margin = 7
limit = 0.8
[[flock.obstacle]]
kind = "box"
min = [-5, -4, -3]
max = [2, 3, 4]
stay = "inside"
margin = 8
limit = 0.6
[[flock.obstacle]]
kind = "mesh"
mesh = "cube"
position = [2, 1, -1]
scale = 1.5
stay = "inside"
margin = 9
limit = 0.4
[[flock.relation]]
kind = "flock"
other = "hunters"
radius = 12
view_angle_degrees = 270
nearest = 7
separation_weight = 0.5
separation_speed = 3
separation_limit = 0.1
separation = "inverse_distance"
alignment_weight = -1
alignment_speed = 2
alignment_limit = 0.4
cohesion_weight = 0
cohesion_speed = 1
cohesion_limit = 0.6
[[flock.relation]]
kind = "avoid"
other = "flock"
radius = 7
view_angle_degrees = 180
nearest = 5
limit = 0.8
[[flock.relation]]
kind = "approach"
other = "hunters"
radius = 8
view_angle_degrees = 90
nearest = 3
limit = 0.9
[[flock]]
name = "hunters"
count = 3
region = { min = [0, 0, 0], max = [1, 1, 1] }
[[fire]]
name = "pyre"
position = [1, 2, 3]
rotation_degrees = [10, 20]
roots = { kind = "circle", radius = 2, count = 7 }
height = { mean = 2, var = 0.5 }
width = { mean = 0.5, var = 0.1 }
base_width = 0.6
swell = 0.3
base_height = 0.25
height_growth = 0.05
speed = "free"
start_speed = 3
buoyancy = 0.9
gravity = [0, -2, 1]
noisiness = 0.02
sampling = 0.3
inverse_cohesion = 1.5
wind_factor = 4
brightness = 1.25
color_noise = 0.4
color_noise_scale = 3
inner_radius = 0.3
inner_alpha = 1.5
blackbody = [1900, 1500]
blackbody_rim = 0.875
details = 3
detail_spread = 0.625
detail_alpha = 0.375
form = "strip"
strip_cells = [3, 7]
strip_contrast = 0.75
particle_matrix = [1, 0.5, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
matrix_noise = 0.125
light = 7
lights = 5
light_from = "tip"
first_frame = -3
kindling_frames = 10
lifetime = 90
growth_frames = 6
[[fire.flame]]
position = [0, 1, 2]
normal = [0, 1, 1]
height = 3
width = 0.75
brightness = 0.5
first_frame = 12
[[fire.ramp]]
age = 0.25
center = [1, 0.75, 0.5]
rim = [0.5, 0.25, 0]
alpha = 0.5
rim_alpha = 0.125
[[fire.profile]]
age = 0.75
width = 1.5
height = 0.875
[fire.spread]
mesh = "cube"
scale = 2
time_scale = 0.25
opposed_flux = 0.1
concurrent_flux = 0.2
ignition_heat = 0.75
drop_distance = 0.3
separation = 0.15
curvature_distance = 0.05
catch_points = 12
law = "stain"
curvature = "literal"
heading = "normal"
insertion = "midpoint"
double_burning = "ignored"
drop_counter = "carry"
max_flames = 300
max_points = 5000
[fire.spread.char]
size = 0.5
opacity = 0.75
edge_softness = 0.5
glow = [2, 0.5, 0.25]
glow_frames = 40
appear_frames = 3
max_marks = 700
[fire.spread.line]
width = 0.03
color = [0.5, 1, 0.25]
opacity = 0.625
[[fire.spread.ignition]]
position = [0, 0, 2]
first_frame = 4
points = 24
[[fire.spread.material]]
part = "+z"
speed = 1.5
thickness = 0.02
conductivity = 0.25
lifetime = 77
[fire.spread.smoke]
speed = 0.03
frames = 30
size = 0.2
growth = 2
color = [0.25, 0.5, 0.75]
opacity = 0.375
max_puffs = 600
[fire.spread.grain]
pattern = "stripes"
direction = [1, 0, 0]
scale = 4
strength = 0.25
shift = 0.5
noise_scale = 2
[fire.spread.formula]
flame_temperature = 1200
fuel_temperature = 350
conductivity = 0.06
emissivity = 0.3
flame_length = 0.2
flame_angle_degrees = 40
thickness = 0.01
density = 450
enthalpy = 250_000
[[wind]]
kind = "uniform"
velocity = [0.01, 0.02, 0.03]
[[wind]]
kind = "buoyancy"
gravity = [0, -2, 0]
strength = 0.04
[[wind]]
kind = "gusts"
velocity = [0.05, 0, 0]
amplitude = 0.75
frames = 20
[[wind]]
kind = "vortex"
position = [1, 2, 3]
axis = [0, 0, 2]
speed = -0.06
radius = 0.7
[[wind]]
kind = "source"
position = [4, 5, 6]
strength = 0.08
radius = 0.9
[[wind]]
kind = "sink"
position = [7, 8, 9]
strength = 0.11
radius = 1.2
[[wind]]
kind = "attractor"
position = [-1, -2, -3]
speed = 0.13
radius = 1.4
[[wind]]
kind = "noise"
strength = 0.15
scale = [1, 2, 0]
drift = [0, 0.5, 0]
octaves = 3
spectrum_exponent = 2.5
absolute = true
[[wind]]
kind = "curl"
strength = 0.16
scale = [3, 3, 3]
drift = [0.25, 0, 0]
octaves = 2
spectrum_exponent = 3
absolute = false
[[layer]]
name = "smoke"
point = [0, 0, -2]
normal = [0, 0, 3]
[[layer]]
name = "far"
point = [0, 0, -4]
normal = [0, 1, 1]
"#;

/// A scene with values that change.
pub(crate) const KEYED: &str = r#"
[image]
exposure = { keys = [[0, 1], [30, 0.5]] }
[camera]
position = { keys = [[0, [0, 1, 5]], [24, [3, 1, 4]], [48.5, [5, 1, 0]]], interpolation = "smooth" }
target = [0, 0, 0]
[[system]]
name = "only"
initial_mean_parts = { keys = [[-10, 0], [10, 100]] }
generation_shape = { kind = "ring", inner_radius = { keys = [[0, 0.5], [9, 1]] }, outer_radius = 1 }
speed = { keys = [[0, 0.1], [12, 0.2]], interpolation = "step" }
lifetime = { mean = 60, var = { keys = [[0, 0], [10, 30]] } }
color = { keys = [[0, [1, 1, 1]], [10, [0.5, 0, 0]]] }
size = 0.02
"#;

/// The index of the first line of [`FULL`] that begins `key = ` in the section: empty for the top
/// of the file, `wind.noise` for a table by its kind. Keys of a `generation_shape` of any kind are
/// on its line.
fn index_of(section: &str, key: &str) -> usize {
    let (section, key) = match section.split_once('.') {
        Some(("generation_shape", _)) => ("system", "generation_shape"),
        Some(("edges", _)) => ("flock", "edges"),
        Some(("roots", _)) => ("fire", "roots"),
        _ => (section, key),
    };
    let mut current = String::new();
    for (i, line) in FULL.lines().enumerate() {
        if line.starts_with('[') {
            current = line
                .trim_matches(['[', ']'])
                .replace("system.", "")
                .replace("flock.", "")
                .replace("fire.", "")
                .replace("spread.", "");
        } else if let Some(kind) = line.strip_prefix("kind = ") {
            current = format!("{current}.{}", kind.trim_matches('"'));
        }
        if current == section && line.starts_with(&format!("{key} = ")) {
            return i;
        }
    }
    panic!("the full scene has no key {section}.{key}")
}

fn replaced(index: usize, line: &str) -> String {
    let mut lines: Vec<&str> = FULL.lines().collect();
    lines[index] = line;
    lines.join("\n") + "\n"
}

/// The line, from 1, that the key stands on in [`FULL`] and what [`with`] makes of it.
pub(crate) fn line_of(section: &str, key: &str) -> usize {
    index_of(section, key) + 1
}

/// The line, from 1, of the header of the table that the key stands in.
pub(crate) fn header_of(section: &str, key: &str) -> usize {
    let before: Vec<&str> = FULL.lines().take(index_of(section, key)).collect();
    let header = before.iter().rposition(|line| line.starts_with('['));
    header.map_or(1, |index| index + 1)
}

/// [`FULL`] with another value for one key.
pub(crate) fn with(section: &str, key: &str, value: &str) -> String {
    let line = match section.split_once('.') {
        Some((variants @ ("generation_shape" | "edges" | "roots"), kind)) => {
            let fields = fields_of(section).iter();
            let others = fields.filter(|field| field.key != key);
            let others = others.map(|field| format!("{} = {}, ", field.key, field.sample()));
            let others: String = others.collect();
            format!("{variants} = {{ kind = \"{kind}\", {others}{key} = {value} }}")
        }
        _ => format!("{key} = {value}"),
    };
    replaced(index_of(section, key), &line)
}

/// The rows of the schema for a section of [`FULL`].
pub(crate) fn fields_of(section: &str) -> &'static [Field] {
    let (variants, kind) = match section.split_once('.') {
        Some(("generation_shape", kind)) => (schema::GENERATION_SHAPES, kind),
        Some(("extinction", kind)) => (schema::EXTINCTIONS, kind),
        Some(("wind", kind)) => (schema::WINDS, kind),
        Some(("edges", kind)) => (schema::EDGES, kind),
        Some(("roots", kind)) => (schema::ROOTS, kind),
        Some(("relation", kind)) => (schema::RELATIONS, kind),
        Some(("obstacle", kind)) => (schema::OBSTACLES, kind),
        _ => {
            return match section {
                "" => schema::SCENE,
                "image" => schema::IMAGE,
                "camera" => schema::CAMERA,
                "light" => schema::LIGHT,
                "system" => schema::SYSTEM,
                "flock" => schema::FLOCK,
                "region" => schema::REGION,
                "goal" => schema::GOAL,
                "fire" => schema::FIRE,
                "flame" => schema::FLAME,
                "ramp" => schema::RAMP,
                "profile" => schema::PROFILE,
                "spread" => schema::SPREAD,
                "ignition" => schema::IGNITION,
                "material" => schema::MATERIAL,
                "formula" => schema::FORMULA,
                "grain" => schema::GRAIN,
                "smoke" => schema::SMOKE,
                "char" => schema::CHAR,
                "line" => schema::LINE,
                "burst" => schema::BURST,
                "inherit" => schema::INHERIT,
                "planet" => schema::PLANET,
                "lamp" => schema::LAMP,
                "ground" => schema::GROUND,
                "pillar" => schema::PILLAR,
                "surface" => schema::SURFACE,
                "layer" => schema::LAYER,
                _ => panic!("no section {section}"),
            };
        }
    };
    let variant = variants.iter().find(|variant| variant.name == kind);
    variant.expect("a kind of the schema").fields
}

/// [`FULL`] without one key; its line stays, empty.
pub(crate) fn without(section: &str, key: &str) -> String {
    replaced(index_of(section, key), "")
}

/// [`FULL`] with another line before the key's.
pub(crate) fn with_line_before(section: &str, key: &str, line: &str) -> String {
    let index = index_of(section, key);
    let old = FULL.lines().nth(index).unwrap_or_default();
    replaced(index, &format!("{line}\n{old}"))
}

/// The error that the text is refused with.
#[track_caller]
pub(crate) fn refused(text: &str) -> SceneError {
    match parse(text, FILE, "some") {
        Ok(_) => panic!("this was accepted:\n{text}"),
        Err(error) => error,
    }
}

/// The scene that the text is.
#[track_caller]
pub(crate) fn accepted(text: &str) -> Scene {
    parse(text, FILE, "some").unwrap_or_else(|error| panic!("{error}\n{text}"))
}
