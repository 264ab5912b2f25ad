//! resolve: the sums of light become pixels (Reeves 1983, 2.5). Twin of `wgsl/draw/resolve.wgsl`.

use crate::cpu::light::{LightSums, light_of};
use crate::exact::{clamp_unit, to_i32};
use crate::layout::Frame;

#[inline]
fn byte_of(light: f32) -> u32 {
    to_i32(clamp_unit(light) * 255.0 + 0.5) as u32
}

/// What is behind the light of a pixel, besides the background.
#[derive(Clone, Copy, Debug, Default)]
pub struct Behind {
    /// The pixel of the ground, if there is one.
    pub ground: Option<[u32; 4]>,
    /// That of the planet before it, if there is one.
    pub planet: Option<[u32; 4]>,
    /// That of the surfaces before it, if there are any, dimmed by what covers them.
    pub surface: Option<[u32; 4]>,
    /// Words of `cover_rg` and `cover_bt` for the pixel, if anything covers.
    pub covers: Option<([u32; 2], [u32; 2])>,
}

/// What is behind the light of a pixel's channel, red, green or blue: what covers it, and what of
/// surfaces, of the planet, of the ground and of the background shows through.
#[inline]
pub(crate) fn behind(frame: &Frame, what: Behind, channel: usize) -> f32 {
    let Behind {
        ground,
        planet,
        surface,
        covers,
    } = what;
    let mut background = frame.background[channel];
    for behind in [ground, planet].into_iter().flatten() {
        let [color, clear] = [behind[channel], behind[3]].map(f32::from_bits);
        background = color * frame.exposure + background * clear;
    }
    let clear = covers.map_or(1.0, |(_, [_, clear])| f32::from_bits(clear));
    background *= clear;
    if let Some(surface) = surface {
        // What covers is behind it and before it: it is dimmed by that already.
        let [color, open] = [surface[channel], surface[3]].map(f32::from_bits);
        background = color * frame.exposure + background * open;
    }
    let Some(([red, green], [blue, _])) = covers else {
        return background;
    };
    let color = f32::from_bits([red, green, blue][channel]);
    color * frame.exposure + background
}

/// One pixel: RGBA with red in the low byte.
#[inline]
pub fn resolve(frame: &Frame, light: &LightSums, what: Behind, pixel: usize) -> u32 {
    let channel = |at: usize| {
        let (low, high) = light.limbs(pixel * 3 + at);
        byte_of(light_of(low, high) * frame.exposure + behind(frame, what, at))
    };
    channel(0) | (channel(1) << 8) | (channel(2) << 16) | 0xff00_0000
}
