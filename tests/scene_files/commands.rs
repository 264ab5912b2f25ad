//! What `motes schema` and `motes scenes --knobs` print, and how they refuse.

use std::process::{Command, Output};

use motes::scene::schema::{json_schema, reference_page};
use motes::scene::{BUILTIN, KnobValue, knobs};
use serde_json::Value;

fn run(arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_motes");
    let ended = Command::new(program).args(arguments).output();
    ended.expect("the program runs")
}

#[track_caller]
fn printed(arguments: &[&str]) -> String {
    let ended = run(arguments);
    assert_eq!(ended.status.code(), Some(0), "{arguments:?}: {ended:?}");
    assert!(ended.stderr.is_empty(), "{ended:?}");
    String::from_utf8(ended.stdout).expect("text")
}

#[test]
fn the_schema_goes_to_standard_output_or_to_a_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("new/some.file");
    let file = path.to_string_lossy();
    assert_eq!(printed(&["schema"]), json_schema());
    assert_eq!(printed(&["schema", "--markdown"]), reference_page());
    for (arguments, wanted) in [
        (&["schema", "-o", &file][..], json_schema()),
        (&["schema", "--markdown", "-o", &file], reference_page()),
    ] {
        let ended = run(arguments);
        assert_eq!(ended.status.code(), Some(0), "{ended:?}");
        assert!(ended.stdout.is_empty(), "{ended:?}");
        let told = String::from_utf8(ended.stderr).expect("text");
        assert_eq!(told, format!("motes: wrote {file}\n"));
        assert_eq!(std::fs::read_to_string(&path).ok(), Some(wanted));
    }
    let ended = run(&["schema", "-o", &folder.path().to_string_lossy()]);
    assert_eq!(ended.status.code(), Some(2), "{ended:?}");
}

#[test]
fn p7_the_program_lists_the_knobs() {
    for scene in BUILTIN.iter().map(|scene| scene.name) {
        let knobs = knobs(scene).expect("a built-in scene");
        let list = printed(&["scenes", "--knobs", scene]);
        let mut lines = list.lines();
        let json: Value =
            serde_json::from_str(&printed(&["scenes", "--knobs", scene, "--json"])).expect("JSON");
        let json = json.as_array().expect("an array");
        assert_eq!(json.len(), knobs.len());
        for (knob, json) in knobs.iter().zip(json) {
            let (value, from, word) = match &knob.value {
                KnobValue::Written(toml) => (toml.as_str(), "scene", "(the scene's"),
                KnobValue::Default(toml) => (toml.as_str(), "default", "(default"),
                KnobValue::None => ("", "none", "(none"),
            };
            assert_eq!(json["path"].as_str(), Some(knob.path.as_str()));
            assert_eq!(json["value"].as_str().unwrap_or_default(), value);
            assert_eq!(json["from"].as_str(), Some(from));
            assert_eq!(json["has_keys"].as_bool(), Some(knob.has_keys));
            assert_eq!(json["unit"].as_str(), Some(knob.field.unit));
            assert_eq!(json["about"].as_str(), Some(knob.about.as_str()));
            let ends = [&json["min"], &json["max"]].map(Value::is_number);
            let has_words = json["choices"]
                .as_array()
                .is_some_and(|words| !words.is_empty());
            let is_flag = json["kind"] == "flag";
            assert_eq!(
                [ends, [has_words || is_flag; 2]]
                    .concat()
                    .iter()
                    .filter(|is| **is)
                    .count(),
                2
            );
            // A line for --set, and one about it.
            let line = format!("{}={value}", knob.path);
            assert!(lines.any(|found| found == line), "{line}");
            let about = lines.next().expect("a line about it");
            let keys = if knob.has_keys { " by keys; " } else { "; " };
            for part in [&knob.about, word, keys, &knob.right()] {
                assert!(about.contains(part), "wants {part}: {about}");
            }
        }
    }
}

#[test]
fn what_has_no_knobs_is_refused() {
    let cases = [
        (
            &["scenes", "--knobs", "fontain"][..],
            "did you mean fountain?",
        ),
        (&["scenes", "--knobs", "nowhere.toml"], "cannot be read"),
        (&["scenes", "--json"], "--knobs"),
        (
            &["scenes", "--knobs", "million", "--show", "million"],
            "cannot be used with",
        ),
    ];
    for (arguments, wanted) in cases {
        let ended = run(arguments);
        assert_eq!(ended.status.code(), Some(2), "{arguments:?}");
        let message = String::from_utf8(ended.stderr).expect("text");
        assert!(message.contains(wanted), "wants {wanted}: {message}");
    }
}
