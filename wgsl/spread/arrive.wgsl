// arrive: control points where their walkers have brought them.
//
// Perry 1994, 3.3.2. One invocation a control point.
// Reads: spread_counts, spread_faces, control_points, walkers. Writes: moved_points.
// Invariant: a point's path grows by what it has walked; points at rest stay as they are.

#import motes::dispatch::linear_index
#import motes::exact::bits_of
#import motes::layout::{POINT_MOVES, SpreadCounts, SpreadFace, SpreadPoint, Walker}
#import motes::walk::{normalized2, position_on}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(1) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(2) var<storage, read> control_points: array<SpreadPoint>;
@group(0) @binding(3) var<storage, read> walkers: array<Walker>;
@group(0) @binding(4) var<storage, read_write> moved_points: array<SpreadPoint>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn arrive(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total {
        return;
    }
    let point = control_points[at];
    if point.course.w != POINT_MOVES {
        moved_points[at] = point;
        return;
    }
    let walker = walkers[at];
    let place = bitcast<vec2<f32>>(walker.place.xy);
    let heading = normalized2(bitcast<vec2<f32>>(walker.way.zw));
    let position = position_on(spread_faces[walker.place.z], place);
    let walked = bitcast<f32>(walker.left.y) - bitcast<f32>(walker.left.x);
    let since = bitcast<f32>(point.path.x) + walked;
    let whole = bitcast<f32>(point.path.y) + walked;
    moved_points[at] = SpreadPoint(
        vec4<u32>(walker.place.xyz, point.place.w),
        vec4<u32>(bits_of(heading.x), bits_of(heading.y), point.course.z, walker.place.w),
        vec4<u32>(bits_of(since), bits_of(whole), point.path.zw),
        vec4<u32>(bits_of(position.x), bits_of(position.y), bits_of(position.z), point.position.w),
    );
}
