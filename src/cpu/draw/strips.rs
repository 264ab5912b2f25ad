//! strips: strips along flames add their light (Perry 1994, 4.2). Twin of `wgsl/draw/strips.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use super::glow::Onto;
use crate::cpu::light::steps_of;
use crate::cpu::strip::{along, beside, color_age, end_share, middle_share, turbulence};
use crate::cpu::veil::{front_of, open_share};
use crate::exact::{f32_of_u32, less, reciprocal, to_u32};
use crate::layout::{AgeLook, FLAME_STEPS, FireFrame, Flame, StripJoint};
use crate::plan::FrameInputs;

/// The light of the strip at an age and so many half-widths from its middle; `looks` are the fire's.
#[inline]
fn texel(
    fire: &FireFrame,
    looks: &[AgeLook],
    index: u32,
    age: f32,
    across: f32,
    opacity: f32,
) -> Vec3 {
    let turbulent = turbulence(fire, index, age, across);
    let share = middle_share(fire, age, across, turbulent);
    let moved = color_age(fire, age, turbulent);
    let low = to_u32(moved).min(FLAME_STEPS - 2);
    let part = moved - f32_of_u32(low);
    let [here, next] = [looks[low as usize], looks[low as usize + 1]];
    let mixed = |here: [f32; 4], next: [f32; 4]| {
        Vec4::from(here) + (Vec4::from(next) - Vec4::from(here)) * part
    };
    let center = mixed(here.center, next.center);
    let rim = mixed(here.rim, next.rim);
    let alpha = center.w * share * (opacity * end_share(age));
    (rim.truncate() + (center.truncate() - rim.truncate()) * share) * alpha
}

/// What a flame adds to a pixel; `open` is what surfaces leave of a place at a depth that is so wide.
fn strip_light(
    joints: &[StripJoint],
    fire: &FireFrame,
    looks: &[AgeLook],
    index: u32,
    pixel: Vec2,
    open: impl Fn(f32, f32) -> f32,
) -> Vec3 {
    let mut sum = Vec3::ZERO;
    for (age, two) in (0..).zip(joints.windows(2)) {
        let [here, there] = [two[0], two[1]];
        let split = |joint: StripJoint| {
            let [x, y, way_x, way_y] = joint.place.map(f32::from_bits);
            (pixel - Vec2::new(x, y), Vec2::new(way_x, way_y))
        };
        let ((off, way), (off_next, way_next)) = (split(here), split(there));
        let (ahead, ahead_next) = (along(off, way), along(off_next, way_next));
        let are_seen = here.extent[2] == 1 && there.extent[2] == 1;
        let goes_on = less(0.0, along(way_next, way));
        if !are_seen || !goes_on || less(ahead, 0.0) || !less(ahead_next, 0.0) {
            continue;
        }
        let part = ahead * reciprocal(ahead - ahead_next);
        let between = |at: usize| {
            let [here, there] = [here.extent[at], there.extent[at]].map(f32::from_bits);
            here + (there - here) * part
        };
        let aside = beside(off, way);
        let far = aside + (beside(off_next, way_next) - aside) * part;
        let across = far * reciprocal(between(0));
        if less(across.abs(), 1.0) {
            let own_age = f32_of_u32(age) + part;
            let light = texel(fire, looks, index, own_age, across, between(1));
            sum += light * open(between(3), between(0));
        }
    }
    sum
}

/// Adds the light of the strip along a flame, of which
/// [`strip_joints`](super::strip_joints::strip_joints) tells the `bounds`.
pub fn strips(
    inputs: &FrameInputs,
    flame: &Flame,
    joints: &[StripJoint],
    [across, down, ..]: [u32; 4],
    onto: Onto<'_>,
) {
    let light = onto.light;
    let fire = &inputs.fires[flame.fire() as usize];
    let looks = &inputs.age_looks[(flame.fire() * FLAME_STEPS) as usize..];
    for y in down & 0xffff..down >> 16 {
        for x in across & 0xffff..across >> 16 {
            let pixel = Vec2::new(f32_of_u32(x) + 0.5, f32_of_u32(y) + 0.5);
            let nearness = onto.nearness.get((y * light.width + x) as usize);
            let open = |depth, half_width| {
                let front = front_of(onto.frame, depth, half_width);
                nearness.map_or(1.0, |nearness| open_share(*nearness, front))
            };
            let sum = strip_light(joints, fire, looks, flame.index(), pixel, open);
            if less(0.0, sum.x + sum.y + sum.z) {
                let first = (y * light.width + x) as usize * 3;
                for (channel, value) in sum.to_array().into_iter().enumerate() {
                    light.add(first + channel, steps_of(value));
                }
            }
        }
    }
}
