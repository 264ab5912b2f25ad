//! Wrong meshes, and paths that lead where a scene may not read.

use crate::all_are_refused;
use crate::row::Row;
use crate::scenes::with;

const SPHERE: &str = "{ kind = \"sphere\", radius = 0.5 }";

/// The scene, born on this mesh.
fn born_on(mesh: &str) -> String {
    with(SPHERE, &format!("{{ kind = \"mesh\", mesh = {mesh} }}"))
}

/// A scene that is born on a mesh that is not there, or not a mesh.
fn named(mesh: &str, said: &[&str]) -> Row {
    let place = ["generation_shape.mesh`", "w.toml:17:44"];
    Row::scene(born_on(mesh), &[said, &place].concat())
}

/// A scene that is born on this file.
fn file(name: &'static str, bytes: impl Into<Vec<u8>>, said: &[&str]) -> Row {
    named(&format!("\"{name}\""), said).file(name, bytes)
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn what_is_no_mesh_is_answered_with_the_key_and_the_file() {
    all_are_refused(&[
        named("\"\"", &["cannot be \"\"", "cube, cylinder"]),
        named("5", &["cannot be the whole number 5", "\"torus\""]),
        named("[\"torus\"]", &["cannot be an array"]),
        named(
            "\"tours\"",
            &["cannot be \"tours\"", "did you mean", "torus"],
        ),
        named(
            "\"teapot\"",
            &["cannot be \"teapot\"", ".obj, .ply, .gltf or .glb"],
        ),
        named("\"missing.obj\"", &["missing.obj: there is no such file"]),
        named("\"in/missing.obj\"", &["there is no such file"]).file("in/", ""),
        named("\"in.obj\"", &["in.obj: it is a folder"]).file("in.obj/", ""),
        named(
            "\"sparks.toml\"",
            &["sparks.toml: the name has no ending", ".glb"],
        ),
        named("\"sparks.toml/a.obj\"", &["a.obj: the file cannot be read"]),
        named("\"a\\u0000.obj\"", &["control character"]),
        file(
            "w.stl",
            "solid\n",
            &["w.stl: the name has no ending", ".ply"],
        ),
        file("w.obj", "", &["w.obj: there are no vertices"]),
        file("w.obj", SQUARE, &["w.obj: there are no faces"]),
        file(
            "w.obj",
            format!("{SQUARE}f 1 2 9\n"),
            &["--> w.obj:5:7", "5 | f 1 2 9", "vertex 9", "from 1 to 4"],
        ),
        file(
            "w.obj",
            format!("{SQUARE}f 1 2\n"),
            &["--> w.obj:5:1", "2 corners", "at least 3"],
        ),
        file(
            "w.obj",
            format!("{SQUARE}v NaN 0 0\n"),
            &["--> w.obj:5:1", "a coordinate is NaN"],
        ),
        file(
            "w.obj",
            format!("{SQUARE}v 1e9 0 0\n"),
            &["--> w.obj:5:1", "1000000000", "1_000_000"],
        ),
        file(
            "w.obj",
            format!("{SQUARE}f 1 1 2\n"),
            &["its only face has no area", "one line"],
        ),
        file(
            "w.obj",
            vec![0x89, b'P', b'N', b'G', 0, 7, 0],
            &["--> w.obj:1:1", "no line of an OBJ"],
        ),
        file(
            "w.obj",
            format!("{SQUARE}\u{1b}[31m 1 2 3\n"),
            &["--> w.obj:5:1"],
        ),
        file("w.ply", "plx\n", &["--> w.ply:1:1", "begin with `ply`"]),
        file(
            "w.ply",
            "ply\nformat ascii 1.0\nelement vertex 9999999999\nproperty float x\nend_header\n1\n",
            &["w.ply: ", "9999999999 records"],
        ),
        file(
            "w.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty flaot x\nend_header\n1\n",
            &["--> w.ply:4:1", "`flaot`"],
        ),
        file(
            "w.gltf",
            "{ \"asset\": 5 }",
            &["--> w.gltf:1:", "not glTF's JSON"],
        ),
        file(
            "w.gltf",
            "{ \"asset\": { \"version\": \"2.0\" } }",
            &["w.gltf: it has no scene"],
        ),
        file(
            "w.glb",
            "{ \"asset\": { \"version\": \"2.0\" } }",
            &["w.glb: ", "`glTF`"],
        ),
        file(
            "w.glb",
            b"glTF\x02\0\0\0\xff\xff\0\0\xff\xff\xff\x7fJSON{}".to_vec(),
            &["w.glb: ", "middle of a chunk"],
        ),
        Row::scene(
            with(SPHERE, "{ kind = \"mesh\" }"),
            &[
                "`system.sparks.generation_shape.mesh` is missing",
                "w.toml:17:20",
            ],
        ),
        Row::scene(
            with(SPHERE, "{ kind = \"mesh\", mesh = \"cube\", scale = 2000 }"),
            &["generation_shape.scale` is out of range", "w.toml:17:60"],
        ),
        Row::scene(
            with(SPHERE, "{ kind = \"mesh\", mesh = \"cube\", radius = 1 }"),
            &["no key `radius`", "mesh, scale"],
        ),
    ]);
}

#[test]
fn meshes_are_not_written_over() {
    let of_mesh = ["is a mesh of the scene, and would be written over"];
    let points = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_index\n\
                  end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let render = ["render", "w.toml", "--adapter", "cpu", "-o", "a.gif"];
    let row = |more: &[&str], name: &'static str, text: &str| {
        Row::new(&[&render[..], more].concat(), &of_mesh)
            .file("w.toml", born_on(&format!("\"{name}\"")))
            .file(name, text)
    };
    all_are_refused(&[
        row(
            &["--stats", "w.obj"],
            "w.obj",
            &format!("{SQUARE}f 1 2 3\n"),
        ),
        row(
            &["--dump", "2", "--dump-dir", "."],
            "particles-0002.ply",
            points,
        ),
        // One that only a change names.
        Row::render(
            &["-o", "a.gif", "--inputs", "r", "--stats", "w.obj"],
            &of_mesh,
        )
        .file("w.obj", format!("{SQUARE}f 1 2 3\n"))
        .file(
            "r",
            "3 system.sparks.generation_shape={ kind = \"mesh\", mesh = \"w.obj\" }\n",
        ),
        // A buffer that a mesh names.
        Row::new(
            &[&render[..], &["--stats", "d/../b.bin"]].concat(),
            &["is a buffer of a mesh, and would be written over"],
        )
        .file("d/", "")
        .file("w.toml", born_on("\"w.gltf\""))
        .file("w.gltf", GLTF.replace("../../b.bin", "b.bin"))
        .file("b.bin", triangle()),
        Row::new(
            &["bench", "w.toml", "--adapter", "cpu", "--json", "./w.obj"],
            &of_mesh,
        )
        .file("w.toml", born_on("\"w.obj\""))
        .file("w.obj", format!("{SQUARE}f 1 2 3\n")),
        Row::new(&["check", "w.toml", "--junit", "d/../w.obj"], &of_mesh)
            .file("d/", "")
            .file("w.toml", born_on("\"w.obj\""))
            .file("w.obj", format!("{SQUARE}f 1 2 3\n")),
    ]);
}

#[test]
fn paths_that_leave_the_scene_s_folder_are_answered_with_the_flag_that_lets_them() {
    let outside = |path: &str, why: &str| named(path, &[why, "--allow-outside"]);
    let set = "system.sparks.generation_shape={ kind = \"mesh\", mesh = \"../w.obj\" }";
    all_are_refused(&[
        outside("\"/etc/hostname.obj\"", "the path is absolute"),
        outside("\"../w.obj\"", "the path leaves the scene's folder"),
        outside("\"in/../../w.obj\"", "the path leaves the scene's folder").file("in/", ""),
        outside("\"/dev/zero\"", "the path is absolute"),
        outside("'\\\\server\\w.obj'", "the path is absolute"),
        // A buffer of a glTF is held to the same.
        outside("\"w.gltf\"", "its buffer ../../b.bin: the path leaves").file("w.gltf", GLTF),
        Row::render(
            &["--set", set],
            &["leaves the scene's folder", "--allow-outside", "--set "],
        ),
        Row::render(
            &["--inputs", "r"],
            &["leaves the scene's folder", "--allow-outside"],
        )
        .file("r", format!("2 {set}\n")),
        Row::new(
            &["check", "w.toml", "--adapter", "cpu"],
            &["leaves the scene's folder"],
        )
        .file("w.toml", born_on("\"../w.obj\"")),
        Row::new(
            &["scenes", "--knobs", "w.toml"],
            &["leaves the scene's folder"],
        )
        .file("w.toml", born_on("\"../w.obj\"")),
        Row::new(
            &[
                "render",
                "fountain",
                "--set",
                "system.0.generation_shape={ kind = \"mesh\", mesh = \"w.obj\" }",
            ],
            &["carries no such file", "--allow-outside"],
        )
        .file("w.obj", format!("{SQUARE}f 1 2 3\n")),
        // What may be read has to be a file all the same: these have no end.
        Row::new(
            &["render", "w.toml", "--allow-outside", "-o", "a.gif"],
            &["/dev/zero: it is a device or a pipe"],
        )
        .file("w.toml", born_on("\"/dev/zero\"")),
        Row::new(&["scenes", "--allow-outside"], &["--knobs"]),
        Row::new(
            &["bench", "w.toml", "--adapter", "cpu"],
            &["leaves the scene's folder", "--allow-outside"],
        )
        .file("w.toml", born_on("\"../w.obj\"")),
    ]);
}

/// The buffer of that.
fn triangle() -> Vec<u8> {
    let places = [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    places.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// A triangle whose buffer is outside.
const GLTF: &str = r#"{ "asset": { "version": "2.0" }, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
"meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
"accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }],
"bufferViews": [{ "buffer": 0, "byteLength": 36 }],
"buffers": [{ "byteLength": 36, "uri": "../../b.bin" }] }"#;
