//! glow: a flame adds its light to the pixels it touches (Perry 1994, 3.2.2). Twin of
//! `wgsl/draw/glow.wgsl`.

use glam::{Vec3, Vec4};

use crate::cpu::disc::{center_share, disc_light};
use crate::cpu::light::{LightSums, steps_of};
use crate::exact::{f32_of_u32, less};
use crate::layout::FlameDisc;

/// Adds the light of the discs of one flame, which touch the pixels within `bounds`.
pub fn glow(discs: &[FlameDisc], [left, top, right, bottom]: [u32; 4], light: &LightSums) {
    for y in top..bottom {
        let center_y = f32_of_u32(y) + 0.5;
        for x in left..right {
            // Halves of integers below 2^24 are exact, from whichever pixel they are counted.
            let center_x = f32_of_u32(x) + 0.5;
            let mut sum = Vec3::ZERO;
            for disc in discs {
                let [place_x, place_y, inverse_width, inverse_height] =
                    disc.place.map(f32::from_bits);
                let down = (center_y - place_y) * inverse_height;
                if less(down.abs(), 1.0) {
                    let across = (center_x - place_x) * inverse_width;
                    let [center, rim] =
                        [disc.center, disc.rim].map(|bits| Vec4::from(bits.map(f32::from_bits)));
                    sum += disc_light(center, rim, center_share(across, down));
                }
            }
            if less(0.0, sum.x + sum.y + sum.z) {
                let first = (y * light.width + x) as usize * 3;
                for (channel, value) in sum.to_array().into_iter().enumerate() {
                    light.add(first + channel, steps_of(value));
                }
            }
        }
    }
}
