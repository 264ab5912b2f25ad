//! Outputs that cannot be written, or would be written over something.

use crate::all_are_refused;
use crate::commands::one;
use crate::row::Row;

#[test]
fn outputs_that_cannot_be_are_refused() {
    let out = |value, said: &[&str]| one("-o", value, said);
    let resumed = ["-o", "/dev/stdout", "--resume", "--frame", "1"];
    let dump = ["-o", "a.gif", "--dump", "1", "--dump-dir", "sparks.toml"];
    let mut rows = vec![
        out("", &["no name", "name-%04d.png"]),
        out("a.jpg", &["a.jpg", "does not write .jpg", "name.gif"]),
        out("a.png", &["a.png", "10", "--frame"]),
        out("a.svg", &["one frame", "10", "--frame"]),
        out("x%04d", &["x%04d", "use x%04d.png"]),
        out("x%04d.gif", &["x%04d.gif", "name.gif"]),
        out("a-%04d-%04d.png", &["two frame numbers", "keep one"]),
        out("a-%s.png", &["a-%s.png", "%04d"]),
        out(
            "sparks.toml",
            &["sparks.toml is the scene", "path of its own"],
        ),
        out("sparks.toml/x.gif", &["sparks.toml", "folder", "is a file"]),
        Row::render(&["-o", "a.gif", "--layers"], &["--layers", "name-%04d.png"]),
        Row::render(
            &["-o", "a.gif", "--stats", "a.gif"],
            &["(-o)", "(--stats)", "path of its own"],
        ),
        Row::render(
            &["-o", "a.gif", "--stats", "."],
            &["--stats", "is a folder", "name of a file"],
        ),
        Row::render(&["-o", "a.gif", "--stats", ""], &["--stats <FILE.csv>"]),
        Row::render(
            &["-o", "a.gif", "--stats", "sparks.toml"],
            &["sparks.toml is the scene", "path of its own"],
        ),
        Row::render(
            &["-o", "a.gif", "--stats", "sparks.toml/s"],
            &["sparks.toml is a file", "--stats"],
        ),
        Row::render(&dump, &["sparks.toml", "is a file"]),
        Row::render(
            &["-o", "g.gif", "--no-clobber"],
            &["g.gif is there already", "--no-clobber"],
        )
        .file("g.gif", "x"),
        Row::render(
            &["-o", "d", "--no-clobber"],
            &["d/frame-0003.png", "--no-clobber"],
        )
        .file("d/", "")
        .file("d/frame-0003.png", "x"),
        Row::render(&["-o", "d.gif"], &["d.gif", "is a folder"]).file("d.gif/", ""),
        Row::new(
            &["check", "sparks.toml", "--json", "."],
            &["--json", "is a folder", "name of a file"],
        ),
        Row::new(
            &["check", "sparks.toml", "--junit", "sparks.toml/x"],
            &["sparks.toml is a file", "--junit"],
        ),
        Row::new(
            &["check", "sparks.toml", "--json", "x", "--junit", "x"],
            &["--json and --junit", "path of its own"],
        ),
        Row::new(
            &["check", "sparks.toml", "--save", "sparks.toml"],
            &["--save", "sparks.toml is a file"],
        ),
        Row::new(&["schema", "-o", "."], &["directory", "name of a file"]),
        Row::new(
            &["schema", "-o", "sparks.toml/x"],
            &["sparks.toml", "is a file"],
        ),
    ];
    if cfg!(unix) {
        let long = "a".repeat(300) + ".gif";
        rows.push(out(&long, &["too long", "this file system allows"]));
        rows.push(Row::render(&resumed, &["/dev/stdout"]));
    }
    if cfg!(target_os = "linux") {
        let nowhere = ["-o", "/sys/a.gif"];
        rows.push(Row::render(&nowhere, &["/sys/a.gif", "may write to"]).machine());
        rows.push(Row::new(&["schema", "-o", "/sys/x"], &["/sys/x", "may write to"]).machine());
        rows.push(Row::new(&["schema", "-o", "/dev/full"], &["/dev/full", "make room"]).machine());
    }
    all_are_refused(&rows);
}
