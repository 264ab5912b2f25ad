//! walk: a walker goes straight on over the surface until it has come as far as it should. Twin of
//! `wgsl/spread/walk.wgsl`.

use glam::Vec2;

use crate::cpu::walk::{
    CORNER_SHARE, MOST_AROUND, MOST_CROSSINGS, dot2, exit_of, half_after, half_before, rotated,
};
use crate::exact::{bits_of, less, less_equal};
use crate::layout::{
    NO_EDGE, POINT_BLOCKED, POINT_ENDED, POINT_LOST, POINT_MOVES, SpreadEdge, Walker,
};

/// Two words as a vector.
#[inline]
pub(super) fn vec2(x: u32, y: u32) -> Vec2 {
    Vec2::new(f32::from_bits(x), f32::from_bits(y))
}

/// Half way around the corner that this half-edge begins at: the half-edge that begins there, left of
/// which the way out is, and that way.
fn straight_on(edges: &[SpreadEdge], arrived: u32, way: Vec2) -> (u32, Vec2) {
    let mut half = arrived;
    let mut out = -way;
    let mut faces = 0;
    for _ in 0..2 {
        let [_, _, cos, sin] = edges[half as usize].corner;
        out = rotated([cos, sin], out);
        while faces < MOST_AROUND {
            let last = &edges[half_before(half) as usize];
            if !less(dot2(Vec2::new(last.line[0], last.line[1]), out), 0.0) {
                break;
            }
            out = rotated([last.turn[0], last.turn[1]], out);
            half = last.ties[0];
            faces += 1;
        }
    }
    (half, out)
}

/// The walker where it has come to.
pub fn walk(walker: &Walker, edges: &[SpreadEdge]) -> Walker {
    let [x, y, mut face, mut state] = walker.place;
    let mut place = vec2(x, y);
    let mut way = vec2(walker.way[0], walker.way[1]);
    let mut aside = vec2(walker.way[2], walker.way[3]);
    let mut left = f32::from_bits(walker.left[0]);
    let mut skip = 0;
    let mut crossings = 0;
    while (state == POINT_MOVES || state == POINT_BLOCKED) && less(0.0, left) {
        let first = 3 * face;
        let own = &edges[first as usize..first as usize + 3];
        let (side, distance) = exit_of(place, way, skip, own);
        if less_equal(left, distance) {
            place += way * left;
            left = 0.0;
            break;
        }
        if crossings == MOST_CROSSINGS {
            state = POINT_LOST;
            break;
        }
        crossings += 1;
        place += way * distance;
        left -= distance;
        let half = first + side;
        let edge = &edges[half as usize];
        let from_corner = place - Vec2::new(edge.corner[0], edge.corner[1]);
        let along = from_corner.x * edge.line[1] - from_corner.y * edge.line[0];
        let margin = edge.line[3] * CORNER_SHARE;
        let is_at_end = less(edge.line[3] - margin, along);
        let corner_of = |half: u32| {
            let [x, y, ..] = edges[half as usize].corner;
            Vec2::new(x, y)
        };
        if is_at_end || less(along, margin) {
            let corner = if is_at_end { half_after(half) } else { half };
            place = corner_of(corner);
            if edges[corner as usize].ties[1] == 0 {
                state = POINT_ENDED;
                break;
            }
            let (out, onward) = straight_on(edges, corner, way);
            let ahead = dot2(aside, way);
            let across = way.x * aside.y - way.y * aside.x;
            way = onward;
            aside = way * ahead + Vec2::new(-way.y, way.x) * across;
            face = out / 3;
            place = corner_of(out);
            skip = (1 << (out % 3)) | (1 << (half_before(out) % 3));
        } else {
            let [beyond, ..] = edge.ties;
            if beyond == NO_EDGE {
                state = POINT_ENDED;
                break;
            }
            let [cos, sin, dx, dy] = edge.turn;
            place = rotated([cos, sin], place) + Vec2::new(dx, dy);
            way = rotated([cos, sin], way);
            aside = rotated([cos, sin], aside);
            face = beyond / 3;
            skip = 1 << (beyond % 3);
        }
    }
    let [_, whole, after, unused] = walker.left;
    Walker {
        place: [bits_of(place.x), bits_of(place.y), face, state],
        way: [way.x, way.y, aside.x, aside.y].map(bits_of),
        left: [bits_of(left), whole, after, unused],
    }
}
