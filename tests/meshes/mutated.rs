//! Mesh files changed at random: each is a mesh or an error, in bounded time, and what is a mesh
//! is sound.

use std::time::{Duration, Instant};

use motes::mesh::{Mesh, MeshError};

use crate::gltf::{buffer, in_glb};

/// No mutant may take longer.
const MOST_TIME: Duration = Duration::from_secs(5);

/// A sequence of numbers that look random (splitmix64).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) % end.max(1) as u64) as usize
    }
}

/// Words that numbers are replaced by.
const WORDS: [&str; 14] = [
    "0",
    "-1",
    "1e9",
    "nan",
    "inf",
    "4294967295",
    "-2147483648",
    "18446744073709551615",
    "2",
    "1e-45",
    "255",
    "65536",
    "{",
    "]",
];

/// The file with one change or two: bits, runs of bytes, words.
fn mutant(file: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..=random.below(2) {
        let at = random.below(bytes.len());
        let end = (at + 1 + random.below(24)).min(bytes.len());
        match random.below(7) {
            0 | 1 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            2 => drop(bytes.drain(at..end)),
            3 => {
                let copy = bytes[at..end].to_vec();
                let to = random.below(bytes.len());
                drop(bytes.splice(to..to, copy));
            }
            4 => bytes.truncate(at),
            5 if at < bytes.len() => bytes[at] = [0, 0xff, 0x7f, 0x80][random.below(4)],
            _ => {
                // A number as text, if there is one from here on.
                let is_digit = |byte: &u8| byte.is_ascii_digit();
                if let Some(first) = bytes[at..].iter().position(is_digit) {
                    let start = at + first;
                    let length = bytes[start..].iter().take_while(|it| is_digit(it)).count();
                    let word = WORDS[random.below(WORDS.len())].bytes();
                    drop(bytes.splice(start..start + length, word));
                }
            }
        }
    }
    bytes
}

fn assert_sound(mesh: &Mesh) {
    let count = mesh.positions().len();
    assert!(!mesh.triangles().is_empty());
    assert_eq!(mesh.face_parts().len(), mesh.triangles().len());
    for face in 0..mesh.triangles().len() {
        let corners = mesh.triangles()[face];
        assert!(corners.iter().all(|at| (*at as usize) < count));
        assert!(mesh.doubled_area(face).iter().any(|x| *x != 0.0));
        assert!((mesh.face_parts()[face] as usize) < mesh.parts().len());
    }
    assert!(mesh.positions().iter().flatten().all(|x| x.abs() <= 1e6));
    assert!(mesh.area().is_finite() && mesh.bounding_sphere().1.is_finite());
}

#[test]
fn a_mutated_mesh_is_a_mesh_or_an_error() {
    let knot = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\ng a\nusemtl b\nf 1 2 3 4\nf -1/2/3 -2//1 1\n";
    let ascii = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                 property float z\nelement face 2\nproperty list uchar int vertex_indices\n\
                 end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 2\n";
    let mut binary = ascii
        .split("end_header\n")
        .next()
        .expect("a header")
        .replace("ascii", "binary_little_endian")
        .into_bytes();
    binary.extend(b"end_header\n");
    for x in [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0] {
        binary.extend(x.to_le_bytes());
    }
    for face in [&[0i32, 1, 2, 3][..], &[0, 1, 2]] {
        binary.push(face.len() as u8);
        binary.extend(face.iter().flat_map(|at| at.to_le_bytes()));
    }
    let glb = in_glb();
    let end = glb
        .iter()
        .rposition(|byte| *byte == b'}')
        .expect("it has JSON");
    let json = String::from_utf8_lossy(&glb[20..=end]);
    let json = json.replace("\"byteLength\": 42", "\"byteLength\": 42, \"uri\": \"a\"");
    let corpus: [(&str, Vec<u8>); 5] = [
        ("a.obj", knot.into()),
        ("a.ply", ascii.into()),
        ("b.ply", binary),
        ("a.glb", glb),
        ("a.gltf", json.into()),
    ];
    let full = std::env::var("MOTES_FULL").is_ok_and(|value| !value.is_empty() && value != "0");
    let rounds = if full { 200_000 } else { 6_000 };
    for (name, file) in &corpus {
        let (mut right, mut wrong) = (0, 0);
        let mut random = Random(7);
        for number in 0..rounds {
            let bytes = mutant(file, &mut random);
            let begun = Instant::now();
            let read = Mesh::read(name, &bytes, &mut |path: &str| match path.len() {
                0..20 => Ok(buffer()),
                _ => Err(MeshError::new("no such file", "another")),
            });
            assert!(begun.elapsed() < MOST_TIME, "{name}, {number}");
            match read {
                Ok(mesh) => {
                    assert_sound(&mesh);
                    right += 1;
                }
                Err(error) => {
                    assert!(!error.what.is_empty() && !error.help.is_empty());
                    assert!(error.what.len() < 1000, "{error}");
                    wrong += 1;
                }
            }
        }
        println!("{name}: {right} meshes, {wrong} errors");
        // Both happen, so that both are tested.
        assert!(wrong > rounds / 20, "{name}: {wrong}");
        assert!(right > rounds / 50, "{name}: {right}");
    }
}
