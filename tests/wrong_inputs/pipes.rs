//! Readers that go away, as `head` does.

use std::process::Stdio;

use crate::row::{Ended, Workshop};

#[test]
fn a_closed_standard_output_ends_in_one_message_and_exit_code_3() {
    let here = Workshop::new(&[]);
    let commands: [&[&str]; 5] = [
        &["scenes", "--show", "million"],
        &["scenes"],
        &["scenes", "--knobs", "million"],
        &["schema"],
        &["adapters", "--json"],
    ];
    for arguments in commands {
        let (reader, writer) = std::io::pipe().expect("the system has pipes");
        drop(reader);
        let ended = Ended::of(here.command(arguments).stdout(writer));
        assert_eq!(ended.code, Some(3), "{arguments:?}\n{}", ended.stderr);
        let lines: Vec<&str> = ended.stderr.lines().collect();
        assert_eq!(lines.len(), 2, "{arguments:?}\n{}", ended.stderr);
        let said = "error: standard output cannot be written: ";
        assert!(lines[0].starts_with(said), "{}", ended.stderr);
        assert!(lines[1].starts_with("  = help: "), "{}", ended.stderr);
    }
}

/// Pictures are what was asked for; that nobody reads how it went is no reason to give up.
#[test]
fn a_closed_standard_error_keeps_nothing_from_its_end() {
    let here = Workshop::new(&[]);
    let closed = |arguments: &[&str]| {
        let (reader, writer) = std::io::pipe().expect("the system has pipes");
        drop(reader);
        let mut command = here.command(arguments);
        let status = command.stdout(Stdio::null()).stderr(writer).status();
        status.expect("the program can be started").code()
    };
    let render = ["render", "sparks.toml", "--adapter", "cpu", "-o"];
    assert_eq!(closed(&[&render[..], &["a.gif"]].concat()), Some(0));
    assert!(here.has("a.gif"));
    assert_eq!(closed(&[&render[..], &["a.jpg"]].concat()), Some(2));
    assert_eq!(closed(&["render", "nothing"]), Some(2));
    assert_eq!(closed(&["--wobble"]), Some(2));
}
