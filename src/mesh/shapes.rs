//! Meshes made from numbers, the same on every machine. Closed ones face outward; +z is up.

use std::collections::HashMap;

use super::build::Builder;
use super::{MOST_COORDINATE, Mesh, MeshError};
use crate::transcendental::{cos_turns, sin_turns};

/// Names of the meshes that need no file.
pub const BUILTIN: [&str; 5] = ["cube", "cylinder", "plane", "sphere", "torus"];

/// The built-in mesh of that name, within 1 of the origin along each axis: a cube of edge 2, a
/// cylinder of radius 1 and height 2, a plane 2 by 2, a sphere of radius 1, a torus of radii 0.7
/// and 0.3; or, of `letters:` and a text, that text ([`letters`](super::letters)). `None` if there is
/// none.
///
/// # Errors
/// Those of letters; none of the others fails.
pub fn builtin(name: &str) -> Option<Result<Mesh, MeshError>> {
    if let Some(text) = name.strip_prefix("letters:") {
        return Some(super::letters(text));
    }
    Some(match name {
        "cube" => cube(2.0),
        "cylinder" => cylinder(1.0, 2.0, 96),
        "plane" => plane(2.0, 2.0),
        "sphere" => sphere(1.0, 4),
        "torus" => torus(0.7, 0.3, 96, 48),
        _ => return None,
    })
}

/// A cube around the origin, of 12 triangles; parts `-x`, `+x`, … `+z` of 2 each.
///
/// # Errors
/// An edge, in world units, that is not above 0 or beyond 1,000,000.
pub fn cube(edge: f32) -> Result<Mesh, MeshError> {
    above_zero(&[("edge", edge)])?;
    let half = 0.5 * edge;
    let mut built = Builder::default();
    for corner in 0..8 {
        let side = |bit: u32| if corner >> bit & 1 == 1 { half } else { -half };
        built.vertex([side(0), side(1), side(2)])?;
    }
    for (part, corners) in [
        ("-x", [0, 4, 6, 2]),
        ("+x", [1, 3, 7, 5]),
        ("-y", [0, 1, 5, 4]),
        ("+y", [2, 6, 7, 3]),
        ("-z", [0, 2, 3, 1]),
        ("+z", [4, 5, 7, 6]),
    ] {
        built.part(part, "")?;
        built.polygon(&corners)?;
    }
    built.finish("cube")
}

/// A rectangle in the x-y plane around the origin that faces +z, of 2 triangles.
///
/// # Errors
/// A side, in world units, that is not above 0 or beyond 1,000,000.
pub fn plane(length: f32, width: f32) -> Result<Mesh, MeshError> {
    above_zero(&[("length", length), ("width", width)])?;
    let (x, y) = (0.5 * length, 0.5 * width);
    let mut built = Builder::default();
    for (x, y) in [(-x, -y), (x, -y), (x, y), (-x, y)] {
        built.vertex([x, y, 0.0])?;
    }
    built.polygon(&[0, 1, 2, 3])?;
    built.finish("plane")
}

/// A prism of so many sides around the z axis, centred: 4 triangles a side; parts `side`, `bottom`
/// and `top`.
///
/// # Errors
/// A radius or height, in world units, that is not above 0 or beyond 1,000,000; other than 3 to
/// 10,000 sides.
pub fn cylinder(radius: f32, height: f32, sides: u32) -> Result<Mesh, MeshError> {
    above_zero(&[("radius", radius), ("height", height)])?;
    within("sides", sides, 3..=10_000)?;
    let mut built = Builder::default();
    for z in [-0.5 * height, 0.5 * height] {
        built.vertex([0.0, 0.0, z])?;
    }
    for side in 0..sides {
        let (x, y) = around(side, sides, radius);
        built.vertex([x, y, -0.5 * height])?;
        built.vertex([x, y, 0.5 * height])?;
    }
    let corners = |side: u32| {
        let next = (side + 1) % sides;
        [2 + 2 * side, 2 + 2 * next, 3 + 2 * next, 3 + 2 * side]
    };
    built.part("side", "")?;
    for side in 0..sides {
        built.polygon(&corners(side))?;
    }
    built.part("bottom", "")?;
    for [low, next_low, ..] in (0..sides).map(corners) {
        built.polygon(&[0, next_low, low])?;
    }
    built.part("top", "")?;
    for [.., next_high, high] in (0..sides).map(corners) {
        built.polygon(&[1, high, next_high])?;
    }
    built.finish("cylinder")
}

/// An icosahedron whose faces are parted in 4 so many times, its vertices on the sphere around the
/// origin: 20 · 4^`subdivisions` triangles.
///
/// # Errors
/// A radius, in world units, that is not above 0 or beyond 1,000,000; more than 8 subdivisions.
pub fn sphere(radius: f32, subdivisions: u32) -> Result<Mesh, MeshError> {
    above_zero(&[("radius", radius)])?;
    within("subdivisions", subdivisions, 0..=8)?;
    // Three golden rectangles.
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut places = Vec::new();
    for (a, b) in [
        (-1.0, -golden),
        (1.0, -golden),
        (-1.0, golden),
        (1.0, golden),
    ] {
        places.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]]);
    }
    // Faces are the triples of vertices that are an edge, 2, apart.
    let squared =
        |p: [f64; 3], q: [f64; 3]| -> f64 { (0..3).map(|i| (p[i] - q[i]) * (p[i] - q[i])).sum() };
    let is_edge = |i: usize, j: usize| (squared(places[i], places[j]) - 4.0).abs() < 1e-9;
    let mut faces = Vec::new();
    for (i, j, k) in triples(places.len()) {
        if is_edge(i, j) && is_edge(j, k) && is_edge(i, k) {
            let front = determinant(places[i], places[j], places[k]) > 0.0;
            faces.push(if front { [i, j, k] } else { [i, k, j] });
        }
    }
    for place in &mut places {
        *place = on_unit_sphere(*place);
    }
    for _ in 0..subdivisions {
        let mut middles = HashMap::new();
        let mut parted = Vec::with_capacity(4 * faces.len());
        for [i, j, k] in faces {
            let [a, b, c] = [(i, j), (j, k), (k, i)].map(|(p, q): (usize, usize)| {
                *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    let sum = [0, 1, 2].map(|x| places[p][x] + places[q][x]);
                    places.push(on_unit_sphere(sum));
                    places.len() - 1
                })
            });
            parted.extend([[i, a, c], [a, j, b], [c, b, k], [a, b, c]]);
        }
        faces = parted;
    }
    let mut built = Builder::default();
    for place in places {
        built.vertex(place.map(|x| (x * f64::from(radius)) as f32))?;
    }
    for face in faces {
        built.polygon(&face.map(|at| at as u32))?;
    }
    built.finish("sphere")
}

/// A ring around the z axis: `radius` from the axis to the middle of its tube, which has
/// `tube_radius`; cut into so many `segments` along it, each with so many `sides`: 2 triangles a
/// side of a segment.
///
/// # Errors
/// A radius, in world units, that is not above 0 or beyond 1,000,000; a tube that meets the axis;
/// other than 3 to 1,000 segments or sides.
pub fn torus(radius: f32, tube_radius: f32, segments: u32, sides: u32) -> Result<Mesh, MeshError> {
    above_zero(&[("radius", radius), ("tube radius", tube_radius)])?;
    within("segments", segments, 3..=1000)?;
    within("sides", sides, 3..=1000)?;
    if tube_radius >= radius {
        let what = format!("the tube's radius, {tube_radius}, is not below {radius}");
        return Err(MeshError::new(what, "a tube that does not meet the axis"));
    }
    let mut built = Builder::default();
    for segment in 0..segments {
        for side in 0..sides {
            let (out, z) = around(side, sides, tube_radius);
            let (x, y) = around(segment, segments, radius + out);
            built.vertex([x, y, z])?;
        }
    }
    for segment in 0..segments {
        for side in 0..sides {
            let at = |segment: u32, side: u32| segment % segments * sides + side % sides;
            let corners = [
                at(segment, side),
                at(segment + 1, side),
                at(segment + 1, side + 1),
                at(segment, side + 1),
            ];
            built.polygon(&corners)?;
        }
    }
    built.finish("torus")
}

/// The place on a circle, `at` parts of `count` around.
fn around(at: u32, count: u32, radius: f32) -> (f32, f32) {
    let turns = at as f32 / count as f32;
    (radius * cos_turns(turns), radius * sin_turns(turns))
}

fn triples(count: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..count)
        .flat_map(move |i| (i + 1..count).flat_map(move |j| (j + 1..count).map(move |k| (i, j, k))))
}

fn determinant([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3], [cx, cy, cz]: [f64; 3]) -> f64 {
    ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
}

fn on_unit_sphere(place: [f64; 3]) -> [f64; 3] {
    let length = super::build::length(place);
    place.map(|x| x / length)
}

fn above_zero(lengths: &[(&str, f32)]) -> Result<(), MeshError> {
    let is_right = |length: f32| length > 0.0 && length <= MOST_COORDINATE;
    match lengths.iter().find(|(_, length)| !is_right(*length)) {
        None => Ok(()),
        Some((what, length)) => Err(MeshError::new(
            format!("the {what} is {length}"),
            "a number above 0, at most 1_000_000",
        )),
    }
}

fn within(what: &str, count: u32, range: std::ops::RangeInclusive<u32>) -> Result<(), MeshError> {
    if range.contains(&count) {
        return Ok(());
    }
    let (least, most) = range.into_inner();
    let help = format!("a whole number from {least} to {most}");
    Err(MeshError::new(format!("{what}: {count}"), help))
}
