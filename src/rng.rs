//! Random numbers by hashing, the twin of `wgsl/lib/rng.wgsl`: pcg4d of Jarzynski and Olano, "Hash Functions for GPU
//! Rendering", JCGT 9(3), 2020, and its bits as floats.

use crate::exact::shared_constants;
use glam::{UVec4, Vec4};

shared_constants! {
    /// The multiplier of the linear congruential step.
    pub const MULTIPLIER: u32 = 1_664_525;
    /// The increment of the linear congruential step.
    pub const INCREMENT: u32 = 1_013_904_223;
    /// 2^-24, the spacing of [`unit_float`].
    pub const UNIT_STEP: f32 = 5.960_464_5e-8;
}

/// Four well-mixed words from four words of "who and what for". A bijection: different keys give different results.
#[inline]
pub fn pcg4d(key: UVec4) -> UVec4 {
    let step = |word: u32| word.wrapping_mul(MULTIPLIER).wrapping_add(INCREMENT);
    let mut v = UVec4::new(step(key.x), step(key.y), step(key.z), step(key.w));
    v.x = v.x.wrapping_add(v.y.wrapping_mul(v.w));
    v.y = v.y.wrapping_add(v.z.wrapping_mul(v.x));
    v.z = v.z.wrapping_add(v.x.wrapping_mul(v.y));
    v.w = v.w.wrapping_add(v.y.wrapping_mul(v.z));
    v ^= v >> 16u32;
    v.x = v.x.wrapping_add(v.y.wrapping_mul(v.w));
    v.y = v.y.wrapping_add(v.z.wrapping_mul(v.x));
    v.z = v.z.wrapping_add(v.x.wrapping_mul(v.y));
    v.w = v.w.wrapping_add(v.y.wrapping_mul(v.z));
    v
}

/// Uniform in 0 .. 1 (1 excluded), a multiple of 2^-24, from the upper 24 bits of `word`.
#[inline]
pub fn unit_float(word: u32) -> f32 {
    (word >> 8) as f32 * UNIT_STEP
}

/// Uniform in -1 .. 1 (1 excluded), a multiple of 2^-23: Rand() of Reeves (1983), section 2.1.
#[inline]
pub fn signed_float(word: u32) -> f32 {
    2.0 * unit_float(word) - 1.0
}

/// Below `count`, each as often as any other but for one in 2^32: the upper word of the product.
#[inline]
pub fn index_below(word: u32, count: u32) -> u32 {
    ((u64::from(word) * u64::from(count)) >> 32) as u32
}

/// [`unit_float`] of each word.
#[inline]
pub fn unit4(words: UVec4) -> Vec4 {
    Vec4::new(
        unit_float(words.x),
        unit_float(words.y),
        unit_float(words.z),
        unit_float(words.w),
    )
}

/// [`signed_float`] of each word.
#[inline]
pub fn signed4(words: UVec4) -> Vec4 {
    Vec4::new(
        signed_float(words.x),
        signed_float(words.y),
        signed_float(words.z),
        signed_float(words.w),
    )
}
