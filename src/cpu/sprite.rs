//! What a particle looks like in the picture, before its pixels (Reeves 1983, 2.5 and 3). Twin of
//! `wgsl/lib/sprite.wgsl`.

use glam::{Vec3, Vec4};

use crate::cpu::disc::reach_of;
use crate::cpu::lanes::{LANES, VecLanes, lane_of, lanes, set_lane};
use crate::cpu::particle::{Appearance, Identity, appearance_of, identity_of};
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
    let system = &inputs.systems[particle.slot() as usize];
    let (who, age) = identity_of(particle, inputs);
    let look = appearance_of(who, row, age + 1);
    let world = world_of(system, Vec3::from(particle.position()));
    let start = project(&inputs.frame, world);
    let radius_px = radius_of(look.size, start.scale);
    finished(inputs, row, particle, look, world, start, radius_px)
}

/// The radius in pixels of what has that size where a unit spans so many.
#[inline(always)]
fn radius_of(size: f32, scale: f32) -> f32 {
    min_exact(size * scale, MOST_RADIUS_PX)
}

/// The sprite of `particle`, which looks so and is there, when the frame begins.
#[inline(always)]
fn finished(
    inputs: &FrameInputs,
    row: &SystemRow,
    particle: &Particle,
    look: Appearance,
    world: Vec3,
    start: Projected,
    radius_px: f32,
) -> Sprite {
    let view = &inputs.frame;
    let mut end = start;
    if row.kinds[1] == PARTICLE_STREAK {
        let system = &inputs.systems[particle.slot() as usize];
        let velocity = Vec3::from(particle.velocity());
        let position = Vec3::from(particle.position());
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
        radius_px,
        color: look.color * light,
        surface: look.color.extend(1.0 - look.transparency),
        square: row.kinds[1] == PARTICLE_RECTANGLE,
        conserved: row.kinds[2] & STREAK_CONSTANT == 0,
    }
}

/// [`sprite_of`] of particles that one system has borne in one frame, in turn, and how far each reaches at
/// rest: what most of the time
/// goes to is done in loops over all of them, so that the processor takes several in one instruction.
#[inline]
pub(crate) fn each_sprite(
    inputs: &FrameInputs,
    row: &SystemRow,
    particles: &[Particle; LANES],
    mut take: impl FnMut(Sprite, f32),
) {
    let system = &inputs.systems[particles[0].slot() as usize];
    let (first, age) = identity_of(&particles[0], inputs);
    let indices = lanes(|lane| particles[lane].index());
    let mut places = VecLanes::default();
    for (lane, particle) in particles.iter().enumerate() {
        set_lane(&mut places, lane, Vec3::from(particle.position()));
    }
    let mut colors = VecLanes::default();
    let [mut transparencies, mut sizes] = [[0.0; LANES]; 2];
    for (lane, index) in indices.into_iter().enumerate() {
        let look = appearance_of(Identity { index, ..first }, row, age + 1);
        set_lane(&mut colors, lane, look.color);
        transparencies[lane] = look.transparency;
        sizes[lane] = look.size;
    }
    let mut worlds = VecLanes::default();
    let mut starts = [[0.0; LANES]; 5];
    let mut radii = [0.0; LANES];
    for (lane, radius_px) in radii.iter_mut().enumerate() {
        let world = world_of(system, lane_of(&places, lane));
        set_lane(&mut worlds, lane, world);
        let start = project(&inputs.frame, world);
        starts[0][lane] = start.x;
        starts[1][lane] = start.y;
        starts[2][lane] = start.depth;
        starts[3][lane] = start.distance_squared;
        starts[4][lane] = start.scale;
        *radius_px = radius_of(sizes[lane], start.scale);
    }
    let reaches = lanes(|lane| reach_of(radii[lane]));
    for (lane, particle) in particles.iter().enumerate() {
        let look = Appearance {
            color: lane_of(&colors, lane),
            transparency: transparencies[lane],
            size: sizes[lane],
        };
        let world = lane_of(&worlds, lane);
        let start = Projected {
            x: starts[0][lane],
            y: starts[1][lane],
            depth: starts[2][lane],
            distance_squared: starts[3][lane],
            scale: starts[4][lane],
        };
        let sprite = finished(inputs, row, particle, look, world, start, radii[lane]);
        take(sprite, reaches[lane]);
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
