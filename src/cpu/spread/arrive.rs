//! arrive: a control point where its walker has brought it. Twin of `wgsl/spread/arrive.wgsl`.

use super::walk::vec2;
use crate::cpu::walk::{normalized2, position_on};
use crate::exact::bits_of;
use crate::layout::{POINT_MOVES, SpreadFace, SpreadPoint, Walker};

/// The point after its step.
pub fn arrive(point: &SpreadPoint, walker: &Walker, faces: &[SpreadFace]) -> SpreadPoint {
    let [_, _, key, state] = point.course;
    if state != POINT_MOVES {
        return *point;
    }
    let [x, y, face, state] = walker.place;
    let heading = normalized2(vec2(walker.way[2], walker.way[3]));
    let position = position_on(&faces[face as usize], vec2(x, y));
    let walked = f32::from_bits(walker.left[1]) - f32::from_bits(walker.left[0]);
    let [since, whole, began, unused] = point.path;
    SpreadPoint {
        place: [x, y, face, point.place[3]],
        course: [bits_of(heading.x), bits_of(heading.y), key, state],
        path: [
            bits_of(f32::from_bits(since) + walked),
            bits_of(f32::from_bits(whole) + walked),
            began,
            unused,
        ],
        position: [
            bits_of(position.x),
            bits_of(position.y),
            bits_of(position.z),
            point.position[3],
        ],
    }
}
