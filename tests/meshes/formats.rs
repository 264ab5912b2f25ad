//! OBJ and PLY, as programs write them and as they should not.

use motes::mesh::{Mesh, MeshError};

/// Reads a mesh that names no other file.
pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Mesh, MeshError> {
    Mesh::read(name, bytes, &mut |path: &str| {
        panic!("{path} is asked for");
    })
}

/// A square of two triangles and a triangle below it, in two groups and materials.
const OBJ: &str = "# a comment\nmtllib house.mtl\no house\nv 0 0 0\nv 1 0 0 1.0\r\nv 1 1 0 0.1 0.2 0.3\n\
    v 0 1 0\nvt 0 0\nvn 0 0 1\ng wall\nusemtl brick\nf 1/1/1 2/1/1 3/1/1 4/1/1\n\ng roof top\n\
    usemtl tile\nv 0.5e0 -2 +.5\nf -1 -4 \\\n -5\ns off\nl 1 2\n";

#[test]
fn obj_polygons_are_fanned_and_keep_their_groups_and_materials() {
    let mesh = read("house.obj", OBJ.as_bytes()).expect("it is right");
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [4, 1, 0]]);
    assert_eq!(mesh.positions()[4], [0.5, -2.0, 0.5]);
    let parts: Vec<(&str, &str)> = (mesh.face_parts().iter())
        .map(|part| &mesh.parts()[*part as usize])
        .map(|part| (part.group.as_str(), part.material.as_str()))
        .collect();
    let wall = ("wall", "brick");
    assert_eq!(parts, [wall, wall, ("roof top", "tile")]);
    assert!(mesh.notes().is_empty());
    let slope = (2.0f64 * 2.0 + 0.5 * 0.5).sqrt();
    assert!((mesh.area() - 1.0 - 0.5 * slope).abs() < 1e-6);
}

#[test]
fn faces_without_area_are_left_out_with_a_note() {
    let text = OBJ.replace("s off", "f 1 1 2\nf 1 2 3\nf 2 3 2");
    let mesh = read("house.obj", text.as_bytes()).expect("it can be mended");
    assert_eq!(mesh.triangles().len(), 4);
    assert_eq!(mesh.face_parts().len(), 4);
    assert_eq!(mesh.notes().len(), 1);
    assert!(mesh.notes()[0].contains("2 of 6"), "{:?}", mesh.notes());
}

/// The same triangle and square, in text and in either order of bytes.
fn ply(format: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {format} 1.0\ncomment made by hand\nelement vertex 4\n\
         property double x\nproperty float y\nproperty short z\nproperty uchar red\n\
         element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\n\
         property list uint float weights\nelement strange 2\nproperty int a\nend_header\n"
    )
    .into_bytes();
    let vertices = [
        (0.0, 0.0, -1),
        (2.0, 0.0, -1),
        (2.0, 1.5, -1),
        (0.0, 1.5, -1),
    ];
    let faces: [&[i32]; 2] = [&[0, 1, 2, 3], &[0, 2, 1]];
    if format == "ascii" {
        let mut text = String::new();
        for (x, y, z) in vertices {
            text += &format!("{x} {y}\t{z} 255\n");
        }
        text += "\n0 4 0 1 2 3 2 0.5 0.25\r\n1 3 0 2 1 0\n7\n8\n";
        bytes.extend(text.into_bytes());
        return bytes;
    }
    let little = format == "binary_little_endian";
    let mut put = |mut number: Vec<u8>| {
        if !little {
            number.reverse();
        }
        bytes.extend(number);
    };
    for (x, y, z) in vertices {
        put(f64::to_le_bytes(x).into());
        put(f32::to_le_bytes(y).into());
        put(i16::to_le_bytes(z).into());
        put(vec![255]);
    }
    for face in faces {
        put(vec![0]);
        put(vec![face.len() as u8]);
        for at in face {
            put(at.to_le_bytes().into());
        }
        put(1u32.to_le_bytes().into());
        put(0.5f32.to_le_bytes().into());
    }
    for number in [7i32, 8] {
        put(number.to_le_bytes().into());
    }
    bytes
}

#[test]
fn ply_is_read_in_all_its_forms() {
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let mesh = read("a.PLY", &ply(format)).unwrap_or_else(|e| panic!("{format}: {e}"));
        assert_eq!(
            mesh.triangles(),
            [[0, 1, 2], [0, 2, 3], [0, 2, 1]],
            "{format}"
        );
        assert_eq!(mesh.positions()[2], [2.0, 1.5, -1.0], "{format}");
        assert!((mesh.area() - 4.5).abs() < 1e-9);
    }
}

/// Wrong texts, their lines (0: none), and what is said.
#[test]
fn wrong_objs_are_refused_with_their_lines() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    #[rustfmt::skip]
    let rows: [(String, usize, &str); 19] = [
        (String::new(), 0, "no vertices"),
        ("# nothing\n".into(), 0, "no vertices"),
        (square.into(), 0, "no faces"),
        (format!("{square}f 1 2 5"), 5, "vertex 5, and 4 are above"),
        (format!("{square}f 1 2 -5"), 5, "vertex -5"),
        (format!("{square}f 0 1 2"), 5, "indices begin at 1"),
        (format!("f 1 2 3\n{square}"), 1, "0 are above"),
        (format!("{square}f 1 2"), 5, "2 corners"),
        (format!("{square}f"), 5, "0 corners"),
        (format!("{square}f 1 2 three"), 5, "`three`"),
        (format!("{square}f 1 2 99999999999999999999"), 5, "no corner"),
        (format!("{square}v nan 0 0\nf 1 2 3"), 5, "a coordinate is NaN"),
        (format!("{square}v inf 0 0\nf 1 2 3"), 5, "a coordinate is inf"),
        (format!("{square}v 1e30 0 0\nf 1 2 3"), 5, "a coordinate is 1"),
        (format!("{square}v 1 2\nf 1 2 3"), 5, "fewer than 3"),
        (format!("{square}v 1 2 x\nf 1 2 3"), 5, "`x`"),
        (format!("{square}F 1 2 3"), 5, "`F`"),
        (format!("{square}f 1 1 2\nf 1 2 2"), 0, "none of its 2 faces"),
        (format!("{square}f 1 1 2"), 0, "its only face has no area"),
    ];
    for (text, line, said) in rows {
        let error = read("w.obj", text.as_bytes()).expect_err(&text);
        assert!(error.what.contains(said), "{text}: {error}");
        assert_eq!(error.line.unwrap_or(0), line, "{text}: {error}");
        assert!(!error.help.is_empty(), "{error}");
    }
}

#[test]
fn wrong_plys_are_refused() {
    let ascii = String::from_utf8(ply("ascii")).expect("it is text");
    let with = |old: &str, new: &str| {
        assert_eq!(ascii.matches(old).count(), 1, "{old}");
        ascii.replacen(old, new, 1)
    };
    #[rustfmt::skip]
    let rows: [(String, usize, &str); 19] = [
        (String::new(), 0, "ends in its header"),
        ("solid\n".into(), 1, "does not begin with `ply`"),
        (with("format ascii", "format utf8"), 2, "the format is none"),
        (with("format ascii 1.0\n", ""), 14, "without a format"),
        (with("element vertex 4", "element vertex four"), 4, "`four`"),
        (with("element vertex 4", "element vertex 5"), 23, "fewer numbers"),
        (with("element vertex 4", "element vertex 4000000000"), 0, "4000000000 records of `vertex`"),
        (with("element vertex 4\n", ""), 4, "before any element"),
        (with("property double x", "property real x"), 5, "`real`"),
        (with("property float y", "property float w"), 0, "no `y`"),
        (with("int vertex_indices", "int corners"), 0, "no list of corners"),
        (with("comment made", "kommentar made"), 3, "`kommentar made by hand`"),
        (with("end_header\n", ""), 15, "is no line of a PLY header"),
        (with("2 1.5\t-1", "2 up\t-1"), 18, "`up`"),
        (with("2 1.5\t-1", "2 nan\t-1"), 18, "a coordinate is NaN"),
        (with("0 4 0 1 2 3", "0 4 0 1 2 4"), 21, "vertex 4"),
        (with("0 4 0 1 2 3", "0 4 0 1 2 -3"), 21, "vertex -3"),
        (with("1 3 0 2 1 0", "1 2 0 2 1 0"), 22, "2 corners"),
        (with("1 3 0 2 1 0", "1 99999999 0 2 1 0"), 22, "99999999"),
    ];
    for (text, line, said) in rows {
        let error = read("w.ply", text.as_bytes()).expect_err(&text);
        assert!(error.what.contains(said), "{text}: {error}");
        assert_eq!(error.line.unwrap_or(0), line, "{text}: {error}");
        assert!(!error.help.is_empty(), "{error}");
    }
    let whole = ply("binary_little_endian");
    for cut in 0..whole.len() {
        // The last element says nothing about triangles, but it is counted all the same.
        assert!(read("w.ply", &whole[..cut]).is_err(), "{cut}");
    }
}

#[test]
fn counts_that_lie_take_no_memory() {
    // A list as long as its number says would take 16 GiB.
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n\
                  property float y\nproperty float z\nelement face 1\n\
                  property list uint int vertex_indices\nend_header\n";
    let mut bytes = header.as_bytes().to_vec();
    for x in [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        bytes.extend(x.to_le_bytes());
    }
    bytes.extend(u32::MAX.to_le_bytes());
    let error = read("w.ply", &bytes).expect_err("it lies");
    assert!(
        error.what.contains("2796204") || error.what.contains("4294967295"),
        "{error}"
    );
    // Elements without bytes are not counted one by one.
    let empty = header.replace(
        "element face 1",
        "element nothing 18446744073709551615\nelement face 1",
    );
    let mut bytes = empty.into_bytes();
    bytes.extend([0; 36]);
    let error = read("w.ply", &bytes).expect_err("it has no faces");
    assert!(!error.what.is_empty());
    let huge = header.replace("element vertex 3", "element vertex 99999999999999999999");
    assert!(read("w.ply", huge.as_bytes()).is_err());
}

#[test]
fn more_triangles_than_allowed_are_refused_before_they_are_kept() {
    let mut text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf".to_owned();
    text += &" 1 2 3".repeat(1_400_000);
    let error = read("w.obj", text.as_bytes()).expect_err("it is too large");
    assert!(
        error.what.contains("more than 2796202 triangles"),
        "{error}"
    );
    assert_eq!(error.line, Some(4));
}

#[test]
fn the_ending_says_the_format() {
    for name in ["a.stl", "a", "obj", "a.obj.zip", ".ply"] {
        let error = read(name, OBJ.as_bytes()).expect_err(name);
        assert!(error.help.contains(".obj, .ply, .gltf, .glb"), "{error}");
    }
}

#[test]
fn a_wrong_word_is_named_by_its_line_and_column() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let header = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_index\n\
                  end_header\n0 0 0\n";
    for (name, text, place) in [
        ("w.obj", format!("{square}f 1 2  9\n"), (5, Some(8))),
        ("w.obj", format!("{square}  f 1 2 x3 4\n"), (5, Some(9))),
        ("w.obj", format!("{square}v 1 2 1o\r\n"), (5, Some(7))),
        ("w.obj", format!("{square}\tface 1 2 3\n"), (5, Some(2))),
        // A statement of three lines, wrong in each.
        (
            "w.obj",
            format!("{square}f x \\\n 1 \\\n 2 3\n"),
            (5, Some(3)),
        ),
        (
            "w.obj",
            format!("{square}f 1 \\\n  0 \\\n 2 3\n"),
            (6, Some(3)),
        ),
        (
            "w.obj",
            format!("{square}f 1 \\\n  2 \\\n 3 77\n"),
            (7, Some(4)),
        ),
        ("w.obj", format!("{square}f 1 \\\n  2\n"), (5, None)),
        ("w.obj", format!("{square}# so \\\nf 1 2 5\n"), (6, Some(7))),
        ("w.ply", format!("{header}0  l 0\n3 0 1 0\n"), (11, Some(4))),
        ("w.ply", format!("{header}0 1 0\n3 0 1 8\n"), (12, Some(7))),
        (
            "w.ply",
            format!("{header}0 1 0\n\n9 0 1 0\n"),
            (13, Some(1)),
        ),
        ("w.ply", format!("{header}0 1e9 0\n3 0 1 0\n"), (11, None)),
    ] {
        let error = read(name, text.as_bytes()).expect_err(&text);
        let found = (error.line.unwrap_or(0), error.column);
        assert_eq!(found, place, "{text}: {error}");
    }
}

#[test]
fn a_wrong_number_of_a_binary_ply_is_named_by_its_byte() {
    let right = ply("binary_little_endian");
    let body = right
        .windows(11)
        .position(|it| it == b"end_header\n")
        .expect("a header")
        + 11;
    // A vertex is 8 + 4 + 2 + 1 bytes, and 1 + 1 stand before the corners of the first face.
    let first_corner = body + 4 * 15 + 2;
    let mut wrong = right.clone();
    wrong[first_corner + 4] = 9;
    let error = read("w.ply", &wrong).expect_err("there are 4 vertices");
    let place = format!("byte {}", first_corner + 4);
    assert_eq!(error.within.as_deref(), Some(&*place), "{error}");
    let mut far = right.clone();
    far[body + 15..body + 23].copy_from_slice(&1e9f64.to_le_bytes());
    let error = read("w.ply", &far).expect_err("it is too far");
    let place = format!("byte {}", body + 15);
    assert_eq!(error.within.as_deref(), Some(&*place), "{error}");
    let error = read("w.ply", &right[..first_corner]).expect_err("it is cut");
    assert!(error.within.is_some(), "{error}");
}

#[test]
fn byte_order_marks_are_passed_over() {
    for (name, text) in [("a.obj", OBJ.as_bytes().to_vec()), ("a.ply", ply("ascii"))] {
        let marked = [b"\xef\xbb\xbf", &text[..]].concat();
        assert_eq!(read(name, &marked), read(name, &text), "{name}");
    }
}

#[test]
fn lines_that_go_on_take_time_as_they_are_long() {
    let mut text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf".to_vec();
    text.extend(b" 1 2 3\\\n".repeat(500_000));
    let begun = std::time::Instant::now();
    let mesh = read("a.obj", &text).expect("it is long but right");
    assert_eq!(mesh.triangles().len(), 500_000);
    // Joined again and again it took minutes.
    assert!(begun.elapsed().as_secs() < 10, "{:?}", begun.elapsed());
    // Neither are empty ones kept for their places.
    let empty = [b"\\\n".repeat(2_000_000), b"w".to_vec()].concat();
    let error = read("a.obj", &empty).expect_err("it is no statement");
    assert_eq!((error.line, error.column), (Some(2_000_001), Some(1)));
}

#[test]
fn a_comment_ends_with_its_line() {
    let text = "v 0 0 0 # the first \\\n\nv 1 0 0\n  # a \\\nv 0 1 0\n# b\\\nf 1 2 3\n";
    let mesh = read("a.obj", text.as_bytes()).expect("it is right");
    assert_eq!((mesh.positions().len(), mesh.triangles().len()), (3, 1));
}
