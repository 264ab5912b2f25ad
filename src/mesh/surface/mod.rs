//! A mesh made ready to be walked on (Perry 1994, 3.3.2): who is beside whom, how a step turns that
//! crosses an edge, how sharp edges are, and which of them lie between what is not flat.
//!
//! Faces have frames of their own: their middle, x along the first edge, y to its left, and the outward
//! normal. A place is a face with x and y; a step into the next face is turned by the
//! rotation about the edge that the two share, which in these frames is one of the plane.
//!
//! Vertices in the same place are one; triangles that are there twice are left out once, and those
//! that face another way than most around them are turned, each with a note. Edges of more than two
//! faces, and surfaces with one side, are refused.

mod features;
mod joined;
mod places;
mod solid;
mod vectors;

use super::{Mesh, MeshError};
pub use features::{Feature, FeatureNear};
use vectors::{Place, angle_of, cross, dot, length, less, plus, unit};

/// What a triangle takes in a surface and in the tables that are made of it, on the way too.
const BYTES_A_TRIANGLE: usize = 1300;

/// No half-edge: beyond a border.
pub const NO_EDGE: u32 = u32::MAX;

/// Faces that meet at less than this, in radians, are parts of one flat polygon.
pub const FLAT: f64 = 1e-4;

/// A triangle with its frame, in the scaled coordinates of the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceFace {
    /// Its middle, the origin of its frame.
    pub origin: [f64; 3],
    /// Unit vector along its first edge.
    pub x: [f64; 3],
    /// Unit vector to the left of that.
    pub y: [f64; 3],
    /// Outward unit normal.
    pub normal: [f64; 3],
    /// Its corners in its frame, counterclockwise.
    pub corners: [[f64; 2]; 3],
    /// The mesh's face that it was.
    pub source: u32,
}

/// One side of a face; half-edge 3 f + i runs from corner i of face f to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfEdge {
    /// The same edge in the face beyond, or [`NO_EDGE`].
    pub twin: u32,
    /// From this face's frame to that beyond: cosine and sine of the rotation, then the shift.
    pub turn: [f64; 4],
    /// Inward unit normal in the face's frame.
    pub inward: [f64; 2],
    /// What the inward normal times a place of the edge is, negated.
    pub offset: f64,
    /// Its length.
    pub length: f64,
    /// The angle between the normals of its two faces, above 0 where the surface is convex; 0 at a
    /// border.
    pub dihedral: f64,
    /// The sum of the angles of all faces around its first corner; 0 where a border is.
    pub around: f64,
}

/// A mesh that can be walked on.
#[derive(Clone, PartialEq)]
pub struct Surface {
    faces: Vec<SurfaceFace>,
    half_edges: Vec<HalfEdge>,
    features: Vec<Feature>,
    feature_of: Vec<u32>,
    mean_edge_length: f64,
    pieces: Vec<u32>,
    notes: Vec<String>,
    digest: u64,
}

impl Surface {
    /// The mesh with all coordinates times `scale`, which is above 0.
    ///
    /// # Errors
    /// An edge of more than two faces, or a surface with one side: names where, in the mesh's own
    /// coordinates.
    pub fn new(mesh: &Mesh, scale: f32) -> Result<Self, MeshError> {
        MeshError::room_for(
            mesh.triangles().len(),
            BYTES_A_TRIANGLE,
            "triangles to walk on",
        )?;
        let joined = joined::joined(mesh)?;
        let scaled = |at: u32| joined.positions[at as usize].map(|x| x * f64::from(scale));
        let framed = |(corners, source): (&[u32; 3], &u32)| framed(corners.map(scaled), *source);
        let faces: Vec<SurfaceFace> = joined
            .triangles
            .iter()
            .zip(&joined.sources)
            .map(framed)
            .collect();
        let half_edges = (0..3 * faces.len())
            .map(|half| half_edge(&faces, &joined.twins, half))
            .collect();
        let mut surface = Self {
            faces,
            half_edges,
            features: Vec::new(),
            feature_of: Vec::new(),
            mean_edge_length: 0.0,
            pieces: joined.pieces,
            notes: joined.notes,
            digest: mesh.digest() ^ u64::from(scale.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15),
        };
        surface.measure_corners();
        surface.find_features();
        Ok(surface)
    }

    /// Its faces.
    pub fn faces(&self) -> &[SurfaceFace] {
        &self.faces
    }

    /// Three half-edges a face.
    pub fn half_edges(&self) -> &[HalfEdge] {
        &self.half_edges
    }

    /// The edges of its flat polygons, each once for either side; those along one line are one.
    pub fn features(&self) -> &[Feature] {
        &self.features
    }

    /// The mean length of the edges of its flat polygons: it does not depend on how these are cut
    /// into triangles.
    pub fn mean_edge_length(&self) -> f64 {
        self.mean_edge_length
    }

    /// The faces of each piece that hangs together, one piece after the other.
    pub fn pieces(&self) -> impl Iterator<Item = std::ops::Range<u32>> + '_ {
        let count = self.faces.len() as u32;
        let ends = self.pieces.iter().skip(1).copied().chain([count]);
        self.pieces
            .iter()
            .copied()
            .zip(ends)
            .map(|(first, end)| first..end)
    }

    /// What was mended, a line each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Tells surfaces of other meshes, or of another scale, from this one.
    pub fn digest(&self) -> u64 {
        self.digest
    }

    /// The place on it that is nearest to `p`: a face, x and y in its frame.
    pub fn nearest(&self, p: [f64; 3]) -> (u32, [f64; 2]) {
        let mut best = (f64::MAX, 0, [0.0; 2]);
        for (at, face) in (0..).zip(&self.faces) {
            let near = nearest_in(face, p);
            let place = plus(plus(face.origin, face.x, near[0]), face.y, near[1]);
            let away = length(less(p, place));
            // Of two faces that share the place, the first.
            if away < best.0 * (1.0 - 1e-9) {
                best = (away, at, near);
            }
        }
        (best.1, best.2)
    }

    /// The angle of the face at a half-edge's first corner.
    fn corner_angle(&self, half: u32) -> f64 {
        let corners = self.faces[half as usize / 3].corners;
        let at = half as usize % 3;
        let way = |to: usize| [0, 1].map(|i| corners[to % 3][i] - corners[at][i]);
        let (u, v) = (way(at + 1), way(at + 2));
        angle_of(u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0])
    }

    fn measure_corners(&mut self) {
        for first in 0..self.half_edges.len() as u32 {
            let (mut half, mut sum) = (first, 0.0);
            let whole = loop {
                sum += self.corner_angle(half);
                half = self.half_edges[before(half) as usize].twin;
                if half == NO_EDGE {
                    break false;
                }
                if half == first {
                    break true;
                }
            };
            self.half_edges[first as usize].around = if whole { sum } else { 0.0 };
        }
    }
}

/// The half-edge that ends where this one begins.
fn before(half: u32) -> u32 {
    half - half % 3 + (half + 2) % 3
}

/// The half-edge that begins where this one ends.
fn after(half: u32) -> u32 {
    half - half % 3 + (half + 1) % 3
}

fn framed([a, b, c]: [Place; 3], source: u32) -> SurfaceFace {
    let (u, v) = (less(b, a), less(c, a));
    let x = unit(u);
    let normal = unit(cross(u, v));
    let y = cross(normal, x);
    // Around the middle, coordinates are small, and what they lose by rounding is.
    let origin = [0, 1, 2].map(|i| (a[i] + b[i] + c[i]) / 3.0);
    let flat = |corner: Place| {
        let away = less(corner, origin);
        [dot(away, x), dot(away, y)]
    };
    SurfaceFace {
        origin,
        x,
        y,
        normal,
        corners: [a, b, c].map(flat),
        source,
    }
}

fn half_edge(faces: &[SurfaceFace], twins: &[u32], half: usize) -> HalfEdge {
    let face = &faces[half / 3];
    let (a, b) = ends_of(faces, half);
    let way = [b[0] - a[0], b[1] - a[1]];
    let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
    let inward = [-way[1] / length, way[0] / length];
    let twin = twins[half];
    let (mut turn, mut dihedral) = ([1.0, 0.0, 0.0, 0.0], 0.0);
    if twin != NO_EDGE {
        let other = &faces[twin as usize / 3];
        // The other runs the opposite way.
        let (to_b, to_a) = ends_of(faces, twin as usize);
        let there = [to_b[0] - to_a[0], to_b[1] - to_a[1]];
        let cos = way[0] * there[0] + way[1] * there[1];
        let sin = way[0] * there[1] - way[1] * there[0];
        let size = (cos * cos + sin * sin).sqrt();
        let (cos, sin) = (cos / size, sin / size);
        let middle = |p: [f64; 2], q: [f64; 2]| [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
        let (from, to) = (middle(a, b), middle(to_a, to_b));
        turn = [
            cos,
            sin,
            to[0] - (cos * from[0] - sin * from[1]),
            to[1] - (sin * from[0] + cos * from[1]),
        ];
        let along = plus(face.x.map(|x| x * way[0]), face.y, way[1]);
        let crossed = cross(face.normal, other.normal);
        let angle = angle_of(dot(face.normal, other.normal), vectors::length(crossed));
        dihedral = if dot(crossed, along) < 0.0 {
            -angle
        } else {
            angle
        };
    }
    HalfEdge {
        twin,
        turn,
        inward,
        offset: -(inward[0] * a[0] + inward[1] * a[1]),
        length,
        dihedral,
        around: 0.0,
    }
}

/// Where a half-edge begins and ends, in its face's frame.
fn ends_of(faces: &[SurfaceFace], half: usize) -> ([f64; 2], [f64; 2]) {
    let corners = faces[half / 3].corners;
    (corners[half % 3], corners[(half % 3 + 1) % 3])
}

fn nearest_in(face: &SurfaceFace, p: Place) -> [f64; 2] {
    let away = less(p, face.origin);
    let flat = [dot(away, face.x), dot(away, face.y)];
    let corners = face.corners;
    let mut best: Option<(f64, [f64; 2])> = None;
    let mut inside = true;
    for at in 0..3 {
        let (a, b) = (corners[at], corners[(at + 1) % 3]);
        let way = [b[0] - a[0], b[1] - a[1]];
        let from = [flat[0] - a[0], flat[1] - a[1]];
        inside &= way[0] * from[1] - way[1] * from[0] >= 0.0;
        let t = (way[0] * from[0] + way[1] * from[1]) / (way[0] * way[0] + way[1] * way[1]);
        let t = t.clamp(0.0, 1.0);
        let near = [a[0] + t * way[0], a[1] + t * way[1]];
        let off = [flat[0] - near[0], flat[1] - near[1]];
        let off = off[0] * off[0] + off[1] * off[1];
        if best.is_none_or(|(least, _)| off < least) {
            best = Some((off, near));
        }
    }
    match best {
        Some((_, near)) if !inside => near,
        _ => flat,
    }
}

impl std::fmt::Debug for Surface {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Surface")
            .field("faces", &self.faces.len())
            .field("features", &self.features.len())
            .field("digest", &format_args!("{:016x}", self.digest))
            .finish()
    }
}
