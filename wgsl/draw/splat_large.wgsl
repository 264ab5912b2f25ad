// splat_large: particles that cover many pixels add their light to them.
//
// What splat does, for those that it has left in large_particles. 256 invocations share a particle
// of one page, each taking every 256th row of pixels, so that no invocation's loops get long.
// Reads: frame, system_frames, rows, large_particles, particles. Writes: light_low, light_high.
// Invariant: as splat's: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::{less, min_exact}
#import motes::footprint::{
    Footprint, MOST_RADIUS_PX, SHARES, SQUARE, footprint_of, minor_range, project, square_weight_at,
    weight_at,
}
#import motes::layout::{Frame, Particle, SystemFrame, SystemRow}
#import motes::light::steps_of
#import motes::particle::{Identity, age_of, appearance_of, row_index, slot_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether any system draws such particles.
const STREAKS: bool = #{STREAKS};
const RECTANGLES: bool = #{RECTANGLES};

const PARTICLE_RECTANGLE: u32 = 1u;
const PARTICLE_STREAK: u32 = 2u;
const STREAK_CONSTANT: u32 = 1u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> particles: array<Particle>;
@group(0) @binding(4) var<storage, read> large_particles: array<u32>;
@group(0) @binding(5) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> light_high: array<atomic<u32>>;

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

@compute @workgroup_size(WORKGROUP_SIZE)
fn splat_large(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let work = linear_index(global_id, WORKGROUP_SIZE);
    let place = work / SHARES;
    if place >= large_particles[1] {
        return;
    }
    let at = large_particles[2u + place];
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
    let color = look.color * (1.0f - look.transparency);
    let square = RECTANGLES && row.kinds.y == PARTICLE_RECTANGLE;
    let conserved = row.kinds.z != STREAK_CONSTANT;
    let shape = footprint_of(frame, start, end, radius_px, square, conserved);
    let share = i32(work % SHARES);
    for (var major = shape.first + share; major < shape.last; major += i32(SHARES)) {
        draw_row(shape, major, color);
    }
}
