// drop: the flames that control points drop on their way.
//
// Perry 1994, 3.4: a point that has come as far as d_d drops a flame where it is, which leaves along the
// face's outward normal. One that carries on what it has come beyond d_d drops them every d_d on the way
// behind it, as far as that is on its face. One invocation a control point of before.
// Reads: frame, fires, spreads, spread_counts, spread_faces, spread_edges, moved_points, gap_flags,
// drop_runs. Writes: dropped_flames.
// Invariant: flames are numbered in the order of the points; who they are depends on the point, the
// frame and their order alone.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, min_exact, snap}
#import motes::layout::{
    DroppedFlame, FireFrame, Frame, GAP_DROPS_SHIFT, SPREAD_CARRIES, SpreadCounts, SpreadEdge, SpreadFace,
    SpreadFrame, SpreadPoint,
}
#import motes::rng::pcg4d
#import motes::walk::{exit_of, position_on}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Tells keys of dropped flames from other hashes.
const DROPPED_TAG: u32 = 0x64726f70u;

struct Work {
    // Places for flames.
    places: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> spreads: array<SpreadFrame>;
@group(0) @binding(3) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(4) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(5) var<storage, read> spread_edges: array<SpreadEdge>;
@group(0) @binding(6) var<storage, read> moved_points: array<SpreadPoint>;
@group(0) @binding(7) var<storage, read> gap_flags: array<u32>;
@group(0) @binding(8) var<storage, read> drop_runs: array<vec2<u32>>;
@group(0) @binding(9) var<storage, read_write> dropped_flames: array<DroppedFlame>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn drop(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.before {
        return;
    }
    let drops = gap_flags[at] >> GAP_DROPS_SHIFT;
    if drops == 0u {
        return;
    }
    var rank = drop_runs[at / 32u].y;
    for (var other = at - at % 32u; other < at; other += 1u) {
        rank += gap_flags[other] >> GAP_DROPS_SHIFT;
    }
    let end = min(drops, spread_counts.flames_born - min(rank, spread_counts.flames_born));
    let point = moved_points[at];
    let spread = spreads[point.position.w];
    let carries = (spread.kinds.y & SPREAD_CARRIES) != 0u;
    let face = spread_faces[point.place.z];
    let lifetime = select(fires[spread.kinds.x].times.z, face.material.z, face.material.z != 0u);
    let here = bitcast<vec2<f32>>(point.place.xy);
    let back = -bitcast<vec2<f32>>(point.course.xy);
    let first = 3u * point.place.z;
    let exit = exit_of(
        here, back, 0u, spread_edges[first].line, spread_edges[first + 1u].line, spread_edges[first + 2u].line,
    );
    var far = bitcast<f32>(point.path.x);
    for (var nth = 0u; nth < end; nth += 1u) {
        far = select(0.0f, snap(far - spread.distances.y), carries);
        let root = position_on(face, here + back * min_exact(far, exit.distance));
        let number = spread_counts.flames_total - spread_counts.flames_born + rank + nth;
        let key = pcg4d(vec4<u32>(point.course.z, frame.frame, nth, DROPPED_TAG)).x;
        dropped_flames[number % work.places] = DroppedFlame(
            vec4<u32>(bits_of(root.x), bits_of(root.y), bits_of(root.z), spread.kinds.x),
            vec4<u32>(
                bits_of(face.fire_from_face_x.z), bits_of(face.fire_from_face_y.z),
                bits_of(face.fire_from_face_z.z), frame.frame,
            ),
            vec4<u32>(key, number, lifetime, 0u),
        );
    }
}
