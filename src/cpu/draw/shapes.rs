//! shapes: what of the particles covers, as it is seen (Reeves 1983, 5). Twin of
//! `wgsl/draw/shapes.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::particle::row_index;
use crate::cpu::reach::is_visible;
use crate::cpu::shade::light_at;
use crate::cpu::shape::{Look, disc_of, segment_of, square_of};
use crate::cpu::sprite::{Sprite, sprite_of};
use crate::exact::{f32_of_u32, less, shared_constants};
use crate::layout::{
    Cover, PARTICLE_STROKE, Particle, ROW_LIT_CLOUD, ROW_LIT_SPHERE, ROW_OVER, ROW_SOFTNESS_SHIFT,
    SystemRow,
};
use crate::plan::FrameInputs;

shared_constants! {
    /// A 65,535th.
    const SOFTNESS_STEP: f32 = 0.000_015_259_022;
}

fn cover_of(sprite: &Sprite, flags: u32, inputs: &FrameInputs, shade_light: &[u32]) -> Cover {
    let frame = &inputs.frame;
    let from = Vec2::new(sprite.start.x, sprite.start.y);
    let to = Vec2::new(sprite.end.x, sprite.end.y);
    let way = to - from;
    let mut look = Look {
        depth: sprite.start.depth,
        color: sprite.surface,
        lit: Vec3::ZERO,
    };
    if flags & ROW_LIT_CLOUD != 0 {
        let part = match inputs.shade_boxes.first() {
            Some(shade_box) => light_at(shade_box, shade_light, sprite.world),
            None => 1.0,
        };
        let light = Vec4::from(frame.ambient_color) + Vec4::from(frame.light_color) * part;
        let color = sprite.surface.truncate() * light.truncate();
        look.color = color.extend(sprite.surface.w);
    }
    if sprite.square {
        return square_of(from.x, from.y, sprite.radius_px, &look);
    }
    if less(0.0001, way.x * way.x + way.y * way.y) {
        return segment_of(from, to, sprite.radius_px, &look);
    }
    if flags & ROW_LIT_SPHERE != 0 {
        let surface = sprite.surface.truncate();
        let ambient = surface * Vec4::from(frame.ambient_color).truncate();
        look.color = ambient.extend(sprite.surface.w);
        look.lit = surface * Vec4::from(frame.light_color).truncate();
    }
    let softness = f32_of_u32(flags >> ROW_SOFTNESS_SHIFT) * SOFTNESS_STEP;
    disc_of(from.x, from.y, sprite.radius_px, softness, &look)
}

/// The record of `particle`, of nothing if it covers nothing; `shade_light` is how much of the light comes to
/// the cells of the box in which clouds throw shadows.
pub fn shapes(
    particle: &Particle,
    inputs: &FrameInputs,
    rows: &[SystemRow],
    shade_light: &[u32],
) -> Cover {
    let frame = &inputs.frame;
    let birth_frame = frame.frame.wrapping_sub(particle.age(frame.frame));
    let row = &rows[row_index(particle.slot(), birth_frame, frame.row_mask)];
    if row.kinds[3] & ROW_OVER == 0 || row.kinds[1] == PARTICLE_STROKE {
        return Cover::default();
    }
    let sprite = sprite_of(inputs, row, particle);
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, sprite.world) == frame.layer;
    let is_seen = here
        && less(0.0, sprite.surface.w)
        && is_visible(frame, sprite.start, sprite.end, sprite.radius_px);
    if is_seen {
        cover_of(&sprite, row.kinds[3], inputs, shade_light)
    } else {
        Cover::default()
    }
}
