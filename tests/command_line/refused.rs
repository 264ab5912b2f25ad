//! Wrong scenes and wrong command lines: the exit code says whose fault it is, the message names the
//! place and what would be right, and nothing is left behind.

use crate::{Ended, Workshop};

/// Runs the program, which must end with `code`, say all of `said` on standard error, print nothing,
/// and leave the folder's files as they were.
pub(crate) fn refused(workshop: &Workshop, arguments: &[&str], code: i32, said: &[&str]) -> Ended {
    let before = workshop.files();
    let ended = workshop.run(arguments);
    let told = format!("motes {}\n{}", arguments.join(" "), ended.stderr);
    assert_eq!(ended.code, code, "{told}");
    assert!(
        ended.stderr.starts_with("error: ") || ended.stderr.contains("\nerror: "),
        "{told}"
    );
    for words in said {
        assert!(
            ended.stderr.contains(words),
            "`{words}` is not said by {told}"
        );
    }
    assert_eq!(ended.stdout, "", "{told}");
    assert_eq!(workshop.files(), before, "{told}");
    ended
}

/// As [`refused`], rendering `sparks.toml` on the processor; the input is at fault.
pub(crate) fn render_refused(workshop: &Workshop, arguments: &[&str], said: &[&str]) {
    let all = [&["render", "sparks.toml", "--adapter", "cpu"], arguments].concat();
    refused(workshop, &all, 2, said);
}

#[test]
fn an_unknown_scene_is_answered_with_the_nearest_name() {
    let here = Workshop::new();
    refused(
        &here,
        &["render", "firework"],
        2,
        &["`firework`", "did you mean fireworks?"],
    );
    refused(
        &here,
        &["render", "zzzzzz"],
        2,
        &["`zzzzzz`", "`motes scenes` lists the built-in scenes"],
    );
    refused(
        &here,
        &["render", "missing.toml"],
        2,
        &["missing.toml", "No such file"],
    );
    refused(
        &here,
        &["scenes", "--show", "fontain"],
        2,
        &["`fontain`", "fountain"],
    );
}

#[test]
fn a_file_that_is_missing_is_answered_with_the_nearest_there_is() {
    let here = Workshop::new();
    here.write("scenes/campfire.toml", crate::SPARKS);
    for (given, said) in [
        ("spark.toml", "did you mean `sparks.toml`?"),
        (
            "scenes/campfir.toml",
            "did you mean `scenes/campfire.toml`?",
        ),
        (
            "firework.toml",
            "did you mean `fireworks`, which is built in?",
        ),
        (".", "is a folder"),
        ("scenes", "is a folder"),
        ("scenes/", "is a folder"),
    ] {
        refused(&here, &["render", given], 2, &[said]);
    }
}

#[cfg(unix)]
#[test]
fn a_variable_that_is_no_text_is_named() {
    use std::os::unix::ffi::OsStrExt as _;
    let here = Workshop::new();
    let mut command = here.command(&["render", "sparks.toml", "-o", "a.gif"]);
    let value = std::ffi::OsStr::from_bytes(b"llvm\xff");
    let ended = Ended::of(command.env("MOTES_ADAPTER", value).output());
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert!(ended.stderr.contains("MOTES_ADAPTER"), "{}", ended.stderr);
}

#[test]
fn a_wrong_scene_file_is_answered_with_file_line_and_column() {
    let here = Workshop::new();
    let wrong_files: &[(&str, &[&str])] = &[
        (
            "title = \"x\"\nframes = = 3\n",
            &["not TOML", "wrong.toml:2:10", "2 | frames = = 3"],
        ),
        (
            "title = \"x\"\n\nfrmaes = 3\n",
            &["`frmaes`", "wrong.toml:3:1", "did you mean `frames`?"],
        ),
        ("frames = \"three\"\n", &["`frames`", "wrong.toml:1:10"]),
        ("frames = -1\n", &["`frames`", "wrong.toml:1:10"]),
    ];
    for (text, said) in wrong_files {
        here.write("wrong.toml", text);
        refused(
            &here,
            &["render", "wrong.toml", "--adapter", "cpu"],
            2,
            said,
        );
    }
    here.write("wrong.toml", b"title = \"\xff\"\n");
    refused(
        &here,
        &["render", "wrong.toml"],
        2,
        &["UTF-8", "wrong.toml:1:10"],
    );
    let scene_with = crate::SPARKS.replace("speed = {", "sped = {");
    here.write("wrong.toml", scene_with);
    refused(
        &here,
        &["render", "wrong.toml"],
        2,
        &["`sped`", "wrong.toml:18:1", "`speed`"],
    );
}

#[test]
fn wrong_arguments_are_named_with_what_would_be_right() {
    let here = Workshop::new();
    render_refused(&here, &["--wobble"], &["'--wobble'"]);
    render_refused(&here, &["--sizes", "3x3"], &["'--sizes'", "'--size'"]);
    for frames in [
        "5..2",
        "5..5",
        "5",
        "a..b",
        "..",
        "-1..2",
        "0..99999999999",
        "0..1000001",
    ] {
        render_refused(
            &here,
            &[&format!("--frames={frames}")],
            &["--frames", "A..B", "0..48"],
        );
    }
    for size in ["12", "12x", "x12", "12x12x12", "12.5x3", "-4x4"] {
        render_refused(
            &here,
            &[&format!("--size={size}")],
            &["--size", "WxH", "1280x720"],
        );
    }
    render_refused(&here, &["--size", "0x5"], &["`image.width`", "from 1 to"]);
    render_refused(
        &here,
        &["--size", "5x99999"],
        &["`image.height`", "from 1 to"],
    );
    render_refused(&here, &["--frame", "1000000"], &["1000000", "below"]);
    render_refused(
        &here,
        &["--frame", "1", "--frames", "0..2"],
        &["--frame", "--frames"],
    );
    render_refused(&here, &["--seed=-1"], &["--seed"]);
    refused(&here, &["fly"], 2, &["'fly'"]);
    refused(&here, &["render"], 2, &["<SCENE>"]);
}

#[test]
fn a_wrong_set_is_shown_with_its_place() {
    let here = Workshop::new();
    render_refused(
        &here,
        &["--set", "camera.vertical_fov=3"],
        &[
            "`vertical_fov`",
            "vertical_fov_degrees",
            "--set camera.vertical_fov=3",
        ],
    );
    render_refused(&here, &["--set", "system.0.sped=3"], &["`sped`", "`speed`"]);
    render_refused(&here, &["--set", "system.3.speed=3"], &["system.3.speed=3"]);
    render_refused(&here, &["--set", "seed"], &["no `=`"]);
    render_refused(&here, &["--set", "frames=0"], &["`frames`", "from 1 to"]);
}

#[test]
fn an_unknown_adapter_is_answered_with_those_there_are() {
    let here = Workshop::new();
    let arguments = [
        "render",
        "sparks.toml",
        "--adapter",
        "no-such-adapter",
        "-o",
        "a.gif",
    ];
    refused(&here, &arguments, 2, &["`no-such-adapter`", "cpu"]);
    let mut command = here.command(&["render", "sparks.toml", "-o", "a.gif"]);
    let ended = Ended::of(command.env("MOTES_ADAPTER", "no-such-adapter").output());
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert!(
        ended.stderr.contains("`no-such-adapter`"),
        "{}",
        ended.stderr
    );
}

#[test]
fn an_output_that_cannot_be_is_refused_before_the_run() {
    let here = Workshop::new();
    let layers = ["-o", "a.mp4", "--layers"];
    render_refused(&here, &layers, &["--layers", "name-%04d.png", ".exr"]);
    render_refused(&here, &["-o", "a.exr"], &["a.exr", "10", "name-%04d.exr"]);
    render_refused(&here, &["-o", "a.jpg"], &["a.jpg", "does not write .jpg"]);
    render_refused(&here, &["-o", "a.png"], &["a.png", "10", "--frame"]);
    render_refused(&here, &["-o", "a-%04d.gif"], &["a-%04d.gif"]);
    render_refused(&here, &["-o", "a-%q.png"], &["a-%q.png", "%04d"]);
    render_refused(
        &here,
        &["-o", "sparks.toml/a"],
        &["sparks.toml/a", "is a file"],
    );
    std::fs::create_dir(here.path("folder.gif")).expect("a temporary folder can be written");
    render_refused(&here, &["-o", "folder.gif"], &["folder.gif", "folder"]);
}

#[test]
fn a_dump_outside_the_frames_is_refused_before_the_run() {
    let here = Workshop::new();
    render_refused(&here, &["--dump", "10"], &["frame 10", "0..10", "--frames"]);
    render_refused(
        &here,
        &["--frames", "2..4", "--dump", "2,3,4"],
        &["frame 4", "2..4"],
    );
    render_refused(&here, &["--dump", "1,x"], &["--dump", "'x'"]);
}

#[test]
fn outputs_that_would_overwrite_each_other_are_refused_before_the_run() {
    let here = Workshop::new();
    std::fs::create_dir(here.path("folder")).expect("a temporary folder can be written");
    let collisions = [
        ("x.png", "x.png", "x.png"),
        ("x.gif", "./folder/../x.gif", "x.gif"),
        ("x", "x/frame-0005.png", "x/frame-0005.png"),
        ("x-%d.png", "x-5.png", "x-5.png"),
        // The statistics' file would have to be the pictures' folder.
        ("x", "x", "x/frame-0005.png"),
    ];
    for (out, stats, said) in collisions {
        render_refused(
            &here,
            &["-o", out, "--stats", stats, "--frame", "5"],
            &["(-o)", "(--stats)", said, "path of its own"],
        );
    }
    let dump = ["-o", "x.gif", "--dump", "5", "--dump-dir", "d", "--stats"];
    for stats in ["d/particles-0005.ply", "d"] {
        render_refused(
            &here,
            &[&dump[..], &[stats]].concat(),
            &["(--stats)", "(--dump)", "d/particles-0005.ply"],
        );
    }
    // Beside each other there is room, under the name of a frame that is not drawn, too.
    here.render(&["-o", "x", "--frame", "5", "--stats", "x/frame-0004.png"]);
    assert!(here.path("x/frame-0004.png").is_file());
}

#[test]
fn a_wrong_recording_is_answered_with_file_and_line() {
    let here = Workshop::new();
    let wrong_recordings: &[(&str, &[&str])] = &[
        (
            "# a comment\n\n2 system.0.speed=0.2\nnonsense\n",
            &["changes.txt:4", "`nonsense`"],
        ),
        (
            "two system.0.speed=0.2\n",
            &["changes.txt:1", "frame number"],
        ),
        ("2 system.0.speed\n", &["changes.txt:1", "`=`"]),
        (
            "2 system.0.speed=1\n1 system.0.speed=2\n",
            &["changes.txt:2", "before"],
        ),
        (
            "# slower\n2 system.0.sped=0.2\n",
            &["changes.txt:2:12", "`sped`", "system.0.sped=0.2", "`speed`"],
        ),
        (
            "2 system.0.speed=0.2\n3 image.width=48\n",
            &["changes.txt:2: ", "at frame 3", "image size"],
        ),
    ];
    for (text, said) in wrong_recordings {
        here.write("changes.txt", text);
        render_refused(&here, &["--inputs", "changes.txt"], said);
    }
    render_refused(
        &here,
        &["--inputs", "none.txt"],
        &["none.txt", "No such file"],
    );
}
