//! Which triangle is seen, and how near it is, by lines of sight in double precision: away from edges,
//! where a subpixel decides.

use motes::mesh;

use crate::support::*;

/// A triangle in world space.
type Triangle = [Place; 3];

/// How deep the line of sight meets a triangle's plane, and how far inside the triangle, as the least
/// share of a corner.
fn met(way: Place, eye: Place, [a, b, c]: Triangle) -> Option<(f64, f64)> {
    let (ab, ac) = (minus(b, a), minus(c, a));
    let normal = cross(ab, ac);
    let slant = dot(normal, way);
    if slant == 0.0 {
        return None;
    }
    let depth = dot(normal, minus(a, eye)) / slant;
    let place = [0, 1, 2].map(|i| eye[i] + way[i] * depth - a[i]);
    let area = dot(normal, normal);
    let of_b = dot(cross(place, ac), normal) / area;
    let of_c = dot(cross(ab, place), normal) / area;
    Some((depth, of_b.min(of_c).min(1.0 - of_b - of_c)))
}

#[test]
fn what_is_seen_is_what_lines_of_sight_meet_first() {
    let parts = [
        ("torus", [70.0, 20.0], 0.9, [0.0, 0.1, 0.0]),
        ("cube", [25.0, 40.0], 0.7, [0.8, -0.4, 0.5]),
        ("sphere", [0.0, 10.0], 0.6, [-0.8, 0.5, -0.4]),
        // Through the near plane, and far beyond the picture.
        ("plane", [-90.0, 30.0], 60.0, [25.0, -0.9, -5.0]),
        ("cylinder", [80.0, 5.0], 0.5, [-0.7, -0.4, 2.6]),
    ];
    let text: String = parts
        .iter()
        .map(|(name, [x, y], scale, at)| {
            let more = format!("rotation_degrees = [{x}, {y}]\nscale = {scale}\nposition = {at:?}");
            surface(name, &more)
        })
        .collect();
    let drawn = drawn(&scene_with(&format!("{NOBODY}{text}")));
    let mut triangles: Vec<Triangle> = Vec::new();
    for (name, turns, scale, at) in parts {
        let mesh = mesh::builtin(name)
            .expect("it is built in")
            .expect("it is right");
        let place = |corner| placed(corner, turns, scale, at);
        triangles.extend((0..mesh.triangles().len()).map(|face| mesh.corners(face).map(place)));
    }
    let eye = [0.0, 0.0, 4.0];
    let (mut seen, mut unsure, mut empty) = (0, 0, 0);
    for pixel in (0..WIDTH * HEIGHT).filter(|pixel| pixel % 11 == 0) {
        for (sample, [right, down]) in SAMPLES.into_iter().enumerate() {
            let x = (pixel % WIDTH) as f64 + right - 80.0;
            let y = 60.0 - (pixel / WIDTH) as f64 - down;
            let way = [x / focal(), y / focal(), -1.0];
            let mut all: Vec<(f64, f64, u32)> = Vec::new();
            for (face, triangle) in (1..).zip(&triangles) {
                if let Some((depth, inside)) = met(way, eye, *triangle)
                    && inside > -0.02
                    && depth > 0.09
                {
                    all.push((depth, inside, face));
                }
            }
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            let got = drawn.faces[pixel][sample];
            // Near an edge, the near plane or another triangle, rounding decides.
            let sure = |(depth, inside, _): &(f64, f64, u32)| *inside > 0.02 && *depth > 0.11;
            match all.as_slice() {
                [] => {
                    assert_eq!(got, 0, "{pixel} {sample}");
                    empty += 1;
                }
                [first, rest @ ..]
                    if sure(first) && rest.iter().all(|other| other.0 > first.0 * 1.001) =>
                {
                    assert_eq!(got, first.2, "{pixel} {sample}: {all:?}");
                    let near = drawn.nearness[pixel][sample] * first.0;
                    assert!((near - 1.0).abs() < 2e-4, "{near}");
                    seen += 1;
                }
                _ => unsure += 1,
            }
        }
    }
    assert!(
        seen > 3000 && empty > 300 && unsure < seen / 4,
        "{seen} {empty} {unsure}"
    );
}

#[test]
fn a_disc_takes_as_much_of_the_picture_as_it_is_large() {
    // A ball of radius 1 from 4 units away: a disc whose half-angle has the sine 1/4.
    let drawn = drawn(&scene_with(&format!("{NOBODY}{}", surface("sphere", ""))));
    let covered: f64 = drawn.surfaces.iter().map(|pixel| 1.0 - pixel[3]).sum();
    let radius = focal() * 0.25 / (1.0 - 0.0625f64).sqrt();
    let disc = std::f64::consts::PI * radius * radius;
    // The ball is made of triangles within it.
    assert!(
        covered < disc && covered > 0.985 * disc,
        "{covered} of {disc}"
    );
}
