//! insert and ignite: the control points that come into being. Twins of `wgsl/spread/insert.wgsl` and
//! `wgsl/spread/ignite.wgsl`.

use glam::{UVec4, Vec2};

use super::walk::vec2;
use crate::cpu::walk::{normalized2, position_on};
use crate::exact::{bits_of, f32_of_u32, shared_constants};
use crate::layout::{Ignition, POINT_MOVES, SpreadFace, SpreadPoint, Walker};
use crate::rng::pcg4d;
use crate::transcendental::{cos_turns, sin_turns};

shared_constants! {
    const INSERTED_TAG: u32 = 0x696e_7365;
    const IGNITED_TAG: u32 = 0x6967_6e69;
}

/// The point that is inserted between two, where its walker has come to.
pub fn insert(
    frame: u32,
    walker: &Walker,
    point: &SpreadPoint,
    after: &SpreadPoint,
    faces: &[SpreadFace],
) -> SpreadPoint {
    let [x, y, face, _] = walker.place;
    let position = position_on(&faces[face as usize], vec2(x, y));
    let heading = normalized2(vec2(walker.way[2], walker.way[3]));
    let keys = UVec4::new(point.course[2], after.course[2], frame, INSERTED_TAG);
    let mean = |at: usize| {
        bits_of(0.5 * (f32::from_bits(point.path[at]) + f32::from_bits(after.path[at])))
    };
    SpreadPoint {
        place: [x, y, face, point.place[3]],
        course: [
            bits_of(heading.x),
            bits_of(heading.y),
            pcg4d(keys).x,
            POINT_MOVES,
        ],
        path: [mean(0), mean(1), frame, 0],
        position: [
            bits_of(position.x),
            bits_of(position.y),
            bits_of(position.z),
            point.position[3],
        ],
    }
}

/// The point `nth` of a ring that begins.
pub fn ignite(frame: u32, ignition: &Ignition, nth: u32, faces: &[SpreadFace]) -> SpreadPoint {
    let [x, y, share, _] = ignition.place;
    let [face, _, slot, key] = ignition.kinds;
    let turns = f32_of_u32(nth) * share;
    let position = position_on(&faces[face as usize], Vec2::new(x, y));
    let key = pcg4d(UVec4::new(key, nth, frame, IGNITED_TAG)).x;
    SpreadPoint {
        place: [bits_of(x), bits_of(y), face, ignition.order[1]],
        course: [
            bits_of(cos_turns(turns)),
            bits_of(sin_turns(turns)),
            key,
            POINT_MOVES,
        ],
        path: [0, 0, frame, 0],
        position: [
            bits_of(position.x),
            bits_of(position.y),
            bits_of(position.z),
            slot,
        ],
    }
}
