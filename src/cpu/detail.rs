//! Smaller particles beside the way of a flame (Perry 1994, 4.1). Twin of `wgsl/lib/detail.wgsl`.

use glam::Vec3;

use crate::exact::{f32_of_u32, reciprocal, shared_constants};
use crate::layout::FireFrame;
use crate::noise::noise;
use crate::plan::DetailPass;

shared_constants! {
    /// Noise cells a particle's width.
    pub const CELLS_A_WIDTH: f32 = 0.4;
    /// The inverse of the greatest age.
    pub const AGE_SHARE: f32 = 0.041_666_668;
    /// Tells the noises of details from the one that bends flames.
    pub const DETAIL_TAG: u32 = 0x6465_7461;
}

/// The size of particles of an octave, as a factor.
#[inline]
pub fn scale_of(octave: u32) -> f32 {
    reciprocal(f32_of_u32(1 << octave))
}

/// Where a particle is that would be at `p` at that age, of a flame so wide.
#[inline]
pub fn strayed(fire: &FireFrame, pass: DetailPass, p: Vec3, age: f32, width: f32) -> Vec3 {
    let DetailPass { octave, copy } = pass;
    let cells = CELLS_A_WIDTH * reciprocal(width * scale_of(octave));
    let key = fire.kinds[2] ^ (DETAIL_TAG + (1 << octave) + copy);
    let off = noise(p * cells + Vec3::from_slice(&fire.noise), key).truncate();
    p + off * (width * fire.details[1] * age * AGE_SHARE)
}
