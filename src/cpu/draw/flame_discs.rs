//! flame_discs: the particles along a flame as they are seen. Twin of `wgsl/draw/flame_discs.wgsl`.

use glam::{IVec2, Vec3};

use super::splat::layer_of;
use crate::cpu::disc::LEAST_HALF_AXIS_PX;
use crate::cpu::projection::project;
use crate::exact::{bits_of, less, max_exact, reciprocal, shared_constants, to_i32};
use crate::layout::{FLAME_STEPS, Flame, FlameDisc};
use crate::plan::FrameInputs;

shared_constants! {
    /// Half-axes in pixels, at most.
    pub const MOST_HALF_AXIS_PX: f32 = 16_384.0;
}

/// A half-axis that is drawn, and how much fainter it is for that.
#[inline]
fn half_axis(pixels: f32) -> (f32, f32) {
    let drawn = max_exact(pixels, LEAST_HALF_AXIS_PX);
    (drawn, pixels * reciprocal(drawn))
}

/// The discs of a flame whose particle is at these places, from age 0 on, and the pixels that they
/// touch: first column and line, one past the last ones; all 0 for none.
pub fn flame_discs(
    inputs: &FrameInputs,
    flame: &Flame,
    steps: &[[u32; 4]],
    discs: &mut [FlameDisc],
) -> [u32; 4] {
    let frame = &inputs.frame;
    let [_, width, brightness, burns] = flame.look;
    let half_width = 0.5 * f32::from_bits(width);
    let brightness = f32::from_bits(brightness);
    let root = Vec3::from(flame.root());
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, root) == frame.layer;
    let burns = here && burns == 1;
    let size = IVec2::new(frame.width as i32, frame.height as i32);
    let (mut low, mut high) = (size, IVec2::ZERO);
    let first_look = (flame.fire() * FLAME_STEPS) as usize;
    let looks = &inputs.age_looks[first_look..];
    for ((step, look), disc) in steps.iter().zip(looks).zip(discs) {
        let [x, y, z, _] = step.map(f32::from_bits);
        let seen = project(frame, Vec3::new(x, y, z));
        let (across, fainter) = half_axis(half_width * look.scale[0] * seen.scale);
        let (along, fainter_still) = half_axis(half_width * look.scale[1] * seen.scale);
        let is_near = less(MOST_HALF_AXIS_PX, across) || less(MOST_HALF_AXIS_PX, along);
        let is_seen = burns && !is_near && !less(seen.depth, frame.near);
        let opacity = if is_seen {
            brightness * fainter * fainter_still
        } else {
            0.0
        };
        let with =
            |[red, green, blue, alpha]: [f32; 4]| [red, green, blue, alpha * opacity].map(bits_of);
        *disc = FlameDisc {
            place: [seen.x, seen.y, reciprocal(across), reciprocal(along)].map(bits_of),
            center: with(look.center),
            rim: with(look.rim),
        };
        if is_seen {
            let first = IVec2::new(to_i32(seen.x - across), to_i32(seen.y - along));
            let last = IVec2::new(to_i32(seen.x + across) + 1, to_i32(seen.y + along) + 1);
            low = low.min(first);
            high = high.max(last);
        }
    }
    low = low.max(IVec2::ZERO);
    high = high.min(size);
    if low.x < high.x && low.y < high.y {
        [low.x, low.y, high.x, high.y].map(|at| at as u32)
    } else {
        [0; 4]
    }
}
