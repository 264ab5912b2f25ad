// front_lines: the fronts of fires that spread, as lines from control point to control point.
//
// Perry 1994, 3.3.2 and 4.7: the boundary is shown as a connected line. One invocation a control point:
// the piece to the next.
// Reads: frame, fires, spreads, spread_counts, spread_faces, ring_spans, control_points, layer_planes.
// Writes: covers, cover_counts (word 0: how many records are of something, by atomic adds; word 4: how
// many there are of fronts).
// Invariant: ends of pieces are control points; what has come to rest at both ends is no front.

#import motes::dispatch::linear_index
#import motes::exact::{dot3, less, min_exact}
#import motes::emission::turned
#import motes::layout::{
    COVERS_OF_BOIDS, COVERS_OF_FRONTS, COVERS_OF_MARKS, COVERS_OF_PARTICLES, COVERS_SEEN, COVER_NONE, Cover,
    FRAME_ORTHOGRAPHIC, FireFrame, Frame, POINT_MOVES, SpreadCounts, SpreadFace, SpreadFrame, SpreadPoint,
}
#import motes::projection::{Projected, project}
#import motes::reach::is_visible
#import motes::shape::{Look, nothing_of, segment_of}
#import motes::sprite::next_layer

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> spreads: array<SpreadFrame>;
@group(0) @binding(3) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(4) var<storage, read> spread_faces: array<SpreadFace>;
@group(0) @binding(5) var<storage, read> ring_spans: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read> control_points: array<SpreadPoint>;
@group(0) @binding(7) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> covers: array<Cover>;
@group(0) @binding(9) var<storage, read_write> cover_counts: array<atomic<u32>>;

// The layer, from 1, that a world place is in. No branch and no loop asks uniforms alone, see
// motes::sprite::next_layer.
fn layer_of(world: vec3<f32>) -> u32 {
    var layer = 0u;
    for (var at = 0u; (at < frame.layer_plane_count) & (layer == 0u); at += 1u) {
        let plane = layer_planes[at];
        layer = next_layer(layer, at, dot3(plane.xyz, world) - plane.w);
    }
    return select(layer, frame.layer_plane_count + 1u, layer == 0u);
}

fn world_of_point(fire: FireFrame, point: SpreadPoint) -> vec3<f32> {
    let x_row = fire.world_from_fire_x;
    let y_row = fire.world_from_fire_y;
    let z_row = fire.world_from_fire_z;
    let place = bitcast<vec3<f32>>(point.position.xyz);
    return turned(x_row, y_row, z_row, place) + vec3<f32>(x_row.w, y_row.w, z_row.w);
}

// How much the face under a point looks at the viewer; more than 0 if it does.
fn facing(fire: FireFrame, point: SpreadPoint, world: vec3<f32>) -> f32 {
    let face = spread_faces[point.place.z];
    let outward = vec3<f32>(face.fire_from_face_x.z, face.fire_from_face_y.z, face.fire_from_face_z.z);
    let normal = turned(fire.world_from_fire_x, fire.world_from_fire_y, fire.world_from_fire_z, outward);
    let x = frame.view_from_world_x;
    let y = frame.view_from_world_y;
    let z = frame.view_from_world_z;
    let along = dot3(z.xyz, normal);
    let to_point = dot3(x.xyz, normal) * (dot3(x.xyz, world) + x.w)
        + dot3(y.xyz, normal) * (dot3(y.xyz, world) + y.w) + along * (dot3(z.xyz, world) + z.w);
    return -select(to_point, along, (frame.flags & FRAME_ORTHOGRAPHIC) != 0u);
}

fn piece(from_point: SpreadPoint, to_point: SpreadPoint) -> Cover {
    let spread = spreads[from_point.position.w];
    let fire = fires[spread.kinds.x];
    let is_front = from_point.course.w == POINT_MOVES || to_point.course.w == POINT_MOVES;
    if !is_front || !less(0.0f, spread.line_shape.x) {
        return nothing_of();
    }
    let begin_at = world_of_point(fire, from_point);
    let end_at = world_of_point(fire, to_point);
    let begin = project(frame, begin_at);
    let end = project(frame, end_at);
    let width_px = spread.line_shape.x * begin.scale;
    let here = !LAYERS || ((frame.layer == 0u) | (layer_of(begin_at) == frame.layer));
    let is_faced = less(0.0f, facing(fire, from_point, begin_at)) || less(0.0f, facing(fire, to_point, end_at));
    if !here || !is_faced || !is_visible(frame, begin, end, width_px) {
        return nothing_of();
    }
    // In front of the char that it runs along.
    let depth = min_exact(begin.depth, end.depth) - spread.line_shape.x;
    let look = Look(depth, spread.line_look, vec3<f32>(0.0f));
    return segment_of(vec2<f32>(begin.x, begin.y), vec2<f32>(end.x, end.y), 0.5f * width_px, look);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn front_lines(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total {
        return;
    }
    if at == 0u {
        atomicStore(&cover_counts[COVERS_OF_FRONTS], spread_counts.total);
    }
    let point = control_points[at];
    let span = ring_spans[point.place.w];
    let cover = piece(point, control_points[select(at + 1u, span.x, at == span.y)]);
    if cover.shape.z != COVER_NONE {
        atomicAdd(&cover_counts[COVERS_SEEN], 1u);
    }
    let first = atomicLoad(&cover_counts[COVERS_OF_PARTICLES]) + atomicLoad(&cover_counts[COVERS_OF_BOIDS])
        + atomicLoad(&cover_counts[COVERS_OF_MARKS]);
    covers[first + at] = cover;
}
