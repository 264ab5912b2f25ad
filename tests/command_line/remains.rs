//! What a run leaves alone: files that others write, notes of a run that was stopped, files of
//! others; and what is gone after it, however it ends.
#![cfg(target_os = "linux")]

use crate::refused::refused;
use crate::resume::{CROWDED, stop};
use crate::{Ended, Workshop};

/// Runs a script in the folder, with the program as `$MOTES`; it must not hang.
fn shell(here: &Workshop, script: &str) -> Ended {
    let mut command = std::process::Command::new("timeout");
    command
        .args(["60", "bash", "-c", script])
        .current_dir(here.path(""))
        .env("MOTES", env!("CARGO_BIN_EXE_motes"))
        .env_remove("MOTES_ADAPTER")
        .env("NODEVICE_SELECT", "1");
    Ended::of(command.output())
}

const RENDER: &str = "$MOTES render sparks.toml --adapter cpu -o a.gif";
const CROWD: [&str; 6] = ["render", "crowded.toml", "--adapter", "cpu", "-o", "all"];

fn hidden(here: &Workshop) -> Vec<String> {
    let mut files = here.files();
    files.retain(|name| name.contains(".motes-"));
    files
}

#[test]
fn what_is_open_already_is_written_into_and_not_replaced() {
    let here = Workshop::new();
    here.render(&["-o", "a.gif", "--stats", "plain.csv"]);
    let rows = String::from_utf8(here.read("plain.csv")).expect("it is text");
    for (place, redirected) in [
        ("/dev/stdout", ">>log"),
        ("/dev/fd/1", ">>log"),
        ("/proc/self/fd/1", ">>log"),
        ("/dev/stderr", "2>>log"),
        ("/dev/fd/5", "5>>log"),
        ("link", ">>log"),
    ] {
        here.write("log", "before\n");
        let link = "ln -sf /dev/stdout link";
        let script = format!("{link}; ln -f log other; {RENDER} --stats {place} {redirected}");
        let ended = shell(&here, &script);
        assert_eq!(ended.code, 0, "{place}: {}", ended.stderr);
        let log = String::from_utf8(here.read("log")).expect("it is text");
        // Among what the program says, on standard error.
        let is_said = |line: &&str| !line.starts_with("motes: ");
        let kept: Vec<&str> = log.lines().filter(is_said).collect();
        let expected = format!("before\n{rows}");
        assert_eq!(kept, expected.lines().collect::<Vec<_>>(), "{place}");
        assert!(here.read("other") == here.read("log"), "{place}: replaced");
    }
    // Who writes next goes on behind it.
    let script = format!("{{ echo before; {RENDER} -n --stats /dev/stdout; echo after; }} >log");
    std::fs::remove_file(here.path("a.gif")).expect("it was there");
    let ended = shell(&here, &script);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let log = String::from_utf8(here.read("log")).expect("it is text");
    assert_eq!(log, format!("before\n{rows}after\n"), "{}", ended.stderr);
}

#[test]
fn a_refused_command_leaves_the_notes_of_a_stopped_run() {
    let here = Workshop::new();
    here.write("crowded.toml", CROWDED);
    let ended = stop(&here, &CROWD, "-INT", Some("all/frame-0003.png"));
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    let journal = here.read("all/.frame-%04d.png.0-40.resume/journal");
    for refused_for in [
        &["-n"][..],
        &["--dump", "3", "--dump-dir", "crowded.toml/d"],
    ] {
        refused(&here, &[&CROWD[..], refused_for].concat(), 2, &[]);
        assert!(here.read("all/.frame-%04d.png.0-40.resume/journal") == journal);
    }
    // As of one that was killed when it had put a frame in its place, and not yet noted it.
    let text = String::from_utf8(journal).expect("it is text");
    let last = text.trim_end().rfind('\n').expect("it has many lines");
    here.write("all/.frame-%04d.png.0-40.resume/journal", &text[..=last]);
    let ended = here.run(&[&CROWD[..], &["--resume", "-n"]].concat());
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(ended.stderr.contains("going on after"), "{}", ended.stderr);
}

#[test]
fn signals_close_together_are_one_and_a_later_one_ends_it_at_once() {
    let here = Workshop::new();
    here.write("crowded.toml", CROWDED);
    // Frames that take longer than the signals are apart; the second pair of them is waited for.
    let run = "$MOTES render crowded.toml --adapter cpu --frame 60000 -o all.png";
    let gif = "$MOTES render crowded.toml --adapter cpu --frames 0..60000 -o all.gif";
    let twice = "kill -TERM $!; kill -TERM $!; wait $!; exit $?";
    let ended = shell(&here, &format!("{run} & sleep 1; {twice}"));
    assert_eq!(ended.code, 143, "{}", ended.stderr);
    let stopped = "motes: stopped before frame 60000";
    assert!(ended.stderr.contains(stopped), "{}", ended.stderr);
    let ended = shell(&here, &format!("{gif} & sleep 1; {twice}"));
    assert_eq!(ended.code, 143, "{}", ended.stderr);
    let stopped = "motes: stopped before frame";
    assert!(ended.stderr.contains(stopped), "{}", ended.stderr);
    assert!(hidden(&here).is_empty(), "{:?}", here.files());
}

#[test]
fn asked_again_it_ends_at_once_and_leaves_no_hidden_file() {
    let here = Workshop::new();
    // One frame of it takes far longer than the signals are apart.
    let crowd = crate::SPARKS
        .replace("initial_mean_parts = 20", "initial_mean_parts = 4_000_000")
        .replace("frames = 10", "capacity = 16_000_000\nframes = 10");
    here.write("sparks.toml", crowd);
    let wait = "while ! ls -A | grep -q '^[.]motes-'; do sleep 0.05; done";
    let script =
        format!("{RENDER} & {wait}; kill -TERM $!; sleep 0.8; kill -TERM $!; wait $!; exit $?");
    let ended = shell(&here, &script);
    assert_eq!(ended.code, 143, "{}", ended.stderr);
    assert!(hidden(&here).is_empty(), "{:?}", here.files());
}

#[test]
fn a_signal_that_was_to_be_ignored_is() {
    let here = Workshop::new();
    let script =
        format!("trap '' HUP; {RENDER} --frames 0..400 & sleep 0.3; kill -HUP $!; wait $!");
    let ended = shell(&here, &script);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(!ended.stderr.contains("stopping"), "{}", ended.stderr);
    assert!(here.path("a.gif").exists());
}

#[test]
fn what_a_killed_animation_has_begun_goes_with_the_next_run() {
    let here = Workshop::new();
    let wait = "while ! ls -A | grep -q '^[.]motes-'; do sleep 0.02; done";
    let script = format!(
        "{RENDER} --frames 0..100000 --stats s.csv & {wait}; sleep 0.2; kill -9 $!; wait $!; true"
    );
    let ended = shell(&here, &script);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert_eq!(hidden(&here).len(), 2, "{:?}", here.files());
    here.render(&["-o", "b.gif"]);
    assert_eq!(hidden(&here).len(), 2, "those are of another file");
    here.render(&["-o", "a.gif", "--stats", "s.csv"]);
    assert_eq!(hidden(&here).len(), 0, "{:?}", here.files());
}

#[test]
fn what_was_kept_to_go_on_from_goes_when_a_run_begins_anew() {
    let here = Workshop::new();
    let wait = "while ! ls .a.gif*.resume/frame-0003.png >/dev/null 2>&1; do sleep 0.02; done";
    let script = format!("{RENDER} --frames 0..400 --resume & {wait}; kill -9 $!; wait $!; true");
    let ended = shell(&here, &script);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(!here.files().iter().all(|name| !name.contains(".resume")));
    here.render(&["-o", "b.gif", "--frames", "0..400"]);
    here.render(&["-o", "a.gif", "--frames", "0..3"]);
    assert!(
        !here.files().iter().all(|name| !name.contains(".resume")),
        "of other frames"
    );
    here.render(&["-o", "a.gif", "--frames", "0..400"]);
    assert!(
        here.files().iter().all(|name| !name.starts_with('.')),
        "{:?}",
        here.files()
    );
}

#[test]
fn a_film_into_a_pipe_is_refused_and_nobody_is_waited_for() {
    let here = Workshop::new();
    let script = "mkfifo a.mp4; $MOTES render sparks.toml --adapter cpu -o a.mp4";
    let ended = shell(&here, script);
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert!(ended.stderr.contains("in one go"), "{}", ended.stderr);
}

#[test]
fn errors_name_the_output_and_leave_no_folder() {
    let here = Workshop::new();
    here.write("a.png/keep", "");
    here.write("out/sparks", "a file");
    let render = ["render", "sparks.toml", "--adapter", "cpu"];
    let wrong: &[(&[&str], &[&str])] = &[
        (
            &["-o", "sparks.toml/b.png", "--frame", "0"],
            &["error: sparks.toml/b.png: "],
        ),
        (
            &["-o", "sparks.toml/b-%d.png"],
            &["error: sparks.toml/b-0.png: "],
        ),
        (&[], &["error: out/sparks: ", "it is a file"]),
        (
            &["-o", "newd/x.png", "--frames", "1..3"],
            &["error: newd/x.png: ", "2", "--frame"],
        ),
    ];
    for (arguments, said) in wrong {
        let ended = refused(&here, &[&render[..], arguments].concat(), 2, said);
        assert!(!ended.stderr.contains("journal"), "{}", ended.stderr);
    }
    assert!(!here.path("newd").exists());
    let proc = ["-o", "/proc/x-%d.png"];
    let ended = here.run(&[&render[..], &proc].concat());
    assert!(
        ended.stderr.contains("error: /proc/x-0.png: "),
        "{}",
        ended.stderr
    );
    assert!(!ended.stderr.contains("journal"), "{}", ended.stderr);
    // A name as long as a file system has them.
    let long = format!("{}-%d.png", "x".repeat(240));
    here.render(&["-o", &long]);
    assert!(here.path(&long.replace("%d", "9")).exists());
}

#[test]
fn help_that_cannot_be_printed_is_told_with_exit_code_3() {
    let here = Workshop::new();
    for arguments in ["--help", "--version", "render --help"] {
        let ended = shell(&here, &format!("$MOTES {arguments} >/dev/full"));
        assert_eq!(ended.code, 3, "{arguments}: {}", ended.stderr);
        let told = "error: standard output cannot be written";
        assert!(ended.stderr.starts_with(told), "{}", ended.stderr);
    }
}
