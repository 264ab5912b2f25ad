//! Where files go: what stands in their way, what they replace, and that it is said.

use crate::Workshop;
use crate::refused::render_refused;

#[test]
fn folders_of_frames_are_not_files_nor_pipes() {
    let here = Workshop::new();
    here.write("taken", "precious");
    for out in ["taken", "taken/"] {
        let said = format!("{out}: frames go to a folder of this name, and it is a file");
        render_refused(&here, &["-o", out], &[&said, "name.gif"]);
    }
    assert_eq!(here.read("taken"), b"precious");
    render_refused(
        &here,
        &["-o", "-"],
        &["-: pictures do not go to standard output", "./-"],
    );
    if cfg!(unix) {
        let said = ["/dev/stdout: frames go to a folder", "a device or a pipe"];
        render_refused(&here, &["-o", "/dev/stdout"], &said);
    }
}

#[test]
fn schema_and_man_say_what_they_wrote() {
    let here = Workshop::new();
    let ended = here.run(&["schema", "-o", "s.json"]);
    assert_eq!((ended.code, ended.stdout.as_str()), (0, ""));
    assert_eq!(ended.stderr, "motes: wrote s.json\n");
    let ended = here.run(&["man", "-o", "m"]);
    let pages = here
        .files()
        .iter()
        .filter(|it| it.starts_with("m/"))
        .count();
    assert!(pages > 5, "{pages}");
    assert_eq!(ended.stderr, format!("motes: wrote m: {pages} pages\n"));
}

#[test]
fn the_manual_has_every_exit_code() {
    let page = Workshop::new().run(&["man"]).stdout;
    for (code, meaning) in [
        ("1", "it got slower (compare)"),
        ("129, 130, 143", "the terminal was closed"),
    ] {
        let found = page.split(&format!(".TP\n{code}\n")).nth(1);
        let found = found.unwrap_or_else(|| panic!("no {code}: {page}"));
        let line = found.lines().next().expect("a line about it");
        assert!(line.contains(meaning), "{code}: {line}");
    }
}

#[cfg(unix)]
#[test]
fn a_file_that_is_replaced_hands_on_its_permissions() {
    use std::fs::{self, Permissions};
    use std::os::unix::fs::PermissionsExt as _;
    let here = Workshop::new();
    for mode in [0o640, 0o606, 0o444] {
        for name in ["a.gif", "s.csv"] {
            let _ = fs::remove_file(here.path(name));
            here.write(name, "old");
            fs::set_permissions(here.path(name), Permissions::from_mode(mode)).expect("ours");
        }
        here.render(&["-o", "a.gif", "--stats", "s.csv"]);
        for name in ["a.gif", "s.csv"] {
            let found = fs::metadata(here.path(name)).expect("it is there");
            assert_eq!(found.permissions().mode() & 0o777, mode, "{name}");
            assert_ne!(here.read(name), b"old");
        }
    }
}

#[cfg(unix)]
#[test]
fn links_are_followed_to_where_there_is_nothing_yet() {
    use std::os::unix::fs::symlink;
    let here = Workshop::new();
    symlink("far/second.gif", here.path("a.gif")).expect("ours");
    std::fs::create_dir(here.path("far")).expect("ours");
    symlink("real.gif", here.path("far/second.gif")).expect("ours");
    here.render(&["-o", "a.gif"]);
    assert!(here.path("a.gif").is_symlink() && here.path("far/second.gif").is_symlink());
    assert!(here.read("far/real.gif").starts_with(b"GIF89a"));
    symlink("round.gif", here.path("round.gif")).expect("ours");
    render_refused(
        &here,
        &["-o", "round.gif"],
        &["round.gif: links", "in a circle"],
    );
}
