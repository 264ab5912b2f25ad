//! Scene texts for tests, and ways to spoil them.

use motes::scene::{SceneError, parse};

/// What the tests call the file.
pub(crate) const FILE: &str = "folder/some.toml";

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
[image]
width = 640
height = 360
background = [0, 0.5, 1]
shutter = 0.48
[camera]
position = [0, 1, 5]
target = [0, 0, 0]
up = [0.5, 1, 0]
vertical_fov_degrees = 60
near = 0.01
[[system]]
name = "first"
position = [1, 2, 3]
rotation_degrees = [-90, 45.5]
first_frame = 3
end_frame = 9
initial_mean_parts = 100.5
delta_mean_parts = -2
var_parts = 20
birth_rounding = "nearest"
generation_shape = { kind = "rectangle", length = 2, width = 0.5 }
ejection_angle_degrees = 30
speed = { mean = -0.1, var = 0.02 }
lifetime = { mean = 60, var = 10 }
color = { mean = [0.4, 0.1, 0.02], var = [0.1, 0, 0], rate = [0, -0.01, 0.01] }
transparency = { mean = 0.25, var = 0.125, rate = 0.5 }
size = { mean = 0.02, var = 0.01, rate = -0.001 }
acceleration = [0, -0.01, 0]
particle_shape = "streak"
streak_light = "constant"
intensity_threshold = 0.01
[[system]]
name = "second"
initial_mean_parts_per_area = 0.5
delta_mean_parts_per_area = 0.1
var_parts_per_area = 0.25
generation_shape = { kind = "circle", radius = 3 }
speed = 1
lifetime = 2
color = [1, 1, 1]
size = 1
"#;

/// The index of the first line of [`FULL`] that begins `key = ` in the section, which is empty
/// for the top of the file.
fn index_of(section: &str, key: &str) -> usize {
    let key = match section {
        "sphere" | "circle" | "rectangle" => "generation_shape",
        _ => key,
    };
    let section = match key {
        "generation_shape" => "system",
        _ => section,
    };
    let mut current = "";
    for (i, line) in FULL.lines().enumerate() {
        if line.starts_with('[') {
            current = line.trim_matches(['[', ']']);
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

/// [`FULL`] with another value for one key.
pub(crate) fn with(section: &str, key: &str, value: &str) -> String {
    let line = match (section, key) {
        ("rectangle", "length") => {
            format!("generation_shape = {{ kind = \"rectangle\", width = 1, length = {value} }}")
        }
        ("rectangle", _) => {
            format!("generation_shape = {{ kind = \"rectangle\", length = 1, width = {value} }}")
        }
        ("sphere" | "circle", _) => {
            format!("generation_shape = {{ kind = \"{section}\", radius = {value} }}")
        }
        _ => format!("{key} = {value}"),
    };
    replaced(index_of(section, key), &line)
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
