// Sine and cosine in turns, powers of two, logarithms and cube roots that give the same bits on every driver and in
// `src/transcendental.rs`, their line-by-line twin.
//
// Each reduces its argument exactly, then evaluates a polynomial by Horner's rule, or, for the cube root, Newton's method on
// an integer start value. The polynomials are fitted to the least largest relative error (Lawson's iteratively reweighted
// least squares, 40 digits); coefficients are rounded to f32 from the lowest order up, and the rest fitted anew after each
// rounding. *_LOW is what rounding took from the leading coefficient before it. Error against f64: at most 2 ULP over each
// stated range, as `tests/exact_errors.rs` measures. Reads and writes no buffers.
#define_import_path motes::transcendental

#import motes::exact::{SMALLEST, clamp_exact, floor_exact, snap, to_i32}

// sin(2 pi r), |r| <= 1/8: off by 2^-27.9 before rounding.
const SIN_1: f32 = 6.2831855f;
const SIN_1_LOW: f32 = -1.7484555e-7f;
const SIN_3: f32 = -41.34167f;
const SIN_5: f32 = 81.59343f;
const SIN_7: f32 = -75.4274f;
// cos(2 pi r), |r| <= 1/8: 2^-31.1.
const COS_2: f32 = -19.739208f;
const COS_4: f32 = 64.93915f;
const COS_6: f32 = -85.42439f;
const COS_8: f32 = 58.610687f;
// 2^f, |f| <= 1/2: 2^-28.3.
const EXP2_1: f32 = 0.6931472f;
const EXP2_2: f32 = 0.24022648f;
const EXP2_3: f32 = 0.055503596f;
const EXP2_4: f32 = 0.009618499f;
const EXP2_5: f32 = 0.001339097f;
const EXP2_6: f32 = 0.0001532931f;
const EXP2_LOWEST: f32 = -40.0f;
const EXP2_HIGHEST: f32 = 60.0f;
// log2(1 + f), sqrt(1/2) <= 1 + f < sqrt(2): 2^-27.7.
const LOG2_1: f32 = 1.442695f;
const LOG2_1_LOW: f32 = 1.925963e-8f;
const LOG2_2: f32 = -0.72134733f;
const LOG2_3: f32 = 0.4808982f;
const LOG2_4: f32 = -0.36069864f;
const LOG2_5: f32 = 0.2885714f;
const LOG2_6: f32 = -0.23956844f;
const LOG2_7: f32 = 0.2044881f;
const LOG2_8: f32 = -0.19138128f;
const LOG2_9: f32 = 0.18707253f;
const LOG2_10: f32 = -0.110262156f;
// The bits of sqrt(1/2), and 2^60.
const SQRT_HALF_BITS: i32 = 0x3f3504f3i;
const LOG2_LARGEST: f32 = 1152921504606846976.0f;
// Start value for 1/cbrt(x), at most 3.5 % off; thirds, for Newton's steps; and 2^40.
const INVERSE_CUBE_ROOT_START: u32 = 0x54a21d2au;
const THIRD: f32 = 0.33333334f;
const FOUR_THIRDS: f32 = 1.3333334f;
const CUBE_ROOT_LARGEST: f32 = 1099511627776.0f;

// sin(2 pi (t + quarters/4)): what is left of t after the nearest quarter turn is exact, so multiples of 1/4 are, too.
fn sine_after_quarters(t: f32, quarters: i32) -> f32 {
    let turns = snap(t);
    let nearest = floor_exact(4.0f * turns + 0.5f);
    let quadrant = to_i32(nearest) + quarters;
    let rest = turns - 0.25f * nearest;
    let square = rest * rest;
    let sine_tail = SIN_1_LOW + square * (SIN_3 + square * (SIN_5 + square * SIN_7));
    let sine = rest * SIN_1 + rest * sine_tail;
    let cosine = 1.0f + square * (COS_2 + square * (COS_4 + square * (COS_6 + square * COS_8)));
    let value = select(sine, cosine, (quadrant & 1i) == 1i);
    return snap(select(value, -value, (quadrant & 2i) == 2i));
}

// sin(2 pi t), |t| <= 2^20 turns.
fn sin_turns(t: f32) -> f32 {
    return sine_after_quarters(t, 0i);
}

// cos(2 pi t), |t| <= 2^20 turns.
fn cos_turns(t: f32) -> f32 {
    return sine_after_quarters(t, 1i);
}

// 2^x with x clamped to -40 ..= 60. Exact for whole x.
fn exp2_exact(x: f32) -> f32 {
    let bounded = clamp_exact(x, EXP2_LOWEST, EXP2_HIGHEST);
    let whole = floor_exact(bounded + 0.5f);
    let f = bounded - whole;
    let tail = EXP2_3 + f * (EXP2_4 + f * (EXP2_5 + f * EXP2_6));
    let fraction = 1.0f + f * (EXP2_1 + f * (EXP2_2 + f * tail));
    let power = bitcast<f32>((to_i32(whole) + 127i) << 23u);
    return fraction * power;
}

// log2(x) with x clamped to 2^-40 ..= 2^60. Exact for powers of two.
fn log2_exact(x: f32) -> f32 {
    let bits = bitcast<i32>(clamp_exact(x, SMALLEST, LOG2_LARGEST));
    let exponent = (bits - SQRT_HALF_BITS) >> 23u;
    let f = bitcast<f32>(bits - (exponent << 23u)) - 1.0f;
    let high = LOG2_7 + f * (LOG2_8 + f * (LOG2_9 + f * LOG2_10));
    let middle = LOG2_4 + f * (LOG2_5 + f * (LOG2_6 + f * high));
    let tail = LOG2_1_LOW + f * (LOG2_2 + f * (LOG2_3 + f * middle));
    return snap(f32(exponent) + (f * LOG2_1 + f * tail));
}

// The cube root of x clamped to 0 ..= 2^40; 0 where x < 2^-40.
fn cube_root(x: f32) -> f32 {
    let bounded = clamp_exact(x, 0.0f, CUBE_ROOT_LARGEST);
    let third = bounded * THIRD;
    let start = bitcast<f32>(INVERSE_CUBE_ROOT_START - bitcast<u32>(bounded) / 3u);
    let first = start * (FOUR_THIRDS - third * start * start * start);
    let second = first * (FOUR_THIRDS - third * first * first * first);
    let inverse = second * (FOUR_THIRDS - third * second * second * second);
    let squared = inverse * inverse;
    let root = bounded * squared;
    return root - (root * root * root - bounded) * squared * THIRD;
}
