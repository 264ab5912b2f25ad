//! Triangles joined at their edges: vertices in the same place are one, sides agree.

use std::collections::{HashMap, HashSet};

use super::NO_EDGE;
use super::vectors::{Place, length};
use crate::mesh::{Mesh, MeshError};

/// Triangles whose sides agree, with what was mended.
pub(super) struct Joined {
    pub(super) positions: Vec<Place>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The mesh's face that each was.
    pub(super) sources: Vec<u32>,
    /// Of each half-edge, 3 a triangle, the other one of its edge, or [`NO_EDGE`].
    pub(super) twins: Vec<u32>,
    /// The first triangle of each piece that hangs together.
    pub(super) pieces: Vec<u32>,
    pub(super) notes: Vec<String>,
}

/// A half-edge by its edge's vertices, the lesser first.
struct Side {
    edge: [u32; 2],
    half: u32,
    ascends: bool,
}

pub(super) fn joined(mesh: &Mesh) -> Result<Joined, MeshError> {
    let mut notes = Vec::new();
    let mut known = HashMap::new();
    let mut positions: Vec<Place> = Vec::new();
    let mut of_vertex = Vec::with_capacity(mesh.positions().len());
    for place in mesh.positions() {
        let next = positions.len() as u32;
        let at = *known.entry(place.map(f32::to_bits)).or_insert(next);
        if at == next {
            positions.push(place.map(f64::from));
        }
        of_vertex.push(at);
    }
    let mut triangles = Vec::with_capacity(mesh.triangles().len());
    let mut sources = Vec::with_capacity(mesh.triangles().len());
    let mut met = HashSet::new();
    for (face, corners) in (0..).zip(mesh.triangles()) {
        let corners = corners.map(|at| of_vertex[at as usize]);
        let mut sorted = corners;
        sorted.sort_unstable();
        if met.insert(sorted) {
            triangles.push(corners);
            sources.push(face);
        }
    }
    let doubled = mesh.triangles().len() - triangles.len();
    if doubled > 0 {
        notes.push(format!(
            "{doubled} of {} triangles are there twice and are left out once",
            mesh.triangles().len()
        ));
    }
    let sides = sides(&triangles);
    let place = |at: u32| {
        let [x, y, z] = mesh_place(&positions, at);
        format!("({x}, {y}, {z})")
    };
    let name = |[a, b]: [u32; 2]| format!("from {} to {}", place(a), place(b));
    let mut pairs: Vec<[&Side; 2]> = Vec::new();
    for same in sides.chunk_by(|a, b| a.edge == b.edge) {
        match same {
            [] | [_] => {}
            [one, other] => pairs.push([one, other]),
            [one, ..] => {
                let what = format!("the edge {} has {} faces", name(one.edge), same.len());
                let help = "a surface to spread over, on which each edge has one face or two";
                return Err(MeshError::new(what, help));
            }
        }
    }
    let flips = flips(&positions, &triangles, &pairs).map_err(|at| {
        let [one, _] = pairs[at];
        let what = format!(
            "its surface has one side only, as at the edge {}",
            name(one.edge)
        );
        MeshError::new(
            what,
            "a surface with a front and a back, to spread over the front",
        )
    })?;
    let flipped = flips.iter().filter(|flip| **flip).count();
    if flipped > 0 {
        let all = triangles.len();
        notes.push(format!(
            "{flipped} of {all} triangles faced the other way than those around them and are turned"
        ));
    }
    // A turned triangle keeps its first edge first.
    let local = |face: usize, side: u32| match (flips[face], side) {
        (false, side) => side,
        (true, 0) => 0,
        (true, side) => 3 - side,
    };
    let half = |side: &Side| {
        let face = side.half / 3;
        3 * face + local(face as usize, side.half % 3)
    };
    let mut twins = vec![NO_EDGE; 3 * triangles.len()];
    for [one, other] in pairs {
        let (one, other) = (half(one), half(other));
        twins[one as usize] = other;
        twins[other as usize] = one;
    }
    for (triangle, _) in triangles.iter_mut().zip(&flips).filter(|(_, flip)| **flip) {
        triangle.swap(0, 1);
    }
    let mut joined = Joined {
        positions,
        triangles,
        sources,
        twins,
        pieces: Vec::new(),
        notes,
    };
    joined.sort_by_piece();
    Ok(joined)
}

impl Joined {
    /// Puts the triangles of each piece together; the rest of their order is as it was.
    fn sort_by_piece(&mut self) {
        let count = self.triangles.len();
        let mut piece_of = vec![NO_EDGE; count];
        let mut pieces = 0;
        for first in 0..count {
            if piece_of[first] != NO_EDGE {
                continue;
            }
            let mut found = vec![first];
            piece_of[first] = pieces;
            while let Some(face) = found.pop() {
                for twin in &self.twins[3 * face..3 * face + 3] {
                    let other = *twin as usize / 3;
                    if *twin != NO_EDGE && piece_of[other] == NO_EDGE {
                        piece_of[other] = pieces;
                        found.push(other);
                    }
                }
            }
            pieces += 1;
        }
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|face| piece_of[*face]);
        let mut place_of = vec![0u32; count];
        for (at, face) in (0..).zip(&order) {
            place_of[*face] = at;
        }
        let moved = |half: u32| match half {
            NO_EDGE => NO_EDGE,
            half => 3 * place_of[half as usize / 3] + half % 3,
        };
        let halves = order
            .iter()
            .flat_map(|face| [0, 1, 2].map(|i| 3 * face + i));
        self.twins = halves.map(|half| moved(self.twins[half])).collect();
        self.triangles = order.iter().map(|face| self.triangles[*face]).collect();
        self.sources = order.iter().map(|face| self.sources[*face]).collect();
        let starts =
            (0..count).filter(|at| *at == 0 || piece_of[order[*at]] != piece_of[order[*at - 1]]);
        self.pieces = starts.map(|at| at as u32).collect();
    }
}

fn mesh_place(positions: &[Place], at: u32) -> [f32; 3] {
    positions[at as usize].map(|x| x as f32)
}

fn sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (face, corners) in (0u32..).zip(triangles) {
        for side in 0..3 {
            let (a, b) = (corners[side], corners[(side + 1) % 3]);
            sides.push(Side {
                edge: [a.min(b), a.max(b)],
                half: 3 * face + side as u32,
                ascends: a < b,
            });
        }
    }
    sides.sort_unstable_by_key(|side| (side.edge, side.half));
    sides
}

/// Which triangles have to turn over so that all neighbours face alike, as little of the area of
/// each piece as can be; or the pair that cannot.
fn flips(
    positions: &[Place],
    triangles: &[[u32; 3]],
    pairs: &[[&Side; 2]],
) -> Result<Vec<bool>, usize> {
    let mut neighbours: Vec<Vec<(u32, usize)>> = vec![Vec::new(); triangles.len()];
    for (at, [one, other]) in pairs.iter().enumerate() {
        let (a, b) = (one.half / 3, other.half / 3);
        neighbours[a as usize].push((b, at));
        neighbours[b as usize].push((a, at));
    }
    let area = |face: usize| {
        let corners = triangles[face].map(|at| mesh_place(positions, at));
        length(crate::mesh::build::doubled_area(corners))
    };
    let mut flips: Vec<Option<bool>> = vec![None; triangles.len()];
    for first in 0..triangles.len() {
        if flips[first].is_some() {
            continue;
        }
        flips[first] = Some(false);
        let mut piece = vec![first];
        let mut areas = [0.0; 2];
        let mut at = 0;
        while let Some(&face) = piece.get(at) {
            at += 1;
            let own = flips[face] == Some(true);
            areas[usize::from(own)] += area(face);
            for &(other, pair) in &neighbours[face] {
                // Two that face alike run along their edge in opposite ways.
                let disagree = pairs[pair][0].ascends == pairs[pair][1].ascends;
                let wanted = own != disagree;
                match flips[other as usize] {
                    None => {
                        flips[other as usize] = Some(wanted);
                        piece.push(other as usize);
                    }
                    Some(found) if found != wanted => return Err(pair),
                    Some(_) => {}
                }
            }
        }
        if areas[1] > areas[0] {
            for face in piece {
                flips[face] = flips[face].map(|flip| !flip);
            }
        }
    }
    Ok(flips.into_iter().map(|flip| flip == Some(true)).collect())
}
