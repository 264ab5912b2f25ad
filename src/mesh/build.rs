//! Vertices and faces, checked one by one as they come from any format.

use std::collections::HashMap;

use super::{MOST_COORDINATE, MOST_TRIANGLES, MOST_VERTICES, Mesh, MeshError, Part};

/// Parts of a mesh at most.
const MOST_PARTS: usize = 65_536;

/// Characters of a group's or a material's name at most; what is longer is cut.
const MOST_NAME_CHARS: usize = 256;

/// A mesh that is being read.
#[derive(Default)]
pub(super) struct Builder {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    parts: Vec<Part>,
    known: HashMap<Part, u32>,
    face_parts: Vec<u32>,
    part: u32,
}

impl Builder {
    /// Makes room for what is known to come, as far as it is allowed to.
    pub(super) fn reserve(&mut self, vertices: usize) -> Result<(), MeshError> {
        let room = vertices.min(MOST_VERTICES);
        let done = self.positions.try_reserve(room);
        done.map_err(|_| MeshError::no_memory(room as u64, "vertices"))
    }

    /// Vertices up to now.
    pub(super) fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Adds a vertex.
    pub(super) fn vertex(&mut self, place: [f32; 3]) -> Result<(), MeshError> {
        let is_right = |x: &f32| x.abs() <= MOST_COORDINATE;
        if let Some(x) = place.iter().find(|x| !is_right(x)) {
            let help = "a number from -1_000_000 to 1_000_000";
            return Err(MeshError::new(format!("a coordinate is {x}"), help));
        }
        if self.positions.len() == MOST_VERTICES {
            let what = format!("there are more than {MOST_VERTICES} vertices");
            return Err(MeshError::new(what, "a smaller mesh"));
        }
        if self.positions.len() == self.positions.capacity() {
            let more = self.positions.len().max(1024);
            self.reserve(more)?;
        }
        self.positions.push(place.map(crate::exact::snap));
        Ok(())
    }

    /// The part that faces are of from now on.
    pub(super) fn part(&mut self, group: &str, material: &str) -> Result<(), MeshError> {
        let name = |name: &str| name.chars().take(MOST_NAME_CHARS).collect();
        let part = Part {
            group: name(group),
            material: name(material),
        };
        if let Some(known) = self.known.get(&part) {
            self.part = *known;
            return Ok(());
        }
        if self.parts.len() == MOST_PARTS {
            let what = format!("there are more than {MOST_PARTS} groups and materials");
            return Err(MeshError::new(what, "fewer of them"));
        }
        self.part = self.parts.len() as u32;
        self.known.insert(part.clone(), self.part);
        self.parts.push(part);
        Ok(())
    }

    /// Adds a face of vertices that are there, as a fan around its first corner.
    pub(super) fn polygon(&mut self, corners: &[u32]) -> Result<(), MeshError> {
        let [first, rest @ ..] = corners else {
            return Err(too_few(0));
        };
        if corners.len() < 3 {
            return Err(too_few(corners.len()));
        }
        let count = self.positions.len();
        if let Some(at) = corners.iter().find(|at| **at as usize >= count) {
            let what = format!("a face has the vertex {at}, counted from 0, of {count}");
            return Err(MeshError::new(what, "a vertex that the file has"));
        }
        let more = corners.len() - 2;
        if self.triangles.len() + more > MOST_TRIANGLES {
            return Err(too_many());
        }
        let room = self.triangles.try_reserve(more);
        room.and_then(|()| self.face_parts.try_reserve(more))
            .map_err(|_| MeshError::no_memory(more as u64, "triangles"))?;
        if self.parts.is_empty() {
            self.part("", "")?;
        }
        for pair in rest.windows(2) {
            self.triangles.push([*first, pair[0], pair[1]]);
            self.face_parts.push(self.part);
        }
        Ok(())
    }

    /// The mesh, called `name`; faces without area are left out.
    pub(super) fn finish(mut self, name: &str) -> Result<Mesh, MeshError> {
        let help = "a mesh file with vertices, and with faces between them";
        if self.positions.is_empty() {
            return Err(MeshError::new("there are no vertices", help));
        }
        let all = self.triangles.len();
        if all == 0 {
            return Err(MeshError::new("there are no faces", help));
        }
        let positions = &self.positions;
        let has_area = |triangle: &[u32; 3]| {
            let corners = triangle.map(|at| positions[at as usize]);
            length(doubled_area(corners)) > 0.0
        };
        let keep: Vec<bool> = self.triangles.iter().map(has_area).collect();
        let mut kept = keep.iter();
        self.triangles.retain(|_| kept.next().is_some_and(|it| *it));
        let mut kept = keep.iter();
        self.face_parts
            .retain(|_| kept.next().is_some_and(|it| *it));
        let left = self.triangles.len();
        if left == 0 {
            let what = match all {
                1 => "its only face has no area".to_owned(),
                all => format!("none of its {all} faces has an area"),
            };
            return Err(MeshError::new(what, "corners that are not on one line"));
        }
        let mut notes = Vec::new();
        if left < all {
            let dropped = all - left;
            let verbs = if dropped == 1 {
                "has no area and is"
            } else {
                "have no area and are"
            };
            notes.push(format!("{dropped} of {all} triangles {verbs} left out"));
        }
        let sphere = sphere_around(positions, &self.triangles);
        let digest = digest(&self);
        Ok(Mesh {
            name: name.to_owned(),
            positions: self.positions,
            triangles: self.triangles,
            parts: self.parts,
            face_parts: self.face_parts,
            notes,
            sphere,
            digest,
        })
    }
}

/// The error of more triangles than there may be.
pub(super) fn too_many() -> MeshError {
    let what = format!("there are more than {MOST_TRIANGLES} triangles");
    MeshError::new(what, "a mesh with fewer triangles")
}

fn too_few(corners: usize) -> MeshError {
    let what = match corners {
        1 => "a face has 1 corner".to_owned(),
        _ => format!("a face has {corners} corners"),
    };
    MeshError::new(what, "at least 3")
}

/// Twice the triangle's area times its outward unit normal.
pub(super) fn doubled_area([a, b, c]: [[f32; 3]; 3]) -> [f64; 3] {
    let [ax, ay, az] = a.map(f64::from);
    let [ux, uy, uz] = [
        f64::from(b[0]) - ax,
        f64::from(b[1]) - ay,
        f64::from(b[2]) - az,
    ];
    let [vx, vy, vz] = [
        f64::from(c[0]) - ax,
        f64::from(c[1]) - ay,
        f64::from(c[2]) - az,
    ];
    [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx]
}

/// Length of a vector.
pub(super) fn length([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

fn sphere_around(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> ([f32; 3], f32) {
    let corners = || triangles.iter().flatten().map(|at| positions[*at as usize]);
    let center: [f64; 3] = [0, 1, 2].map(|i| {
        let low = corners().map(|p| p[i]).fold(f32::MAX, f32::min);
        let high = corners().map(|p| p[i]).fold(f32::MIN, f32::max);
        0.5 * (f64::from(low) + f64::from(high))
    });
    let away = |p: [f32; 3]| length([0, 1, 2].map(|i| f64::from(p[i]) - center[i]));
    let radius = corners().map(away).fold(0.0, f64::max);
    let center = center.map(|x| crate::exact::snap(x as f32));
    // What rounding takes away is less than that.
    (center, (radius * (1.0 + 1e-6)) as f32)
}

/// FNV-1a by words instead of bytes, with its high bits folded in.
fn digest(built: &Builder) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    let mut add = |word: u32| {
        hash = (hash ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3);
        hash ^= hash >> 29;
    };
    add(built.positions.len() as u32);
    for x in built.positions.iter().flatten() {
        add(x.to_bits());
    }
    add(built.triangles.len() as u32);
    for word in built.triangles.iter().flatten().chain(&built.face_parts) {
        add(*word);
    }
    for part in &built.parts {
        for name in [&part.group, &part.material] {
            add(name.len() as u32);
            name.bytes().for_each(|byte| add(byte.into()));
        }
    }
    hash
}
