//! `motes bench` as a program.

use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

use motes::bench::read_records;

use crate::SMALL;

fn motes(folder: &Path, arguments: &[&str]) -> Command {
    std::fs::write(folder.join("small.toml"), SMALL).expect("a temporary folder");
    let program = env!("CARGO_BIN_EXE_motes");
    let mut command = if cfg!(target_os = "linux") {
        // Tests that run in the background may ignore signals, and so would what they start.
        let mut command = Command::new("/usr/bin/env");
        command.args(["--default-signal=INT", program]);
        command
    } else {
        Command::new(program)
    };
    command
        .arg("bench")
        .args(arguments)
        .current_dir(folder)
        .env_remove("MOTES_ADAPTER")
        .env("NODEVICE_SELECT", "1");
    command
}

fn ended(folder: &Path, arguments: &[&str]) -> Output {
    motes(folder, arguments).output().expect("it is started")
}

#[test]
fn one_call_tells_prints_and_writes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let here = folder.path();
    let ended = ended(
        here,
        &[
            "small.toml",
            "--particles",
            "2e3,500,2000",
            "--frames",
            "3",
            "--adapter",
            "llvmpipe,cpu",
            "--json",
            "out/a.json",
            "--csv",
            "out/a.csv",
            "--html",
            "out/a.html",
        ],
    );
    let told = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(0), "{told}");
    // Nothing moves in a pipe.
    assert!(!told.contains('\r') && !told.contains('\u{1b}'), "{told:?}");
    assert!(told.contains("motes: measuring on llvmpipe"), "{told}");
    let printed = String::from_utf8_lossy(&ended.stdout);
    for words in [
        "particles/advance",
        "draw/splat",
        "advance",
        "2,000 particles",
    ] {
        assert!(printed.contains(words), "{words}: {printed}");
    }
    let records = read_records(&here.join("out/a.json")).expect("records");
    let names: Vec<_> = records
        .iter()
        .map(|record| record.backend.as_str())
        .collect();
    assert_eq!(names, ["vulkan", "cpu"]);
    for record in &records {
        // In ascending order, each once.
        let counts: Vec<_> = record.runs.iter().map(|run| run.particles).collect();
        assert_eq!(counts, [500, 2000]);
        assert!(
            record
                .micro
                .iter()
                .any(|measure| measure.name == "copy_kernel")
        );
    }
    for file in ["out/a.csv", "out/a.html"] {
        let text = std::fs::read_to_string(here.join(file)).expect("it is written");
        assert!(text.contains("advance"), "{file}");
    }
}

#[test]
fn one_adapter_makes_one_record_and_micro_alone_no_run() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let here = folder.path();
    let arguments = [
        "--micro",
        "--particles",
        "400,300",
        "--frames",
        "1",
        "--adapter",
        "cpu",
    ];
    let ended = ended(here, &[&arguments[..], &["--json", "m.json"]].concat());
    assert_eq!(
        ended.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&ended.stderr)
    );
    let text = std::fs::read_to_string(here.join("m.json")).expect("it is written");
    assert!(text.starts_with('{'), "one record stands by itself");
    let records = read_records(&here.join("m.json")).expect("a record");
    assert!(records[0].runs.is_empty());
    let names: Vec<_> = records[0].micro.iter().map(|of| of.name.as_str()).collect();
    assert_eq!(names[0], "copy_kernel@300");
    assert!(names.contains(&"copy_kernel@400") && names.contains(&"splat_streaks@300"));
    // Of a copy of its own, out of caches.
    assert!(
        records[0]
            .copy_kernel_gb_per_s
            .is_some_and(|rate| rate > 0.0)
    );
}

#[cfg(unix)]
/// What --set changed is another scene in the record.
#[test]
fn changed_scenes_are_called_by_their_changes() {
    let folder = tempfile::tempdir().expect("there is room");
    let out = ended(
        folder.path(),
        &[
            "fountain",
            "--adapter",
            "cpu",
            "--frames",
            "1",
            "--set",
            "image.width=64",
            "--set",
            "image.height=36",
            "--json",
            "r.json",
        ],
    );
    assert!(
        out.status.success(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    let records =
        motes::bench::read_records(&folder.path().join("r.json")).expect("it is a record");
    let run = &records[0].runs[0];
    assert_eq!(run.scene, "fountain with image.height=36, image.width=64");
    assert_eq!(run.image_px, Some([64, 36]));
}

#[test]
fn control_c_ends_it_cleanly_and_nothing_is_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let here = folder.path();
    // So many that a moment's frames do not agree well enough.
    let arguments = [
        "small.toml",
        "--adapter",
        "cpu",
        "--particles",
        "200000",
        "--noise",
        "0.01",
        "--seconds",
        "600",
    ];
    let mut command = motes(here, &[&arguments[..], &["--json", "a.json"]].concat());
    let child = command
        .stderr(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .spawn()
        .expect("it is started");
    std::thread::sleep(Duration::from_millis(1500));
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status();
    assert!(sent.expect("kill is there").success());
    let ended = child.wait_with_output().expect("it ends");
    let told = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(130), "{told}");
    assert!(told.contains("stopped; nothing was written"), "{told}");
    let left: Vec<_> = std::fs::read_dir(here)
        .expect("it is there")
        .flatten()
        .collect();
    assert_eq!(left.len(), 1, "{left:?}");
}
