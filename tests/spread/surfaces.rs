//! Meshes made ready to be walked on.

use motes::mesh::surface::NO_EDGE;
use motes::mesh::{Mesh, Surface, cube, cylinder, plane, sphere, torus};

use crate::support::{INNER_CORNER, assert_close};

fn obj(text: &str) -> Mesh {
    Mesh::read("m.obj", text.as_bytes(), &mut |_| {
        unreachable!("it names no file")
    })
    .unwrap_or_else(|e| panic!("{e}"))
}

fn surface(mesh: &Mesh) -> Surface {
    Surface::new(mesh, 1.0).unwrap_or_else(|e| panic!("{e}"))
}

/// Where a place of a face's frame is.
fn raised(surface: &Surface, face: usize, [x, y]: [f64; 2]) -> [f64; 3] {
    let face = &surface.faces()[face];
    [0, 1, 2].map(|i| face.origin[i] + x * face.x[i] + y * face.y[i])
}

/// The vector of a face's plane.
fn turned(surface: &Surface, face: usize, [x, y]: [f64; 2]) -> [f64; 3] {
    let face = &surface.faces()[face];
    [0, 1, 2].map(|i| x * face.x[i] + y * face.y[i])
}

#[test]
fn p64_a_turn_takes_an_edge_onto_itself_and_rotates_about_it() {
    for mesh in [
        cube(2.0),
        sphere(1.0, 2),
        torus(0.7, 0.3, 12, 9),
        Ok(obj(INNER_CORNER)),
    ] {
        let surface = surface(&mesh.expect("it is right"));
        for (half, edge) in surface.half_edges().iter().enumerate() {
            if edge.twin == NO_EDGE {
                continue;
            }
            assert_eq!(surface.half_edges()[edge.twin as usize].twin as usize, half);
            let (face, other) = (half / 3, edge.twin as usize / 3);
            let [cos, sin, dx, dy] = edge.turn;
            let corners = surface.faces()[face].corners;
            for [x, y] in [corners[half % 3], corners[(half + 1) % 3]] {
                let there = [cos * x - sin * y + dx, sin * x + cos * y + dy];
                let (here, there) = (
                    raised(&surface, face, [x, y]),
                    raised(&surface, other, there),
                );
                for axis in 0..3 {
                    assert_close(there[axis], here[axis], 1e-12);
                }
            }
            // What points out of this face points into the other.
            let outward = edge.inward.map(|x| -x);
            let [x, y] = outward;
            let onward = [cos * x - sin * y, sin * x + cos * y];
            let inward = surface.half_edges()[edge.twin as usize].inward;
            assert_close(onward[0], inward[0], 1e-9);
            assert_close(onward[1], inward[1], 1e-9);
            // Rodrigues' rotation about the edge that takes one normal to the other takes that there, too.
            let axis = turned(&surface, face, [outward[1], -outward[0]]);
            let (s, c) = edge.dihedral.sin_cos();
            let v = turned(&surface, face, outward);
            let around = |v: [f64; 3]| {
                let k = axis;
                let cross = [
                    k[1] * v[2] - k[2] * v[1],
                    k[2] * v[0] - k[0] * v[2],
                    k[0] * v[1] - k[1] * v[0],
                ];
                let along: f64 = (0..3).map(|i| k[i] * v[i]).sum();
                // The edge runs the way that turns outward to inward by the negative angle.
                [0, 1, 2].map(|i| v[i] * c - cross[i] * s + k[i] * along * (1.0 - c))
            };
            let rotated = around(v);
            let expected = turned(&surface, other, onward);
            for axis in 0..3 {
                assert_close(rotated[axis], expected[axis], 1e-9);
            }
        }
    }
}

#[test]
fn p57_angles_between_faces_have_the_sign_of_what_they_expose() {
    let right = std::f64::consts::FRAC_PI_2;
    let of = |mesh: &Mesh| {
        let surface = surface(mesh);
        let found = surface.half_edges().iter().map(|edge| edge.dihedral);
        let mut found: Vec<f64> = found.collect();
        found.sort_by(f64::total_cmp);
        found
    };
    let cube = of(&cube(2.0).expect("it is right"));
    // Six diagonals, seen from both sides, then the twelve edges.
    assert!(
        cube[..12].iter().all(|angle| angle.abs() < 1e-12),
        "{cube:?}"
    );
    assert!(
        cube[12..].iter().all(|angle| (angle - right).abs() < 1e-12),
        "{cube:?}"
    );
    let inner = of(&obj(INNER_CORNER));
    assert_close(inner[0], -right, 1e-12);
    assert_close(inner[1], -right, 1e-12);
    assert_close(inner[2], 0.0, 1e-12);
}

#[test]
fn p58_edges_of_polygons_do_not_depend_on_how_they_are_cut() {
    let cube = surface(&cube(2.0).expect("it is right"));
    assert_eq!(cube.features().len(), 24, "12 edges, from both sides");
    assert_close(cube.mean_edge_length(), 2.0, 1e-12);
    // Each square as 4 triangles around its middle, and with its edges cut in two.
    let mut text = String::new();
    let mut count = 0;
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let around = [
                (-1.0, -1.0),
                (0.0, -1.0),
                (1.0, -1.0),
                (1.0, 0.0),
                (1.0, 1.0),
                (0.0, 1.0),
                (-1.0, 1.0),
                (-1.0, 0.0),
            ];
            for (u, v) in around.into_iter().chain([(0.1, 0.2)]) {
                let mut place = [0.0; 3];
                (place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]) = (side, u, v);
                text += &format!("v {} {} {}\n", place[0], place[1], place[2]);
            }
            for at in 0..8 {
                let (a, b) = (count + at + 1, count + (at + 1) % 8 + 1);
                let (a, b) = if side > 0.0 { (a, b) } else { (b, a) };
                text += &format!("f {a} {b} {}\n", count + 9);
            }
            count += 9;
        }
    }
    let finer = surface(&obj(&text));
    assert_eq!(finer.faces().len(), 48);
    assert_eq!(finer.features().len(), 24);
    assert_close(finer.mean_edge_length(), 2.0, 1e-12);
    // A square's borders count once.
    let plane = surface(&plane(3.0, 1.0).expect("it is right"));
    assert_close(plane.mean_edge_length(), 2.0, 1e-12);
}

#[test]
fn p58_what_is_near_a_face_is_found_through_its_polygon_alone() {
    let surface = surface(&cube(2.0).expect("it is right"));
    for face in 0..12 {
        // Near enough for two of its square's edges, or for all four.
        let near = |reach: f64| surface.features_near(face, reach).len();
        assert_eq!((near(1e-3), near(3.0)), (4, 4));
        for feature in surface.features_near(face, 0.1) {
            let length = (feature.along[0].powi(2) + feature.along[1].powi(2)).sqrt();
            assert_close(length, 2.0, 1e-12);
        }
    }
    let strip = "v 0 0 0\nv 9 0 0\nv 9 1 0\nv 0 1 0\nv 9 0 -1\nv 9 1 -1\nv 4 0 0\nv 4 1 0\n\
                 f 1 7 8 4\nf 7 2 3 8\nf 2 5 6 3\n";
    let strip = Surface::new(&obj(strip), 1.0).expect("it is right");
    let far = |reach: f64| strip.features_near(0, reach).len();
    assert_eq!((far(4.9), far(5.1)), (0, 1), "an edge 5 away");
}

#[test]
fn pa12_angles_around_corners_sum_up() {
    let around = |mesh: Mesh| {
        let surface = surface(&mesh);
        let all = surface.half_edges().iter().map(|edge| edge.around);
        all.collect::<Vec<f64>>()
    };
    let pi = std::f64::consts::PI;
    for angle in around(cube(2.0).expect("it is right")) {
        assert_close(angle, 1.5 * pi, 1e-12);
    }
    // Descartes: what is missing to full turns is 4 pi in all, around each corner once.
    let mesh = sphere(1.0, 2).expect("it is right");
    let corners = mesh.positions().len() as f64;
    let each = surface(&mesh);
    let mut whole = 0.0;
    for half in 0..each.half_edges().len() {
        let mut count = 1.0;
        let mut at = each.half_edges()[half - half % 3 + (half + 2) % 3].twin as usize;
        while at != half {
            count += 1.0;
            at = each.half_edges()[at - at % 3 + (at + 2) % 3].twin as usize;
        }
        whole += each.half_edges()[half].around / count;
    }
    assert_close(2.0 * pi * corners - whole, 4.0 * pi, 1e-9);
    // Corners at borders have none.
    assert!(
        around(plane(1.0, 1.0).expect("it is right"))
            .iter()
            .all(|angle| *angle == 0.0)
    );
    let _ = cylinder(1.0, 2.0, 9);
}

#[test]
fn pa19_what_is_wound_wrongly_or_there_twice_is_mended() {
    // A cube whose vertices are those of each face alone; two faces are turned and one is doubled.
    let cube = cube(2.0).expect("it is right");
    let mut text = String::new();
    for face in 0..12 {
        for [x, y, z] in cube.corners(face) {
            text += &format!("v {x} {y} {z}\n");
        }
        let [a, b, c] = [3 * face + 1, 3 * face + 2, 3 * face + 3];
        text += &match face {
            3 | 7 => format!("f {a} {c} {b}\n"),
            5 => format!("f {a} {b} {c}\nf {b} {c} {a}\n"),
            _ => format!("f {a} {b} {c}\n"),
        };
    }
    let mended = surface(&obj(&text));
    assert_eq!(mended.faces().len(), 12);
    let notes = mended.notes();
    assert_eq!(notes.len(), 2, "{notes:?}");
    assert!(notes[0].starts_with("1 of 13 triangles"), "{notes:?}");
    assert!(
        notes[1].starts_with("2 of 12 triangles faced the other way"),
        "{notes:?}"
    );
    for face in mended.faces() {
        let outward: f64 = (0..3).map(|i| face.normal[i] * face.origin[i]).sum();
        assert_close(outward, 1.0, 1e-12);
    }
    assert!(mended.half_edges().iter().all(|edge| edge.twin != NO_EDGE));
    let of_itself = surface(&cube);
    assert_close(
        mended.mean_edge_length(),
        of_itself.mean_edge_length(),
        1e-12,
    );
    assert!(of_itself.notes().is_empty());
}

#[test]
fn pa19_edges_of_three_faces_and_surfaces_of_one_side_are_refused() {
    let fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    let error = Surface::new(&obj(fan), 1.0).expect_err("an edge has three faces");
    assert_eq!(
        error.what,
        "the edge from (0, 0, 0) to (1, 0, 0) has 3 faces"
    );
    // A strip of five triangles whose ends meet turned over.
    let mut moebius = String::new();
    for at in 0..5 {
        let (s, c) = (f64::from(at) * std::f64::consts::TAU / 5.0).sin_cos();
        moebius += &format!("v {c} {s} {}\n", f64::from(at % 2));
    }
    for at in 0..5 {
        moebius += &format!("f {} {} {}\n", at + 1, (at + 1) % 5 + 1, (at + 2) % 5 + 1);
    }
    let error = Surface::new(&obj(&moebius), 1.0).expect_err("it has one side");
    assert!(
        error.what.starts_with("its surface has one side only"),
        "{error}"
    );
}
