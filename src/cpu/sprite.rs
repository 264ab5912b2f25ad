//! What a particle looks like in the picture, before its pixels (Reeves 1983, 2.5 and 3). Twin of
//! `wgsl/lib/sprite.wgsl`.

use glam::{Vec3, Vec4};

use crate::cpu::particle::{appearance_of, identity_of};
use crate::cpu::projection::{Projected, project, project_closing, world_of};
use crate::cpu::reach::MOST_RADIUS_PX;
use crate::exact::{inverse_square_root, less, min_exact};
use crate::layout::{PARTICLE_RECTANGLE, PARTICLE_STREAK, Particle, STREAK_CONSTANT, SystemRow};
use crate::plan::FrameInputs;

/// Where a particle is seen, how large, and its colour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sprite {
    pub(crate) world: Vec3,
    pub(crate) start: Projected,
    pub(crate) end: Projected,
    pub(crate) radius_px: f32,
    /// Light, as far as it is not transparent.
    pub(crate) color: Vec3,
    /// Colour, and how opaque it is.
    pub(crate) surface: Vec4,
    pub(crate) square: bool,
    pub(crate) conserved: bool,
}

/// The sprite of `particle` in the frame of `inputs`; the row is that of its birth.
#[inline]
pub(crate) fn sprite_of(inputs: &FrameInputs, row: &SystemRow, particle: &Particle) -> Sprite {
    let view = &inputs.frame;
    let system = &inputs.systems[particle.slot() as usize];
    let (who, age) = identity_of(particle, inputs);
    let look = appearance_of(who, row, age + 1);
    let position = Vec3::from(particle.position());
    let world = world_of(system, position);
    let start = project(view, world);
    let mut end = start;
    if row.kinds[1] == PARTICLE_STREAK {
        let velocity = Vec3::from(particle.velocity());
        end = project_closing(view, system, position + velocity * view.shutter);
    }
    let mut light = 1.0 - look.transparency;
    let unit_distance = row.ejection_and_light[2];
    if less(0.0, unit_distance) {
        let share = unit_distance * inverse_square_root(start.distance_squared);
        light *= share * share;
    }
    Sprite {
        world,
        start,
        end,
        radius_px: min_exact(look.size * start.scale, MOST_RADIUS_PX),
        color: look.color * light,
        surface: look.color.extend(1.0 - look.transparency),
        square: row.kinds[1] == PARTICLE_RECTANGLE,
        conserved: row.kinds[2] & STREAK_CONSTANT == 0,
    }
}

/// The layer, from 1, that a place is in, seen from the plane `at`, from 0.
#[inline]
pub(crate) fn next_layer(layer: u32, at: u32, signed_distance: f32) -> u32 {
    let is_behind = less(signed_distance, 0.0);
    if layer == 0 && is_behind {
        at + 1
    } else {
        layer
    }
}
