// block: control points stop where their steps would lead into what has burnt.
//
// Perry 1994, 3.3.2, in two phases: all points have made their steps; each is held against the pieces of
// the boundary, which move, too, laid flat around where it began, without those that end in it. What comes
// from the unburnt side of a piece to the other stops where it does; where two meet, both stop. One
// invocation a point.
// Reads: spreads, spread_counts, spread_faces, spread_edges, ring_spans, control_points, moved_points,
// crowd. Writes: walkers of those that stop, to go anew.
// Invariant: the first meeting counts, so the order of looking at others does not matter.

#import motes::dispatch::linear_index
#import motes::exact::{
    bits_of, dot3, less, less_equal, max_exact, min_exact, reciprocal, square_root,
}
#import motes::layout::{
    NO_EDGE, POINT_BLOCKED, SPREAD_BLOCKS, SpreadCounts, SpreadEdge, SpreadFace, SpreadFrame, SpreadPoint,
    Walker,
}
#import motes::walk::{
    crowd_cell, crowd_hash, dot2, exit_of, flattened, normalized2, position_on, rotated, rotated_back,
}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Faces that others are looked for through.
const MOST_AWAY: u32 = 8u;
// How far beyond its ends a piece is met, as a share of its length.
const BEYOND_ENDS: f32 = 0.0625f;

struct Work {
    // Lists, less one; a power of two.
    mask: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> spreads: array<SpreadFrame>;
@group(0) @binding(1) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(2) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(3) var<storage, read> spread_edges: array<SpreadEdge>;
@group(0) @binding(4) var<storage, read> ring_spans: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read> control_points: array<SpreadPoint>;
@group(0) @binding(6) var<storage, read> moved_points: array<SpreadPoint>;
@group(0) @binding(7) var<storage, read> crowd: array<u32>;
@group(0) @binding(8) var<storage, read_write> walkers: array<Walker>;

// A place as a point sees it, from itself, in the frame of its face; w: 1 if there is a way to it.
struct Seen {
    away: vec2<f32>,
    is_seen: bool,
}

fn seen_from(here: SpreadPoint, there: SpreadPoint) -> Seen {
    let origin = bitcast<vec2<f32>>(here.place.xy);
    let goal = bitcast<vec3<f32>>(there.position.xyz);
    var place = origin;
    var face = here.place.z;
    var skip = 0u;
    var turn = vec2<f32>(1.0f, 0.0f);
    var shift = vec2<f32>(0.0f);
    for (var between = 0u; between < MOST_AWAY; between += 1u) {
        if face == there.place.z {
            let flat = rotated(turn, bitcast<vec2<f32>>(there.place.xy)) + shift;
            return Seen(flat - origin, true);
        }
        let frame_of = spread_faces[face];
        let way = normalized2(flattened(frame_of, goal - position_on(frame_of, place)));
        let first = 3u * face;
        let exit = exit_of(
            place, way, skip,
            spread_edges[first].line, spread_edges[first + 1u].line, spread_edges[first + 2u].line,
        );
        let edge = spread_edges[first + exit.side];
        if edge.ties.x == NO_EDGE {
            break;
        }
        place = rotated(edge.turn.xy, place + way * exit.distance) + edge.turn.zw;
        turn = rotated_back(edge.turn.xy, turn);
        shift -= rotated(turn, edge.turn.zw);
        face = edge.ties.x / 3u;
        skip = 1u << (edge.ties.x % 3u);
    }
    return Seen(vec2<f32>(0.0f), false);
}

// To the left of a piece from `a` to `b` above 0, to its right below 0.
fn side_of(place: vec2<f32>, a: vec2<f32>, b: vec2<f32>) -> f32 {
    let along = b - a;
    let away = place - a;
    return along.x * away.y - along.y * away.x;
}

// A piece of the boundary before and after its own step.
struct Piece {
    a: Seen,
    b: Seen,
    moved_a: Seen,
    moved_b: Seen,
}

// The share of a step to `goal` at which it comes from the right of a moving piece to its left: 1 if it
// does not.
fn meeting(goal: vec2<f32>, piece: Piece) -> f32 {
    let before = side_of(vec2<f32>(0.0f), piece.a.away, piece.b.away);
    let after = side_of(goal, piece.moved_a.away, piece.moved_b.away);
    let share = before * reciprocal(before - after);
    let a = piece.a.away + (piece.moved_a.away - piece.a.away) * share;
    let b = piece.b.away + (piece.moved_b.away - piece.b.away) * share;
    let along = b - a;
    let at = dot2(goal * share - a, along) * reciprocal(dot2(along, along));
    let is_seen = piece.a.is_seen && piece.b.is_seen && piece.moved_a.is_seen && piece.moved_b.is_seen;
    // A little beyond its ends, so that rounding leaves no gap between two.
    let meets = is_seen && less(before, 0.0f) && less(0.0f, after)
        && less_equal(-BEYOND_ENDS, at) && less_equal(at, 1.0f + BEYOND_ENDS);
    return select(1.0f, share, meets);
}

// The square of the distance between two points.
fn squared_to(here: SpreadPoint, there: SpreadPoint) -> f32 {
    let away = bitcast<vec3<f32>>(there.position.xyz) - bitcast<vec3<f32>>(here.position.xyz);
    return dot3(away, away);
}

// The share of the step that is free.
fn free_share(at: u32, here: SpreadPoint, goal: vec2<f32>, spread: SpreadFrame) -> f32 {
    let center = crowd_cell(bitcast<vec3<f32>>(here.position.xyz), spread.distances.z);
    let step = square_root(dot2(goal, goal));
    var free = 1.0f;
    for (var cell = 0u; cell < 27u; cell += 1u) {
        let off = vec3<i32>(vec3<u32>(cell % 3u, (cell / 3u) % 3u, cell / 9u)) - vec3<i32>(1);
        var entry = crowd[crowd_hash(center + off, here.position.w) & work.mask];
        while entry > 0u {
            let other = entry - 1u;
            entry = crowd[work.mask + 1u + other];
            let start = control_points[other];
            let span = ring_spans[start.place.w];
            let after = select(other + 1u, span.x, other == span.y);
            let is_far = less(spread.distances.w * spread.distances.w, squared_to(here, start));
            if other == at || after == at || start.position.w != here.position.w || is_far {
                continue;
            }
            let end = control_points[after];
            let moved_start = moved_points[other];
            let moved_end = moved_points[after];
            // Nobody is met who is farther away than the step and the pieces are long.
            let longest = max_exact(
                squared_to(start, end),
                max_exact(squared_to(start, moved_start), squared_to(start, moved_end)),
            );
            let within = step + square_root(longest);
            if less(within * within, squared_to(here, start)) {
                continue;
            }
            let piece = Piece(
                seen_from(here, start), seen_from(here, end),
                seen_from(here, moved_start), seen_from(here, moved_end),
            );
            free = min_exact(free, meeting(goal, piece));
        }
    }
    return free;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn block(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total {
        return;
    }
    let here = control_points[at];
    let walker = walkers[at];
    let spread = spreads[here.position.w];
    // What rests makes no step.
    let step = bitcast<f32>(walker.left.y);
    if !less(0.0f, step) || (spread.kinds.y & SPREAD_BLOCKS) == 0u {
        return;
    }
    let way = bitcast<vec2<f32>>(walker.left.zw);
    let free = free_share(at, here, way * step, spread);
    if !less(free, 1.0f) {
        return;
    }
    let left = bits_of(step * free);
    let x = bits_of(way.x);
    let y = bits_of(way.y);
    walkers[at] = Walker(
        vec4<u32>(here.place.xyz, POINT_BLOCKED),
        vec4<u32>(x, y, x, y),
        vec4<u32>(left, left, walker.left.zw),
    );
}
