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
        out("sparks.toml", &["does not write .toml", "`sparks.toml/`"]),
        out(
            "sparks.toml/",
            &["sparks.toml/: frames go to a folder", "it is a file"],
        ),
        out(
            "1s.mp",
            &["does not write .mp", "did you mean `.mp4`?", "`1s.mp/`"],
        ),
        out("k.pgn", &["did you mean `.png`?", "folder"]),
        out("k.GFI", &["did you mean `.gif`?", "folder"]),
        out(
            "k.final",
            &["does not write .final", "`k.final/`", "name.mp4"],
        ),
        Row::render(
            &["-o", "d", "--inputs", "d/frame-0003.png"],
            &[
                "d/frame-0003.png is the recording (--inputs)",
                "written over",
            ],
        )
        .file("d/", "")
        .file("d/frame-0003.png", "3 system.0.speed=0.2\n"),
        Row::render(
            &[
                "-o",
                "d",
                "--layers",
                "--inputs",
                "./d/frame-0003-particles.png",
            ],
            &["is the recording (--inputs)", "written over"],
        )
        .file("d/", "")
        .file("d/frame-0003-particles.png", "3 system.0.speed=0.2\n"),
        Row::render(
            &["-o", "a.gif", "--inputs", ".a.gif.0-10.resume/r"],
            &["the recording (--inputs) is in the folder", "--resume"],
        )
        .file(".a.gif.0-10.resume/", "")
        .file(".a.gif.0-10.resume/r", "3 system.0.speed=0.2\n"),
        Row::render(
            &["-o", "new/../x.gif", "--stats", "x.gif"],
            &["(-o)", "(--stats)", "path of its own"],
        ),
        Row::new(
            &[
                "bench",
                "sparks.toml",
                "--adapter",
                "cpu",
                "--html",
                "sparks.toml",
            ],
            &["sparks.toml is the scene", "written over"],
        ),
        Row::new(
            &[
                "bench",
                "sparks.toml",
                "--adapter",
                "cpu",
                "--csv",
                "d/../a",
                "--json",
                "./a",
            ],
            &["--csv and --json", "same place", "path of its own"],
        )
        .file("d/", ""),
        Row::new(
            &[
                "bench",
                "sparks.toml",
                "--adapter",
                "cpu",
                "--csv",
                "a",
                "--json",
                "a/b",
            ],
            &["--csv and --json", "same place", "path of its own"],
        ),
        Row::new(
            &["check", "sparks.toml", "--json", "./sparks.toml"],
            &["sparks.toml is the scene", "written over"],
        ),
        Row::new(
            &["check", "sparks.toml", "--json", "d", "--save", "./d"],
            &["--json and --save", "path of its own"],
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

#[cfg(unix)]
#[test]
fn links_to_what_is_read_are_not_written_through() {
    use crate::row::Workshop;
    use std::os::unix::fs::symlink;
    let here = Workshop::new(&[
        ("d/", Vec::new()),
        ("r", b"3 system.0.speed=0.2\n".to_vec()),
    ]);
    symlink(here.path("sparks.toml"), here.path("link")).expect("a link");
    symlink(here.path("r"), here.path("d/frame-0002.png")).expect("a link");
    symlink(here.path(""), here.path("d/up")).expect("a link");
    let before = std::fs::read(here.path("sparks.toml")).expect("it is there");
    let render = ["render", "sparks.toml", "--adapter", "cpu"];
    for (more, said) in [
        (&["-o", "a.gif", "--stats", "link"][..], "link is the scene"),
        (
            &["-o", "a.gif", "--stats", "d/up/sparks.toml"],
            "d/up/sparks.toml is the scene",
        ),
        (
            &["-o", "d", "--inputs", "r"],
            "d/frame-0002.png is the recording",
        ),
        (&["-o", "a.gif", "--stats", "d/up/a.gif"], "same place"),
    ] {
        let ended = here.run(&[&render[..], more].concat());
        assert_eq!(ended.code, Some(2), "{more:?}\n{}", ended.stderr);
        assert!(ended.stderr.contains(said), "{more:?}\n{}", ended.stderr);
    }
    let bench = [
        "bench",
        "link.toml",
        "--adapter",
        "cpu",
        "--json",
        "sparks.toml",
    ];
    symlink(here.path("sparks.toml"), here.path("link.toml")).expect("a link");
    let ended = here.run(&bench);
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.contains("is the scene"), "{}", ended.stderr);
    // Another name of the same file is replaced, and the scene stays what it is.
    std::fs::hard_link(here.path("sparks.toml"), here.path("hard.csv")).expect("a hard link");
    let ended = here.run(&[&render[..], &["-o", "a.gif", "--stats", "hard.csv"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(
        std::fs::read(here.path("hard.csv"))
            .expect("it is there")
            .starts_with(b"frame,")
    );
    assert_eq!(
        std::fs::read(here.path("sparks.toml")).expect("it is there"),
        before
    );
}

#[test]
fn a_folder_may_have_a_dot_in_its_name() {
    let here = crate::row::Workshop::new(&[("k.final/", Vec::new())]);
    for (out, file) in [
        ("k.final", "k.final/frame-0003.png"),
        ("new.final/", "new.final/frame-0003.png"),
        ("v1.2", "v1.2/frame-0003.png"),
        (".hidden", ".hidden/frame-0003.png"),
    ] {
        let ended = here.run(&[
            "render",
            "sparks.toml",
            "--adapter",
            "cpu",
            "--frame",
            "3",
            "-o",
            out,
        ]);
        assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        assert!(here.has(file), "{out}");
    }
}
