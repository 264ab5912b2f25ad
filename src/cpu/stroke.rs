//! Strokes: what a particle does in its whole life, as a static shape (Reeves 1983, 4.3). Twin of
//! `wgsl/lib/stroke.wgsl`, line by line; see there.

use glam::{Vec2, Vec3};

use crate::cpu::emission::turned;
use crate::cpu::projection::{project, world_of};
use crate::exact::{
    at_least_zero, dot3, f32_of_u32, inverse_square_root, length3, less, max_exact, min_exact,
    reciprocal, shared_constants, square_root, to_i32,
};
use crate::layout::{FRAME_ORTHOGRAPHIC, Frame, Particle, StrokeLight, SystemFrame};

shared_constants! {
    /// Pieces of a stroke are at most this long, so that colours and widths change softly.
    const MOST_PIECE_PX: f32 = 24.0;
    /// The fewest pieces.
    const LEAST_PIECES: u32 = 3;
    /// The mean light of a thin cylinder's visible half, in powers of a cosine.
    const HALF_LIT: f32 = 0.25;
    /// The first power's factor.
    const HALF_LIT_BY_COSINE: f32 = std::f32::consts::FRAC_PI_8;
    /// The second power's.
    const HALF_LIT_BY_SQUARE: f32 = 0.142_699_08;
}

/// A particle's trajectory in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Where it is born.
    pub birth: Vec3,
    /// What it moves by in its first frame.
    pub first: Vec3,
    /// By how much more in each that follows.
    pub bend: Vec3,
}

/// The trajectory of a particle that is where it was born.
pub fn way_of(system: &SystemFrame, particle: &Particle) -> Way {
    let rows = [
        system.world_from_system_x,
        system.world_from_system_y,
        system.world_from_system_z,
    ];
    Way {
        birth: world_of(system, Vec3::from(particle.position())),
        first: turned(rows, Vec3::from(particle.velocity())),
        bend: turned(rows, Vec3::from_slice(&system.acceleration)),
    }
}

/// Where the light that falls on the way would fall on the ground.
pub fn shadow_of(way: &Way, light: &StrokeLight) -> Way {
    let normal = Vec3::from_slice(&light.ground);
    let by = Vec3::from_slice(&light.shade_from);
    Way {
        birth: way.birth - by * (dot3(normal, way.birth) - light.ground[3]),
        first: way.first - by * dot3(normal, way.first),
        bend: way.bend - by * dot3(normal, way.bend),
    }
}

/// Where it is after so many frames; the parabola through the places of all whole ones.
#[inline]
pub fn place_at(way: &Way, frames: f32) -> Vec3 {
    way.birth + way.first * frames + way.bend * (0.5 * frames * (frames - 1.0))
}

/// How fast it is then, world units a frame.
#[inline]
pub fn motion_at(way: &Way, frames: f32) -> Vec3 {
    way.first + way.bend * (frames - 0.5)
}

/// How many chords of equal times keep within a quarter of a pixel of the way for so many frames, and are
/// short; `most` at most.
pub fn pieces_of(view: &Frame, way: &Way, frames: f32, most: u32) -> u32 {
    let mut nearest = project(view, way.birth).depth;
    for at in 1..=4 {
        let place = place_at(way, frames * (0.25 * f32_of_u32(at)));
        nearest = min_exact(nearest, project(view, place).depth);
    }
    let bent = length3(way.bend) * frames * frames * 0.125;
    let nearness = reciprocal(max_exact(nearest - bent * 0.0625, view.near));
    let orthographic = view.flags & FRAME_ORTHOGRAPHIC != 0;
    let scale = if orthographic {
        view.focal_px
    } else {
        view.focal_px * nearness
    };
    let corner = view.center_x_px * view.center_x_px + view.center_y_px * view.center_y_px;
    let of_corner = corner * reciprocal(view.focal_px) * reciprocal(view.focal_px);
    let slant = square_root(1.0 + if orthographic { 0.0 } else { of_corner });
    let by_bend = to_i32(square_root(4.0 * bent * scale * slant));
    let long = length3(place_at(way, frames) - way.birth) + bent;
    let by_length = to_i32(long * scale * reciprocal(MOST_PIECE_PX));
    let wanted = by_bend.max(by_length) as u32 + 1;
    wanted.max(LEAST_PIECES).min(most)
}

/// A world vector as the light has it: right, up, towards the viewer.
#[inline]
pub fn as_light_has_it(view: &Frame, v: Vec3) -> Vec3 {
    Vec3::new(
        dot3(Vec3::from_slice(&view.view_from_world_x), v),
        dot3(Vec3::from_slice(&view.view_from_world_y), v),
        -dot3(Vec3::from_slice(&view.view_from_world_z), v),
    )
}

/// How much of a light from there a thin cylinder along there sends to the eye; unit vectors.
pub fn lit_along(along: Vec3, light_from: Vec3, to_eye: Vec3) -> f32 {
    let light_aside = light_from - along * dot3(along, light_from);
    let eye_aside = to_eye - along * dot3(along, to_eye);
    let squared = dot3(light_aside, light_aside);
    let inverse = inverse_square_root(squared);
    let cosine =
        dot3(light_aside, eye_aside) * inverse * inverse_square_root(dot3(eye_aside, eye_aside));
    let seen = HALF_LIT + cosine * (HALF_LIT_BY_COSINE + cosine * HALF_LIT_BY_SQUARE);
    squared * inverse * at_least_zero(seen)
}

/// The number in -2 .. 2 of a direction in the picture: which edge of a square it points to, and where.
pub fn cut_of(way: Vec2) -> f32 {
    let part = way.x * reciprocal(way.x.abs() + way.y.abs());
    if less(way.y, 0.0) {
        part - 1.0
    } else {
        1.0 - part
    }
}
