// ignite: the control points of rings that begin in this frame.
//
// Perry 1994, 3.3.2: eight or more points at one place of a face, their headings evenly around it,
// counterclockwise. One invocation a point of the rings that begin.
// Behind those come the rings of pieces that flames have met in the frame before (4.6).
// Reads: frame, spread_counts, spread_faces, due_ignitions, spread_pieces, catches. Writes:
// control_points, ring_spans.
// Invariant: rings that begin stand in the order of their numbers.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, f32_of_u32}
#import motes::layout::{Frame, Ignition, POINT_MOVES, SpreadCounts, SpreadFace, SpreadPiece, SpreadPoint}
#import motes::rng::pcg4d
#import motes::transcendental::{cos_turns, sin_turns}
#import motes::walk::position_on

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Tells keys of ignited points from other hashes.
const IGNITED_TAG: u32 = 0x69676e69u;

struct Work {
    // Pieces that flames may light.
    pieces: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(2) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(3) var<storage, read> due_ignitions: array<Ignition>;
@group(0) @binding(4) var<storage, read_write> control_points: array<SpreadPoint>;
@group(0) @binding(5) var<storage, read_write> ring_spans: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read> spread_pieces: array<SpreadPiece>;
@group(0) @binding(7) var<storage, read> catches: array<vec4<u32>>;

// The ring of the piece that is so many points behind those that begin by themselves.
fn caught(at: u32) -> Ignition {
    var before = 0u;
    for (var piece = 0u; piece < work.pieces; piece += 1u) {
        let met = catches[piece];
        let points = select(0u, spread_pieces[piece].ring.x, met.x > 0u);
        if at < before + points {
            let own = spread_pieces[piece];
            return Ignition(
                vec4<f32>(bitcast<f32>(met.z), bitcast<f32>(met.w), bitcast<f32>(own.ring.z), 0.0f),
                vec4<u32>(met.y, points, own.faces.z, own.ring.y),
                vec4<u32>(before, own.faces.w, 0u, 0u),
            );
        }
        before += points;
    }
    return Ignition(vec4<f32>(0.0f), vec4<u32>(0u), vec4<u32>(0u));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn ignite(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total - spread_counts.ignited_from {
        return;
    }
    // The first of the due ignitions says how many points they have together.
    let due = due_ignitions[0].order.z;
    var ignition: Ignition;
    var nth: u32;
    if at < due {
        var which = 0u;
        while at >= due_ignitions[which].order.x + due_ignitions[which].kinds.y {
            which += 1u;
        }
        ignition = due_ignitions[which];
        nth = at - ignition.order.x;
    } else {
        ignition = caught(at - due);
        nth = at - due - ignition.order.x;
    }
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
