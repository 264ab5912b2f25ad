// splat: every particle adds its light to the pixels it covers.
//
// Reeves 1983, 2.5: each particle is a point light source, nothing hides anything, and the light
// added depends on colour and transparency, not on distance; motes::footprint says where it falls.
// One invocation a particle of one page; what covers many pixels is left to splat_large.
// Reads: frame, system_frames, rows, counts, particles. Writes: light_low, light_high (atomic
// adds; a carry goes from low to high), large_particles (count, then indices from word 2).
// Invariant: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::{clamp_exact, f32_of_i32, less, min_exact, reciprocal, square_root, to_i32}
#import motes::footprint::{
    FEW_CELLS, Footprint, MOST_RADIUS_PX, PI, SMALL_DISC, SQUARE, footprint_of, is_visible,
    minor_range, project, square_weight_at, weight_at,
}
#import motes::layout::{Counts, Frame, Particle, SystemFrame, SystemRow}
#import motes::light::steps_of
#import motes::particle::{Identity, age_of, appearance_of, row_index, slot_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether any system draws such particles.
const STREAKS: bool = #{STREAKS};
const RECTANGLES: bool = #{RECTANGLES};

const PARTICLE_RECTANGLE: u32 = 1u;
const PARTICLE_STREAK: u32 = 2u;
const STREAK_CONSTANT: u32 = 1u;

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
fn draw_small_disc(center_x: f32, center_y: f32, reach: f32, radius_px: f32, color: vec3<f32>) {
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
    let gain = PI * radius_px * radius_px * reciprocal(sum);
    for (var at = 0; at < 9; at += 1) {
        let x = left + at % 3;
        let y = top + at / 3;
        let weight = weights[at] * gain;
        if less(0.0f, weight) && x >= 0 && y >= 0 && x < i32(frame.width) && y < i32(frame.height) {
            add_light(x, y, color, weight);
        }
    }
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
    let position_bits = particles[at].position_and_index;
    let velocity_bits = particles[at].velocity_and_birth;
    let slot = slot_of(velocity_bits.w);
    let age = age_of(velocity_bits.w, frame.frame);
    let birth_frame = frame.frame - age;
    let system = system_at(slot);
    let who = Identity(system.key, birth_frame, position_bits.w);
    let row = row_at(row_index(slot, birth_frame, frame.row_mask));
    let look = appearance_of(who, row, age + 1u);

    let position = bitcast<vec3<f32>>(position_bits.xyz);
    let start = project(frame, system, position);
    var end = start;
    if STREAKS && row.kinds.y == PARTICLE_STREAK {
        let velocity = bitcast<vec3<f32>>(velocity_bits.xyz);
        end = project(frame, system, position + velocity * frame.shutter);
    }
    let radius_px = min_exact(look.size * start.scale, MOST_RADIUS_PX);
    if !is_visible(frame, start, end, radius_px) {
        return;
    }
    let color = look.color * (1.0f - look.transparency);
    let square = RECTANGLES && row.kinds.y == PARTICLE_RECTANGLE;
    let conserved = row.kinds.z != STREAK_CONSTANT;
    let shape = footprint_of(frame, start, end, radius_px, square, conserved);
    if shape.kind == SMALL_DISC {
        draw_small_disc(start.x, start.y, shape.reach, radius_px, color);
    } else if shape.cells <= FEW_CELLS {
        for (var major = shape.first; major < shape.last; major += 1) {
            draw_row(shape, major, color);
        }
    } else {
        leave_to_splat_large(at);
    }
}
