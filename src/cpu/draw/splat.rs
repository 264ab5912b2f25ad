//! splat: one particle adds its light to the pixels that it covers (Reeves 1983, 2.5 and 3).
//! Twin of `wgsl/draw/splat.wgsl` and `wgsl/draw/splat_large.wgsl`, which share the work out.

use glam::Vec3;

use crate::cpu::footprint::{Footprint, PI, SMALL_DISC, SQUARE, is_visible};
use crate::cpu::light::{LightSums, steps_of};
use crate::cpu::particle::row_index;
use crate::cpu::sprite::{Sprite, next_layer, sprite_of};
use crate::exact::{clamp_exact, dot3, f32_of_i32, less, reciprocal, square_root, to_i32};
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

/// A disc at rest that covers at most the nine pixels around its centre's.
fn draw_small_disc(light: &LightSums, sprite: &Sprite, reach: f32) {
    let center = (sprite.start.x, sprite.start.y);
    let left = to_i32(center.0) - 1;
    let top = to_i32(center.1) - 1;
    let mut weights = [0.0; 9];
    let mut sum = 0.0;
    for at in 0..9 {
        let dx = f32_of_i32(left + at % 3) + 0.5 - center.0;
        let dy = f32_of_i32(top + at / 3) + 0.5 - center.1;
        let distance = square_root(dx * dx + dy * dy);
        let weight = clamp_exact(reach - distance, 0.0, 1.0);
        weights[at as usize] = weight;
        sum += weight;
    }
    let gain = PI * sprite.radius_px * sprite.radius_px * reciprocal(sum);
    for at in 0..9 {
        let x = left + at % 3;
        let y = top + at / 3;
        let weight = weights[at as usize] * gain;
        let inside = x >= 0 && y >= 0 && x < light.width as i32 && y < light.height as i32;
        if less(0.0, weight) && inside {
            add_light(light, x, y, sprite.color, weight);
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

/// Adds the light of `particle`, as of the frame of `inputs`.
pub fn splat(particle: &Particle, inputs: &FrameInputs, rows: &[SystemRow], light: &LightSums) {
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
