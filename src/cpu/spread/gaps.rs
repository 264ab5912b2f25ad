//! gaps: where neighbours of a front are too far apart, and the way to where a point comes between
//! (Perry 1994, 3.3.2). Twin of `wgsl/spread/gaps.wgsl`.

use glam::{Vec2, Vec3};

use super::unfold::unfolded;
use super::walk::vec2;
use crate::cpu::drops::drops_of;
use crate::cpu::walk::{dot2, flattened, normalized2, raised, rotated};
use crate::exact::{
    at_least_zero, bits_of, length3, less, reciprocal, shared_constants, square_root,
};
use crate::layout::{
    GAP_CAME_TO_REST, GAP_DROPS_SHIFT, GAP_INSERTS, GAP_MOVES, POINT_ENDED, POINT_MOVES,
    SPREAD_MIDPOINT, SpreadPoint, Walker,
};
use crate::plan::{FrameInputs, SpreadTables};

shared_constants! {
    /// Faces that a neighbour is looked for through.
    pub const MOST_BETWEEN: u32 = 16;
}

/// The way to a neighbour, and its heading, in the frame of the point's face.
pub(super) fn seen_from(
    tables: &SpreadTables,
    here: &SpreadPoint,
    there: &SpreadPoint,
) -> (Vec2, Vec2) {
    let there_heading = vec2(there.course[0], there.course[1]);
    if let Some((way, by)) = unfolded(tables, here, there, MOST_BETWEEN) {
        return (way, rotated(by, there_heading));
    }
    // As if the surface were flat between them.
    let goal = Vec3::from(there.position());
    let own_face = &tables.faces[here.place[2] as usize];
    let away = goal - Vec3::from(here.position());
    let its_face = &tables.faces[there.place[2] as usize];
    let heading = raised(its_face, there_heading);
    (
        normalized2(flattened(own_face, away)) * length3(away),
        normalized2(flattened(own_face, heading)),
    )
}

/// The gap after a point: flags, and the walker to where a point comes.
pub fn gaps(
    inputs: &FrameInputs,
    tables: &SpreadTables,
    before: &[SpreadPoint],
    moved: &[SpreadPoint],
    [first, last]: [u32; 2],
    at: u32,
) -> (u32, Walker) {
    let here = &moved[at as usize];
    let after = if at == last { first } else { at + 1 };
    let there = &moved[after as usize];
    let (moves, next_moves) = (here.moves(), there.moves());
    let mut flags = if moves { GAP_MOVES } else { 0 };
    if !moves && before[at as usize].moves() {
        flags |= GAP_CAME_TO_REST;
    }
    let spread = &inputs.spreads[here.position[3] as usize];
    if before[at as usize].moves() {
        flags |= drops_of(spread, f32::from_bits(here.path[0])) << GAP_DROPS_SHIFT;
    }
    let mut middle = Vec2::ZERO;
    let mut heading = Vec2::ZERO;
    let at_border = [here, there]
        .iter()
        .any(|point| point.course[3] == POINT_ENDED);
    if (moves && next_moves) || (at_border && (moves || next_moves)) {
        let (away, next_heading) = seen_from(tables, here, there);
        let own_heading = vec2(here.course[0], here.course[1]);
        let distance = square_root(dot2(away, away));
        if less(spread.distances[0], distance) && after != at {
            flags |= GAP_INSERTS;
            heading = normalized2(own_heading + next_heading);
            if less(dot2(heading, heading), 0.5) {
                heading = normalized2(Vec2::new(away.y, -away.x));
            }
            middle = away * 0.5;
            if moves && next_moves && spread.kinds[1] & SPREAD_MIDPOINT == 0 {
                let cos_delta = dot2(own_heading, next_heading);
                let cos_half = square_root(at_least_zero(0.5 + 0.5 * cos_delta));
                let sin_half = square_root(at_least_zero(0.5 - 0.5 * cos_delta));
                let bulge = 0.5 * distance * sin_half * reciprocal(1.0 + cos_half);
                let opens = less(0.0, dot2(next_heading - own_heading, away));
                middle += heading * if opens { bulge } else { -bulge };
            }
        }
    }
    let far = square_root(dot2(middle, middle));
    let way = normalized2(middle);
    let [x, y, face, _] = here.place;
    let walker = Walker {
        place: [x, y, face, POINT_MOVES],
        way: [way.x, way.y, heading.x, heading.y].map(bits_of),
        left: [bits_of(far), bits_of(far), after, 0],
    };
    (flags, walker)
}
