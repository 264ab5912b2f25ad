//! Another control point as one sees it along the surface, through the faces between them. The kernels
//! `block` and `gaps` each have their own, for WGSL hands no buffers to functions.

use glam::{Vec2, Vec3};

use super::walk::vec2;
use crate::cpu::walk::{exit_of, flattened, normalized2, position_on, rotated, rotated_back};
use crate::layout::{NO_EDGE, SpreadPoint};
use crate::plan::SpreadTables;

/// The way to a point in the frame of `here`'s face, and the rotation from the frame of its own face,
/// looked for through so many faces; `None` if it is not found.
pub(super) fn unfolded(
    tables: &SpreadTables,
    here: &SpreadPoint,
    there: &SpreadPoint,
    most_faces: u32,
) -> Option<(Vec2, [f32; 2])> {
    let from = vec2(here.place[0], here.place[1]);
    let goal = Vec3::from(there.position());
    let mut place = from;
    let mut face = here.place[2];
    let mut skip = 0;
    // From the frame of the face at hand to that of `here`: a rotation, then a shift.
    let mut turn = Vec2::new(1.0, 0.0);
    let mut shift = Vec2::ZERO;
    for _ in 0..most_faces {
        let by = [turn.x, turn.y];
        if face == there.place[2] {
            let flat = rotated(by, vec2(there.place[0], there.place[1])) + shift;
            return Some((flat - from, by));
        }
        let frame_of = &tables.faces[face as usize];
        let way = normalized2(flattened(frame_of, goal - position_on(frame_of, place)));
        let first = 3 * face as usize;
        let edges = &tables.edges[first..first + 3];
        let (side, distance) = exit_of(place, way, skip, edges);
        let edge = &edges[side as usize];
        let [beyond, ..] = edge.ties;
        if beyond == NO_EDGE {
            return None;
        }
        let [cos, sin, dx, dy] = edge.turn;
        let moved = Vec2::new(dx, dy);
        place = rotated([cos, sin], place + way * distance) + moved;
        turn = rotated_back([cos, sin], turn);
        shift -= rotated([turn.x, turn.y], moved);
        face = beyond / 3;
        skip = 1 << (beyond % 3);
    }
    None
}
