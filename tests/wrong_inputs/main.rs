//! Wrong scenes, recordings and command lines, as a newcomer would type them: each is answered in
//! time with the exit code that says whose fault it is, and with what is wrong, where, and what would
//! be right; nothing is printed or left behind. All on the processor.

mod benches;
mod commands;
mod meshes;
mod outputs;
mod pipes;
mod recordings;
mod records;
mod row;
mod scenes;
mod values;

use row::{Row, Workshop};

/// A scene that takes milliseconds. Lines count from 1.
const SPARKS: &str = r#"title = "Sparks"
frames = 10
seed = 7

[image]
width = 32
height = 18

[camera]
position = [0, 0, 5]
target = [0, 0, 0]

[[system]]
name = "sparks"
initial_mean_parts = 20
var_parts = 8
generation_shape = { kind = "sphere", radius = 0.5 }
speed = { mean = 0.05, var = 0.02 }
lifetime = { mean = 4, var = 1 }
color = [0.5, 0.3, 0.1]
size = 0.05
"#;

/// Tries all rows, and tells about all that are not as they should be.
fn all_are_refused(rows: &[Row]) {
    let faults: Vec<String> = rows.iter().filter_map(Row::fault).collect();
    let (wrong, all) = (faults.len(), rows.len());
    assert!(
        faults.is_empty(),
        "{wrong} of {all} rows:\n\n{}",
        faults.join("\n\n")
    );
}

#[test]
fn the_scene_that_all_others_differ_from_is_right() {
    let here = Workshop::new(&[]);
    let ended = here.run(&["render", "sparks.toml", "--adapter", "cpu", "-o", "a.gif"]);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
}
