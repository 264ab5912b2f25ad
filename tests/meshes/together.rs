//! The files of a scene taken together: each is read once, all are bounded, and errors show them.

use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

use motes::scene::{GenerationShape, Loader, Scene, SceneError, load};
use tempfile::TempDir;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A scene with a system born on each of these meshes.
fn text<'a>(meshes: impl IntoIterator<Item = &'a str>) -> String {
    let head = "frames = 4\n[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n";
    let system = |(at, mesh): (usize, &str)| {
        format!(
            "[[system]]\nname = \"s{at}\"\ninitial_mean_parts = 9\nspeed = 0.1\nlifetime = 2\n\
             color = [1, 1, 1]\nsize = 0.1\n\
             generation_shape = {{ kind = \"mesh\", mesh = \"{mesh}\" }}\n"
        )
    };
    let systems = meshes.into_iter().enumerate().map(system);
    head.to_owned() + &systems.collect::<String>()
}

/// A folder with `a.toml`, which names these meshes, and these files.
fn folder(meshes: &[&str], files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().expect("the machine has room for temporary files");
    write(folder.path(), meshes, files);
    folder
}

fn write(folder: &Path, meshes: &[&str], files: &[(&str, &[u8])]) {
    let scene = text(meshes.iter().copied());
    for (name, bytes) in [("a.toml", scene.as_bytes())].iter().chain(files) {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("room");
        fs::write(path, bytes).expect("a temporary folder can be written");
    }
}

fn read(folder: &TempDir) -> Result<Scene, SceneError> {
    load(&folder.path().join("a.toml").display().to_string())
}

/// A binary PLY of three vertices and that many times the face between them.
fn faces(count: u32) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n\
         property uchar y\nproperty uchar z\nelement face {count}\n\
         property list uchar uchar vertex_index\nend_header\n"
    )
    .into_bytes();
    bytes.extend([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    bytes.extend([3, 0, 1, 2].repeat(count as usize));
    bytes
}

#[test]
fn a_file_is_read_once_however_it_is_spelled() {
    let mut names = vec!["t.obj".to_owned(), "in/../t.obj".to_owned()];
    names.extend((1..40).map(|at| format!("{}t.obj", "./".repeat(at))));
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let here = folder(&names, &[("t.obj", TRIANGLE.as_bytes()), ("in/x", b"")]);
    let scene = read(&here).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((scene.systems.len(), scene.meshes().len()), (41, 1));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("t.obj", here.path().join("link.obj")).expect("a link");
        fs::write(here.path().join("a.toml"), text(["link.obj", "t.obj"])).expect("room");
        let scene = read(&here).unwrap_or_else(|e| panic!("{e}"));
        let meshes = scene.systems.iter().map(|it| match &it.generation_shape {
            GenerationShape::Mesh { mesh, .. } => mesh,
            other => panic!("{other:?}"),
        });
        let meshes: Vec<_> = meshes.collect();
        assert!(Arc::ptr_eq(meshes[0], meshes[1]));
    }
}

#[test]
fn triangles_of_all_meshes_together_are_bounded_at_the_key_of_the_one_too_many() {
    let many = faces(1_400_000);
    let here = folder(&["a.ply", "./a.ply"], &[("a.ply", &many), ("b.ply", &many)]);
    assert!(read(&here).is_ok(), "one file counts once");
    fs::write(here.path().join("a.toml"), text(["a.ply", "b.ply"])).expect("room");
    let error = read(&here).expect_err("they are too many");
    let shown = error.to_string();
    assert!(
        error
            .message()
            .contains("`system.s1.generation_shape.mesh`: b.ply: it has 1400000 triangles"),
        "{shown}"
    );
    assert!(error.help().contains("at most 2796202"), "{shown}");
    assert_eq!(error.line(), Some(20), "{shown}");
    // One alone is held to the same number.
    fs::write(here.path().join("a.ply"), faces(2_796_203)).expect("room");
    let error = read(&here).expect_err("it has too many");
    assert!(
        error.message().contains("more than 2796202 triangles"),
        "{error}"
    );
}

#[test]
fn bytes_of_all_files_together_are_bounded() {
    let here = folder(&["a.ply", "b.ply"], &[]);
    for name in ["a.ply", "b.ply"] {
        let path = here.path().join(name);
        fs::write(&path, faces(1)).expect("room");
        // What follows the last element is nothing, but it is read.
        let file = File::options()
            .write(true)
            .open(&path)
            .expect("it is there");
        file.set_len(140 << 20).expect("holes take no room");
    }
    let error = read(&here).expect_err("they are too long");
    assert!(
        error
            .message()
            .contains("b.ply: the files that the scene names are larger than 256 MiB"),
        "{error}"
    );
}

#[test]
fn vertices_of_no_face_are_bounded_as_well() {
    let vertices = 8_388_606;
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty uchar x\n\
         property uchar y\nproperty uchar z\nelement face 1\n\
         property list uchar uchar vertex_index\nend_header\n"
    );
    let mut bytes = header.into_bytes();
    bytes.extend([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    bytes.resize(bytes.len() + 3 * (vertices - 3), 0);
    bytes.extend([3, 0, 1, 2]);
    let names = ["a.ply", "b.ply", "c.ply", "d.ply", "e.ply", "f.ply"];
    let files: Vec<(&str, &[u8])> = names.iter().map(|name| (*name, &bytes[..])).collect();
    let error = read(&folder(&names, &files)).expect_err("600 MB");
    assert!(
        error
            .message()
            .contains("f.ply: the scene's meshes take more than 512 MiB"),
        "{error}"
    );
}

#[test]
fn a_wrong_mesh_is_shown_where_it_is_wrong_with_the_key_that_names_it() {
    let text = TRIANGLE.replace("f 1 2 3", "# é\nf 1 2  9 # é");
    let here = folder(&["in/t.obj"], &[("in/t.obj", text.as_bytes())]);
    let error = read(&here).expect_err("there are 3 vertices");
    let shown = error.to_string();
    let root = here.path().display();
    assert_eq!(
        shown,
        format!(
            "error: `system.s0.generation_shape.mesh`: a face has the vertex 9, and 3 are above it\n  \
             --> {root}/in/t.obj:5:8\n   |\n 5 | f 1 2  9 # é\n   |        ^\n   \
             = help: a number from 1 to 3, or from -3 to -1\n   \
             = note: {root}/a.toml:12:44 names this mesh"
        )
    );
    assert_eq!((error.line(), error.column()), (Some(5), Some(8)));
    assert!(error.file().is_some_and(|file| file.ends_with("in/t.obj")));
}

#[test]
fn what_is_no_text_or_endless_is_shown_harmlessly() {
    let escape = b"v 0 0 0\n\x1b[31m\xff\xfe 1 2 3\n".to_vec();
    let long = [b"v 0 0 0\nf ".to_vec(), b"x".repeat(1 << 20)].concat();
    for (bytes, place) in [(escape, "t.obj:2:1"), (long, "t.obj:2: ")] {
        let error = read(&folder(&["t.obj"], &[("t.obj", &bytes)])).expect_err("it is wrong");
        let shown = error.to_string();
        assert!(shown.contains(place), "{shown}");
        assert!(shown.len() < 1500 && !shown.contains('\x1b'), "{shown}");
    }
}

#[test]
fn a_missing_mesh_is_answered_with_one_that_is_there() {
    for (asked, meant) in [
        ("torch.obj", Some("Torch.obj")),
        ("in/tee.ply", Some("in/tree.ply")),
        ("in/tree.obj", Some("in/tree.ply")),
        ("in/house.obj", None),
        ("no/tree.ply", None),
    ] {
        let files: [(&str, &[u8]); 3] = [
            ("Torch.obj", b""),
            ("in/tree.ply", b""),
            ("in/house.txt", b""),
        ];
        let error = read(&folder(&[asked], &files)).expect_err("it is not there");
        let guess = meant.map(|name| format!("did you mean `{name}`?"));
        match guess {
            Some(guess) => assert!(error.help().starts_with(&guess), "{error}"),
            None => assert!(!error.help().contains("did you mean"), "{error}"),
        }
    }
}

#[cfg(unix)]
#[test]
fn names_outside_of_the_scene_s_folder_are_not_told() {
    let here = folder(&["up/tree.ply"], &[("x/a.ply", b"")]);
    let other = folder(&[], &[("tee.ply", b"")]);
    std::os::unix::fs::symlink(other.path(), here.path().join("up")).expect("a link");
    let error = read(&here).expect_err("it is not there");
    assert!(!error.to_string().contains("tee.ply"), "{error}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_scene_in_a_strange_place_has_its_files_beside_it() {
    let shared = tempfile::tempdir_in("/dev/shm").expect("Linux has shared memory");
    write(shared.path(), &["t.obj"], &[("t.obj", TRIANGLE.as_bytes())]);
    let path = shared.path().join("a.toml").display().to_string();
    assert!(load(&path).is_ok_and(|scene| scene.meshes().len() == 1));
    // Through a link of the system, as `/proc/self/cwd` is one.
    let here = folder(&["t.obj"], &[("t.obj", TRIANGLE.as_bytes())]);
    let path = format!("/proc/self/root{}/a.toml", here.path().display());
    assert!(load(&path).is_ok_and(|scene| scene.meshes().len() == 1));
    // A descriptor has no folder: its files are those of the current one.
    let text = text(["scenes/meshes/torus-knot.obj"]);
    let scene = Loader::default().parse(&text, "/dev/stdin", "piped");
    assert!(scene.is_ok_and(|scene| scene.meshes().len() == 1));
}
