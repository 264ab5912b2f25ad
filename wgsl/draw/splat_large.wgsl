// splat_large: particles that cover many pixels add their light to them.
//
// Reeves 1983, 2.5 and 3: streaks, squares and larger discs (motes::footprint), row by row of pixels.
// What splat has left in large_particles of one page: first an invocation each for those of few
// pixels, then SHARES for each of the others, of which each takes every SHARES-th row, so that no
// invocation's loops get long.
// Reads: frame, system_frames, rows, large_particles, particles, surface_nearness. Writes: light as splat does.
// Invariant: as splat's: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::less
#import motes::footprint::{
    Footprint, LIST_START, SHARES, footprint_of, minor_range, square_weight_at, weight_at,
}
#import motes::layout::{Frame, Particle, SystemFrame, SystemRow}
#import motes::light::steps_for
#import motes::packed::{UNFIT, channels_of, left_over, packed, rest_of}
#import motes::particle::{age_of, from_words, row_index, slot_of}
#import motes::reach::center_of
#import motes::veil::{front_of, open_share}
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
// Whether surfaces hide what is behind them.
const SURFACES: bool = #{SURFACES};

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(4) var<storage, read> large_particles: array<u32>;
@group(0) @binding(5) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> light_high: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read> surface_nearness: array<vec4<u32>>;
#if WIDE == true
@group(0) @binding(3) var<storage, read> particles: array<vec4<u64>>;
@group(0) @binding(8) var<storage, read_write> light_packed: array<atomic<u64>>;
#else
@group(0) @binding(3) var<storage, read> particles: array<Particle>;
#endif

// Adds to a pixel what its packed fields take, and tells what is left (motes::packed): all of it
// where there are none.
fn add_packed(pixel: u32, steps: vec3<u32>) -> u32 {
#if WIDE == true
    let word = packed(steps);
    return rest_of(atomicAdd(&light_packed[pixel], word), word, steps);
#else
    return UNFIT;
#endif
}

// Adds what is left to the limbs; a count with the highest bit set is negative. Drivers that run
// all branches turn a loop once: it is the one place of three channels.
fn add_left(pixel: u32, rest: u32, steps: vec3<u32>) {
#if WIDE == true
    let over = left_over(rest, steps);
#else
    let over = steps;
#endif
    var left = channels_of(over);
    while left != 0u {
        let channel = firstTrailingBit(left);
        left &= left - 1u;
        let at = pixel * 3u + channel;
        let before = atomicAdd(&light_low[at], over[channel]);
        let carry = select(0u, 1u, before > 0xffffffffu - over[channel]);
        let high = carry - (over[channel] >> 31u);
        if high != 0u {
            atomicAdd(&light_high[at], high);
        }
    }
}

// One row of pixels across the major axis.
fn draw_row(shape: Footprint, major: i32, color: vec3<f32>, front: u32) {
    let at_major = center_of(major);
    let range = minor_range(shape, at_major);
    let last = min(range.y, shape.minor_size);
    var at_minor = center_of(max(range.x, 0));
    for (var minor = max(range.x, 0); minor < last; minor += 1) {
        var weight: f32;
        if RECTANGLES && shape.square {
            weight = square_weight_at(shape, at_major, at_minor);
        } else {
            weight = weight_at(shape, at_major, at_minor) * shape.gain;
        }
        if less(0.0f, weight) {
            let x = u32(select(major, minor, shape.steep));
            let y = u32(select(minor, major, shape.steep));
            let pixel = y * frame.width + x;
            if SURFACES {
                weight *= open_share(surface_nearness[pixel], front);
            }
            let steps = steps_for(color, weight);
            add_left(pixel, add_packed(pixel, steps), steps);
        }
        at_minor += 1.0f;
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn splat_large(@builtin(global_invocation_id) global_id: vec3<u32>) {
    // Before the first branch, as software drivers load it lane by lane after that.
    var system = system_frames[0];
    var row = rows[0];
    let few = large_particles[2];
    let many = large_particles[3];
    let work = linear_index(global_id, WORKGROUP_SIZE);
    if work >= few + many * SHARES {
        return;
    }
    let is_shared = work >= few;
    let share = select(0u, work - few, is_shared);
    let place = select(work, frame.page_len - 1u - share / SHARES, is_shared);
    let at = large_particles[LIST_START + place];
#if WIDE == true
    let particle = from_words(particles[at]);
#else
    let particle = particles[at];
#endif
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    if MANY_ROWS {
        row = rows[row_index(slot, frame.frame - age_of(birth, frame.frame), frame.row_mask)];
    }
    if MANY_SYSTEMS {
        system = system_frames[slot];
    }
    let features = Features(STREAKS, RECTANGLES, RATE_SPREADS, LIGHT_DISTANCES);
    let sprite = sprite_of(frame, system, row, particle, features);
    let shape = footprint_of(
        frame, sprite.start, sprite.end, sprite.radius_px, sprite.square, sprite.conserved,
    );
    let front = front_of(frame, sprite.start.depth, sprite.radius_px);
    let step = select(1, i32(SHARES), is_shared);
    for (var major = shape.first + i32(share % SHARES); major < shape.last; major += step) {
        draw_row(shape, major, sprite.color, front);
    }
}
