//! marks: char where dropped flames have gone out, as discs that lie on what has burnt (Perry 1994, 3.4.1
//! and 4.6). Twin of `wgsl/draw/marks.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::emission::turned;
use crate::cpu::projection::project;
use crate::cpu::reach::is_visible;
use crate::cpu::shape::{Look, slanted_disc_of};
use crate::exact::{
    at_least_zero, dot3, f32_of_u32, less, max_exact, min_exact, normalize_exact, reciprocal,
    shared_constants,
};
use crate::layout::{Cover, DroppedFlame, FRAME_ORTHOGRAPHIC, FireFrame};
use crate::plan::FrameInputs;

shared_constants! {
    const LEAST_FACING: f32 = 0.05;
}

/// The mark of a flame that has been out for `age` frames.
fn mark(inputs: &FrameInputs, fire: &FireFrame, flame: &DroppedFlame, age: u32) -> Cover {
    let frame = &inputs.frame;
    let rows = [
        fire.world_from_fire_x,
        fire.world_from_fire_y,
        fire.world_from_fire_z,
    ];
    let [x, y, z, _] = flame.root_and_fire.map(f32::from_bits);
    let world = turned(rows, Vec3::new(x, y, z)) + Vec3::from(rows.map(|row| row[3]));
    let [x, y, z, _] = flame.normal_and_birth.map(f32::from_bits);
    let normal = normalize_exact(turned(rows, Vec3::new(x, y, z)));
    let seen = project(frame, world);
    let [right, up, ahead] = [
        frame.view_from_world_x,
        frame.view_from_world_y,
        frame.view_from_world_z,
    ]
    .map(|row| dot3(Vec3::from_slice(&row), normal));
    let is_parallel = frame.flags & FRAME_ORTHOGRAPHIC != 0;
    let inverse_scale = reciprocal(frame.focal_px);
    let (across, above) = if is_parallel {
        (0.0, 0.0)
    } else {
        (
            (seen.x - frame.center_x_px) * inverse_scale,
            (frame.center_y_px - seen.y) * inverse_scale,
        )
    };
    let facing = -(right * across + up * above + ahead);
    let [size, softness, cooling, growing] = fire.char_shape;
    let radius_px = 0.5 * size * seen.scale;
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, world) == frame.layer;
    if !here || less(facing, LEAST_FACING) || !is_visible(frame, seen, seen, radius_px) {
        return Cover::default();
    }
    let glow = at_least_zero(1.0 - f32_of_u32(age) * cooling);
    let grown = min_exact((f32_of_u32(age) + 1.0) * growing, 1.0);
    let [red, green, blue, opacity] = fire.char_look;
    let color = Vec3::new(red, green, blue) * (glow * glow);
    let look = Look {
        // As near as the nearest that it can have.
        depth: max_exact(seen.depth - 0.5 * size, 0.5 * seen.depth),
        color: Vec4::new(color.x, color.y, color.z, opacity * grown),
        lit: Vec3::ZERO,
    };
    let slope = Vec2::new(right, -up) * reciprocal(facing);
    slanted_disc_of(seen.x, seen.y, radius_px, softness, slope, &look)
}

/// The record of a dropped flame.
pub fn marks(inputs: &FrameInputs, flame: &DroppedFlame) -> Cover {
    let fire = &inputs.fires[flame.root_and_fire[3] as usize];
    let lifetime = flame.identity[2];
    let age = inputs.frame.frame.wrapping_sub(flame.normal_and_birth[3]);
    if lifetime != 0 && age >= lifetime && less(0.0, fire.char_look[3]) {
        mark(inputs, fire, flame, age - lifetime)
    } else {
        Cover::default()
    }
}
