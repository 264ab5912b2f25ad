//! resolve: the sums of light become pixels (Reeves 1983, 2.5). Twin of `wgsl/draw/resolve.wgsl`.

use crate::cpu::lanes::{LANES, Lanes, lanes};
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

/// [`byte_of`] where floats beside 2^23 are rounded to whole numbers: vectors have no conversion that clamps.
#[inline(always)]
fn byte_of_lane(light: f32) -> u32 {
    const WHOLE_FROM: f32 = 8_388_608.0;
    let steps = clamp_unit(light) * 255.0 + 0.5;
    let raised = steps + WHOLE_FROM;
    let is_above = raised - WHOLE_FROM > steps;
    raised.to_bits() - WHOLE_FROM.to_bits() - u32::from(is_above)
}

/// [`light_of`] where vectors convert signed numbers alone: none of these is above 2^24.
#[inline(always)]
fn light_of_lane(low: u32, high: u32) -> f32 {
    let float = |whole: u32| whole as i32 as f32;
    let fraction = float(low & 0xfff) * 9.536_743e-7;
    let middle = float(low >> 12) * 0.003_906_25;
    float(high.min(0x00ff_ffff)) * 4096.0 + (middle + fraction)
}

/// [`resolve`] of so many pixels from one on, with nothing behind their light but the background.
pub(crate) fn resolve_lanes(frame: &Frame, light: &LightSums, first: usize) -> Lanes<u32> {
    let mut pixels = [0xff00_0000; LANES];
    for channel in 0..3 {
        let background = behind(frame, Behind::default(), channel);
        let (mut low, mut high) = ([0; LANES], [0; LANES]);
        for lane in 0..LANES {
            (low[lane], high[lane]) = light.limbs((first + lane) * 3 + channel);
        }
        let bytes = lanes(|lane| {
            byte_of_lane(light_of_lane(low[lane], high[lane]) * frame.exposure + background)
        });
        for lane in 0..LANES {
            pixels[lane] |= bytes[lane] << (8 * channel);
        }
    }
    pixels
}

#[cfg(test)]
mod tests {
    use bytemuck::Zeroable;
    use rayon::prelude::*;

    use super::*;

    #[test]
    fn sixteen_pixels_are_what_each_is() {
        let mut light = LightSums::new(64, 64);
        light.bands_mut(64).for_each(|sums| {
            let mut state = 7u64;
            for sum in sums {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                // Of all magnitudes: of a step, of what is white, of more than floats count.
                *sum.get_mut() = state >> (state % 64);
            }
        });
        let mut frame = Frame::zeroed();
        let backgrounds = [0.0, 0.25, 1.0, -3.0, 1e30, f32::INFINITY, f32::NAN];
        for exposure in [0.0, 1e-6, 0.03, 1.0, 700.0, -1.0, f32::INFINITY, f32::NAN] {
            for background in backgrounds {
                frame.exposure = exposure;
                frame.background[0] = background;
                frame.background[1] = 0.5 * background;
                for first in (0..64 * 64).step_by(LANES) {
                    let each =
                        lanes(|lane| resolve(&frame, &light, Behind::default(), first + lane));
                    assert_eq!(
                        resolve_lanes(&frame, &light, first),
                        each,
                        "{exposure} {background}"
                    );
                }
            }
        }
    }
}
