//! splat: one particle adds its light to the pixels that it covers (Reeves 1983, 2.5 and 3).
//! Twin of `wgsl/draw/splat.wgsl` and `wgsl/draw/splat_large.wgsl`, which share the work out.

use glam::{Vec2, Vec3};

use crate::cpu::disc::{SMALL_REACH_PX, reach_of, small_disc};
use crate::cpu::draw::planet::is_beyond;
use crate::cpu::footprint::Footprint;
use crate::cpu::light::{LightSums, steps_of};
use crate::cpu::particle::row_index;
use crate::cpu::reach::{is_visible, moves};
use crate::cpu::sprite::{Sprite, next_layer, sprite_of};
use crate::exact::{dot3, less};
use crate::layout::{Particle, ROW_OVER, SystemRow};
use crate::plan::FrameInputs;

#[inline]
fn add_light(light: &LightSums, x: i32, y: i32, color: Vec3, weight: f32) {
    let at = (y as usize * light.width as usize + x as usize) * 3;
    light.add(at, steps_of(color.x * weight));
    light.add(at + 1, steps_of(color.y * weight));
    light.add(at + 2, steps_of(color.z * weight));
}

/// One row of pixels across the major axis.
#[inline]
fn draw_row(light: &LightSums, shape: &Footprint, major: i32, color: Vec3) {
    let (low, high) = shape.minor_range(major);
    for minor in low.max(0)..high.min(shape.minor_size) {
        let weight = if shape.square {
            shape.square_weight_at(major, minor)
        } else {
            shape.weight_at(major, minor) * shape.gain
        };
        if less(0.0, weight) {
            let (x, y) = if shape.steep {
                (minor, major)
            } else {
                (major, minor)
            };
            add_light(light, x, y, color, weight);
        }
    }
}

/// A small disc at rest.
fn draw_small_disc(light: &LightSums, sprite: &Sprite) {
    let center = Vec2::new(sprite.start.x, sprite.start.y);
    let (width, height) = (light.width as i32, light.height as i32);
    small_disc(center, sprite.radius_px, |at, weight| {
        let inside = (0..width).contains(&at.x) && (0..height).contains(&at.y);
        if inside && less(0.0, weight) {
            add_light(light, at.x, at.y, sprite.color, weight);
        }
    });
}

/// The layer, from 1, that a world place is in.
#[inline]
pub(super) fn layer_of(planes: &[[f32; 4]], world: Vec3) -> u32 {
    let mut layer = 0;
    for (at, [x, y, z, offset]) in planes.iter().enumerate() {
        let signed_distance = dot3(Vec3::new(*x, *y, *z), world) - offset;
        layer = next_layer(layer, at as u32, signed_distance);
    }
    if layer == 0 {
        planes.len() as u32 + 1
    } else {
        layer
    }
}

/// Adds the light of `particle`, as of the frame of `inputs`, if it is on that side of a planet's
/// outline.
pub fn splat(
    particle: &Particle,
    inputs: &FrameInputs,
    rows: &[SystemRow],
    light: &LightSums,
    is_behind: bool,
) {
    let frame = &inputs.frame;
    let birth_frame = frame.frame.wrapping_sub(particle.age(frame.frame));
    let row = &rows[row_index(particle.slot(), birth_frame, frame.row_mask)];
    if row.kinds[3] & ROW_OVER != 0 {
        return;
    }
    let sprite = sprite_of(inputs, row, particle);
    let (start, end) = (sprite.start, sprite.end);
    if !is_visible(frame, start, end, sprite.radius_px) {
        return;
    }
    if frame.layer != 0 && layer_of(&inputs.layer_planes, sprite.world) != frame.layer {
        return;
    }
    if !inputs.planets.is_empty() && is_beyond(frame, sprite.world) != is_behind {
        return;
    }
    let rests = !moves(start, end) && !sprite.square;
    if rests && less(reach_of(sprite.radius_px), SMALL_REACH_PX) {
        draw_small_disc(light, &sprite);
        return;
    }
    let shape = Footprint::new(
        frame,
        start,
        end,
        sprite.radius_px,
        sprite.square,
        sprite.conserved,
    );
    for major in shape.first..shape.last {
        draw_row(light, &shape, major, sprite.color);
    }
}
