//! Where a piece of a flame's way goes through a face (Perry 1994, 4.6). Twin of `wgsl/lib/meet.wgsl`.

use glam::{Vec2, Vec3};

use crate::cpu::walk::{dot2, flattened};
use crate::exact::{dot3, less, reciprocal, shared_constants};
use crate::layout::{SpreadEdge, SpreadFace, SpreadPiece};

shared_constants! {
    const MEETING_SLACK: f32 = 0.00001;
}

/// A place of world space in the space of the piece's fire.
#[inline]
pub fn within_fire(piece: &SpreadPiece, place: Vec3) -> Vec3 {
    let [x, y, z] = [
        piece.world_from_fire_x,
        piece.world_from_fire_y,
        piece.world_from_fire_z,
    ];
    let away = place - Vec3::new(x[3], y[3], z[3]);
    Vec3::from_slice(&x) * away.x + Vec3::from_slice(&y) * away.y + Vec3::from_slice(&z) * away.z
}

/// The place in the face's frame where a way goes through it, and how much of the way is before it.
#[inline]
pub fn meeting(
    face: &SpreadFace,
    edges: &[SpreadEdge],
    from: Vec3,
    to: Vec3,
) -> Option<(Vec2, f32)> {
    let rows = [
        face.fire_from_face_x,
        face.fire_from_face_y,
        face.fire_from_face_z,
    ];
    let origin = Vec3::from(rows.map(|row| row[3]));
    let normal = Vec3::from(rows.map(|row| row[2]));
    let above = dot3(normal, from - origin);
    let beyond = dot3(normal, to - origin);
    if less(0.0, above) == less(0.0, beyond) {
        return None;
    }
    let share = above * reciprocal(above - beyond);
    let place = flattened(face, from + (to - from) * share - origin);
    let is_inside = edges.iter().all(|edge| {
        let [x, y, offset, length] = edge.line;
        less(
            -MEETING_SLACK * length,
            dot2(Vec2::new(x, y), place) + offset,
        )
    });
    is_inside.then_some((place, share))
}
