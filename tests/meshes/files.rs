//! Files that scenes name: where they are looked for, and what becomes of changed ones.

use std::fs;
use std::path::Path;

use motes::recording::Recording;
use motes::scene::{GenerationShape, Loader, Scene, load, load_with, parse};
use tempfile::TempDir;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn text(mesh: &str) -> String {
    format!(
        "frames = 4\n[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n[[system]]\n\
         name = \"one\"\ninitial_mean_parts = 9\nspeed = 0.1\nlifetime = 2\ncolor = [1, 1, 1]\n\
         size = 0.1\ngeneration_shape = {{ kind = \"mesh\", mesh = \"{mesh}\" }}\n"
    )
}

/// A folder with `scenes/a.toml`, which names `mesh`, and triangles in `scenes/in/t.obj` and
/// `out.obj`.
fn folder(mesh: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("the machine has room for temporary files");
    let at = |name: &str| folder.path().join(name);
    fs::create_dir_all(at("scenes/in")).expect("a temporary folder can be written");
    for (name, text) in [
        ("scenes/a.toml", text(mesh)),
        ("scenes/in/t.obj", TRIANGLE.to_owned()),
        ("out.obj", TRIANGLE.to_owned()),
    ] {
        fs::write(at(name), text).expect("a temporary folder can be written");
    }
    folder
}

fn scene_in(folder: &TempDir) -> String {
    folder.path().join("scenes/a.toml").display().to_string()
}

fn triangles(scene: &Scene) -> usize {
    match &scene.systems[0].generation_shape {
        GenerationShape::Mesh { mesh, .. } => mesh.triangles().len(),
        other => panic!("{other:?}"),
    }
}

const TRUSTING: Loader = Loader {
    allow_outside: true,
};

#[test]
fn paths_are_relative_to_the_scene() {
    for path in ["in/t.obj", "./in/t.obj", "in/../in/./t.obj"] {
        let folder = folder(path);
        let scene = load(&scene_in(&folder)).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(triangles(&scene), 1);
        // A text is as good as the file that it is called by.
        let parsed = parse(&text(path), &scene_in(&folder), "a").unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(parsed, scene);
    }
}

#[test]
fn paths_that_leave_the_folder_are_refused_unless_that_is_allowed() {
    let outside = |path: &str, why: &str, folder: &TempDir| {
        let error = load(&scene_in(folder)).expect_err(path);
        let shown = error.to_string();
        assert!(shown.contains(why), "{shown}");
        assert!(error.help().contains("--allow-outside"), "{shown}");
        assert_eq!(error.line(), Some(12), "{shown}");
        let scene = TRUSTING.load(&scene_in(folder));
        assert_eq!(triangles(&scene.unwrap_or_else(|e| panic!("{e}"))), 1);
    };
    for path in ["../out.obj", "in/../../out.obj", "./../scenes/../out.obj"] {
        outside(path, "leaves the scene's folder", &folder(path));
    }
    let here = folder("in/t.obj");
    let absolute = here.path().join("out.obj").display().to_string();
    fs::write(scene_in(&here), text(&absolute)).expect("a temporary folder can be written");
    outside(&absolute, "the path is absolute", &here);
    #[cfg(unix)]
    {
        let here = folder("link.obj");
        let link = here.path().join("scenes/link.obj");
        std::os::unix::fs::symlink(here.path().join("out.obj"), link).expect("a link can be made");
        outside("link.obj", "a link leads out", &here);
        let here = folder("up/out.obj");
        std::os::unix::fs::symlink(here.path(), here.path().join("scenes/up")).expect("a link");
        outside("up/out.obj", "a link leads out", &here);
        // A link that stays is as good as a file.
        let here = folder("link.obj");
        std::os::unix::fs::symlink("in/t.obj", here.path().join("scenes/link.obj"))
            .expect("a link");
        assert!(load(&scene_in(&here)).is_ok());
    }
}

#[test]
fn buffers_of_a_gltf_are_held_to_the_same_folder() {
    let with = |uri: &str| crate::gltf::NODES.replace("three.bin", uri);
    for (uri, right) in [
        ("t.bin", true),
        ("../in/t.bin", true),
        ("../../t.bin", false),
        ("%74%2ebin", true),
        ("%2e./in/t%2Ebin", true),
        ("%2E%2e/..%2ft.bin", false),
    ] {
        let here = folder("in/t.gltf");
        let write =
            |name: &str, bytes: &[u8]| fs::write(here.path().join(name), bytes).expect("room");
        write("scenes/in/t.gltf", with(uri).as_bytes());
        write("scenes/in/t.bin", &crate::gltf::buffer());
        write("t.bin", &crate::gltf::buffer());
        match load(&scene_in(&here)) {
            Ok(scene) => assert!(right && triangles(&scene) == 3, "{uri}"),
            Err(error) => assert!(
                !right && error.to_string().contains("leaves"),
                "{uri}: {error}"
            ),
        }
        assert!(TRUSTING.load(&scene_in(&here)).is_ok());
    }
}

#[test]
fn sets_and_changes_name_files_beside_the_scene() {
    let here = folder("cube");
    let scene = scene_in(&here);
    let set = "system.one.generation_shape.mesh=\"in/t.obj\"".to_owned();
    let sets = [set.clone()];
    assert_eq!(
        triangles(&load_with(&scene, &sets).expect("it is right")),
        1
    );
    let recording = Recording::parse(&format!("2 {set}\n"), "r").expect("it is right");
    let turns = recording.turns(&scene, &[]).expect("it is right");
    assert_eq!(triangles(&turns[0].scene), 1);
    let leaving = Recording::parse(&format!("2 {}\n", set.replace("in/t", "../out")), "r");
    let leaving = leaving.expect("it is right");
    let error = leaving.turns(&scene, &[]).expect_err("it leaves");
    assert!(error.to_string().contains("--allow-outside"), "{error}");
    assert!(leaving.turns_with(TRUSTING, &scene, &[]).is_ok());
    assert!(TRUSTING.knobs(&scene).is_ok_and(|knobs| {
        knobs
            .iter()
            .any(|knob| knob.path == "system.one.generation_shape.scale")
    }));
}

#[test]
fn built_in_scenes_name_what_the_program_carries() {
    let sets = ["system.0.generation_shape={ kind = \"mesh\", mesh = \"nowhere.obj\" }".to_owned()];
    let error = load_with("fountain", &sets).expect_err("it is not carried");
    assert!(
        error.to_string().contains("carries no such file"),
        "{error}"
    );
    assert!(error.help().contains("--allow-outside"), "{error}");
    // Then it is one of the current folder, where there is none either.
    let error = TRUSTING
        .load_with("fountain", &sets)
        .expect_err("there is none");
    assert!(error.to_string().contains("no such file"), "{error}");
    for (file, bytes) in motes::scene::BUILTIN_FILES {
        assert!(Path::new("scenes").join(file).is_file(), "{file}");
        let sets = [format!(
            "system.0.generation_shape={{ kind = \"mesh\", mesh = \"{file}\" }}"
        )];
        assert!(load_with("fountain", &sets).is_ok(), "{file}");
        assert!(bytes.len() < 1 << 20, "{file}");
    }
}

#[test]
fn a_changed_file_is_a_changed_scene() {
    let here = folder("in/t.obj");
    let before = load(&scene_in(&here)).expect("it is right");
    let again = load(&scene_in(&here)).expect("it is right");
    assert_eq!(format!("{before:?}"), format!("{again:?}"));
    let moved = TRIANGLE.replace("v 1 0 0", "v 1 0 0.0001");
    fs::write(here.path().join("scenes/in/t.obj"), moved).expect("room");
    let after = load(&scene_in(&here)).expect("it is right");
    assert_ne!(before, after);
    // What tells runs apart is how a scene is printed.
    assert_ne!(format!("{before:?}"), format!("{after:?}"));
    assert!(format!("{after:?}").len() < 10_000);
}
