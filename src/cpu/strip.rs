//! A strip along a flame, textured by a slice through noise (Perry 1994, 4.2). Twin of
//! `wgsl/lib/strip.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use crate::cpu::flame::flame_draw;
use crate::exact::{
    at_least_zero, clamp_exact, dot3, less, max_exact, min_exact, reciprocal, shared_constants,
    square_root,
};
use crate::layout::FireFrame;
use crate::noise::noise;
use crate::rng::unit_float;

shared_constants! {
    /// Pieces of a strip: one between each two places of its flame.
    pub const PIECES: u32 = 24;
    /// Tells the noise of strips from the one that bends flames.
    pub const STRIP_TAG: u32 = 0x7374_7270;
    const STREAM_SLICE: u32 = 3;
    const SLICES: f32 = 64.0;
    /// The last age.
    pub const LAST_AGE: f32 = 24.0;
    const TWICE_AGE_SHARE: f32 = 0.083_333_336;
    const LEAST_STRETCH_SQUARED: f32 = 0.000_001;
    const LEAST_SPACING: f32 = 0.04;
}

/// The unit vector along a way in the picture; up, where there is none.
#[inline]
pub fn direction_of(way: Vec2) -> Vec2 {
    let squared = way.x * way.x + way.y * way.y;
    if less(squared, LEAST_STRETCH_SQUARED) {
        return Vec2::new(0.0, -1.0);
    }
    way * reciprocal(square_root(squared))
}

/// How many particles of that half-height overlap where they are so far apart.
#[inline]
pub fn overlap_of(half_height: f32, spacing: f32) -> f32 {
    half_height * reciprocal(max_exact(spacing, half_height * LEAST_SPACING))
}

/// How far along a way a place is that is so far from it.
#[inline]
pub fn along(off: Vec2, way: Vec2) -> f32 {
    off.x * way.x + off.y * way.y
}

/// How far beside it.
#[inline]
pub fn beside(off: Vec2, way: Vec2) -> f32 {
    off.x * way.y - off.y * way.x
}

/// How far from its first joint across and along the picture a piece reaches at most, by its two joints'
/// places and ways on, which do not look away from each other, and the greater half-width.
#[inline]
pub fn piece_reach(here: Vec4, there: Vec4, half_width: f32) -> Vec2 {
    let (way, way_next) = (Vec2::new(here.z, here.w), Vec2::new(there.z, there.w));
    // Between the joints the way across the strip turns, and is shorter by no more than where it has
    // turned by half: squared, by the mean of 1 and the cosine.
    let stretch = reciprocal(0.5 + 0.5 * along(way_next, way));
    let length = (there.x - here.x).abs() + (there.y - here.y).abs();
    let sideways = max_exact(here.w.abs(), there.w.abs());
    let lengthwise = max_exact(here.z.abs(), there.z.abs());
    // A pixel is more than rounding.
    Vec2::new(
        (length + half_width * sideways) * stretch + 1.0,
        (length + half_width * lengthwise) * stretch + 1.0,
    )
}

/// The sum of folded octaves at an age and a distance from the middle.
#[inline]
pub fn turbulence(fire: &FireFrame, index: u32, age: f32, across: f32) -> f32 {
    let sunk = dot3(Vec3::from_slice(&fire.noise), Vec3::from_slice(&fire.rise));
    let slice = unit_float(flame_draw(fire, index, STREAM_SLICE).x) * SLICES;
    let p = Vec3::new(
        across * fire.strip[0],
        age * fire.strip[1] + sunk,
        slice + sunk,
    );
    let key = fire.kinds[2] ^ STRIP_TAG;
    noise(p, key).w.abs() + 0.5 * noise(p * 2.0, key + 1).w.abs()
}

/// The share of the middle in what is there: none at the edges.
#[inline]
pub fn middle_share(fire: &FireFrame, age: f32, across: f32, turbulent: f32) -> f32 {
    let eaten = fire.strip[2] * turbulent * (age * TWICE_AGE_SHARE);
    at_least_zero(1.0 - across.abs() - eaten)
}

/// The age that colours are looked up by.
#[inline]
pub fn color_age(fire: &FireFrame, age: f32, turbulent: f32) -> f32 {
    clamp_exact(age + turbulent * fire.look[1], 0.0, LAST_AGE)
}

/// How clear the two ends are.
#[inline]
pub fn end_share(age: f32) -> f32 {
    clamp_exact(min_exact(age, LAST_AGE - age), 0.0, 1.0)
}
