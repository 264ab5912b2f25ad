//! Where a flame stands, and how its particle moves (Perry 1994, 3.2.3 and 3.4). Twin of
//! `wgsl/lib/flame.wgsl`.

use glam::{UVec4, Vec2, Vec3};

use crate::exact::{
    clamp3, cross3, dot3, f32_of_u32, less, max_exact, normalize_exact, reciprocal,
    shared_constants, square_root,
};
use crate::layout::{FIRE_NORMALISED, FireFrame, ROOTS_CIRCLE, ROOTS_DISC};
use crate::noise::noise;
use crate::rng::{pcg4d, signed_float, unit_float};
use crate::transcendental::{cos_turns, sin_turns};

shared_constants! {
    /// Tells the draws of flames from others, whose second word is a frame.
    pub const FLAME_TAG: u32 = 0x666c_616d;
    /// Stream of the hash: the root.
    pub const STREAM_ROOT: u32 = 0;
    /// Stream of the hash: height and width.
    pub const STREAM_SHAPE: u32 = 1;
    /// Stream of the hash: the way along a ceiling.
    pub const STREAM_CEILING: u32 = 2;
    /// The least height and width, world units.
    pub const LEAST_EXTENT: f32 = 0.000001;
    const LEAST_SPEED_SQUARED: f32 = 1e-12;
    const NUDGE: f32 = 0.001;
    const MOST_SPEED: f32 = 1_000_000.0;
}

/// Four random words of a flame.
#[inline]
pub fn flame_draw(fire: &FireFrame, index: u32, stream: u32) -> UVec4 {
    pcg4d(UVec4::new(fire.kinds[1], FLAME_TAG, index, stream))
}

/// Where the flame `nth` of those that are not listed stands, on what is no mesh.
#[inline]
pub fn root_on(fire: &FireFrame, nth: u32, place: UVec4) -> Vec3 {
    let kind = fire.kinds[0];
    let [extent, share, ..] = fire.roots;
    let n = f32_of_u32(nth);
    if kind != ROOTS_CIRCLE && kind != ROOTS_DISC {
        return Vec3::new(extent * ((n + 0.5) * share - 0.5), 0.0, 0.0);
    }
    let (turns, part) = if kind == ROOTS_DISC {
        (unit_float(place.y), square_root(unit_float(place.x)))
    } else {
        (n * share, 1.0)
    };
    let distance = extent * part;
    Vec3::new(
        distance * cos_turns(turns),
        0.0,
        distance * sin_turns(turns),
    )
}

/// Height and width of the flame, before what is its own.
#[inline]
pub fn extents_of(fire: &FireFrame, index: u32) -> Vec2 {
    let random = flame_draw(fire, index, STREAM_SHAPE);
    let [height, height_var, width, width_var] = fire.extents;
    Vec2::new(
        max_exact(height + signed_float(random.x) * height_var, LEAST_EXTENT),
        max_exact(width + signed_float(random.y) * width_var, LEAST_EXTENT),
    )
}

/// How much of its size a flame has that was kindled `age` frames ago.
#[inline]
pub fn growth_of(fire: &FireFrame, age: i32) -> f32 {
    let [_, _, lifetime, frames] = fire.times;
    if frames == 0 {
        return 1.0;
    }
    let mut least = age as u32 + 1;
    if lifetime > 0 {
        least = least.min(lifetime - age as u32);
    }
    f32_of_u32(least.min(frames)) * reciprocal(f32_of_u32(frames))
}

/// Whether a flame burns that was kindled `age` frames ago.
#[inline]
pub fn burns_at(fire: &FireFrame, age: i32) -> bool {
    let lifetime = fire.times[2];
    age >= 0 && (lifetime == 0 || (age as u32) < lifetime)
}

/// What a particle is in: its place, and its velocity in steps.
#[derive(Clone, Copy, Debug)]
pub struct Along {
    /// World units.
    pub position: Vec3,
    /// Steps.
    pub velocity: Vec3,
}

/// w_S at the place `p` of a flame of that height with its root there (equation 3.1).
#[inline]
pub fn small_wind(fire: &FireFrame, p: Vec3, root: Vec3, inverse_height: f32) -> Vec3 {
    let [x, y, z, scale] = fire.noise;
    let above = dot3(p - root, Vec3::from_slice(&fire.rise)) * inverse_height;
    let at = p * scale + Vec3::new(x, y, z);
    noise(at, fire.kinds[2]).truncate() * (above * fire.motion[0])
}

#[inline]
fn of_length_one(
    fire: &FireFrame,
    next: Vec3,
    before: Vec3,
    wind: Vec3,
    normal: Vec3,
    index: u32,
) -> Vec3 {
    let mut way = next;
    if less(dot3(next, next), LEAST_SPEED_SQUARED) {
        way = wind - normal * dot3(wind, normal);
        if less(dot3(way, way), LEAST_SPEED_SQUARED) {
            let random = flame_draw(fire, index, STREAM_CEILING);
            let turns = unit_float(random.x);
            let z = signed_float(random.y);
            let ring = square_root(1.0 - z * z);
            let any = Vec3::new(ring * cos_turns(turns), ring * sin_turns(turns), z);
            way = before + normalize_exact(cross3(normal, any)) * NUDGE;
        }
    }
    normalize_exact(way)
}

/// One step through the wind u: the place by the velocity, then the velocity by the wind.
#[inline]
pub fn stepped(
    fire: &FireFrame,
    from_here: Along,
    wind: Vec3,
    height: f32,
    normal: Vec3,
    index: u32,
) -> Along {
    let position = from_here.position + from_here.velocity * (height * fire.motion[3]);
    let velocity = from_here.velocity + wind;
    let mut velocity = clamp3(velocity, Vec3::splat(-MOST_SPEED), Vec3::splat(MOST_SPEED));
    if fire.kinds[3] & FIRE_NORMALISED != 0 {
        velocity = of_length_one(fire, velocity, from_here.velocity, wind, normal, index);
    }
    Along { position, velocity }
}

/// Whether the places are told that the point lights' are counted from.
#[inline]
pub fn tells_roots(fire: &FireFrame) -> bool {
    fire.faces[2] == 1
}

/// The flame whose root a point light's place is counted from: one of every so many.
#[inline]
pub fn light_seed(fire: &FireFrame, light: u32) -> u32 {
    fire.members[0] + (2 * light + 1) * fire.members[1] / (2 * fire.lights[1])
}
