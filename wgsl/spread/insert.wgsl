// insert: control points in their places, each with the one that is inserted after it.
//
// Perry 1994, 3.3.2: an inserted point has its neighbours' mean path, and is who they are. Who has
// dropped a flame counts anew. One invocation a control point of before.
// Reads: frame, spreads, spread_counts, spread_faces, moved_points, walkers, gap_flags, gap_runs.
// Writes: control_points, ring_spans.
// Invariant: the order of a ring is kept; a point's place depends on the insertions before it alone.

#import motes::dispatch::linear_index
#import motes::drops::rest_of
#import motes::exact::bits_of
#import motes::layout::{
    Frame, GAP_DROPS_SHIFT, POINT_MOVES, SpreadCounts, SpreadFace, SpreadFrame, SpreadPoint, Walker,
}
#import motes::rng::pcg4d
#import motes::walk::{normalized2, position_on}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Tells keys of inserted points from other hashes.
const INSERTED_TAG: u32 = 0x696e7365u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(2) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(3) var<storage, read> moved_points: array<SpreadPoint>;
@group(0) @binding(4) var<storage, read> walkers: array<Walker>;
@group(0) @binding(5) var<storage, read> gap_runs: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read_write> control_points: array<SpreadPoint>;
@group(0) @binding(7) var<storage, read_write> ring_spans: array<vec2<u32>>;
@group(0) @binding(8) var<storage, read> spreads: array<SpreadFrame>;
@group(0) @binding(9) var<storage, read> gap_flags: array<u32>;

fn mean_of(a: u32, b: u32) -> u32 {
    return bits_of(0.5f * (bitcast<f32>(a) + bitcast<f32>(b)));
}

// The point with how far it has come since it dropped a flame, this frame's included.
fn counted(at: u32) -> SpreadPoint {
    let point = moved_points[at];
    let drops = gap_flags[at] >> GAP_DROPS_SHIFT;
    let rest = rest_of(spreads[point.position.w], bitcast<f32>(point.path.x), drops);
    return SpreadPoint(
        point.place, point.course, vec4<u32>(bits_of(rest), point.path.yzw), point.position,
    );
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn insert(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    let count = spread_counts.before;
    if at >= count {
        return;
    }
    let run = gap_runs[at / 32u];
    let bit = 1u << (at % 32u);
    let rank = run.w + countOneBits(run.x & (bit - 1u));
    let target_at = at + min(rank, spread_counts.inserted);
    let inserts = (run.x & bit) != 0u && rank < spread_counts.inserted;
    let point = counted(at);
    control_points[target_at] = point;
    let ring = point.place.w;
    if at == 0u || moved_points[max(at, 1u) - 1u].place.w != ring {
        ring_spans[ring].x = target_at;
    }
    if at + 1u == count || moved_points[min(at + 1u, count - 1u)].place.w != ring {
        ring_spans[ring].y = select(target_at, target_at + 1u, inserts);
    }
    if !inserts {
        return;
    }
    let walker = walkers[at];
    let after = counted(walker.left.z);
    let position = position_on(spread_faces[walker.place.z], bitcast<vec2<f32>>(walker.place.xy));
    let heading = normalized2(bitcast<vec2<f32>>(walker.way.zw));
    let key = pcg4d(vec4<u32>(point.course.z, after.course.z, frame.frame, INSERTED_TAG)).x;
    control_points[target_at + 1u] = SpreadPoint(
        vec4<u32>(walker.place.xyz, ring),
        vec4<u32>(bits_of(heading.x), bits_of(heading.y), key, POINT_MOVES),
        vec4<u32>(mean_of(point.path.x, after.path.x), mean_of(point.path.y, after.path.y), frame.frame, 0u),
        vec4<u32>(bits_of(position.x), bits_of(position.y), bits_of(position.z), point.position.w),
    );
}
