// splat: every particle adds its light to the pixels it covers.
//
// Reeves 1983, 2.5: each particle is a point light source, nothing hides anything, and the light
// added depends on colour and transparency, not on distance; motes::footprint says where it falls.
// One invocation a particle of one page; what covers many pixels is left to splat_large.
// Reads: frame, system_frames, rows, counts, particles. Writes: light_low, light_high (atomic
// adds; a carry goes from low to high), large_particles (count, then indices from word 2).
// Invariant: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::{clamp_exact, dot3, f32_of_i32, less, reciprocal, square_root, to_i32}
#import motes::footprint::{
    FEW_CELLS, Footprint, PI, SMALL_DISC, SQUARE, footprint_of, is_visible, minor_range,
    square_weight_at, weight_at,
}
#import motes::layout::{Counts, Frame, Particle, ROW_OVER, SystemFrame, SystemRow}
#import motes::light::steps_of
#import motes::particle::{age_of, row_index, slot_of}
#import motes::sprite::{Features, Sprite, next_layer, sprite_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether any system has such particles.
const STREAKS: bool = #{STREAKS};
const RECTANGLES: bool = #{RECTANGLES};
const RATE_SPREADS: bool = #{RATE_SPREADS};
const LIGHT_DISTANCES: bool = #{LIGHT_DISTANCES};
// Whether any system's particles cover, which are not of this stage.
const COVERS: bool = #{COVERS};
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> counts: Counts;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> light_high: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read_write> large_particles: array<atomic<u32>>;
@group(0) @binding(8) var<storage, read> layer_planes: array<vec4<f32>>;

// The system in that slot; a lone one is loaded once for all invocations.
fn system_at(slot: u32) -> SystemFrame {
    if frame.system_count == 1u {
        return system_frames[0];
    }
    return system_frames[slot];
}

// The parameter row there. A lone row is loaded once for all invocations, not once for each.
fn row_at(index: u32) -> SystemRow {
    if frame.system_count == 1u && frame.row_mask == 0u {
        return rows[0];
    }
    return rows[index];
}

fn add_channel(at: u32, steps: u32) {
    let before = atomicAdd(&light_low[at], steps);
    if before > 0xffffffffu - steps {
        atomicAdd(&light_high[at], 1u);
    }
}

fn add_light(x: i32, y: i32, color: vec3<f32>, weight: f32) {
    let at = (u32(y) * frame.width + u32(x)) * 3u;
    add_channel(at, steps_of(color.x * weight));
    add_channel(at + 1u, steps_of(color.y * weight));
    add_channel(at + 2u, steps_of(color.z * weight));
}

// One row of pixels across the major axis.
fn draw_row(shape: Footprint, major: i32, color: vec3<f32>) {
    let range = minor_range(shape, major);
    let last = min(range.y, shape.minor_size);
    for (var minor = max(range.x, 0); minor < last; minor += 1) {
        var weight: f32;
        if RECTANGLES && shape.kind == SQUARE {
            weight = square_weight_at(shape, major, minor);
        } else {
            weight = weight_at(shape, major, minor) * shape.gain;
        }
        if less(0.0f, weight) {
            add_light(
                select(major, minor, shape.steep),
                select(minor, major, shape.steep),
                color,
                weight,
            );
        }
    }
}

// A disc at rest that covers at most the nine pixels around its centre's: no loops over ranges,
// and each weight is computed once.
fn draw_small_disc(sprite: Sprite, reach: f32) {
    let center_x = sprite.start.x;
    let center_y = sprite.start.y;
    let left = to_i32(center_x) - 1;
    let top = to_i32(center_y) - 1;
    var weights: array<f32, 9>;
    var sum = 0.0f;
    for (var at = 0; at < 9; at += 1) {
        let dx = f32_of_i32(left + at % 3) + 0.5f - center_x;
        let dy = f32_of_i32(top + at / 3) + 0.5f - center_y;
        let distance = square_root(dx * dx + dy * dy);
        let weight = clamp_exact(reach - distance, 0.0f, 1.0f);
        weights[at] = weight;
        sum += weight;
    }
    let gain = PI * sprite.radius_px * sprite.radius_px * reciprocal(sum);
    for (var at = 0; at < 9; at += 1) {
        let x = left + at % 3;
        let y = top + at / 3;
        let weight = weights[at] * gain;
        if less(0.0f, weight) && x >= 0 && y >= 0 && x < i32(frame.width) && y < i32(frame.height) {
            add_light(x, y, sprite.color, weight);
        }
    }
}

// The layer, from 1, that a world place is in.
fn layer_of(world: vec3<f32>) -> u32 {
    var layer = 0u;
    for (var at = 0u; at < frame.layer_plane_count; at += 1u) {
        let plane = layer_planes[at];
        layer = next_layer(layer, at, dot3(plane.xyz, world) - plane.w);
    }
    return select(layer, frame.layer_plane_count + 1u, layer == 0u);
}

fn leave_to_splat_large(at: u32) {
    let place = atomicAdd(&large_particles[0], 1u);
    atomicStore(&large_particles[2u + place], at);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn splat(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let page_start = pages.page * frame.page_len;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.live - min(counts.live, page_start), frame.page_len) {
        return;
    }
    let particle = particles[at];
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    let row = row_at(row_index(slot, frame.frame - age_of(birth, frame.frame), frame.row_mask));
    if COVERS && (row.kinds.w & ROW_OVER) != 0u {
        return;
    }
    let features = Features(STREAKS, RECTANGLES, RATE_SPREADS, LIGHT_DISTANCES);
    let sprite = sprite_of(frame, system_at(slot), row, particle, features);
    if !is_visible(frame, sprite.start, sprite.end, sprite.radius_px) {
        return;
    }
    if LAYERS && frame.layer != 0u && layer_of(sprite.world) != frame.layer {
        return;
    }
    let shape = footprint_of(
        frame, sprite.start, sprite.end, sprite.radius_px, sprite.square, sprite.conserved,
    );
    if shape.kind == SMALL_DISC {
        draw_small_disc(sprite, shape.reach);
    } else if shape.cells <= FEW_CELLS {
        for (var major = shape.first; major < shape.last; major += 1) {
            draw_row(shape, major, sprite.color);
        }
    } else {
        leave_to_splat_large(at);
    }
}
