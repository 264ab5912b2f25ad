//! Reports that cannot be written: told before the work, and what was measured is shown all the same.
#![cfg(target_os = "linux")]

use crate::Workshop;
use crate::refused::refused;

#[test]
fn reports_that_cannot_be_written_are_told_before_the_work() {
    let here = Workshop::new();
    let bench = ["bench", "sparks.toml", "--adapter", "cpu", "--frames", "1"];
    let check = ["check", "sparks.toml", "--adapter", "cpu"];
    for (command, report) in [
        (&bench[..], "--json"),
        (&bench, "--csv"),
        (&bench, "--html"),
        (&check, "--json"),
        (&check, "--junit"),
    ] {
        // The kernel's own tree takes no files, from nobody.
        let all = [command, &[report, "/sys/motes.txt"]].concat();
        let ended = refused(&here, &all, 3, &["/sys/motes.txt", "you may write to"]);
        for work in ["measuring", "checking"] {
            assert!(!ended.stderr.contains(work), "{report}: {}", ended.stderr);
        }
    }
}

#[test]
fn what_was_measured_is_shown_although_its_report_finds_no_room() {
    let here = Workshop::new();
    let bench = ["bench", "sparks.toml", "--adapter", "cpu", "--frames", "1"];
    let ended = here.run(&[&bench[..], &["--csv", "/dev/full"]].concat());
    assert_eq!(ended.code, 3, "{}", ended.stderr);
    assert!(ended.stderr.contains("make room"), "{}", ended.stderr);
    assert!(ended.stdout.contains("sparks"), "{}", ended.stdout);
}
