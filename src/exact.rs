//! Float arithmetic that gives the same bits as `wgsl/lib/exact.wgsl` on every driver: its line-by-line twin.
//!
//! Only `+`, `-`, `*`, negation, comparison, selection, `abs`, `floor`, changes between a float and its bits, integer
//! operations and bounded conversions occur here, for these alone are the same everywhere. Arguments of a comparison, of
//! `floor` and of an integer start value are snapped, so neither denormals nor the sign of zero can be observed.
//! Vectors are [`glam::Vec3`] as storage: of its operations only the component-wise `+`, `-` and `*` are used.
//!
//! Reciprocal and inverse square root start from an integer guess on the float's bits (Blinn, "Floating-Point Tricks",
//! IEEE CG&A 17(4), 1997) and are refined by Newton's method; the last step adds a residual to keep rounding small.
//! Errors are in units in the last place (ULP) of the true value's `f32`, measured by `tests/exact_errors.rs`.

use glam::{IVec3, Vec2, Vec3, Vec4};

/// Declares constants that a WGSL file has, too, and lists them for the test that compares the two bit for bit.
macro_rules! shared_constants {
    (@bits f32 $value:expr) => { f32::to_bits($value) };
    (@bits u32 $value:expr) => { $value };
    (@bits i32 $value:expr) => { i32::cast_unsigned($value) };
    ($($(#[$doc:meta])* $visibility:vis const $name:ident: $kind:ident = $value:expr;)*) => {
        $($(#[$doc])* $visibility const $name: $kind = $value;)*

        /// Every constant that the WGSL file of this module's name declares: its name and its bits.
        pub const CONSTANTS: &[(&str, u32)] =
            &[$((stringify!($name), $crate::exact::shared_constants!(@bits $kind $name))),*];
    };
}
pub(crate) use shared_constants;

shared_constants! {
    /// 2^-40: what is smaller counts as zero.
    pub const SMALLEST: f32 = 9.094947e-13;
    /// The bit that holds a float's sign.
    pub const SIGN_BIT: u32 = 0x8000_0000;
    /// The bits that hold a float's magnitude.
    pub const MAGNITUDE_BITS: u32 = 0x7fff_ffff;
    /// The bits that hold a float's exponent; alone, they are infinity.
    pub const EXPONENT_BITS: u32 = 0x7f80_0000;
    /// The bits of 2^-40.
    pub const SMALLEST_BITS: u32 = 0x2b80_0000;
    /// The bits of 2^40.
    pub const LARGEST_BITS: u32 = 0x5380_0000;
    /// The bits of 2^80.
    pub const LARGEST_SQUARE_BITS: u32 = 0x6780_0000;
    /// Exponent bits of x taken from this give those of 1/x, for x a power of two.
    pub const EXPONENT_MIRROR: u32 = 0x7f00_0000;
    /// Less the bits of x: a start value for 1/x, at most 5.1 % off.
    pub const RECIPROCAL_START: u32 = 0x7ef3_11c7;
    /// Less half the bits of x: a start value for 1/sqrt(x), at most 3.5 % off.
    pub const INVERSE_SQUARE_ROOT_START: u32 = 0x5f37_5a86;
    /// 2^30: what [`to_i32`] clamps to.
    pub const INTEGER_LIMIT: f32 = 1_073_741_824.0;
    /// 2^24: up to here every integer has its float, and drivers agree on it.
    pub const EXACT_INTEGER_LIMIT: u32 = 16_777_216;
    /// 1.5 * 2^39, around which floats are 2^16 apart.
    pub const COARSE_ORIGIN: f32 = 824_633_720_832.0;
    /// Its bits.
    pub const COARSE_BITS: i32 = 0x5340_0000;
    /// 1.5 * 2^23, around which floats are 1 apart.
    pub const FINE_ORIGIN: f32 = 12_582_912.0;
    /// Its bits.
    pub const FINE_BITS: i32 = 0x4b40_0000;
}

/// `x`, or +0 where |x| < 2^-40 (and for -0). Every float is snapped before it is stored.
#[inline]
pub fn snap(x: f32) -> f32 {
    if x.abs() < SMALLEST { 0.0 } else { x }
}

/// [`snap`] of each component.
#[inline]
pub fn snap2(v: Vec2) -> Vec2 {
    Vec2::new(snap(v.x), snap(v.y))
}

/// [`snap`] of each component.
#[inline]
pub fn snap3(v: Vec3) -> Vec3 {
    Vec3::new(snap(v.x), snap(v.y), snap(v.z))
}

/// [`snap`] of each component.
#[inline]
pub fn snap4(v: Vec4) -> Vec4 {
    Vec4::new(snap(v.x), snap(v.y), snap(v.z), snap(v.w))
}

/// The bits of the snapped `x`: zero is always 0.
#[inline]
pub fn bits_of(x: f32) -> u32 {
    snap(x).to_bits()
}

/// a < b, both snapped. "Greater" is the same with the arguments swapped.
#[inline]
pub fn less(a: f32, b: f32) -> bool {
    snap(a) < snap(b)
}

/// a <= b, both snapped.
#[inline]
pub fn less_equal(a: f32, b: f32) -> bool {
    snap(a) <= snap(b)
}

/// The smaller of two, snapped. NaN is not provided for.
#[inline]
pub fn min_exact(a: f32, b: f32) -> f32 {
    if less(a, b) { snap(a) } else { snap(b) }
}

/// The larger of two, snapped. NaN is not provided for.
#[inline]
pub fn max_exact(a: f32, b: f32) -> f32 {
    if less(a, b) { snap(b) } else { snap(a) }
}

/// The larger of two, for sums with numbers so much larger that it makes no difference which of two
/// is taken that are both less than 2^-40 away from zero.
#[inline]
pub fn larger(a: f32, b: f32) -> f32 {
    if a < b { b } else { a }
}

/// The smaller of two, as [`larger`].
#[inline]
pub fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// `less(0, x)`.
#[inline]
pub fn is_positive(x: f32) -> bool {
    x >= SMALLEST
}

/// `max_exact(x, 0.0)`.
#[inline]
pub fn at_least_zero(x: f32) -> f32 {
    if x >= SMALLEST { x } else { 0.0 }
}

/// `x` within `0 ..= 1`, snapped.
#[inline]
pub fn clamp_unit(x: f32) -> f32 {
    if x > 1.0 { 1.0 } else { at_least_zero(x) }
}

/// `x` within `low ..= high`, snapped, where `low <= high` (else `high`).
#[inline]
pub fn clamp_exact(x: f32, low: f32, high: f32) -> f32 {
    min_exact(max_exact(x, low), high)
}

/// [`min_exact`] of each component.
#[inline]
pub fn min3(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        min_exact(a.x, b.x),
        min_exact(a.y, b.y),
        min_exact(a.z, b.z),
    )
}

/// [`max_exact`] of each component.
#[inline]
pub fn max3(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        max_exact(a.x, b.x),
        max_exact(a.y, b.y),
        max_exact(a.z, b.z),
    )
}

/// [`clamp_exact`] of each component.
#[inline]
pub fn clamp3(v: Vec3, low: Vec3, high: Vec3) -> Vec3 {
    min3(max3(v, low), high)
}

/// The largest integer that is not above the snapped `x`.
///
/// Without SSE 4.1 there is no instruction for `floor`, and a call for each number would keep loops from
/// being vectorised; so this rounds by adding 2^23, beside which floats are 1 apart. From there on all
/// floats are whole.
#[inline]
pub fn floor_exact(x: f32) -> f32 {
    const WHOLE_FROM: f32 = 8_388_608.0;
    let x = snap(x);
    let rounded = ((x.abs() + WHOLE_FROM) - WHOLE_FROM).copysign(x);
    let below = if rounded > x { rounded - 1.0 } else { rounded };
    if x.abs() < WHOLE_FROM { below } else { x }
}

/// [`floor_exact`] as an integer, clamped to -2^30 ..= 2^30 (infinities, too); NaN gives 0.
#[inline]
pub fn to_i32(x: f32) -> i32 {
    let is_nan = (x.to_bits() & MAGNITUDE_BITS) > EXPONENT_BITS;
    let whole = if is_nan { 0.0 } else { floor_exact(x) };
    let raised = if whole < -INTEGER_LIMIT {
        -INTEGER_LIMIT
    } else {
        whole
    };
    (if raised > INTEGER_LIMIT {
        INTEGER_LIMIT
    } else {
        raised
    }) as i32
}

/// Whole numbers of two limbs each: 65,536 `coarse` + `fine`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limbs3 {
    /// Multiples of 2^16.
    pub coarse: IVec3,
    /// The rest, at most 2^15 of either sign.
    pub fine: IVec3,
}

/// `v` to the nearest whole numbers, of two the even one, up to 2^37 of either sign. Additions round
/// to the steps of floats as large as the origins; both differences are exact.
#[inline]
pub fn limbs3(v: Vec3) -> Limbs3 {
    let coarse = v + Vec3::splat(COARSE_ORIGIN);
    let fine = (v - (coarse - Vec3::splat(COARSE_ORIGIN))) + Vec3::splat(FINE_ORIGIN);
    let less = |v: Vec3, bits: i32| {
        let of = |x: f32| x.to_bits().cast_signed().wrapping_sub(bits);
        IVec3::new(of(v.x), of(v.y), of(v.z))
    };
    Limbs3 {
        coarse: less(coarse, COARSE_BITS),
        fine: less(fine, FINE_BITS),
    }
}

/// The low 22 bits of a whole number below 2^22 of either sign, under bits that say nothing: beside
/// 1.5 * 2^23 floats are 1 apart.
#[inline]
pub fn low_bits(whole: f32) -> u32 {
    (whole + FINE_ORIGIN).to_bits()
}

/// The largest integer that is not above `x`, clamped to 0 ..= 2^30; NaN gives 0.
#[inline]
pub fn to_u32(x: f32) -> u32 {
    (if x > INTEGER_LIMIT {
        INTEGER_LIMIT
    } else {
        at_least_zero(x)
    }) as i32 as u32
}

/// `i`, clamped to -2^24 ..= 2^24, as a float: exact.
#[inline]
pub fn f32_of_i32(i: i32) -> f32 {
    let limit = EXACT_INTEGER_LIMIT as i32;
    i.clamp(-limit, limit) as f32
}

/// `u`, clamped to 0 ..= 2^24, as a float: exact.
#[inline]
pub fn f32_of_u32(u: u32) -> f32 {
    u.min(EXACT_INTEGER_LIMIT) as f32
}

/// 1/x where 2^-40 <= |x| <= 2^40; 0 outside, for zero and for NaN. Exact for powers of two; else within 1.5 ULP.
#[inline]
pub fn reciprocal(x: f32) -> f32 {
    let bits = bits_of(x);
    let magnitude = bits & MAGNITUDE_BITS;
    let in_range = (SMALLEST_BITS..=LARGEST_BITS).contains(&magnitude);
    let start = f32::from_bits(RECIPROCAL_START.wrapping_sub(magnitude) | (bits & SIGN_BIT));
    let first = start * (2.0 - x * start);
    let second = first * (2.0 - x * first);
    let third = second + second * (1.0 - x * second);
    if in_range { third } else { 0.0 }
}

/// 1/sqrt(x) where 2^-40 <= x <= 2^80; 0 outside, for x <= 0 and for NaN. Exact for powers of four; else within 1.5 ULP.
#[inline]
pub fn inverse_square_root(x: f32) -> f32 {
    let bits = bits_of(x);
    let in_range = (SMALLEST_BITS..=LARGEST_SQUARE_BITS).contains(&bits);
    let half = 0.5 * x;
    let start = f32::from_bits(INVERSE_SQUARE_ROOT_START.wrapping_sub(bits >> 1));
    let first = start * (1.5 - half * start * start);
    let second = first * (1.5 - half * first * first);
    let third = second + second * (0.5 - half * second * second);
    if in_range { third } else { 0.0 }
}

/// sqrt(x) where 2^-40 <= x <= 2^80; 0 outside. Exact for powers of four; else within 2 ULP.
#[inline]
pub fn square_root(x: f32) -> f32 {
    x * inverse_square_root(x)
}

/// a · b, summed from x to z.
#[inline]
pub fn dot3(a: Vec3, b: Vec3) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// a × b.
#[inline]
pub fn cross3(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        a.y * b.z - a.z * b.y,
        a.z * b.x - a.x * b.z,
        a.x * b.y - a.y * b.x,
    )
}

/// The exponent bits of the largest component: as a float, the power of two at or below it.
#[inline]
fn exponent_of(v: Vec3) -> u32 {
    let xy = (bits_of(v.x) & EXPONENT_BITS).max(bits_of(v.y) & EXPONENT_BITS);
    xy.max(bits_of(v.z) & EXPONENT_BITS)
}

/// `v` times the power of two that brings its largest component into 1 .. 2, so that squares neither vanish nor overflow.
#[inline]
fn to_unit_range(v: Vec3, exponent: u32) -> Vec3 {
    snap3(v) * Vec3::splat(f32::from_bits(EXPONENT_MIRROR.wrapping_sub(exponent)))
}

/// The length of `v`, components up to 2^40; 0 where all are below 2^-40. Within 3 ULP.
#[inline]
pub fn length3(v: Vec3) -> f32 {
    let exponent = exponent_of(v);
    let scaled = to_unit_range(v, exponent);
    square_root(dot3(scaled, scaled)) * f32::from_bits(exponent)
}

/// v/|v|, components up to 2^40, each snapped and within 3 ULP; the zero vector stays zero.
#[inline]
pub fn normalize_exact(v: Vec3) -> Vec3 {
    let scaled = to_unit_range(v, exponent_of(v));
    snap3(scaled * Vec3::splat(inverse_square_root(dot3(scaled, scaled))))
}
