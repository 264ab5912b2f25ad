//! Built-in meshes: closed, outward, and of the area that geometry says.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

use motes::mesh::{self, BUILTIN, Mesh, MeshError, cube, cylinder, plane, sphere, torus};

/// How often each directed edge is there.
fn edges(mesh: &Mesh) -> HashMap<(u32, u32), u32> {
    let mut edges = HashMap::new();
    for [a, b, c] in mesh.triangles() {
        for edge in [(*a, *b), (*b, *c), (*c, *a)] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges
}

/// Whether each edge is run through once each way, so that inside and outside are told apart.
fn is_closed(mesh: &Mesh) -> bool {
    let edges = edges(mesh);
    edges
        .iter()
        .all(|((a, b), count)| *count == 1 && edges.get(&(*b, *a)) == Some(&1))
}

/// By the divergence theorem; above 0 where faces look outward.
fn volume(mesh: &Mesh) -> f64 {
    let of = |face: usize| {
        let [a, b, c] = mesh.corners(face).map(|p| p.map(f64::from));
        let cross = [
            b[1] * c[2] - b[2] * c[1],
            b[2] * c[0] - b[0] * c[2],
            b[0] * c[1] - b[1] * c[0],
        ];
        (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0
    };
    (0..mesh.triangles().len()).map(of).sum()
}

/// Vertices, less edges, and faces: 2 for a sphere, 0 for a torus.
fn euler(mesh: &Mesh) -> i64 {
    let edges = edges(mesh).len() as i64 / 2;
    mesh.positions().len() as i64 - edges + mesh.triangles().len() as i64
}

fn assert_near(what: &str, got: f64, expected: f64) {
    let off = (got / expected - 1.0).abs();
    assert!(off < 1e-6, "{what}: {got} for {expected}");
}

fn right(mesh: Result<Mesh, MeshError>) -> Mesh {
    mesh.expect("its numbers are right")
}

#[test]
fn closed_meshes_are_closed_and_look_outward() {
    let sides = 7.0;
    let polygon = 0.5 * sides * (TAU / sides).sin();
    let chord = 2.0 * (PI / sides).sin();
    // Edge of an icosahedron in a unit sphere.
    let edge = 4.0 / (10.0 + 2.0 * 5f64.sqrt()).sqrt();
    #[rustfmt::skip]
    let cases = [
        ("cube", right(cube(3.0)), 2, 54.0, 27.0),
        ("cylinder", right(cylinder(2.0, 5.0, 7)), 2, 8.0 * polygon + 10.0 * sides * chord, 20.0 * polygon),
        ("icosahedron", right(sphere(1.0, 0)), 2, 5.0 * 3f64.sqrt() * edge * edge, 5.0 * (3.0 + 5f64.sqrt()) / 12.0 * edge.powi(3)),
    ];
    for (what, mesh, characteristic, area, inside) in cases {
        assert!(is_closed(&mesh), "{what}");
        assert_eq!(euler(&mesh), characteristic, "{what}");
        assert_near(what, mesh.area(), area);
        assert_near(what, volume(&mesh), inside);
        assert!(mesh.notes().is_empty());
    }
    // Torus and sphere come near to what they stand for with the square of their parts.
    let ideal = TAU * TAU * 2.0 * 0.5;
    let off = [24, 48, 96].map(|n| 1.0 - right(torus(2.0, 0.5, n, n)).area() / ideal);
    assert!(off[0] > 0.0 && off[0] < 0.02, "{off:?}");
    for pair in off.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.1, "{off:?}");
    }
    let ring = right(torus(2.0, 0.5, 24, 12));
    assert!(is_closed(&ring) && volume(&ring) > 0.0);
    assert_eq!(euler(&ring), 0);
    let off = [2, 3, 4].map(|n| 1.0 - right(sphere(2.0, n)).area() / (16.0 * PI));
    for pair in off.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.2, "{off:?}");
    }
    let ball = right(sphere(2.0, 3));
    assert!(is_closed(&ball) && volume(&ball) > 0.0);
    for p in ball.positions() {
        assert_near(
            "radius",
            f64::from(p.iter().map(|x| x * x).sum::<f32>()),
            4.0,
        );
    }
}

#[test]
fn a_plane_faces_up() {
    let mesh = right(plane(4.0, 3.0));
    assert_near("area", mesh.area(), 12.0);
    for face in 0..2 {
        let [x, y, z] = mesh.doubled_area(face);
        assert_eq!((x, y), (0.0, 0.0));
        assert_near("normal", z, 12.0);
    }
}

#[test]
fn parts_are_sides() {
    let mesh = right(cube(2.0));
    for face in 0..12 {
        let part = &mesh.parts()[mesh.face_parts()[face] as usize].group;
        let axis = ["x", "y", "z"].iter().position(|axis| part.ends_with(axis));
        let sign = if part.starts_with('-') { -1.0 } else { 1.0 };
        let mut expected = [0.0; 3];
        expected[axis.expect("an axis")] = 4.0 * sign;
        assert_eq!(mesh.doubled_area(face), expected, "{part}");
    }
    let names = |mesh: &Mesh| -> Vec<String> {
        mesh.parts().iter().map(|part| part.group.clone()).collect()
    };
    assert_eq!(
        names(&right(cylinder(1.0, 1.0, 5))),
        ["side", "bottom", "top"]
    );
}

#[test]
fn built_in_meshes_are_within_one() {
    for name in BUILTIN {
        let mesh = right(mesh::builtin(name).expect("it is built in"));
        let coordinates = mesh.positions().iter().flatten();
        let most = coordinates.map(|x| x.abs()).fold(0.0, f32::max);
        assert!((most - 1.0).abs() < 1e-6, "{name}: {most}");
        let (center, radius) = mesh.bounding_sphere();
        assert!(center.iter().all(|x| x.abs() < 1e-6), "{name}: {center:?}");
        for p in mesh.positions() {
            let distance = p.iter().map(|x| x * x).sum::<f32>().sqrt();
            assert!(distance <= radius * 1.000_001, "{name}");
        }
    }
    assert!(mesh::builtin("teapot").is_none());
}

#[test]
fn wrong_numbers_are_refused() {
    let wrong = [
        cube(0.0),
        cube(f32::NAN),
        cube(1e7),
        plane(1.0, -1.0),
        cylinder(1.0, 1.0, 2),
        cylinder(1.0, 1.0, 10_001),
        sphere(1.0, 9),
        torus(1.0, 1.0, 8, 8),
        torus(1.0, 0.5, 2, 8),
        torus(1.0, 0.5, 8, 1001),
    ];
    for mesh in wrong {
        let error = mesh.expect_err("its numbers are wrong");
        assert!(!error.what.is_empty() && !error.help.is_empty());
    }
}

#[test]
fn digests_tell_meshes_apart() {
    let mut digests: Vec<u64> = [
        cube(2.0),
        cube(2.000_000_2),
        plane(2.0, 2.0),
        sphere(1.0, 1),
        sphere(1.0, 2),
        torus(0.7, 0.3, 8, 8),
        torus(0.7, 0.3, 16, 4),
    ]
    .map(|mesh| right(mesh).digest())
    .to_vec();
    digests.sort_unstable();
    digests.dedup();
    assert_eq!(digests.len(), 7);
    assert_eq!(right(cube(2.0)), right(cube(2.0)));
}

/// Every letter that there is.
const ALL: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789!?.-";

#[test]
fn letters_are_closed_and_can_be_walked_on() {
    for letter in ALL.chars() {
        let mesh = right(mesh::letters(&letter.to_string()));
        assert!(is_closed(&mesh), "{letter}");
        let surface = mesh::Surface::new(&mesh, 1.0);
        let surface = surface.unwrap_or_else(|e| panic!("{letter}: {}", e.what));
        assert!(
            surface.notes().is_empty(),
            "{letter}: {:?}",
            surface.notes()
        );
        // As high as they should be, and no higher; as deep; in the middle.
        let over = |axis: usize| {
            let all = mesh.positions().iter().map(|place| place[axis]);
            all.fold((f32::MAX, f32::MIN), |(low, high), x| {
                (low.min(x), high.max(x))
            })
        };
        let tall = !".-".contains(letter);
        assert!(!tall || over(1) == (-0.5, 0.5), "{letter}: {:?}", over(1));
        assert_eq!(over(2), (-0.15, 0.15));
        assert!((over(0).0 + over(0).1).abs() < 1e-6);
    }
}

#[test]
fn letters_have_the_areas_and_holes_that_they_should() {
    // Of cells a tenth wide: full ones, and halves.
    let volume_of = |text: &str, cells: f64| {
        let mesh = right(mesh::letters(text));
        assert_near(text, volume(&mesh), cells * 0.01 * 0.3);
    };
    volume_of("I", 20.0);
    volume_of("L", 16.0 + 14.0);
    volume_of("T", 16.0 + 16.0);
    // 80, less the corners cut off: outside four triangles of 2, inside a hole of 4 by 6 less four of a half.
    volume_of("O", 80.0 - 8.0 - (24.0 - 2.0));
    // Euler: 2 for each letter, 2 less for each hole.
    for (text, wanted) in [
        ("I", 2),
        ("O", 0),
        ("B", -2),
        ("8", -2),
        ("FIRE", 6),
        ("! ?", 8),
    ] {
        assert_eq!(euler(&right(mesh::letters(text))), wanted, "{text}");
    }
    let mesh = right(mesh::letters("To be"));
    let groups: Vec<&str> = mesh
        .parts()
        .iter()
        .map(|part| part.group.as_str())
        .collect();
    assert_eq!(groups, ["T", "O", "B", "E"]);
    // 8, 8, 8 and 7 cells; one and a half between, and a space of four besides.
    let (_, width) = mesh
        .positions()
        .iter()
        .fold((0, 0.0f32), |most, at| (0, most.1.max(at[0])));
    assert!(
        (2.0 * width - (31.0 + 4.5 + 4.0) / 10.0).abs() < 1e-5,
        "{width}"
    );
}

#[test]
fn letters_that_are_not_there_are_refused() {
    for (text, wanted) in [
        ("", "there are no letters"),
        ("  ", "there are no letters"),
        ("a\u{e9}", "no solid letter \"\u{e9}\""),
        ("a#", "no solid letter \"#\""),
    ] {
        let error = mesh::letters(text).expect_err("it is wrong");
        assert!(error.what.contains(wanted), "{}", error.what);
        assert!(!error.help.is_empty());
    }
    let error = mesh::letters(&"A".repeat(65)).expect_err("there are too many");
    assert!(
        error.what.contains("there are 65 letters"),
        "{}",
        error.what
    );
    assert!(mesh::builtin("letters:A").is_some_and(|made| made.is_ok()));
}
