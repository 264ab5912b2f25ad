//! Smaller particles beside the way of a flame (Perry 1994, 4.1). Twin of `wgsl/lib/detail.wgsl`.

use glam::Vec3;

use crate::exact::{clamp_exact, f32_of_u32, less, reciprocal, shared_constants};
use crate::layout::FireFrame;
use crate::noise::noise;

shared_constants! {
    /// Noise cells a particle's width.
    pub const CELLS_A_WIDTH: f32 = 0.4;
    /// The inverse of the greatest age.
    pub const AGE_SHARE: f32 = 0.041_666_668;
    /// Half-widths in pixels at which octaves begin to be seen, as the inverse; at twice as many they
    /// wholly are.
    pub const COME_IN_PACE: f32 = 1.333_333_4;
    /// Tells the noises of details from the one that bends flames.
    pub const DETAIL_TAG: u32 = 0x6465_7461;
}

/// The size of particles of an octave, as a factor.
#[inline]
pub fn scale_of(octave: u32) -> f32 {
    reciprocal(f32_of_u32(1 << octave))
}

/// Octaves of a fire, the first to this one.
fn octaves_to(fire: &FireFrame, octave: u32) -> impl Iterator<Item = u32> {
    let details = fire.details[0];
    (1..=octave).take_while(move |at| !less(details, f32_of_u32(*at)))
}

/// Where a particle is that would be at `p` at that age, of a flame so wide: each octave strays from
/// the way of the one before. The noise rises as fast in all.
#[inline]
pub fn strayed(fire: &FireFrame, octave: u32, p: Vec3, age: f32, width: f32) -> Vec3 {
    let cells = CELLS_A_WIDTH * reciprocal(width);
    let farthest = width * fire.details[1] * age * AGE_SHARE;
    octaves_to(fire, octave).fold(p, |place, at| {
        let noisy = (place * cells + Vec3::from_slice(&fire.noise)) * f32_of_u32(1 << at);
        let off = noise(noisy, fire.kinds[2] ^ (DETAIL_TAG + at)).truncate();
        place + off * (farthest * scale_of(at))
    })
}

/// How far an octave has come in whose particles have that half-width in pixels.
#[inline]
fn come_in(half_width_px: f32) -> f32 {
    clamp_exact(half_width_px * COME_IN_PACE - 1.0, 0.0, 1.0)
}

/// The opacity of an octave's particles as a factor, where those of the flame's own way have that
/// half-width in pixels: as many as there are have half the light of the octave before where they are
/// as opaque.
#[inline]
pub fn octave_opacity(fire: &FireFrame, octave: u32, half_width_px: f32) -> f32 {
    let share = |at: u32| fire.details[2] * come_in(half_width_px * scale_of(at));
    let opacity = octaves_to(fire, octave).fold(1.0, |opacity, at| opacity * share(at));
    let is_last = !less(f32_of_u32(octave), fire.details[0]);
    let given = if is_last {
        0.0
    } else {
        0.5 * share(octave + 1)
    };
    opacity * (1.0 - given)
}
