//! What a particle is made of, recomputed whenever it is asked for (Reeves 1983, 2.2 to 2.4).
//! Twin of `wgsl/lib/particle.wgsl`, line by line.

use glam::{UVec4, Vec3};

use crate::exact::{
    at_least_zero, clamp_unit, f32_of_u32, max_exact, shared_constants, snap, to_i32,
};
use crate::layout::{Particle, ROW_LUMINANCE, SystemRow};
use crate::plan::FrameInputs;
use crate::rng::{pcg4d, signed_float};

shared_constants! {
    /// Streams of the hash: which attributes a draw is for.
    pub const STREAM_PLACE: u32 = 0;
    /// Direction, speed, size.
    pub const STREAM_MOTION: u32 = 1;
    /// Colour and transparency.
    pub const STREAM_COLOR: u32 = 2;
    /// How many are born; the index is 0.
    pub const STREAM_BIRTHS: u32 = 3;
    /// Rates of colour and transparency.
    pub const STREAM_RATES: u32 = 4;
    /// The moment of birth within its frame, the rate of the size.
    pub const STREAM_MOMENT: u32 = 5;
    /// Which point light stands for it.
    pub const STREAM_CLUSTER: u32 = 6;
    /// The least size at birth: a particle always covers something.
    pub const LEAST_SIZE: f32 = 0.000001;
}

/// Who a particle is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Identity {
    /// Its system's key.
    pub key: u32,
    /// The frame of its birth.
    pub birth_frame: u32,
    /// Its index among that frame's births of the system.
    pub index: u32,
}

/// What a particle looks like in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Appearance {
    /// Light of a fully covered pixel, each >= 0.
    pub color: Vec3,
    /// 0 opaque to 1 invisible.
    pub transparency: f32,
    /// Radius, world units.
    pub size: f32,
}

/// Four random words of `who` for the attributes of `stream`.
#[inline]
pub fn draw(who: Identity, stream: u32) -> UVec4 {
    pcg4d(UVec4::new(who.key, who.birth_frame, who.index, stream))
}

/// Where the parameter row of a system at a birth frame stands in the ring.
#[inline]
pub fn row_index(slot: u32, birth_frame: u32, row_mask: u32) -> usize {
    (slot * (row_mask + 1) + (birth_frame & row_mask)) as usize
}

/// Who a stored particle is, and how many frames old, as of the frame of `inputs`.
#[inline]
pub fn identity_of(particle: &Particle, inputs: &FrameInputs) -> (Identity, u32) {
    let age = particle.age(inputs.frame.frame);
    let who = Identity {
        key: inputs.systems[particle.slot() as usize].key,
        birth_frame: inputs.frame.frame.wrapping_sub(age),
        index: particle.index(),
    };
    (who, age)
}

/// Lifetime in whole frames, at least 1 (2.4).
#[inline]
pub fn lifetime_of(who: Identity, speed_and_lifetime: [f32; 4]) -> u32 {
    let random = signed_float(draw(who, STREAM_PLACE).w);
    let [_, _, mean, half_width] = speed_and_lifetime;
    let frames = to_i32(mean + random * half_width + 0.5);
    frames.max(1) as u32
}

/// Colour, transparency and size after `steps` frames of change (2.2, 2.3).
#[inline(always)]
pub fn appearance_of(who: Identity, row: &SystemRow, steps: u32) -> Appearance {
    let random = draw(who, STREAM_COLOR);
    let random_rate = draw(who, STREAM_RATES);
    let n = f32_of_u32(steps);
    let mean = row.color_mean;
    let half_width = row.color_var;
    // Component by component: the processor's vectors are of several particles.
    let rate = |channel: usize, random: u32| {
        row.color_rate[channel] + signed_float(random) * row.color_rate_var[channel]
    };
    let red = at_least_zero(mean[0] + signed_float(random.x) * half_width[0]);
    let green = at_least_zero(mean[1] + signed_float(random.y) * half_width[1]);
    let blue = at_least_zero(mean[2] + signed_float(random.z) * half_width[2]);
    let clear = clamp_unit(mean[3] + signed_float(random.w) * half_width[3]);
    let [size_mean, size_half_width, size_rate, _] = row.size_and_threshold;
    let spread = signed_float(draw(who, STREAM_MOTION).w) * size_half_width;
    let size = max_exact(size_mean + spread, LEAST_SIZE);
    let size_rate =
        size_rate + signed_float(draw(who, STREAM_MOMENT).y) * row.ejection_and_light[3];
    Appearance {
        color: Vec3::new(
            at_least_zero(red + n * rate(0, random_rate.x)),
            at_least_zero(green + n * rate(1, random_rate.y)),
            at_least_zero(blue + n * rate(2, random_rate.z)),
        ),
        transparency: clamp_unit(clear + n * rate(3, random_rate.w)),
        size: at_least_zero(size + n * size_rate),
    }
}

/// I = (1 - transparency) max(R, G, B), or with a flag (1 - transparency) luminance (2.4).
#[inline]
pub fn intensity_of(look: &Appearance, flags: u32) -> f32 {
    let light = if flags & ROW_LUMINANCE != 0 {
        0.2126 * look.color.x + 0.7152 * look.color.y + 0.0722 * look.color.z
    } else {
        max_exact(look.color.x, max_exact(look.color.y, look.color.z))
    };
    snap((1.0 - look.transparency) * light)
}
