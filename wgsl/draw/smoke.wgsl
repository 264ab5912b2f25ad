// smoke: what rises where dropped flames have gone out.
//
// Perry 1994, 4.6: fuzzy particles that begin where a flame ends, in the wind that the flames are in. Where
// one is, is where this frame's wind takes it in all the time that it has had, as flames have their ways.
// One invocation a place for a flame.
// Reads: frame, fires, winds, spread_counts, dropped_flames, layer_planes. Writes: covers, cover_counts
// (word 0: how many records are of something, by atomic adds; word 5: how many there are of smoke).
// Invariant: records are in the order in which flames were dropped, behind those of fronts.

#import motes::dispatch::linear_index
#import motes::emission::turned
#import motes::exact::{at_least_zero, dot3, f32_of_u32, less, max_exact, min_exact, reciprocal}
#import motes::flame::{LEAST_EXTENT, small_wind}
#import motes::layout::{
    COVERS_OF_BOIDS, COVERS_OF_FRONTS, COVERS_OF_MARKS, COVERS_OF_PARTICLES, COVERS_OF_SMOKE, COVERS_SEEN,
    COVER_NONE, Cover, DroppedFlame, FireFrame, Frame, SpreadCounts, Wind,
}
#import motes::projection::project
#import motes::reach::is_visible
#import motes::shape::{Look, disc_of, nothing_of}
#import motes::sprite::next_layer
#import motes::wind::{Kinds, wind_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
const LAYERS: bool = #{LAYERS};
const MANY_WINDS: bool = #{MANY_WINDS};
const FLOWS: bool = #{FLOWS};
const NOISES: bool = #{NOISES};
const OCTAVES: bool = #{OCTAVES};
const FOLDS: bool = #{FOLDS};
const CURLS: bool = #{CURLS};
// Steps of its way, and the inverse of their number.
const PUFF_STEPS: u32 = 16u;
const PUFF_SHARE: f32 = 0.0625f;
// It appears in an eighth of its time.
const PUFF_APPEARS: f32 = 8.0f;

struct Work {
    // Places for flames.
    places: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(3) var<storage, read> dropped_flames: array<DroppedFlame>;
@group(0) @binding(4) var<storage, read> winds: array<Wind>;
@group(0) @binding(5) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> covers: array<Cover>;
@group(0) @binding(7) var<storage, read_write> cover_counts: array<atomic<u32>>;

// w_L at the place `p`.
fn large_wind(p: vec3<f32>) -> vec3<f32> {
    var flow = vec3<f32>(0.0f);
    let has = Kinds(FLOWS, NOISES, OCTAVES, FOLDS, CURLS);
    if MANY_WINDS {
        for (var at = 0u; at < frame.wind_count; at += 1u) {
            flow += wind_of(winds[at], p, has);
        }
    } else if frame.wind_count == 1u {
        flow = wind_of(winds[0], p, has);
    }
    return flow;
}

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

// The puff of a flame that has been out for `age` frames.
fn puff(fire: FireFrame, flame: DroppedFlame, age: f32) -> Cover {
    let x_row = fire.world_from_fire_x;
    let y_row = fire.world_from_fire_y;
    let z_row = fire.world_from_fire_z;
    let place = bitcast<vec3<f32>>(flame.root_and_fire.xyz);
    let root = turned(x_row, y_row, z_row, place) + vec3<f32>(x_row.w, y_row.w, z_row.w);
    let shape = fire.smoke_shape;
    let step = shape.w * age * PUFF_SHARE;
    // Above its root, as a share of the way that it has in all.
    let inverse_reach = shape.z * reciprocal(max_exact(shape.w, LEAST_EXTENT));
    var p = root;
    for (var at = 0u; at < PUFF_STEPS; at += 1u) {
        let wind = fire.rise.xyz * fire.rise.w + large_wind(p) * fire.motion.y;
        p += (wind + small_wind(fire, p, root, inverse_reach)) * step;
    }
    let seen = project(frame, p);
    let share = age * shape.z;
    let radius_px = 0.5f * shape.x * (1.0f + shape.y * share) * seen.scale;
    let here = !LAYERS || ((frame.layer == 0u) | (layer_of(p) == frame.layer));
    if !here || !is_visible(frame, seen, seen, radius_px) {
        return nothing_of();
    }
    let clears = at_least_zero(1.0f - share) * min_exact(PUFF_APPEARS * share, 1.0f);
    let color = vec4<f32>(fire.smoke_look.xyz, fire.smoke_look.w * clears);
    return disc_of(seen.x, seen.y, radius_px, 1.0f, Look(seen.depth, color, vec3<f32>(0.0f)));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn smoke(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    let count = spread_counts.flames_total - spread_counts.marks_first;
    if at >= count {
        return;
    }
    if at == 0u {
        atomicStore(&cover_counts[COVERS_OF_SMOKE], count);
    }
    let flame = dropped_flames[(spread_counts.marks_first + at) % work.places];
    let fire = fires[flame.root_and_fire.w];
    let lifetime = flame.identity.z;
    let age = frame.frame - flame.normal_and_birth.w;
    var cover = nothing_of();
    if lifetime != 0u && age >= lifetime && less(0.0f, fire.smoke_look.w) {
        let since = f32_of_u32(age - lifetime);
        if less(since * fire.smoke_shape.z, 1.0f) {
            cover = puff(fire, flame, since);
        }
    }
    if cover.shape.z != COVER_NONE {
        atomicAdd(&cover_counts[COVERS_SEEN], 1u);
    }
    let before = atomicLoad(&cover_counts[COVERS_OF_PARTICLES]) + atomicLoad(&cover_counts[COVERS_OF_BOIDS])
        + atomicLoad(&cover_counts[COVERS_OF_MARKS]) + atomicLoad(&cover_counts[COVERS_OF_FRONTS]);
    covers[before + at] = cover;
}
