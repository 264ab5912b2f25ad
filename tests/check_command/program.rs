//! The program: what it prints and writes, and its exit codes.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::common;

fn motes(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_motes"))
        .args(arguments)
        .env_remove("MOTES_ADAPTER")
        .output()
        .expect("the program runs")
}

const SCENE: &str = r#"
frames = 6
[image]
width = 32
height = 18
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "ball"
initial_mean_parts = 40
generation_shape = { kind = "sphere", radius = 1 }
speed = 0.1
lifetime = 3
color = [0.2, 0.3, 0.4]
size = 0.2
"#;

#[test]
fn it_says_equal_and_writes_its_reports() {
    let folder = tempfile::tempdir().expect("writable");
    let path = |file: &str| folder.path().join(file).to_str().expect("UTF-8").to_owned();
    let (scene, json, junit, saved) = (
        path("one & two.toml"),
        path("r/c.json"),
        path("r/c.xml"),
        path("saved"),
    );
    fs::write(&scene, SCENE).expect("writable");
    let adapter = &common::adapters()[0];
    let reports = ["--json", &json, "--junit", &junit, "--save", &saved];
    let arguments = [
        &["check", &scene, "--full", "--adapter", adapter],
        &reports[..],
    ]
    .concat();
    let output = motes(&arguments);
    let stdout = String::from_utf8_lossy(&output.stdout);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{stdout}{stderr}");
    assert_eq!(stdout.lines().count(), 1, "{stdout}");
    assert!(stdout.starts_with("one & two "), "{stdout}");
    let fields: Vec<&str> = stdout.split_whitespace().collect();
    assert_eq!(
        fields[3..7],
        ["6", "frames", "120", "particles"],
        "{stdout}"
    );
    assert_eq!(fields.last(), Some(&"equal"), "{stdout}");
    assert!(stderr.to_lowercase().contains(adapter.as_str()), "{stderr}");
    assert!(stderr.contains("against cpu"), "{stderr}");
    let json = fs::read_to_string(json).expect("it is there");
    for told in [
        "\"equal\": true",
        "\"scene\": \"one & two\"",
        fields[8],
        fields[10],
    ] {
        assert!(json.contains(told), "no `{told}` in {json}");
    }
    let junit = fs::read_to_string(junit).expect("it is there");
    for told in [
        "name=\"one &amp; two\"",
        "tests=\"1\" failures=\"0\" errors=\"0\"",
    ] {
        assert!(junit.contains(told), "no `{told}` in {junit}");
    }
    assert!(!Path::new(&saved).exists(), "there is nothing to save");
}

#[test]
fn it_tells_what_of_the_input_is_at_fault() {
    let adapter = &common::adapters()[0];
    for (arguments, told) in [
        (
            vec!["check", "fountin", "--adapter", adapter],
            "did you mean fountain?",
        ),
        (
            vec!["check", "fountain", "--adapter", "no such thing"],
            "no such thing",
        ),
        (
            vec![
                "check",
                "fountain",
                "--adapter",
                adapter,
                "--against",
                "nothing",
            ],
            "nothing",
        ),
        (
            vec!["check", "fountain", "--adapter", "cpu"],
            "compared with itself",
        ),
        (
            vec![
                "check",
                "fountain",
                "--adapter",
                adapter,
                "--against",
                adapter,
            ],
            "compared with itself",
        ),
        (vec!["check", "fountain", "--frames", "0"], "--frames"),
    ] {
        let output = motes(&arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
        assert!(stderr.contains(told), "{arguments:?}: {stderr}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}

#[test]
fn without_a_driver_there_is_nothing_to_check() {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_motes"))
        .args(["check", "fountain", "--frames", "2"])
        .env("VK_DRIVER_FILES", "/nonexistent")
        .env("VK_ICD_FILENAMES", "/nonexistent")
        .env_remove("MOTES_ADAPTER")
        .output()
        .expect("it starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{stderr}");
    assert!(stderr.contains("mesa-vulkan-drivers"), "{stderr}");
    assert!(output.stdout.is_empty());
}
