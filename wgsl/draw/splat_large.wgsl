// splat_large: particles that cover many pixels add their light to them.
//
// What splat does, for those that it has left in large_particles. 256 invocations share a particle
// of one page, each taking every 256th row of pixels, so that no invocation's loops get long.
// Reads: frame, system_frames, rows, large_particles, particles. Writes: light_low, light_high.
// Invariant: as splat's: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::less
#import motes::footprint::{
    Footprint, SHARES, SQUARE, footprint_of, minor_range, square_weight_at, weight_at,
}
#import motes::layout::{Frame, Particle, SystemFrame, SystemRow}
#import motes::light::steps_of
#import motes::particle::{age_of, row_index, slot_of}
#import motes::sprite::{Features, sprite_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether any system has such particles.
const STREAKS: bool = #{STREAKS};
const RECTANGLES: bool = #{RECTANGLES};
const RATE_SPREADS: bool = #{RATE_SPREADS};
const LIGHT_DISTANCES: bool = #{LIGHT_DISTANCES};

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
    let particle = particles[at];
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    let row = row_at(row_index(slot, frame.frame - age_of(birth, frame.frame), frame.row_mask));
    let features = Features(STREAKS, RECTANGLES, RATE_SPREADS, LIGHT_DISTANCES);
    let sprite = sprite_of(frame, system_at(slot), row, particle, features);
    let shape = footprint_of(
        frame, sprite.start, sprite.end, sprite.radius_px, sprite.square, sprite.conserved,
    );
    let share = i32(work % SHARES);
    for (var major = shape.first + share; major < shape.last; major += i32(SHARES)) {
        draw_row(shape, major, sprite.color);
    }
}
