//! smoke: what rises where dropped flames have gone out (Perry 1994, 4.6). Twin of
//! `wgsl/draw/smoke.wgsl`.

use glam::{Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::emission::turned;
use crate::cpu::flame::{LEAST_EXTENT, small_wind};
use crate::cpu::projection::project;
use crate::cpu::reach::is_visible;
use crate::cpu::shape::{Look, disc_of};
use crate::cpu::wind::wind_at;
use crate::exact::{
    at_least_zero, f32_of_u32, less, max_exact, min_exact, reciprocal, shared_constants,
};
use crate::layout::{Cover, DroppedFlame, FireFrame};
use crate::plan::FrameInputs;

shared_constants! {
    const PUFF_STEPS: u32 = 16;
    const PUFF_SHARE: f32 = 0.0625;
    const PUFF_APPEARS: f32 = 8.0;
}

/// The puff of a flame that has been out for `age` frames.
fn puff(inputs: &FrameInputs, fire: &FireFrame, flame: &DroppedFlame, age: f32) -> Cover {
    let frame = &inputs.frame;
    let rows = [
        fire.world_from_fire_x,
        fire.world_from_fire_y,
        fire.world_from_fire_z,
    ];
    let [x, y, z, _] = flame.root_and_fire.map(f32::from_bits);
    let root = turned(rows, Vec3::new(x, y, z)) + Vec3::from(rows.map(|row| row[3]));
    let [size, growth, inverse_frames, speed] = fire.smoke_shape;
    let step = speed * age * PUFF_SHARE;
    let inverse_reach = inverse_frames * reciprocal(max_exact(speed, LEAST_EXTENT));
    let mut p = root;
    for _ in 0..PUFF_STEPS {
        let wind = Vec3::from_slice(&fire.rise) * fire.rise[3]
            + wind_at(&inputs.winds, p) * fire.motion[1];
        p += (wind + small_wind(fire, p, root, inverse_reach)) * step;
    }
    let seen = project(frame, p);
    let share = age * inverse_frames;
    let radius_px = 0.5 * size * (1.0 + growth * share) * seen.scale;
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, p) == frame.layer;
    if !here || !is_visible(frame, seen, seen, radius_px) {
        return Cover::default();
    }
    let clears = at_least_zero(1.0 - share) * min_exact(PUFF_APPEARS * share, 1.0);
    let [red, green, blue, opacity] = fire.smoke_look;
    let look = Look {
        depth: seen.depth,
        color: Vec4::new(red, green, blue, opacity * clears),
        lit: Vec3::ZERO,
    };
    disc_of(seen.x, seen.y, radius_px, 1.0, &look)
}

/// The record of a dropped flame.
pub fn smoke(inputs: &FrameInputs, flame: &DroppedFlame) -> Cover {
    let fire = &inputs.fires[flame.root_and_fire[3] as usize];
    let lifetime = flame.identity[2];
    let age = inputs.frame.frame.wrapping_sub(flame.normal_and_birth[3]);
    if lifetime != 0 && age >= lifetime && less(0.0, fire.smoke_look[3]) {
        let since = f32_of_u32(age - lifetime);
        if less(since * fire.smoke_shape[2], 1.0) {
            return puff(inputs, fire, flame, since);
        }
    }
    Cover::default()
}
