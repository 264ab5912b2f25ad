//! Runs that fail when they write: nothing half-written is left, and the machine's fault is told from
//! the user's.

use crate::Workshop;
#[cfg(target_os = "linux")]
use crate::refused::refused;
use crate::refused::render_refused;

#[test]
fn what_fails_on_the_way_leaves_nothing_half_written() {
    let here = Workshop::new();
    // The dump's folder is a file, which is found out at frame 3.
    let dump = ["--dump", "3", "--dump-dir", "sparks.toml/dump"];
    let out = ["-o", "a.gif", "--stats", "s.csv"];
    render_refused(
        &here,
        &[&out[..], &dump[..]].concat(),
        &["sparks.toml/dump", "is a file"],
    );
    // What stood there before still stands there.
    here.write("a.gif", "precious");
    render_refused(
        &here,
        &[&out[..], &dump[..]].concat(),
        &["sparks.toml/dump"],
    );
    assert_eq!(here.read("a.gif"), b"precious");
}

#[cfg(target_os = "linux")]
#[test]
fn a_machine_that_refuses_to_write_ends_in_exit_code_3() {
    let here = Workshop::new();
    let render = ["render", "sparks.toml", "--adapter", "cpu", "--frame", "0"];
    // The kernel's own tree takes no files, from nobody.
    let on = |more: &[&'static str]| [&render[..], more].concat();
    refused(
        &here,
        &on(&["-o", "/sys/motes.png"]),
        3,
        &["/sys/motes.png", "you may write to"],
    );
    refused(
        &here,
        &on(&["-o", "/sys/motes"]),
        3,
        &["/sys/motes", "you may write to"],
    );
    refused(
        &here,
        &on(&["-o", "/sys/motes.gif"]),
        3,
        &["/sys/motes.gif"],
    );
    // A disk that is always full.
    let ended = here.run(&on(&["-o", "a.png", "--stats", "/dev/full"]));
    assert_eq!(ended.code, 3, "{}", ended.stderr);
    assert!(
        ended
            .stderr
            .contains("/dev/full: cannot write: No space left"),
        "{}",
        ended.stderr
    );
    assert!(ended.stderr.contains("make room"), "{}", ended.stderr);
}
