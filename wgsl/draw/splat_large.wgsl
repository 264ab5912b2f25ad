// splat_large: particles that cover many pixels add their light to them.
//
// What splat does, for those that it has left in large_particles. 256 invocations share a particle
// of one page, each taking every 256th row of pixels, so that no invocation's loops get long.
// Reads: frame, system_frames, rows, large_particles, particles. Writes: light as splat does.
// Invariant: as splat's: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::less
#import motes::footprint::{
    Footprint, SHARES, SQUARE, footprint_of, minor_range, square_weight_at, weight_at,
}
#import motes::layout::{Frame, Particle, SystemFrame, SystemRow}
#import motes::light::steps_of
#import motes::packed::{channels_of, left_over, packed}
#import motes::particle::{age_of, row_index, slot_of}
#import motes::sprite::{Features, sprite_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether there are several systems, several parameter rows.
const MANY_SYSTEMS: bool = #{MANY_SYSTEMS};
const MANY_ROWS: bool = #{MANY_ROWS};
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
#if WIDE == true
@group(0) @binding(7) var<storage, read_write> light_packed: array<atomic<u64>>;
#endif

// What is the same for all invocations where there is only one of it.
struct Lone {
    system: SystemFrame,
    row: SystemRow,
}

fn system_at(slot: u32, lone: Lone) -> SystemFrame {
    if MANY_SYSTEMS {
        return system_frames[slot];
    }
    return lone.system;
}

fn row_at(index: u32, lone: Lone) -> SystemRow {
    if MANY_ROWS {
        return rows[index];
    }
    return lone.row;
}

// Adds steps to the limbs of a channel; a count with the highest bit set is negative.
fn add_to_limbs(at: u32, steps: u32) {
    let before = atomicAdd(&light_low[at], steps);
    let carry = select(0u, 1u, before > 0xffffffffu - steps);
    let high = carry - (steps >> 31u);
    if high != 0u {
        atomicAdd(&light_high[at], high);
    }
}

fn add_light(x: i32, y: i32, color: vec3<f32>, weight: f32) {
    let pixel = u32(y) * frame.width + u32(x);
    let steps = vec3<u32>(
        steps_of(color.x * weight), steps_of(color.y * weight), steps_of(color.z * weight),
    );
#if WIDE == true
    let word = packed(steps);
    let over = left_over(atomicAdd(&light_packed[pixel], word), word, steps);
    // Drivers that run all branches turn a loop once: it is the one place of three channels.
    var left = channels_of(over);
    while left != 0u {
        let channel = firstTrailingBit(left);
        left &= left - 1u;
        add_to_limbs(pixel * 3u + channel, over[channel]);
    }
#else
    add_to_limbs(pixel * 3u, steps.x);
    add_to_limbs(pixel * 3u + 1u, steps.y);
    add_to_limbs(pixel * 3u + 2u, steps.z);
#endif
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
    // Before the first branch, as software drivers load it lane by lane after that.
    let lone = Lone(system_frames[0], rows[0]);
    let work = linear_index(global_id, WORKGROUP_SIZE);
    let place = work / SHARES;
    if place >= large_particles[1] {
        return;
    }
    let at = large_particles[2u + place];
    let particle = particles[at];
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    let row = row_at(row_index(slot, frame.frame - age_of(birth, frame.frame), frame.row_mask), lone);
    let features = Features(STREAKS, RECTANGLES, RATE_SPREADS, LIGHT_DISTANCES);
    let sprite = sprite_of(frame, system_at(slot, lone), row, particle, features);
    let shape = footprint_of(
        frame, sprite.start, sprite.end, sprite.radius_px, sprite.square, sprite.conserved,
    );
    let share = i32(work % SHARES);
    for (var major = shape.first + share; major < shape.last; major += i32(SHARES)) {
        draw_row(shape, major, sprite.color);
    }
}
