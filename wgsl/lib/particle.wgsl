// What a particle is made of, recomputed whenever it is asked for: its attributes are hashes of
// who it is, spread by the parameter row of its system at its birth frame
// (Reeves 1983, sections 2.2 to 2.4). Twin of src/cpu/particle.rs.
#define_import_path motes::particle

#import motes::layout::{Particle, ROW_LUMINANCE, SystemRow}
#import motes::rng::{pcg4d, signed_float, signed4}
#import motes::exact::{at_least_zero, clamp_unit, f32_of_u32, max_exact, snap, to_i32}

// Streams of the hash: which attributes a draw is for.
const STREAM_PLACE: u32 = 0u;
const STREAM_MOTION: u32 = 1u;
const STREAM_COLOR: u32 = 2u;
const STREAM_BIRTHS: u32 = 3u;
const STREAM_RATES: u32 = 4u;
const STREAM_MOMENT: u32 = 5u;
const STREAM_CLUSTER: u32 = 6u;

// The least size at birth: a particle always covers something.
const LEAST_SIZE: f32 = 0.000001f;

// Who it is: its system's key, the frame of its birth, its index among that frame's births.
struct Identity {
    key: u32,
    birth_frame: u32,
    index: u32,
}

// What it looks like.
struct Appearance {
    color: vec3<f32>,
    transparency: f32,
    size: f32,
}

// A particle of four words of 64 bits, as adapters that have them load it: in one access, not two.
fn from_words(words: vec4<u64>) -> Particle {
    return Particle(
        vec4<u32>(u32(words.x), u32(words.x >> 32u), u32(words.y), u32(words.y >> 32u)),
        vec4<u32>(u32(words.z), u32(words.z >> 32u), u32(words.w), u32(words.w >> 32u)),
    );
}

fn word_of(low: u32, high: u32) -> u64 {
    return u64(low) | (u64(high) << 32u);
}

fn to_words(particle: Particle) -> vec4<u64> {
    let place = particle.position_and_index;
    let motion = particle.velocity_and_birth;
    return vec4<u64>(
        word_of(place.x, place.y), word_of(place.z, place.w),
        word_of(motion.x, motion.y), word_of(motion.z, motion.w),
    );
}

fn slot_of(particle_birth: u32) -> u32 {
    return particle_birth >> 16u;
}

// Frames since birth; lifetimes are below 65,536, so the low 16 bits tell.
fn age_of(particle_birth: u32, frame: u32) -> u32 {
    return (frame - particle_birth) & 0xffffu;
}

fn row_index(slot: u32, birth_frame: u32, row_mask: u32) -> u32 {
    return slot * (row_mask + 1u) + (birth_frame & row_mask);
}

fn draw(who: Identity, stream: u32) -> vec4<u32> {
    return pcg4d(vec4<u32>(who.key, who.birth_frame, who.index, stream));
}

// Lifetime in whole frames, at least 1 (2.4).
fn lifetime_of(who: Identity, speed_and_lifetime: vec4<f32>) -> u32 {
    let random = signed_float(draw(who, STREAM_PLACE).w);
    let frames = to_i32(speed_and_lifetime.z + random * speed_and_lifetime.w + 0.5f);
    return u32(max(frames, 1));
}

// Colour, transparency and size after `steps` frames of change (2.2, 2.3). `spread_rates` is
// whether rates may differ from one particle to the next.
fn appearance_of(who: Identity, row: SystemRow, steps: u32, spread_rates: bool) -> Appearance {
    let random = draw(who, STREAM_COLOR);
    let n = f32_of_u32(steps);
    let mean = row.color_mean;
    let half_width = row.color_var;
    var rate = row.color_rate;
    var size_rate = row.size_and_threshold.z;
    if spread_rates {
        rate = rate + signed4(draw(who, STREAM_RATES)) * row.color_rate_var;
        size_rate += signed_float(draw(who, STREAM_MOMENT).y) * row.ejection_and_light.w;
    }
    let red = at_least_zero(mean.x + signed_float(random.x) * half_width.x);
    let green = at_least_zero(mean.y + signed_float(random.y) * half_width.y);
    let blue = at_least_zero(mean.z + signed_float(random.z) * half_width.z);
    let clear = clamp_unit(mean.w + signed_float(random.w) * half_width.w);
    let spread = signed_float(draw(who, STREAM_MOTION).w) * row.size_and_threshold.y;
    let size = max_exact(row.size_and_threshold.x + spread, LEAST_SIZE);
    return Appearance(
        vec3<f32>(
            at_least_zero(red + n * rate.x),
            at_least_zero(green + n * rate.y),
            at_least_zero(blue + n * rate.z),
        ),
        clamp_unit(clear + n * rate.w),
        at_least_zero(size + n * size_rate),
    );
}

// I = (1 - transparency) max(R, G, B), or with a flag (1 - transparency) luminance (2.4).
fn intensity_of(look: Appearance, flags: u32) -> f32 {
    let brightest = max_exact(look.color.x, max_exact(look.color.y, look.color.z));
    let luminance = 0.2126f * look.color.x + 0.7152f * look.color.y + 0.0722f * look.color.z;
    let light = select(brightest, luminance, (flags & ROW_LUMINANCE) != 0u);
    return snap((1.0f - look.transparency) * light);
}
