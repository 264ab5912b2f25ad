//! Straight on over faces that have frames of their own (Perry 1994, 3.3.2). Twin of
//! `wgsl/lib/walk.wgsl`.

use glam::{IVec3, Vec2, Vec3};

use crate::exact::{at_least_zero, less, normalize_exact, reciprocal, shared_constants, to_i32};
use crate::layout::{SpreadEdge, SpreadFace};

shared_constants! {
    /// Farther than any edge, world units.
    pub const FAR: f32 = 1000000000.0;
    const LEAST_APPROACH: f32 = 0.0000001;
    /// How near to its end, as a share of an edge's length, a way through it meets the corner.
    pub const CORNER_SHARE: f32 = 0.00001;
    /// Edges that a step crosses at most.
    pub const MOST_CROSSINGS: u32 = 64;
    /// Faces around a corner that are looked at, at most.
    pub const MOST_AROUND: u32 = 256;
}

/// `v` turned by a cosine and a sine.
#[inline]
pub fn rotated([cos, sin]: [f32; 2], v: Vec2) -> Vec2 {
    Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}

/// The opposite of [`rotated`].
#[inline]
pub fn rotated_back([cos, sin]: [f32; 2], v: Vec2) -> Vec2 {
    Vec2::new(cos * v.x + sin * v.y, cos * v.y - sin * v.x)
}

/// a · b.
#[inline]
pub fn dot2(a: Vec2, b: Vec2) -> f32 {
    a.x * b.x + a.y * b.y
}

/// v/|v|; the zero vector stays zero.
#[inline]
pub fn normalized2(v: Vec2) -> Vec2 {
    normalize_exact(Vec3::new(v.x, v.y, 0.0)).truncate()
}

#[inline]
fn toward([nx, ny, offset, _]: [f32; 4], place: Vec2, way: Vec2, is_skipped: bool) -> f32 {
    let normal = Vec2::new(nx, ny);
    let approach = -dot2(normal, way);
    let gap = at_least_zero(dot2(normal, place) + offset);
    if less(LEAST_APPROACH, approach) && !is_skipped {
        gap * reciprocal(approach)
    } else {
        FAR
    }
}

/// The side of a face that a way leaves through, and how far that is; `skip` has a bit for each side
/// that it does not.
#[inline]
pub fn exit_of(place: Vec2, way: Vec2, skip: u32, edges: &[SpreadEdge]) -> (u32, f32) {
    let mut exit = (0, toward(edges[0].line, place, way, skip & 1 != 0));
    for side in [1, 2] {
        let distance = toward(edges[side as usize].line, place, way, skip >> side & 1 != 0);
        if less(distance, exit.1) {
            exit = (side, distance);
        }
    }
    exit
}

/// The half-edge of the same face after this one.
#[inline]
pub fn half_after(half: u32) -> u32 {
    half - half % 3 + (half + 1) % 3
}

/// The half-edge of the same face before this one.
#[inline]
pub fn half_before(half: u32) -> u32 {
    half - half % 3 + (half + 2) % 3
}

fn rows(face: &SpreadFace) -> [[f32; 4]; 3] {
    [
        face.fire_from_face_x,
        face.fire_from_face_y,
        face.fire_from_face_z,
    ]
}

/// A place of a face in its fire's space.
#[inline]
pub fn position_on(face: &SpreadFace, place: Vec2) -> Vec3 {
    Vec3::from(rows(face).map(|[x, y, _, origin]| dot2(Vec2::new(x, y), place) + origin))
}

/// A vector of the fire's space in the plane of a face.
#[inline]
pub fn flattened(face: &SpreadFace, v: Vec3) -> Vec2 {
    let [x, y, z] = rows(face);
    Vec2::new(
        x[0] * v.x + y[0] * v.y + z[0] * v.z,
        x[1] * v.x + y[1] * v.y + z[1] * v.z,
    )
}

/// A vector of a face's plane in the fire's space.
#[inline]
pub fn raised(face: &SpreadFace, v: Vec2) -> Vec3 {
    Vec3::from(rows(face).map(|[x, y, ..]| dot2(Vec2::new(x, y), v)))
}

/// The cell of a grid that a place is in.
#[inline]
pub fn crowd_cell(position: Vec3, inverse_size: f32) -> IVec3 {
    let scaled = position * inverse_size;
    IVec3::new(to_i32(scaled.x), to_i32(scaled.y), to_i32(scaled.z))
}
