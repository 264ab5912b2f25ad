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
    let note = "motes: t.obj: 1 of 2 triangles have no area and are left out\n";
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
