//! strip_joints: where the strips along flames bend. Twin of `wgsl/draw/strip_joints.wgsl`.

use glam::{Vec2, Vec3};

use super::splat::layer_of;
use crate::cpu::fan::LEAST_HALF_AXIS_PX;
use crate::cpu::projection::project;
use crate::cpu::strip::{direction_of, overlap_of};
use crate::exact::{bits_of, dot3, less, max_exact, reciprocal, shared_constants, square_root};
use crate::layout::{FIRE_STRIP, FLAME_STEPS, Flame, StripJoint};
use crate::plan::FrameInputs;

shared_constants! {
    /// Half-widths in pixels, at most.
    pub const MOST_HALF_WIDTH_PX: f32 = 16_384.0;
}

/// The joints of the strip along a flame whose particle is at these places, from age 0 on.
pub fn strip_joints(
    inputs: &FrameInputs,
    flame: &Flame,
    steps: &[[u32; 4]],
    joints: &mut [StripJoint],
) {
    let frame = &inputs.frame;
    let [_, width, brightness, burns] = flame.look;
    let half_width = 0.5 * f32::from_bits(width);
    let root = Vec3::from(flame.root());
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, root) == frame.layer;
    let fire = &inputs.fires[flame.fire() as usize];
    let burns = here && burns == 1 && fire.kinds[3] & FIRE_STRIP != 0;
    let looks = &inputs.age_looks[(flame.fire() * FLAME_STEPS) as usize..];
    let place_of = |age: usize| {
        let [x, y, z, _] = steps[age].map(f32::from_bits);
        Vec3::new(x, y, z)
    };
    let last = steps.len() - 1;
    let mut place = place_of(0);
    let mut seen = project(frame, place);
    let mut before = Vec2::new(seen.x, seen.y);
    let mut spacing = 0.0;
    for (age, (look, joint)) in looks.iter().zip(joints).enumerate() {
        let behind = place_of((age + 1).min(last));
        let seen_behind = project(frame, behind);
        if age < last {
            let apart = behind - place;
            spacing = square_root(dot3(apart, apart));
        }
        let way = direction_of(Vec2::new(
            seen_behind.x - before.x,
            seen_behind.y - before.y,
        ));
        let wide = half_width * look.scale[0] * seen.scale;
        let drawn = max_exact(wide, LEAST_HALF_AXIS_PX);
        let is_near = less(MOST_HALF_WIDTH_PX, drawn);
        let is_seen = burns && !is_near && !less(seen.depth, frame.near);
        let overlap = overlap_of(half_width * look.scale[1], spacing);
        let opacity = f32::from_bits(brightness) * (wide * reciprocal(drawn)) * overlap;
        *joint = StripJoint {
            place: [seen.x, seen.y, way.x, way.y].map(bits_of),
            extent: [
                bits_of(drawn),
                bits_of(opacity),
                u32::from(is_seen),
                bits_of(seen.depth),
            ],
        };
        before = Vec2::new(seen.x, seen.y);
        place = behind;
        seen = seen_behind;
    }
}
