//! resolve: the sums of light become pixels (Reeves 1983, 2.5). Twin of `wgsl/draw/resolve.wgsl`.

use crate::cpu::light::{LightSums, light_of};
use crate::exact::{clamp_unit, to_i32};
use crate::layout::Frame;

#[inline]
fn byte_of(light: f32) -> u32 {
    to_i32(clamp_unit(light) * 255.0 + 0.5) as u32
}

/// One pixel: RGBA with red in the low byte.
#[inline]
pub fn resolve(frame: &Frame, light: &LightSums, pixel: usize) -> u32 {
    let channel = |at: usize| {
        let (low, high) = light.limbs(pixel * 3 + at);
        byte_of(light_of(low, high) * frame.exposure + frame.background[at])
    };
    channel(0) | (channel(1) << 8) | (channel(2) << 16) | 0xff00_0000
}
