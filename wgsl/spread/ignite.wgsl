// ignite: the control points of rings that begin in this frame.
//
// Perry 1994, 3.3.2: eight or more points at one place of a face, their headings evenly around it,
// counterclockwise. One invocation a point of the rings that begin.
// Reads: frame, spread_counts, spread_faces, due_ignitions. Writes: control_points, ring_spans.
// Invariant: rings stand in the order of their numbers.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, f32_of_u32}
#import motes::layout::{Frame, Ignition, POINT_MOVES, SpreadCounts, SpreadFace, SpreadPoint}
#import motes::rng::pcg4d
#import motes::transcendental::{cos_turns, sin_turns}
#import motes::walk::position_on

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Tells keys of ignited points from other hashes.
const IGNITED_TAG: u32 = 0x69676e69u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(2) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(3) var<storage, read> due_ignitions: array<Ignition>;
@group(0) @binding(4) var<storage, read_write> control_points: array<SpreadPoint>;
@group(0) @binding(5) var<storage, read_write> ring_spans: array<vec2<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn ignite(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total - spread_counts.ignited_from {
        return;
    }
    var which = 0u;
    while at >= due_ignitions[which].order.x + due_ignitions[which].kinds.y {
        which += 1u;
    }
    let ignition = due_ignitions[which];
    let nth = at - ignition.order.x;
    let place = spread_counts.ignited_from + at;
    let ring = ignition.order.y;
    if nth == 0u {
        ring_spans[ring] = vec2<u32>(place, place + ignition.kinds.y - 1u);
    }
    let turns = f32_of_u32(nth) * ignition.place.z;
    let position = position_on(spread_faces[ignition.kinds.x], ignition.place.xy);
    let key = pcg4d(vec4<u32>(ignition.kinds.w, nth, frame.frame, IGNITED_TAG)).x;
    control_points[place] = SpreadPoint(
        vec4<u32>(bits_of(ignition.place.x), bits_of(ignition.place.y), ignition.kinds.x, ring),
        vec4<u32>(bits_of(cos_turns(turns)), bits_of(sin_turns(turns)), key, POINT_MOVES),
        vec4<u32>(0u, 0u, frame.frame, 0u),
        vec4<u32>(bits_of(position.x), bits_of(position.y), bits_of(position.z), ignition.kinds.z),
    );
}
