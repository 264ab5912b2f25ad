// A strip along a flame, textured by a slice through noise.
//
// Perry 1994, 4.2 and Fig 4-1 (further work): polygons erected around the trajectory, each frame with a
// slice of a flame of noise on them. Between two joints, each point has a share of the way, the age, and a
// distance from the middle in half-widths. Both are the same on both sides of a joint: what is before it
// ends at the line across the flame there, and what is behind begins. The texture is a corona (2.1.2,
// after Perlin): the sum of folded octaves of noise moves the age that colours are looked up by, and
// eats into the edges. So all edges are transparent, whatever the noise.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/strip.rs.
#define_import_path motes::strip

#import motes::exact::{at_least_zero, clamp_exact, dot3, less, max_exact, min_exact, reciprocal, square_root}
#import motes::flame::flame_draw
#import motes::layout::FireFrame
#import motes::noise::noise
#import motes::rng::unit_float

// Pieces of a strip: one between each two places of its flame.
const PIECES: u32 = 24u;
// Tells the noise of strips from the one that bends flames.
const STRIP_TAG: u32 = 0x73747270u;
// The stream of the hash that says which slice a flame has, of so many cells.
const STREAM_SLICE: u32 = 3u;
const SLICES: f32 = 64.0f;
// The last age, and its inverse.
const LAST_AGE: f32 = 24.0f;
const TWICE_AGE_SHARE: f32 = 0.083333336f;
// A way shorter than this in pixels, squared, has no direction.
const LEAST_STRETCH_SQUARED: f32 = 0.000001f;
// Particles overlap so many times, at most.
const LEAST_SPACING: f32 = 0.04f;

// The unit vector along a way in the picture; up, where there is none.
fn direction_of(way: vec2<f32>) -> vec2<f32> {
    let squared = way.x * way.x + way.y * way.y;
    if less(squared, LEAST_STRETCH_SQUARED) {
        return vec2<f32>(0.0f, -1.0f);
    }
    return way * reciprocal(square_root(squared));
}

// How many particles of that half-height overlap where they are so far apart: the strip is as bright.
fn overlap_of(half_height: f32, spacing: f32) -> f32 {
    return half_height * reciprocal(max_exact(spacing, half_height * LEAST_SPACING));
}

// How far along a way a place is that is so far from it.
fn along(off: vec2<f32>, way: vec2<f32>) -> f32 {
    return off.x * way.x + off.y * way.y;
}

// How far beside it.
fn beside(off: vec2<f32>, way: vec2<f32>) -> f32 {
    return off.x * way.y - off.y * way.x;
}

// How far from its first joint across and along the picture a piece reaches at most, by its two joints'
// places and ways on, which do not look away from each other, and the greater half-width.
// Between the joints the way across the strip turns, and is shorter by no more than where it has turned
// by half: squared, by the mean of 1 and the cosine.
fn piece_reach(here: vec4<f32>, there: vec4<f32>, half_width: f32) -> vec2<f32> {
    let stretch = reciprocal(0.5f + 0.5f * along(there.zw, here.zw));
    let length = abs(there.x - here.x) + abs(there.y - here.y);
    let sideways = max_exact(abs(here.w), abs(there.w));
    let lengthwise = max_exact(abs(here.z), abs(there.z));
    // A pixel is more than rounding.
    return vec2<f32>(
        (length + half_width * sideways) * stretch + 1.0f, (length + half_width * lengthwise) * stretch + 1.0f,
    );
}

// The sum of folded octaves at an age and a distance from the middle.
fn turbulence(fire: FireFrame, index: u32, age: f32, across: f32) -> f32 {
    let sunk = dot3(fire.noise.xyz, fire.rise.xyz);
    let slice = unit_float(flame_draw(fire, index, STREAM_SLICE).x) * SLICES;
    let p = vec3<f32>(across * fire.strip.x, age * fire.strip.y + sunk, slice + sunk);
    let key = fire.kinds.z ^ STRIP_TAG;
    return abs(noise(p, key).w) + 0.5f * abs(noise(p * 2.0f, key + 1u).w);
}

// The share of the middle in what is there: none at the edges.
fn middle_share(fire: FireFrame, age: f32, across: f32, turbulent: f32) -> f32 {
    let eaten = fire.strip.z * turbulent * (age * TWICE_AGE_SHARE);
    return at_least_zero(1.0f - abs(across) - eaten);
}

// The age that colours are looked up by.
fn color_age(fire: FireFrame, age: f32, turbulent: f32) -> f32 {
    return clamp_exact(age + turbulent * fire.look.y, 0.0f, LAST_AGE);
}

// How clear the two ends are.
fn end_share(age: f32) -> f32 {
    return clamp_exact(min_exact(age, LAST_AGE - age), 0.0f, 1.0f);
}
