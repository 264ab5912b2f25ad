// walk: walkers go straight on over the surface until they have come as far as they should.
//
// Perry 1994, 3.3.2: a step is split where it crosses an edge, and the rest of it is turned into the
// next face. At a corner a walker goes on so that there is as much of the surface to its left as to
// its right (Polthier and Schmies 1998). At a border it ends. One invocation a control point.
// Reads: spread_counts, spread_edges. Writes: walkers.
// Invariant: a walker stays on the surface, and what it carries turns with it.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, less, less_equal}
#import motes::layout::{
    NO_EDGE, POINT_BLOCKED, POINT_ENDED, POINT_LOST, POINT_MOVES, SpreadCounts, SpreadEdge, Walker,
}
#import motes::walk::{
    CORNER_SHARE, MOST_AROUND, MOST_CROSSINGS, dot2, exit_of, half_after, half_before, rotated,
}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(1) var<storage, read> spread_edges: array<SpreadEdge>;
@group(0) @binding(2) var<storage, read_write> walkers: array<Walker>;

// A way out of a corner: the half-edge that begins there, left of which it is, and the way.
struct Outgoing {
    half: u32,
    way: vec2<f32>,
}

// Half way around the corner that this half-edge begins at, from where a walker came.
fn straight_on(arrived: u32, way: vec2<f32>) -> Outgoing {
    var half = arrived;
    var out = -way;
    var faces = 0u;
    // In two parts, so that each is less than half a turn.
    for (var part = 0u; part < 2u; part += 1u) {
        out = rotated(spread_edges[half].corner.zw, out);
        while faces < MOST_AROUND {
            let last = spread_edges[half_before(half)];
            if !less(dot2(last.line.xy, out), 0.0f) {
                break;
            }
            out = rotated(last.turn.xy, out);
            half = last.ties.x;
            faces += 1u;
        }
    }
    return Outgoing(half, out);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn walk(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total {
        return;
    }
    let walker = walkers[at];
    var place = bitcast<vec2<f32>>(walker.place.xy);
    var face = walker.place.z;
    var state = walker.place.w;
    var way = bitcast<vec2<f32>>(walker.way.xy);
    var aside = bitcast<vec2<f32>>(walker.way.zw);
    var left = bitcast<f32>(walker.left.x);
    var skip = 0u;
    var crossings = 0u;
    // Those that stop at a meeting have to get there yet.
    while (state == POINT_MOVES || state == POINT_BLOCKED) && less(0.0f, left) {
        let first = 3u * face;
        let exit = exit_of(
            place, way, skip,
            spread_edges[first].line, spread_edges[first + 1u].line, spread_edges[first + 2u].line,
        );
        if less_equal(left, exit.distance) {
            place += way * left;
            left = 0.0f;
            break;
        }
        if crossings == MOST_CROSSINGS {
            state = POINT_LOST;
            break;
        }
        crossings += 1u;
        place += way * exit.distance;
        left -= exit.distance;
        let half = first + exit.side;
        let edge = spread_edges[half];
        let from_corner = place - edge.corner.xy;
        let along = from_corner.x * edge.line.y - from_corner.y * edge.line.x;
        let margin = edge.line.w * CORNER_SHARE;
        let is_at_end = less(edge.line.w - margin, along);
        if is_at_end || less(along, margin) {
            let corner = select(half, half_after(half), is_at_end);
            place = spread_edges[corner].corner.xy;
            if spread_edges[corner].ties.y == 0u {
                state = POINT_ENDED;
                break;
            }
            let out = straight_on(corner, way);
            // What it carries keeps its angle to the way.
            let ahead = dot2(aside, way);
            let across = way.x * aside.y - way.y * aside.x;
            way = out.way;
            aside = way * ahead + vec2<f32>(-way.y, way.x) * across;
            face = out.half / 3u;
            place = spread_edges[out.half].corner.xy;
            skip = (1u << (out.half % 3u)) | (1u << (half_before(out.half) % 3u));
        } else {
            if edge.ties.x == NO_EDGE {
                state = POINT_ENDED;
                break;
            }
            place = rotated(edge.turn.xy, place) + edge.turn.zw;
            way = rotated(edge.turn.xy, way);
            aside = rotated(edge.turn.xy, aside);
            face = edge.ties.x / 3u;
            skip = 1u << (edge.ties.x % 3u);
        }
    }
    walkers[at] = Walker(
        vec4<u32>(bits_of(place.x), bits_of(place.y), face, state),
        vec4<u32>(bits_of(way.x), bits_of(way.y), bits_of(aside.x), bits_of(aside.y)),
        vec4<u32>(bits_of(left), walker.left.yzw),
    );
}
