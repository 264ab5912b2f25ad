//! Scenes that name files, from the command line.

use crate::{SPARKS, Workshop};

const TRIANGLES: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n";

fn born_on(mesh: &str) -> String {
    let sphere = "{ kind = \"sphere\", radius = 0.5 }";
    assert!(SPARKS.contains(sphere));
    SPARKS.replace(sphere, &format!("{{ kind = \"mesh\", mesh = \"{mesh}\" }}"))
}

#[test]
fn what_is_mended_in_a_mesh_is_told() {
    let here = Workshop::new();
    here.write("t.obj", TRIANGLES);
    here.write("a.toml", born_on("t.obj"));
    let ended = here.run(&["render", "a.toml", "--adapter", "cpu", "-o", "a.gif"]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let note = "motes: t.obj: 1 of 2 triangles has no area and is left out\n";
    assert_eq!(ended.stderr.matches(note).count(), 1, "{}", ended.stderr);
}

#[test]
fn a_scene_that_is_trusted_reads_files_outside_of_its_folder() {
    let here = Workshop::new();
    here.write("t.obj", TRIANGLES);
    here.write("scenes/a.toml", born_on("../t.obj"));
    here.write(
        "inputs",
        "3 system.sparks.generation_shape.mesh=\"../t.obj\"\n",
    );
    let render = [
        "render",
        "scenes/a.toml",
        "--adapter",
        "cpu",
        "-o",
        "a.gif",
        "--inputs",
        "inputs",
    ];
    for arguments in [&render[..], &["scenes", "--knobs", "scenes/a.toml"]] {
        let ended = here.run(arguments);
        assert_eq!(ended.code, 2, "{}", ended.stderr);
        let ended = here.run(&[arguments, &["--allow-outside"]].concat());
        assert_eq!(ended.code, 0, "{}", ended.stderr);
    }
}

#[test]
fn a_copy_of_a_built_in_scene_needs_a_copy_of_its_mesh() {
    let here = Workshop::new();
    let file = "meshes/torus-knot.obj";
    let scene = here.run(&["scenes", "--show", "ember-knot"]);
    assert!(
        scene.stderr.contains(&format!("--show {file}")),
        "{}",
        scene.stderr
    );
    let mesh = here.run(&["scenes", "--show", file]);
    assert_eq!((scene.code, mesh.code), (0, 0));
    let small = [
        "--adapter",
        "cpu",
        "--frame",
        "2",
        "--size",
        "64x36",
        "--set",
        "camera.near=1",
    ];
    let render =
        |scene: &str, out: &str| here.run(&[&["render", scene, "-o", out], &small[..]].concat());
    here.write("mine.toml", &scene.stdout);
    let ended = render("mine.toml", "mine.png");
    assert_eq!(ended.code, 2);
    assert!(
        ended.stderr.contains("there is no such file"),
        "{}",
        ended.stderr
    );
    here.write(file, &mesh.stdout);
    let ended = render("mine.toml", "mine.png");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert_eq!(render("ember-knot", "theirs.png").code, 0);
    assert!(here.read("mine.png") == here.read("theirs.png"));
}

#[test]
fn what_is_mended_in_a_mesh_that_a_change_names_is_told_once() {
    let here = Workshop::new();
    here.write("t.obj", TRIANGLES);
    let mesh = "system.sparks.generation_shape={ kind = \"mesh\", mesh = \"t.obj\" }";
    here.write("r", format!("3 {mesh}\n5 {mesh}\n"));
    let ended = here.render(&["-o", "a.gif", "--inputs", "r"]);
    let note = "motes: t.obj: 1 of 2 triangles has no area and is left out\n";
    assert_eq!(ended.stderr.matches(note).count(), 1, "{}", ended.stderr);
}

#[test]
fn bench_trusts_scenes_and_tells_what_is_mended() {
    let here = Workshop::new();
    here.write("t.obj", TRIANGLES);
    here.write("scenes/a.toml", born_on("../t.obj"));
    let bench = [
        "bench",
        "scenes/a.toml",
        "--adapter",
        "cpu",
        "--frames",
        "2",
    ];
    let ended = here.run(&bench);
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    let ended = here.run(&[&bench[..], &["--allow-outside"]].concat());
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let note = "motes: ../t.obj: 1 of 2 triangles has no area and is left out\n";
    assert_eq!(ended.stderr.matches(note).count(), 1, "{}", ended.stderr);
}

#[cfg(unix)]
#[test]
fn a_scene_from_a_pipe_is_read_once_and_its_meshes_are_in_the_current_folder() {
    let here = Workshop::new();
    here.write("t.obj", TRIANGLES);
    here.write("a.toml", born_on("t.obj"));
    here.write("r", "3 system.sparks.speed=0.2\n");
    let motes = env!("CARGO_BIN_EXE_motes");
    let render = format!("{motes} render /dev/stdin --adapter cpu --inputs r -o");
    let run = |command: &str| {
        let mut shell = std::process::Command::new("bash");
        shell.args(["-c", command]).current_dir(here.path(""));
        crate::Ended::of(shell.output())
    };
    for command in [
        format!("cat a.toml | {render} piped.gif"),
        format!("{render} redirected.gif <a.toml"),
    ] {
        let ended = run(&command);
        assert_eq!(ended.code, 0, "{command}\n{}", ended.stderr);
    }
    let file = [
        "render",
        "a.toml",
        "--adapter",
        "cpu",
        "--inputs",
        "r",
        "-o",
        "file.gif",
    ];
    assert_eq!(here.run(&file).code, 0);
    assert!(here.read("piped.gif") == here.read("file.gif"));
    assert!(here.read("redirected.gif") == here.read("file.gif"));
    // What it names is not written over either.
    let ended = run(&format!("cat a.toml | {render} a.gif --stats t.obj"));
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert!(
        ended.stderr.contains("t.obj is a mesh of the scene"),
        "{}",
        ended.stderr
    );
    assert_eq!(here.read("t.obj"), TRIANGLES.as_bytes());
}

#[test]
fn texts_may_begin_with_a_byte_order_mark() {
    let here = Workshop::new();
    here.write("a.toml", format!("\u{feff}{SPARKS}"));
    here.write("r", "\u{feff}3 system.sparks.speed=0.2\n");
    let ended = here.run(&[
        "render",
        "a.toml",
        "--adapter",
        "cpu",
        "--inputs",
        "r",
        "-o",
        "a.gif",
    ]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    here.write("r", "3 system.sparks.speed=0.2\n");
    here.render(&["--inputs", "r", "-o", "b.gif"]);
    assert!(here.read("a.gif") == here.read("b.gif"));
    here.write(
        "a.toml",
        format!("\u{feff}{}", SPARKS.replace("title", "tilte")),
    );
    let ended = here.run(&["render", "a.toml", "--adapter", "cpu", "-o", "c.gif"]);
    assert!(
        ended.stderr.contains("a.toml:1:1") && ended.stderr.contains("`tilte`"),
        "{}",
        ended.stderr
    );
}
