//! block: how far a control point goes before it enters what has burnt (Perry 1994, 3.3.2). Twin of
//! `wgsl/spread/block.wgsl`; its lists are a map of cells.

use std::collections::HashMap;

use glam::{IVec3, Vec2, Vec3};

use super::unfold::unfolded;
use super::walk::vec2;
use crate::cpu::walk::{crowd_cell, dot2};
use crate::exact::{
    bits_of, dot3, less, less_equal, max_exact, min_exact, reciprocal, shared_constants,
    square_root,
};
use crate::layout::{POINT_BLOCKED, SPREAD_BLOCKS, SpreadPoint, Walker};
use crate::plan::{FrameInputs, SpreadTables};

shared_constants! {
    /// Faces that others are looked for through.
    pub const MOST_AWAY: u32 = 8;
    const BEYOND_ENDS: f32 = 0.0625;
}

/// The points of each cell and slot of a spread.
pub(super) type Crowd = HashMap<(IVec3, u32), Vec<u32>>;

/// A frame's points before and after their steps.
#[derive(Clone, Copy)]
pub(super) struct Steps<'a> {
    pub(super) tables: &'a SpreadTables,
    pub(super) before: &'a [SpreadPoint],
    pub(super) after: &'a [SpreadPoint],
    pub(super) ring_spans: &'a [[u32; 2]],
}

/// The points of spreads that are kept from burning twice, by cells.
pub(super) fn enlist(inputs: &FrameInputs, points: &[SpreadPoint]) -> Crowd {
    let mut crowd = Crowd::new();
    for (at, point) in (0..).zip(points) {
        let slot = point.position[3];
        let spread = &inputs.spreads[slot as usize];
        if spread.kinds[1] & SPREAD_BLOCKS != 0 {
            let cell = crowd_cell(Vec3::from(point.position()), spread.distances[2]);
            crowd.entry((cell, slot)).or_default().push(at);
        }
    }
    crowd
}

fn seen_from(tables: &SpreadTables, here: &SpreadPoint, there: &SpreadPoint) -> Option<Vec2> {
    unfolded(tables, here, there, MOST_AWAY).map(|(way, _)| way)
}

fn squared_to(here: &SpreadPoint, there: &SpreadPoint) -> f32 {
    let away = Vec3::from(there.position()) - Vec3::from(here.position());
    dot3(away, away)
}

fn side_of(place: Vec2, a: Vec2, b: Vec2) -> f32 {
    let along = b - a;
    let away = place - a;
    along.x * away.y - along.y * away.x
}

/// The share of a step to `goal` at which it comes from the right of a moving piece to its left: 1 if it
/// does not. The piece is its two ends, each before and after its step.
fn meeting(goal: Vec2, piece: [Option<Vec2>; 4]) -> f32 {
    let [Some(start), Some(end), Some(moved_start), Some(moved_end)] = piece else {
        return 1.0;
    };
    let before = side_of(Vec2::ZERO, start, end);
    let after = side_of(goal, moved_start, moved_end);
    let share = before * reciprocal(before - after);
    let a = start + (moved_start - start) * share;
    let b = end + (moved_end - end) * share;
    let along = b - a;
    let at = dot2(goal * share - a, along) * reciprocal(dot2(along, along));
    let meets = less(before, 0.0)
        && less(0.0, after)
        && less_equal(-BEYOND_ENDS, at)
        && less_equal(at, 1.0 + BEYOND_ENDS);
    if meets { share } else { 1.0 }
}

fn free_share(
    steps: Steps<'_>,
    crowd: &Crowd,
    at: u32,
    goal: Vec2,
    [inverse_size, reach]: [f32; 2],
) -> f32 {
    let here = &steps.before[at as usize];
    let slot = here.position[3];
    let center = crowd_cell(Vec3::from(here.position()), inverse_size);
    let step = square_root(dot2(goal, goal));
    let mut free = 1.0;
    for cell in 0..27 {
        let off = IVec3::new(cell % 3, cell / 3 % 3, cell / 9) - IVec3::ONE;
        for &other in crowd.get(&(center + off, slot)).into_iter().flatten() {
            let start = &steps.before[other as usize];
            let [first, last] = steps.ring_spans[start.ring() as usize];
            let after = if other == last { first } else { other + 1 };
            let is_far = less(reach * reach, squared_to(here, start));
            if other == at || after == at || is_far {
                continue;
            }
            let end = &steps.before[after as usize];
            let [moved_start, moved_end] = [other, after].map(|at| &steps.after[at as usize]);
            let longest = max_exact(
                squared_to(start, end),
                max_exact(squared_to(start, moved_start), squared_to(start, moved_end)),
            );
            let within = step + square_root(longest);
            if less(within * within, squared_to(here, start)) {
                continue;
            }
            let piece = [start, end, moved_start, moved_end];
            let piece = piece.map(|there| seen_from(steps.tables, here, there));
            free = min_exact(free, meeting(goal, piece));
        }
    }
    free
}

/// The walker of a point that has to stop earlier, to go anew; `None` where the way is free.
pub(super) fn block(
    inputs: &FrameInputs,
    steps: Steps<'_>,
    crowd: &Crowd,
    at: u32,
    walker: &Walker,
) -> Option<Walker> {
    let here = &steps.before[at as usize];
    let spread = &inputs.spreads[here.position[3] as usize];
    let [_, whole, x, y] = walker.left;
    let step = f32::from_bits(whole);
    if !less(0.0, step) || spread.kinds[1] & SPREAD_BLOCKS == 0 {
        return None;
    }
    let way = vec2(x, y);
    let [.., inverse_size, reach] = spread.distances;
    let free = free_share(steps, crowd, at, way * step, [inverse_size, reach]);
    if !less(free, 1.0) {
        return None;
    }
    let left = bits_of(step * free);
    let [x, y] = [way.x, way.y].map(bits_of);
    let [place_x, place_y, face, _] = here.place;
    Some(Walker {
        place: [place_x, place_y, face, POINT_BLOCKED],
        way: [x, y, x, y],
        left: [left, left, x, y],
    })
}
