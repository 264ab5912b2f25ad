//! `motes compare` as a program: exit codes, files, several records a side.

use std::path::Path;
use std::process::{Command, Output};

use motes::bench::{Record, records_json, write_records};

use crate::synthetic::{LLVMPIPE, Model};

fn motes(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_motes"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program can be started")
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("there is room");
    let slower = |factor, seed| Model {
        seed,
        slower: Some(("particles/advance", factor)),
        ..LLVMPIPE
    };
    let write = |name: &str, records: &[Record]| {
        write_records(&folder.path().join(name), records).expect("it can be written");
    };
    for (name, model) in [
        ("old", slower(1.0, 1)),
        ("same", slower(1.0, 2)),
        ("new", slower(1.3, 3)),
    ] {
        write(&format!("{name}.json"), &[model.record(&[100_000])]);
    }
    write(
        "cpu.json",
        &[Model {
            adapter: "cpu",
            ..LLVMPIPE
        }
        .record(&[100_000])],
    );
    let many = |first: u64, factor| -> Vec<Record> {
        (first..first + 3)
            .map(|seed| slower(factor, seed).record(&[100_000]))
            .collect()
    };
    write("olds.json", &many(10, 1.0));
    for (at, record) in many(20, 1.3).into_iter().enumerate() {
        write(&format!("new{at}.json"), &[record]);
    }
    folder
}

#[test]
fn the_exit_code_is_the_answer() {
    let folder = folder();
    let code = |arguments: &[&str]| motes(folder.path(), arguments).status.code();
    assert_eq!(code(&["compare", "old.json", "new.json"]), Some(0));
    assert_eq!(
        code(&["compare", "old.json", "new.json", "--fail-above", "10"]),
        Some(1)
    );
    assert_eq!(
        code(&["compare", "old.json", "new.json", "--fail-above", "40%"]),
        Some(0)
    );
    assert_eq!(
        code(&["compare", "old.json", "same.json", "--fail-above", "2"]),
        Some(0)
    );
    assert_eq!(code(&["compare", "old.json", "cpu.json"]), Some(2));
    assert_eq!(
        code(&["compare", "old.json", "cpu.json", "--any-adapter"]),
        Some(0)
    );
}

/// Yardsticks are in every record: they do not make records of different scenes comparable.
#[test]
fn records_of_different_scenes_are_refused() {
    let folder = folder();
    let mut other = LLVMPIPE.record(&[100_000]);
    other.runs[0].scene = "million with image.width=640".to_owned();
    write_records(&folder.path().join("other.json"), &[other.clone()]).expect("it can be written");
    other.runs.clear();
    write_records(&folder.path().join("alone.json"), &[other]).expect("it can be written");
    let told = |files: [&str; 2]| {
        let out = motes(folder.path(), &["compare", files[0], files[1]]);
        let text = String::from_utf8_lossy(&out.stderr).into_owned();
        (out.status.code(), text)
    };
    let (code, text) = told(["old.json", "other.json"]);
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("no scene at the same count"), "{text}");
    assert_eq!(told(["alone.json", "alone.json"]).0, Some(0));
    assert_eq!(told(["old.json", "alone.json"]).0, Some(0));
}

#[test]
fn several_records_a_side_come_in_one_file_or_in_many() {
    let folder = folder();
    let out = motes(
        folder.path(),
        &[
            "compare",
            "olds.json",
            "new0.json,new1.json,new2.json",
            "--fail-above",
            "5",
        ],
    );
    let text = String::from_utf8(out.stdout).expect("it is text");
    assert_eq!(out.status.code(), Some(1), "{text}");
    assert!(
        text.contains("3 records before, 3 records now, in pairs"),
        "{text}"
    );
    assert!(text.contains("FAILED: slower by more than 5 %"), "{text}");
    assert!(
        text.contains("Slowed most: particles/advance of million at 100,000 particles"),
        "{text}"
    );
    for line in text.lines() {
        assert!(line.chars().count() <= 100, "{line}");
    }
}

#[test]
fn the_report_says_the_same() {
    let folder = folder();
    let arguments = [
        "compare",
        "old.json",
        "new.json",
        "--fail-above",
        "10",
        "--json",
        "report.json",
    ];
    let out = motes(folder.path(), &arguments);
    assert_eq!(out.status.code(), Some(1));
    let text = std::fs::read_to_string(folder.path().join("report.json")).expect("it was written");
    let report: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
    assert_eq!(
        (&report["schema"], &report["fails"]),
        (&1.into(), &true.into())
    );
    let compared = report["comparisons"][0]["compared"]
        .as_array()
        .expect("it is a list");
    assert_eq!(compared.len(), 4 + 7 + 3);
    let failing: Vec<&str> = compared
        .iter()
        .filter(|it| it["fails"] == true)
        .filter_map(|it| it["name"].as_str())
        .collect();
    assert!(
        failing.contains(&"particles/advance") && !failing.contains(&"draw/splat"),
        "{failing:?}"
    );
    for it in compared {
        let number = |key: &str| it[key].as_f64().expect("it is a number");
        assert!(
            number("low") <= number("ratio") && number("ratio") <= number("high"),
            "{it}"
        );
    }
    assert!(
        report["comparisons"][0]["slowed_most"]
            .as_str()
            .is_some_and(|it| it.starts_with("particles/advance of"))
    );
}

/// The reader is strict where numbers would mislead.
#[test]
fn impossible_numbers_are_refused() {
    let refused = |change: &dyn Fn(&mut Record), words: &str| {
        let mut record = LLVMPIPE.record(&[1000]);
        change(&mut record);
        let (problem, _) =
            motes::bench::parse_records(records_json(&[record]).as_bytes()).expect_err(words);
        assert!(problem.contains(words), "{problem}");
    };
    refused(
        &|it| it.runs[0].passes[0].ms.samples[3] = -1.0,
        "no time is negative",
    );
    refused(&|it| it.runs[0].frame_ms.p90 = 0.0, "out of order");
    refused(
        &|it| it.micro[1].name = it.micro[0].name.clone(),
        "stands twice",
    );
    refused(&|it| it.runs.push(it.runs[0].clone()), "stands twice");
    refused(&|it| it.schema = 2, "schema 2");
    refused(&|it| it.runs[0].step_ms.median = f64::NAN, "null");
}

#[test]
fn the_schema_is_printed() {
    let folder = folder();
    let out = motes(folder.path(), &["schema", "bench"]);
    assert_eq!(out.status.code(), Some(0));
    assert_eq!(out.stdout, motes::bench::record_schema().as_bytes());
    assert_eq!(
        motes(folder.path(), &["schema", "bench", "--markdown"])
            .status
            .code(),
        Some(2)
    );
}

#[test]
fn records_are_shown_again() {
    let folder = folder();
    let out = motes(folder.path(), &["report", "old.json", "cpu.json"]);
    let text = String::from_utf8(out.stdout).expect("it is text");
    assert!(
        text.contains("llvmpipe, Mesa") && text.contains("\ncpu, motes"),
        "{text}"
    );
    let arguments = [
        "report", "old.json", "cpu.json", "--html", "all.html", "--csv", "all.csv",
    ];
    let out = motes(folder.path(), &arguments);
    assert_eq!(
        (out.status.code(), out.stdout.as_slice()),
        (Some(0), &b""[..])
    );
    let told = String::from_utf8(out.stderr).expect("it is text");
    assert!(
        told.contains("wrote all.html: a page of 2 records"),
        "{told}"
    );
    assert!(told.contains("wrote all.csv: 30 measurements"), "{told}");
    let read =
        |name: &str| std::fs::read_to_string(folder.path().join(name)).expect("it was written");
    assert!(read("all.html").contains("<h1>Motes on llvmpipe, cpu</h1>"));
    assert_eq!(read("all.csv").lines().count(), 1 + 2 * (4 + 7 + 4));
}
