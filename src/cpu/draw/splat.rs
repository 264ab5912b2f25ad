//! splat: one particle adds its light to the pixels that it covers (Reeves 1983, 2.5 and 3).
//! Twin of `wgsl/draw/splat.wgsl` and `wgsl/draw/splat_large.wgsl`, which share the work out.

use glam::{Vec2, Vec3};

use crate::cpu::disc::{SMALL_REACH_PX, SmallDisc, reach_of};
use crate::cpu::draw::planet::is_beyond;
use crate::cpu::footprint::Footprint;
use crate::cpu::light::{LightSums, steps_of};
use crate::cpu::particle::row_index;
use crate::cpu::reach::{is_visible, moves};
use crate::cpu::sprite::{Sprite, next_layer, sprite_of};
use crate::cpu::veil::{front_of, open_share};
use crate::exact::{dot3, is_positive, less};
use crate::layout::{Particle, ROW_OVER, SystemRow};
use crate::plan::FrameInputs;

/// What particles are drawn onto.
#[derive(Clone, Copy, Debug)]
pub struct Onto<'a> {
    /// The picture's light.
    pub light: &'a LightSums,
    /// How near surfaces are in each pixel's samples; empty if there are none.
    pub nearness: &'a [[u32; 4]],
}

/// A particle's colour, and how near its front is.
#[derive(Clone, Copy)]
struct Shown {
    color: Vec3,
    front: u32,
}

#[inline(always)]
fn add_light(onto: Onto<'_>, x: i32, y: i32, shown: Shown, weight: f32) {
    let Shown { color, front } = shown;
    let light = onto.light;
    let pixel = y as usize * light.width as usize + x as usize;
    let weight = match onto.nearness.get(pixel) {
        Some(nearness) => weight * open_share(*nearness, front),
        None => weight,
    };
    light.add_to(pixel, (color * weight).to_array().map(steps_of));
}

/// One row of pixels across the major axis.
#[inline]
fn draw_row(onto: Onto<'_>, shape: &Footprint, major: i32, shown: Shown) {
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
            add_light(onto, x, y, shown, weight);
        }
    }
}

/// A small disc at rest.
fn draw_small_disc(onto: Onto<'_>, sprite: &Sprite, shown: Shown) {
    let disc = SmallDisc::new(Vec2::new(sprite.start.x, sprite.start.y), sprite.radius_px);
    let (width, height) = (onto.light.width as i32, onto.light.height as i32);
    for column in 0..disc.columns {
        let x = disc.first.x + column as i32;
        if !(0..width).contains(&x) {
            continue;
        }
        for line in 0..disc.lines {
            let y = disc.first.y + line as i32;
            let weight = disc.weight(column, line);
            if (0..height).contains(&y) && is_positive(weight) {
                add_light(onto, x, y, shown, weight);
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
    onto: Onto<'_>,
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
    let shown = Shown {
        color: sprite.color,
        front: front_of(frame, start.depth, sprite.radius_px),
    };
    let rests = !moves(start, end) && !sprite.square;
    if rests && less(reach_of(sprite.radius_px), SMALL_REACH_PX) {
        draw_small_disc(onto, &sprite, shown);
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
        draw_row(onto, &shape, major, shown);
    }
}
