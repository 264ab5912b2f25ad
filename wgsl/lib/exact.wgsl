// Float arithmetic that gives the same bits on every driver and in `src/exact.rs`, its line-by-line twin.
//
// Only +, -, *, negation, comparison, select, abs, floor, bitcast, integer operations and bounded conversions occur here.
// Reads and writes no buffers. Invariants: every argument of a comparison, of floor and of an integer start value is
// snapped, so neither denormals nor the sign of zero can be observed; no result is NaN or infinite for arguments in the
// stated range. Reciprocal and inverse square root start from an integer guess on the float's bits (Blinn, "Floating-Point
// Tricks", IEEE CG&A 17(4), 1997) and are refined by Newton's method; the last step adds a residual to keep rounding small.
#define_import_path motes::exact

// 2^-40: what is smaller counts as zero.
const SMALLEST: f32 = 9.094947e-13f;
const SIGN_BIT: u32 = 0x80000000u;
const MAGNITUDE_BITS: u32 = 0x7fffffffu;
const EXPONENT_BITS: u32 = 0x7f800000u;
// The bits of 2^-40, 2^40 and 2^80.
const SMALLEST_BITS: u32 = 0x2b800000u;
const LARGEST_BITS: u32 = 0x53800000u;
const LARGEST_SQUARE_BITS: u32 = 0x67800000u;
// Exponent bits of x from this give those of 1/x, for x a power of two.
const EXPONENT_MIRROR: u32 = 0x7f000000u;
// Start values: at most 5.1 % off for 1/x, 3.5 % for 1/sqrt(x).
const RECIPROCAL_START: u32 = 0x7ef311c7u;
const INVERSE_SQUARE_ROOT_START: u32 = 0x5f375a86u;
// 2^30 and 2^24.
const INTEGER_LIMIT: f32 = 1073741824.0f;
const EXACT_INTEGER_LIMIT: u32 = 16777216u;
// 1.5 * 2^39, around which floats are 2^16 apart, and 1.5 * 2^23, around which they are 1 apart;
// their bits.
const COARSE_ORIGIN: f32 = 824633720832.0f;
const COARSE_BITS: i32 = 0x53400000i;
const FINE_ORIGIN: f32 = 12582912.0f;
const FINE_BITS: i32 = 0x4b400000i;

// x, or +0 where |x| < 2^-40. Every float is snapped before it is stored.
fn snap(x: f32) -> f32 {
    return select(x, 0.0f, abs(x) < SMALLEST);
}

fn snap2(v: vec2f) -> vec2f {
    return select(v, vec2f(0.0f), abs(v) < vec2f(SMALLEST));
}

fn snap3(v: vec3f) -> vec3f {
    return select(v, vec3f(0.0f), abs(v) < vec3f(SMALLEST));
}

fn snap4(v: vec4f) -> vec4f {
    return select(v, vec4f(0.0f), abs(v) < vec4f(SMALLEST));
}

// The bits of the snapped x: zero is always 0.
fn bits_of(x: f32) -> u32 {
    return bitcast<u32>(snap(x));
}

fn less(a: f32, b: f32) -> bool {
    return snap(a) < snap(b);
}

fn less_equal(a: f32, b: f32) -> bool {
    return snap(a) <= snap(b);
}

fn min_exact(a: f32, b: f32) -> f32 {
    return select(snap(b), snap(a), less(a, b));
}

fn max_exact(a: f32, b: f32) -> f32 {
    return select(snap(a), snap(b), less(a, b));
}

// The larger and the smaller of two, for sums with numbers so much larger that it makes no difference
// which of two is taken that are both less than 2^-40 away from zero.
fn larger(a: f32, b: f32) -> f32 {
    return select(a, b, a < b);
}

fn smaller(a: f32, b: f32) -> f32 {
    return select(b, a, a < b);
}

// less(0, x).
fn is_positive(x: f32) -> bool {
    return x >= SMALLEST;
}

// max_exact(x, 0).
fn at_least_zero(x: f32) -> f32 {
    return select(0.0f, x, x >= SMALLEST);
}

// x within 0 ..= 1.
fn clamp_unit(x: f32) -> f32 {
    return select(at_least_zero(x), 1.0f, x > 1.0f);
}

// x within low ..= high; low <= high.
fn clamp_exact(x: f32, low: f32, high: f32) -> f32 {
    return min_exact(max_exact(x, low), high);
}

fn min3(a: vec3f, b: vec3f) -> vec3f {
    return vec3f(min_exact(a.x, b.x), min_exact(a.y, b.y), min_exact(a.z, b.z));
}

fn max3(a: vec3f, b: vec3f) -> vec3f {
    return vec3f(max_exact(a.x, b.x), max_exact(a.y, b.y), max_exact(a.z, b.z));
}

fn clamp3(v: vec3f, low: vec3f, high: vec3f) -> vec3f {
    return min3(max3(v, low), high);
}

// The largest integer that is not above the snapped x.
fn floor_exact(x: f32) -> f32 {
    return floor(snap(x));
}

// The same as an integer, clamped to -2^30 ..= 2^30; NaN gives 0 (seen in its bits, as drivers may assume there is none).
fn to_i32(x: f32) -> i32 {
    let is_nan = (bitcast<u32>(x) & MAGNITUDE_BITS) > EXPONENT_BITS;
    let whole = select(floor_exact(x), 0.0f, is_nan);
    let raised = select(whole, -INTEGER_LIMIT, whole < -INTEGER_LIMIT);
    return i32(select(raised, INTEGER_LIMIT, raised > INTEGER_LIMIT));
}

// The largest integer that is not above x, at most 2^30, of an x that is not below 0; such an x
// that is no number gives 0.
fn to_u32(x: f32) -> u32 {
    return u32(i32(select(at_least_zero(x), INTEGER_LIMIT, x > INTEGER_LIMIT)));
}

// Whole numbers of two limbs each: 65,536 .coarse + .fine.
struct Limbs3 {
    coarse: vec3<i32>,
    fine: vec3<i32>,
}

// v to the nearest whole numbers, of two the even one, up to 2^37 of either sign; |.fine| is at most
// 2^15. Additions round to the steps of floats as large as the origins; both differences are exact.
fn limbs3(v: vec3f) -> Limbs3 {
    let coarse = v + vec3f(COARSE_ORIGIN);
    let fine = (v - (coarse - vec3f(COARSE_ORIGIN))) + vec3f(FINE_ORIGIN);
    return Limbs3(
        bitcast<vec3<i32>>(coarse) - vec3<i32>(COARSE_BITS),
        bitcast<vec3<i32>>(fine) - vec3<i32>(FINE_BITS),
    );
}

// The low 22 bits of a whole number below 2^22 of either sign, under bits that say nothing: beside
// 1.5 * 2^23 floats are 1 apart. Far fewer operations than to_i32, for a hash that masks them.
fn low_bits(whole: f32) -> u32 {
    return bitcast<u32>(whole + FINE_ORIGIN);
}

// i clamped to -2^24 ..= 2^24, where every integer has its float.
fn f32_of_i32(i: i32) -> f32 {
    let raised = select(i, -i32(EXACT_INTEGER_LIMIT), i < -i32(EXACT_INTEGER_LIMIT));
    return f32(select(raised, i32(EXACT_INTEGER_LIMIT), raised > i32(EXACT_INTEGER_LIMIT)));
}

// u clamped to 0 ..= 2^24.
fn f32_of_u32(u: u32) -> f32 {
    return f32(select(u, EXACT_INTEGER_LIMIT, u > EXACT_INTEGER_LIMIT));
}

// 1/x where 2^-40 <= |x| <= 2^40; 0 outside, for zero and for NaN. Exact for powers of two.
fn reciprocal(x: f32) -> f32 {
    let bits = bits_of(x);
    let magnitude = bits & MAGNITUDE_BITS;
    let in_range = (magnitude >= SMALLEST_BITS) & (magnitude <= LARGEST_BITS);
    let start = bitcast<f32>((RECIPROCAL_START - magnitude) | (bits & SIGN_BIT));
    let first = start * (2.0f - x * start);
    let second = first * (2.0f - x * first);
    let third = second + second * (1.0f - x * second);
    return select(0.0f, third, in_range);
}

// 1/sqrt(x) where 2^-40 <= x <= 2^80; 0 outside, for x <= 0 and for NaN. Exact for powers of four.
fn inverse_square_root(x: f32) -> f32 {
    let bits = bits_of(x);
    let in_range = (bits >= SMALLEST_BITS) & (bits <= LARGEST_SQUARE_BITS);
    let half = 0.5f * x;
    let start = bitcast<f32>(INVERSE_SQUARE_ROOT_START - (bits >> 1u));
    let first = start * (1.5f - half * start * start);
    let second = first * (1.5f - half * first * first);
    let third = second + second * (0.5f - half * second * second);
    return select(0.0f, third, in_range);
}

// sqrt(x) where 2^-40 <= x <= 2^80; 0 outside.
fn square_root(x: f32) -> f32 {
    return x * inverse_square_root(x);
}

fn dot3(a: vec3f, b: vec3f) -> f32 {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

fn cross3(a: vec3f, b: vec3f) -> vec3f {
    return vec3f(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// The exponent bits of the largest component: as a float, the power of two at or below it.
fn exponent_of(v: vec3f) -> u32 {
    let xy = max(bits_of(v.x) & EXPONENT_BITS, bits_of(v.y) & EXPONENT_BITS);
    return max(xy, bits_of(v.z) & EXPONENT_BITS);
}

// v times the power of two that brings its largest component into 1 .. 2, so that squares neither vanish nor overflow.
fn to_unit_range(v: vec3f, exponent: u32) -> vec3f {
    return snap3(v) * vec3f(bitcast<f32>(EXPONENT_MIRROR - exponent));
}

// The length of v; components up to 2^40.
fn length3(v: vec3f) -> f32 {
    let exponent = exponent_of(v);
    let scaled = to_unit_range(v, exponent);
    return square_root(dot3(scaled, scaled)) * bitcast<f32>(exponent);
}

// v/|v|, components up to 2^40; the zero vector stays zero.
fn normalize_exact(v: vec3f) -> vec3f {
    let scaled = to_unit_range(v, exponent_of(v));
    return snap3(scaled * vec3f(inverse_square_root(dot3(scaled, scaled))));
}
