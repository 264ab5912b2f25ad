//! splat: one particle adds its light to the pixels that it covers (Reeves 1983, 2.5 and 3).
//! Twin of `wgsl/draw/splat.wgsl` and `wgsl/draw/splat_large.wgsl`, which share the work out.

use glam::{Vec2, Vec3};

use crate::cpu::draw::planet::is_beyond;
use crate::cpu::footprint::{Footprint, PI, SMALL_DISC, SMALL_SIDE, SQUARE, is_visible};
use crate::cpu::light::{LightSums, steps_of};
use crate::cpu::particle::row_index;
use crate::cpu::sprite::{Sprite, next_layer, sprite_of};
use crate::exact::{clamp_unit, dot3, f32_of_i32, less, reciprocal, square_root, to_i32};
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
        let weight = if shape.kind == SQUARE {
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

/// How much of a pixel a disc around `center` covers, 0 to 1.
#[inline]
fn disc_weight(center: Vec2, reach: f32, x: i32, y: i32) -> f32 {
    let dx = f32_of_i32(x) + 0.5 - center.x;
    let dy = f32_of_i32(y) + 0.5 - center.y;
    clamp_unit(reach - square_root(dx * dx + dy * dy))
}

/// A small disc at rest: its weights, column by column, then their light.
fn draw_small_disc(light: &LightSums, sprite: &Sprite, reach: f32) {
    let center = Vec2::new(sprite.start.x, sprite.start.y);
    let range = |middle: f32| {
        let first = to_i32(middle - reach + 0.5);
        let last = to_i32(middle + reach - 0.5);
        first..first + (last - first + 1).min(SMALL_SIDE as i32)
    };
    let (columns, lines) = (range(center.x), range(center.y));
    let mut weights = [0.0; (SMALL_SIDE * SMALL_SIDE) as usize];
    let mut sum = 0.0;
    for x in columns.clone() {
        for y in lines.clone() {
            let weight = disc_weight(center, reach, x, y);
            weights[((x - columns.start) * SMALL_SIDE as i32 + y - lines.start) as usize] = weight;
            sum += weight;
        }
    }
    let gain = PI * sprite.radius_px * sprite.radius_px * reciprocal(sum);
    for x in columns.start.max(0)..columns.end.min(light.width as i32) {
        for y in lines.start.max(0)..lines.end.min(light.height as i32) {
            let at = (x - columns.start) * SMALL_SIDE as i32 + y - lines.start;
            let weight = weights[at as usize] * gain;
            if less(0.0, weight) {
                add_light(light, x, y, sprite.color, weight);
            }
        }
    }
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
    let shape = Footprint::new(
        frame,
        start,
        end,
        sprite.radius_px,
        sprite.square,
        sprite.conserved,
    );
    if shape.kind == SMALL_DISC {
        draw_small_disc(light, &sprite, shape.reach);
    } else {
        for major in shape.first..shape.last {
            draw_row(light, &shape, major, sprite.color);
        }
    }
}
