//! glTF and GLB, with their nodes, buffers and faults.

use motes::mesh::{Mesh, MeshError};

/// Three places and three indices: 36 + 6 bytes.
pub(crate) fn buffer() -> Vec<u8> {
    let places = [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0];
    let mut bytes: Vec<u8> = places.iter().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0u16, 1, 2].iter().flat_map(|at| at.to_le_bytes()));
    bytes
}

/// One triangle in two nodes: as it is, moved by its parent and scaled, and mirrored in a third.
pub(crate) const NODES: &str = r#"{ "asset": { "version": "2.0" }, "scene": 0,
"scenes": [{ "nodes": [0, 2] }],
"nodes": [
  { "name": "parent", "translation": [0, 0, 5], "children": [1], "mesh": 0 },
  { "name": "child", "scale": [2, 2, 2], "rotation": [0, 0, 0.70710677, 0.70710677], "mesh": 0 },
  { "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1], "mesh": 0 }
],
"materials": [{ "name": "paper" }],
"meshes": [{ "name": "three", "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
"accessors": [
  { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 0] },
  { "bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR" }
],
"bufferViews": [
  { "buffer": 0, "byteLength": 36 },
  { "buffer": 0, "byteOffset": 36, "byteLength": 6 }
],
"buffers": [{ "byteLength": 42, "uri": "three.bin" }] }"#;

/// Reads glTF beside which only `three.bin` lies.
fn read(json: &str) -> Result<Mesh, MeshError> {
    Mesh::read("a.gltf", json.as_bytes(), &mut |path: &str| match path {
        "three.bin" => Ok(buffer()),
        _ => panic!("{path} is asked for"),
    })
}

/// A GLB of the JSON and the bytes.
pub(crate) fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut file = b"glTF".to_vec();
    let padded = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (json, binary) = (padded(json.as_bytes(), b' '), padded(binary, 0));
    let whole = 12 + 8 + json.len() + 8 + binary.len();
    file.extend(2u32.to_le_bytes());
    file.extend((whole as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

/// The same JSON with its buffer in the GLB.
pub(crate) fn in_glb() -> Vec<u8> {
    let json = NODES.replace(", \"uri\": \"three.bin\"", "");
    glb(&json, &buffer())
}

fn assert_is_right(mesh: &Mesh) {
    let near = |got: [f32; 3], expected: [f32; 3]| {
        let off = (0..3).map(|i| (got[i] - expected[i]).abs());
        assert!(off.fold(0.0, f32::max) < 1e-5, "{got:?} for {expected:?}");
    };
    assert_eq!(mesh.triangles().len(), 3);
    // Depth first: the parent, its child turned a quarter about z, the mirrored one.
    let expected = [
        [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 2.0, 5.0]],
        [[0.0, 0.0, 5.0], [0.0, 2.0, 5.0], [-4.0, 0.0, 5.0]],
        [[10.0, 0.0, 0.0], [10.0, 2.0, 0.0], [9.0, 0.0, 0.0]],
    ];
    for (face, corners) in expected.into_iter().enumerate() {
        for (got, expected) in mesh.corners(face).into_iter().zip(corners) {
            near(got, expected);
        }
        // What is mirrored still shows its front.
        assert!(mesh.doubled_area(face)[2] > 0.0, "{face}");
    }
    let groups: Vec<&str> = mesh.parts().iter().map(|it| it.group.as_str()).collect();
    assert_eq!(groups, ["parent", "child", "three"]);
    assert!(mesh.parts().iter().all(|it| it.material == "paper"));
}

#[test]
fn nodes_are_put_in_their_places() {
    assert_is_right(&read(NODES).expect("it is right"));
    let mesh = Mesh::read("a.glb", &in_glb(), &mut |path: &str| panic!("{path}"));
    assert_is_right(&mesh.expect("it is right"));
    // The same bytes in base64, by another program.
    let data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAAAAABAAIA";
    let uri = format!("data:application/octet-stream;base64,{data}");
    assert_is_right(&read(&NODES.replace("three.bin", &uri)).expect("it is right"));
    let spaced = NODES.replace("three.bin", "my%20three%2Ebin");
    let mesh = Mesh::read("a.gltf", spaced.as_bytes(), &mut |path: &str| {
        assert_eq!(path, "my three.bin");
        Ok(buffer())
    });
    assert_is_right(&mesh.expect("it is right"));
}

#[test]
fn strips_fans_and_bare_triangles_are_read() {
    let square = [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
    let bytes: Vec<u8> = square.iter().flat_map(|x| x.to_le_bytes()).collect();
    let json = |mode: u32, count: u32| {
        format!(
            r#"{{ "asset": {{ "version": "2.0" }}, "scenes": [{{ "nodes": [0] }}], "nodes": [{{ "mesh": 0 }}],
            "meshes": [{{ "primitives": [{{ "attributes": {{ "POSITION": 0 }}, "mode": {mode} }}, {{ "attributes": {{ "POSITION": 0 }}, "mode": 0 }}] }}],
            "accessors": [{{ "bufferView": 0, "componentType": 5126, "count": {count}, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }}],
            "bufferViews": [{{ "buffer": 0, "byteLength": 48 }}], "buffers": [{{ "byteLength": 48 }}] }}"#
        )
    };
    for (mode, count, triangles) in [
        (4, 3, vec![[0, 1, 2]]),
        (5, 4, vec![[0, 1, 2], [2, 1, 3]]),
        (6, 4, vec![[0, 1, 2], [0, 2, 3]]),
    ] {
        let file = glb(&json(mode, count), &bytes);
        let mesh = Mesh::read("a.glb", &file, &mut |_: &str| unreachable!());
        let mesh = mesh.unwrap_or_else(|e| panic!("{mode}: {e}"));
        assert_eq!(mesh.triangles(), triangles, "{mode}");
        assert!(
            mesh.notes()[0].contains("points or lines"),
            "{:?}",
            mesh.notes()
        );
    }
}

#[test]
fn wrong_gltfs_are_refused() {
    let with = |old: &str, new: &str| {
        assert!(NODES.contains(old), "{old}");
        NODES.replacen(old, new, 1)
    };
    #[rustfmt::skip]
    let rows = [
        (String::new(), "not glTF's JSON"),
        ("{}".into(), "not glTF's JSON"),
        (with("\"scene\": 0,\n", "\"scene\": 0\n"), "not glTF's JSON: "),
        (with("\"children\": [1]", "\"children\": [0]"), "more than one parent"),
        (with("\"children\": [1]", "\"children\": [2]"), "more than one parent"),
        (with("\"children\": [1]", "\"children\": [7]"), "nodes[0].children"),
        (with("\"scene\": 0", "\"scene\": 3"), "scene"),
        (with("\"POSITION\": 0", "\"POSITION\": 9"), "POSITION"),
        (with("\"POSITION\": 0", "\"NORMAL\": 0"), "POSITION"),
        (with("\"count\": 3, \"type\": \"VEC3\"", "\"count\": 4, \"type\": \"VEC3\""), "accessor 0 has 4 items"),
        (with("\"count\": 3, \"type\": \"VEC3\"", "\"count\": 1000000000000, \"type\": \"VEC3\""), "accessor 0 has 1000000000000"),
        (with("\"count\": 3, \"type\": \"SCALAR\"", "\"count\": 18446744073709551615, \"type\": \"SCALAR\""), "more than 2796202 triangles"),
        (with("\"count\": 3, \"type\": \"SCALAR\"", "\"count\": 2, \"type\": \"SCALAR\""), "2 corners"),
        (with("5126", "5125"), "accessor 0 of positions"),
        (with("5123", "5126"), "accessor 1 of indices"),
        (with("\"byteLength\": 36", "\"byteLength\": 400"), "view 0 is 400 bytes"),
        (with("\"byteOffset\": 36", "\"byteOffset\": 18446744073709551615"), "view 1"),
        (with("\"byteOffset\": 36", "\"byteOffset\": 30"), "the vertex 16384"),
        (with("three.bin", "https://example.org/three.bin"), "https://example.org"),
        (with("three.bin", "data:text/plain,hello"), "no base64"),
        (with("three.bin", "data:;base64,####"), "no base64"),
        (with(", \"uri\": \"three.bin\"", ""), "has no uri"),
        (with("[0, 0, 5]", "[0, 0, 1e30]"), "a coordinate is"),
        (with("\"scene\": 0", "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"], \"scene\": 0"), "extensionsRequired"),
        (with("\"nodes\": [0, 2]", "\"nodes\": []"), "no vertices"),
    ];
    for (json, said) in rows {
        let error = read(&json).expect_err(&json);
        assert!(error.what.contains(said), "{json}: {error}");
        assert!(!error.help.is_empty(), "{error}");
    }
    let whole = in_glb();
    // The padding of the last chunk is not needed, but it is said to be there.
    for cut in 0..whole.len() {
        let read = Mesh::read("a.glb", &whole[..cut], &mut |_: &str| unreachable!());
        assert!(read.is_err(), "{cut}");
    }
}

#[test]
fn what_would_swell_is_refused() {
    let many = format!("{{ \"nodes\": [{}{{}}] }}", "{},".repeat(300_000));
    let error = read(&many).expect_err("it has too many objects");
    assert!(error.what.contains("too many objects"), "{error}");
    // 60,000 nodes of a mesh of 100 triangles.
    let node = r#"{ "mesh": 0 },"#;
    let nodes = node.repeat(60_000);
    let primitive = r#"{ "attributes": { "POSITION": 0 }, "indices": 1 },"#.repeat(100);
    let list: Vec<String> = (0..60_000).map(|at| at.to_string()).collect();
    let json = format!(
        r#"{{ "asset": {{ "version": "2.0" }}, "scenes": [{{ "nodes": [{}] }}], "nodes": [{}],
        "meshes": [{{ "primitives": [{}] }}], {}"#,
        list.join(","),
        nodes.trim_end_matches(','),
        primitive.trim_end_matches(','),
        NODES
            .split_once("\"accessors\"")
            .map(|it| format!("\"accessors\"{}", it.1))
            .expect("it has")
    );
    let error = read(&json).expect_err("it shows too many");
    assert!(
        error.what.contains("more than 1000000 primitives"),
        "{error}"
    );
}

#[test]
fn nodes_that_add_nothing_are_bounded_too() {
    // 1,001 nodes of 1,000 sets of points.
    let list: Vec<String> = (0..1001).map(|at| at.to_string()).collect();
    let node = r#"{ "mesh": 0 },"#.repeat(1001);
    let points = r#"{ "attributes": { "POSITION": 0 }, "mode": 0 },"#.repeat(1000);
    let rest = NODES.split_once("\"accessors\"").expect("it has").1;
    let json = format!(
        r#"{{ "asset": {{ "version": "2.0" }}, "scenes": [{{ "nodes": [{}] }}], "nodes": [{}],
        "meshes": [{{ "primitives": [{}] }}], "accessors"{rest}"#,
        list.join(","),
        node.trim_end_matches(','),
        points.trim_end_matches(','),
    );
    let error = read(&json).expect_err("it shows too many");
    assert!(
        error.what.contains("more than 1000000 primitives"),
        "{error}"
    );
    assert_eq!(error.within.as_deref(), Some("nodes[1000]"), "{error}");
}

#[test]
fn faults_have_the_path_of_their_object() {
    #[rustfmt::skip]
    let rows = [
        ("\"children\": [1]", "\"children\": [0]", "nodes[0]"),
        ("\"POSITION\": 0", "\"POSITION\": 9", "meshes[0].primitives[0]"),
        ("\"count\": 3, \"type\": \"SCALAR\"", "\"count\": 2, \"type\": \"SCALAR\"", "meshes[0].primitives[0]"),
        ("\"count\": 3, \"type\": \"VEC3\"", "\"count\": 4, \"type\": \"VEC3\"", "accessors[0]"),
        ("5123", "5126", "accessors[1]"),
        ("[0, 0, 5]", "[0, 0, 1e30]", "accessors[0], item 0"),
        ("\"byteLength\": 36", "\"byteLength\": 400", "bufferViews[0]"),
        ("three.bin", "data:;base64,####", "buffers[0]"),
    ];
    for (old, new, place) in rows {
        let error = read(&NODES.replacen(old, new, 1)).expect_err(new);
        assert_eq!(error.within.as_deref(), Some(place), "{error}");
        assert!(error.to_string().starts_with(place), "{error}");
    }
    // Of text it is the line.
    let error = read(&NODES.replace("\"scene\": 0,\n", "\"scene\": 0\n")).expect_err("a comma");
    assert_eq!((error.line, error.column), (Some(2), Some(1)), "{error}");
    let json = NODES.replace("\"scene\": 0,\n", "\"scene\": 0\n");
    let read = |bytes: &[u8]| {
        let read = Mesh::read("a.glb", bytes, &mut |_: &str| unreachable!());
        read.expect_err("it is wrong").within.unwrap_or_default()
    };
    assert_eq!(read(&glb(&json, &buffer())), "line 2, column 1 of its JSON");
    let whole = in_glb();
    assert_eq!(read(&whole[..whole.len() - 1]), {
        let binary = buffer().len().next_multiple_of(4) + 8;
        format!("byte {}", whole.len() - binary)
    });
}
