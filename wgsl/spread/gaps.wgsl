// gaps: where neighbours of a front are farther apart than d_s, and the way to where a point comes.
//
// Perry 1994, 3.3.2. The new point is in the middle, and on the arc that the two headings span: out by
// (c/2) tan(delta/4) along their bisector, where c is the distance and delta the angle between them.
// The neighbour is seen through the faces between the two, laid flat. One invocation a control point.
// Reads: spreads, spread_counts, spread_faces, spread_edges, ring_spans, control_points, moved_points.
// Writes: walkers (which begin at the point, and carry the new heading), gap_flags.
// Invariant: a gap is looked at by the point before it alone; nothing comes between two at rest, nor
// beside one that rests where it has burnt: that might be beyond what it has met.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, dot3, less, length3, reciprocal, square_root, at_least_zero}
#import motes::layout::{
    GAP_CAME_TO_REST, GAP_DROPS_SHIFT, GAP_INSERTS, GAP_MOVES, NO_EDGE, POINT_ENDED, POINT_MOVES, SPREAD_MIDPOINT, SpreadCounts,
    SpreadEdge, SpreadFace, SpreadFrame, SpreadPoint, Walker,
}
#import motes::drops::drops_of
#import motes::walk::{
    dot2, exit_of, flattened, normalized2, position_on, raised, rotated, rotated_back,
}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Faces that a neighbour is looked for through.
const MOST_BETWEEN: u32 = 16u;

@group(0) @binding(0) var<storage, read> spreads: array<SpreadFrame>;
@group(0) @binding(1) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(2) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(3) var<storage, read> spread_edges: array<SpreadEdge>;
@group(0) @binding(4) var<storage, read> ring_spans: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read> control_points: array<SpreadPoint>;
@group(0) @binding(6) var<storage, read> moved_points: array<SpreadPoint>;
@group(0) @binding(7) var<storage, read_write> walkers: array<Walker>;
@group(0) @binding(8) var<storage, read_write> gap_flags: array<u32>;

// A neighbour as a point sees it, in the frame of the point's face.
struct Seen {
    away: vec2<f32>,
    heading: vec2<f32>,
}

fn seen_from(here: SpreadPoint, there: SpreadPoint) -> Seen {
    let origin = bitcast<vec2<f32>>(here.place.xy);
    let goal = bitcast<vec3<f32>>(there.position.xyz);
    var place = origin;
    var face = here.place.z;
    var skip = 0u;
    // From the frame of the face at hand to the point's: a rotation, then a shift.
    var turn = vec2<f32>(1.0f, 0.0f);
    var shift = vec2<f32>(0.0f);
    for (var between = 0u; between < MOST_BETWEEN; between += 1u) {
        if face == there.place.z {
            let flat = rotated(turn, bitcast<vec2<f32>>(there.place.xy)) + shift;
            return Seen(flat - origin, rotated(turn, bitcast<vec2<f32>>(there.course.xy)));
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
    // As if the surface were flat between them.
    let own_face = spread_faces[here.place.z];
    let away = goal - bitcast<vec3<f32>>(here.position.xyz);
    let its_face = spread_faces[there.place.z];
    let heading = raised(its_face, bitcast<vec2<f32>>(there.course.xy));
    return Seen(
        normalized2(flattened(own_face, away)) * length3(away),
        normalized2(flattened(own_face, heading)),
    );
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn gaps(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total {
        return;
    }
    let here = moved_points[at];
    let span = ring_spans[here.place.w];
    let after = select(at + 1u, span.x, at == span.y);
    let there = moved_points[after];
    let moves = here.course.w == POINT_MOVES;
    let both_move = moves && there.course.w == POINT_MOVES;
    var flags = select(0u, GAP_MOVES, moves);
    if !moves && control_points[at].course.w == POINT_MOVES {
        flags |= GAP_CAME_TO_REST;
    }
    let spread = spreads[here.position.w];
    if control_points[at].course.w == POINT_MOVES {
        flags |= drops_of(spread, bitcast<f32>(here.path.x)) << GAP_DROPS_SHIFT;
    }
    var middle = vec2<f32>(0.0f);
    var heading = vec2<f32>(0.0f);
    let at_border = here.course.w == POINT_ENDED || there.course.w == POINT_ENDED;
    if both_move || (at_border && (moves || there.course.w == POINT_MOVES)) {
        let seen = seen_from(here, there);
        let own_heading = bitcast<vec2<f32>>(here.course.xy);
        let distance = square_root(dot2(seen.away, seen.away));
        if less(spread.distances.x, distance) && after != at {
            flags |= GAP_INSERTS;
            heading = normalized2(own_heading + seen.heading);
            if less(dot2(heading, heading), 0.5f) {
                // Opposite headings: out, to the right.
                heading = normalized2(vec2<f32>(seen.away.y, -seen.away.x));
            }
            middle = seen.away * 0.5f;
            if both_move && (spread.kinds.y & SPREAD_MIDPOINT) == 0u {
                let cos_delta = dot2(own_heading, seen.heading);
                let cos_half = square_root(at_least_zero(0.5f + 0.5f * cos_delta));
                let sin_half = square_root(at_least_zero(0.5f - 0.5f * cos_delta));
                let bulge = 0.5f * distance * sin_half * reciprocal(1.0f + cos_half);
                // Where headings meet, the front is hollow.
                let opens = less(0.0f, dot2(seen.heading - own_heading, seen.away));
                middle += heading * select(-bulge, bulge, opens);
            }
        }
    }
    let far = square_root(dot2(middle, middle));
    let way = normalized2(middle);
    gap_flags[at] = flags;
    walkers[at] = Walker(
        vec4<u32>(here.place.xyz, POINT_MOVES),
        vec4<u32>(bits_of(way.x), bits_of(way.y), bits_of(heading.x), bits_of(heading.y)),
        vec4<u32>(bits_of(far), bits_of(far), after, 0u),
    );
}
