// marks: char where dropped flames have gone out, as discs that lie on what has burnt.
//
// Perry 1994, 3.4.1 and 4.6: a circular, fuzzy, translucent black particle at the flame's place once it
// is extinct, which glows at first. One invocation a place for a flame.
// Reads: frame, fires, spread_counts, dropped_flames, layer_planes. Writes: covers, cover_counts (word 0:
// how many records are of something, by atomic adds; word 3: how many there are of marks).
// Invariant: records are in the order in which flames were dropped; marks are seen from the side alone
// that flames leave to.

#import motes::dispatch::linear_index
#import motes::exact::{at_least_zero, dot3, f32_of_u32, less, max_exact, min_exact, normalize_exact, reciprocal}
#import motes::emission::turned
#import motes::layout::{
    COVERS_OF_BOIDS, COVERS_OF_MARKS, COVERS_OF_PARTICLES, COVERS_SEEN, COVER_NONE, Cover, DroppedFlame,
    FRAME_ORTHOGRAPHIC, FireFrame, Frame, SpreadCounts,
}
#import motes::projection::{Projected, project}
#import motes::reach::is_visible
#import motes::shape::{Look, nothing_of, slanted_disc_of}
#import motes::sprite::next_layer

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};
// The least cosine between a mark's normal and the line of sight with which it is seen.
const LEAST_FACING: f32 = 0.05f;

struct Work {
    // Places for flames.
    places: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(3) var<storage, read> dropped_flames: array<DroppedFlame>;
@group(0) @binding(4) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> covers: array<Cover>;
@group(0) @binding(6) var<storage, read_write> cover_counts: array<atomic<u32>>;

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

// The mark of a flame that has been out for `age` frames.
fn mark(fire: FireFrame, flame: DroppedFlame, age: u32) -> Cover {
    let x_row = fire.world_from_fire_x;
    let y_row = fire.world_from_fire_y;
    let z_row = fire.world_from_fire_z;
    let place = bitcast<vec3<f32>>(flame.root_and_fire.xyz);
    let world = turned(x_row, y_row, z_row, place) + vec3<f32>(x_row.w, y_row.w, z_row.w);
    let outward = bitcast<vec3<f32>>(flame.normal_and_birth.xyz);
    let normal = normalize_exact(turned(x_row, y_row, z_row, outward));
    let seen = project(frame, world);
    let right = dot3(frame.view_from_world_x.xyz, normal);
    let up = dot3(frame.view_from_world_y.xyz, normal);
    let ahead = dot3(frame.view_from_world_z.xyz, normal);
    // The line of sight goes from the eye to the mark, or along the view.
    let is_parallel = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u;
    let inverse_scale = reciprocal(frame.focal_px);
    let across = select((seen.x - frame.center_x_px) * inverse_scale, 0.0f, is_parallel);
    let above = select((frame.center_y_px - seen.y) * inverse_scale, 0.0f, is_parallel);
    let facing = -(right * across + up * above + ahead);
    let radius_px = 0.5f * fire.char_shape.x * seen.scale;
    let here = !LAYERS || ((frame.layer == 0u) | (layer_of(world) == frame.layer));
    if !here || less(facing, LEAST_FACING) || !is_visible(frame, seen, seen, radius_px) {
        return nothing_of();
    }
    let glow = at_least_zero(1.0f - f32_of_u32(age) * fire.char_shape.z);
    let grown = min_exact((f32_of_u32(age) + 1.0f) * fire.char_shape.w, 1.0f);
    let color = vec4<f32>(fire.char_look.xyz * (glow * glow), fire.char_look.w * grown);
    let slope = vec2<f32>(right, -up) * reciprocal(facing);
    // As near as the nearest that it can have, so that all of it is before the surface that it is on.
    let depth = max_exact(seen.depth - 0.5f * fire.char_shape.x, 0.5f * seen.depth);
    return slanted_disc_of(
        seen.x, seen.y, radius_px, fire.char_shape.y, slope, Look(depth, color, vec3<f32>(0.0f)),
    );
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn marks(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    let count = spread_counts.flames_total - spread_counts.marks_first;
    if at >= count {
        return;
    }
    if at == 0u {
        atomicStore(&cover_counts[COVERS_OF_MARKS], count);
    }
    let flame = dropped_flames[(spread_counts.marks_first + at) % work.places];
    let fire = fires[flame.root_and_fire.w];
    let lifetime = flame.identity.z;
    let age = frame.frame - flame.normal_and_birth.w;
    var cover = nothing_of();
    if lifetime != 0u && age >= lifetime && less(0.0f, fire.char_look.w) {
        cover = mark(fire, flame, age - lifetime);
    }
    if cover.shape.z != COVER_NONE {
        atomicAdd(&cover_counts[COVERS_SEEN], 1u);
    }
    let first = atomicLoad(&cover_counts[COVERS_OF_PARTICLES]) + atomicLoad(&cover_counts[COVERS_OF_BOIDS]);
    covers[first + at] = cover;
}
