//! Sine and cosine in turns, powers of two, logarithms and cube roots that give the same bits as
//! `wgsl/lib/transcendental.wgsl` on every driver: its line-by-line twin.
//!
//! Each reduces its argument exactly, then evaluates a polynomial by Horner's rule, or, for the cube root, Newton's method
//! on an integer start value. The polynomials are fitted to the least largest relative error (Lawson's iteratively
//! reweighted least squares, 40 digits); coefficients are rounded to `f32` from the lowest order up, and the rest fitted
//! anew after each rounding. `_LOW` is what rounding took from the leading coefficient before it. Errors against `f64` are
//! stated in units in the last place (ULP) over each range, as `tests/exact_errors.rs` measures.

use crate::exact::{SMALLEST, clamp_exact, floor_exact, shared_constants, snap, to_i32};
use std::f32::consts::{FRAC_1_SQRT_2, LN_2, LOG2_E, TAU};

shared_constants! {
    // sin(2 pi r), |r| <= 1/8: off by 2^-27.9 before rounding.
    const SIN_1: f32 = TAU;
    const SIN_1_LOW: f32 = -1.7484555e-7;
    const SIN_3: f32 = -41.34167;
    const SIN_5: f32 = 81.59343;
    const SIN_7: f32 = -75.4274;
    // cos(2 pi r), |r| <= 1/8: 2^-31.1.
    const COS_2: f32 = -19.739208;
    const COS_4: f32 = 64.93915;
    const COS_6: f32 = -85.42439;
    const COS_8: f32 = 58.610687;
    // 2^f, |f| <= 1/2: 2^-28.3.
    const EXP2_1: f32 = LN_2;
    const EXP2_2: f32 = 0.24022648;
    const EXP2_3: f32 = 0.055503596;
    const EXP2_4: f32 = 0.009618499;
    const EXP2_5: f32 = 0.001339097;
    const EXP2_6: f32 = 0.0001532931;
    const EXP2_LOWEST: f32 = -40.0;
    const EXP2_HIGHEST: f32 = 60.0;
    // log2(1 + f), sqrt(1/2) <= 1 + f < sqrt(2): 2^-27.7.
    const LOG2_1: f32 = LOG2_E;
    const LOG2_1_LOW: f32 = 1.925963e-8;
    const LOG2_2: f32 = -0.72134733;
    const LOG2_3: f32 = 0.4808982;
    const LOG2_4: f32 = -0.36069864;
    const LOG2_5: f32 = 0.2885714;
    const LOG2_6: f32 = -0.23956844;
    const LOG2_7: f32 = 0.2044881;
    const LOG2_8: f32 = -0.19138128;
    const LOG2_9: f32 = 0.18707253;
    const LOG2_10: f32 = -0.110262156;
    // The bits of sqrt(1/2), and 2^60.
    const SQRT_HALF_BITS: i32 = f32::to_bits(FRAC_1_SQRT_2).cast_signed();
    const LOG2_LARGEST: f32 = 1152921504606846976.0;
    // Start value for 1/cbrt(x), at most 3.5 % off; thirds, for Newton's steps; and 2^40.
    const INVERSE_CUBE_ROOT_START: u32 = 0x54a2_1d2a;
    const THIRD: f32 = 0.33333334;
    const FOUR_THIRDS: f32 = 1.3333334;
    const CUBE_ROOT_LARGEST: f32 = 1099511627776.0;
}

/// sin(2π(t + quarters/4)): what is left of t after the nearest quarter turn is exact, so multiples of 1/4 are, too.
#[inline]
fn sine_after_quarters(t: f32, quarters: i32) -> f32 {
    let turns = snap(t);
    let nearest = floor_exact(4.0 * turns + 0.5);
    let quadrant = to_i32(nearest) + quarters;
    let rest = turns - 0.25 * nearest;
    let square = rest * rest;
    let sine_tail = SIN_1_LOW + square * (SIN_3 + square * (SIN_5 + square * SIN_7));
    let sine = rest * SIN_1 + rest * sine_tail;
    let cosine = 1.0 + square * (COS_2 + square * (COS_4 + square * (COS_6 + square * COS_8)));
    let value = if (quadrant & 1) == 1 { cosine } else { sine };
    snap(if (quadrant & 2) == 2 { -value } else { value })
}

/// sin(2πt), t in turns, |t| <= 2^20. Exact at multiples of a quarter turn; else within 2 ULP.
#[inline]
pub fn sin_turns(t: f32) -> f32 {
    sine_after_quarters(t, 0)
}

/// cos(2πt), t in turns, |t| <= 2^20. Exact at multiples of a quarter turn; else within 2 ULP.
#[inline]
pub fn cos_turns(t: f32) -> f32 {
    sine_after_quarters(t, 1)
}

/// 2^x with `x` clamped to -40 ..= 60. Exact for whole `x`; else within 1.5 ULP.
#[inline]
pub fn exp2_exact(x: f32) -> f32 {
    let bounded = clamp_exact(x, EXP2_LOWEST, EXP2_HIGHEST);
    let whole = floor_exact(bounded + 0.5);
    let f = bounded - whole;
    let tail = EXP2_3 + f * (EXP2_4 + f * (EXP2_5 + f * EXP2_6));
    let fraction = 1.0 + f * (EXP2_1 + f * (EXP2_2 + f * tail));
    let power = f32::from_bits(((to_i32(whole) + 127) << 23).cast_unsigned());
    fraction * power
}

/// log2(x) with `x` clamped to 2^-40 ..= 2^60. Exact for powers of two; else within 2 ULP.
#[inline]
pub fn log2_exact(x: f32) -> f32 {
    let bits = clamp_exact(x, SMALLEST, LOG2_LARGEST)
        .to_bits()
        .cast_signed();
    let exponent = (bits - SQRT_HALF_BITS) >> 23;
    let f = f32::from_bits((bits - (exponent << 23)).cast_unsigned()) - 1.0;
    let high = LOG2_7 + f * (LOG2_8 + f * (LOG2_9 + f * LOG2_10));
    let middle = LOG2_4 + f * (LOG2_5 + f * (LOG2_6 + f * high));
    let tail = LOG2_1_LOW + f * (LOG2_2 + f * (LOG2_3 + f * middle));
    snap(exponent as f32 + (f * LOG2_1 + f * tail))
}

/// The cube root of `x` clamped to 0 ..= 2^40, within 1.5 ULP; 0 where x < 2^-40.
#[inline]
pub fn cube_root(x: f32) -> f32 {
    let bounded = clamp_exact(x, 0.0, CUBE_ROOT_LARGEST);
    let third = bounded * THIRD;
    let start = f32::from_bits(INVERSE_CUBE_ROOT_START - bounded.to_bits() / 3);
    let first = start * (FOUR_THIRDS - third * start * start * start);
    let second = first * (FOUR_THIRDS - third * first * first * first);
    let inverse = second * (FOUR_THIRDS - third * second * second * second);
    let squared = inverse * inverse;
    let root = bounded * squared;
    root - (root * root * root - bounded) * squared * THIRD
}
