// Random numbers by hashing: pcg4d of Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020,
// and its bits as floats. `src/rng.rs` is the line-by-line twin.
//
// Reads and writes no buffers. Invariant: only integers below 2^24 become floats, so the conversion is exact everywhere.
#define_import_path motes::rng

const MULTIPLIER: u32 = 1664525u;
const INCREMENT: u32 = 1013904223u;
// 2^-24.
const UNIT_STEP: f32 = 5.9604645e-8f;

// Four well-mixed words from four words of "who and what for". A bijection: different keys give different results.
fn pcg4d(key: vec4<u32>) -> vec4<u32> {
    var v = key * MULTIPLIER + INCREMENT;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> vec4<u32>(16u));
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// Uniform in 0 .. 1 (1 excluded), a multiple of 2^-24, from the upper 24 bits.
fn unit_float(word: u32) -> f32 {
    return f32(word >> 8u) * UNIT_STEP;
}

// Uniform in -1 .. 1 (1 excluded), a multiple of 2^-23: Reeves' Rand().
fn signed_float(word: u32) -> f32 {
    return 2.0f * unit_float(word) - 1.0f;
}

// Below `count`, each as often as any other but for one in 2^32: the upper word of the product.
fn index_below(word: u32, count: u32) -> u32 {
    let low = (word & 0xffffu) * (count & 0xffffu);
    let left = (word >> 16u) * (count & 0xffffu);
    let right = (word & 0xffffu) * (count >> 16u);
    let middle = (low >> 16u) + (left & 0xffffu) + (right & 0xffffu);
    return (word >> 16u) * (count >> 16u) + (left >> 16u) + (right >> 16u) + (middle >> 16u);
}

// unit_float of each word.
fn unit4(words: vec4<u32>) -> vec4f {
    return vec4f(unit_float(words.x), unit_float(words.y), unit_float(words.z), unit_float(words.w));
}

// signed_float of each word.
fn signed4(words: vec4<u32>) -> vec4f {
    return vec4f(signed_float(words.x), signed_float(words.y), signed_float(words.z), signed_float(words.w));
}
