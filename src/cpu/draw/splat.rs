//! splat: one particle adds its light to the pixels that it covers (Reeves 1983, 2.5 and 3).
//! Twin of `wgsl/draw/splat.wgsl` and `wgsl/draw/splat_large.wgsl`, which share the work out.

use glam::Vec3;

use crate::cpu::footprint::{
    Footprint, MOST_RADIUS_PX, PI, SMALL_DISC, SQUARE, is_visible, project,
};
use crate::cpu::light::{LightSums, steps_of};
use crate::cpu::particle::{appearance_of, identity_of, row_index};
use crate::exact::{clamp_exact, f32_of_i32, less, min_exact, reciprocal, square_root, to_i32};
use crate::layout::{PARTICLE_RECTANGLE, PARTICLE_STREAK, Particle, STREAK_CONSTANT, SystemRow};
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
fn draw_small_disc(light: &LightSums, center: (f32, f32), reach: f32, radius_px: f32, color: Vec3) {
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
    let gain = PI * radius_px * radius_px * reciprocal(sum);
    for at in 0..9 {
        let x = left + at % 3;
        let y = top + at / 3;
        let weight = weights[at as usize] * gain;
        let inside = x >= 0 && y >= 0 && x < light.width as i32 && y < light.height as i32;
        if less(0.0, weight) && inside {
            add_light(light, x, y, color, weight);
        }
    }
}

/// Adds the light of `particle`, as of the frame of `inputs`.
pub fn splat(particle: &Particle, inputs: &FrameInputs, rows: &[SystemRow], light: &LightSums) {
    let frame = &inputs.frame;
    let system = &inputs.systems[particle.slot() as usize];
    let (who, age) = identity_of(particle, inputs);
    let row = &rows[row_index(particle.slot(), who.birth_frame, frame.row_mask)];
    let look = appearance_of(who, row, age + 1);
    let [_, particle_shape, streak_light, _] = row.kinds;

    let position = Vec3::from(particle.position());
    let start = project(frame, system, position);
    let mut end = start;
    if particle_shape == PARTICLE_STREAK {
        let velocity = Vec3::from(particle.velocity());
        end = project(frame, system, position + velocity * frame.shutter);
    }
    let radius_px = min_exact(look.size * start.scale, MOST_RADIUS_PX);
    if !is_visible(frame, start, end, radius_px) {
        return;
    }
    let color = look.color * (1.0 - look.transparency);
    let square = particle_shape == PARTICLE_RECTANGLE;
    let conserved = streak_light != STREAK_CONSTANT;
    let shape = Footprint::new(frame, start, end, radius_px, square, conserved);
    if shape.kind == SMALL_DISC {
        draw_small_disc(light, (start.x, start.y), shape.reach, radius_px, color);
    } else {
        for major in shape.first..shape.last {
            draw_row(light, &shape, major, color);
        }
    }
}
