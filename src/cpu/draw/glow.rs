//! glow: a flame adds its light to the pixels it touches (Perry 1994, 3.2.2). Twin of
//! `wgsl/draw/glow.wgsl`.

use glam::{Vec3, Vec4};

use crate::cpu::fan::{center_share, disc_light, share_of};
use crate::cpu::light::{LightSums, steps_of};
use crate::cpu::veil::{front_of, open_share};
use crate::exact::{f32_of_u32, less, reciprocal};
use crate::layout::{FlameDisc, Frame};

/// What flames are drawn onto.
#[derive(Clone, Copy, Debug)]
pub struct Onto<'a> {
    /// The frame.
    pub frame: &'a Frame,
    /// The picture's light.
    pub light: &'a LightSums,
    /// How near surfaces are in each pixel's samples; empty if there are none.
    pub nearness: &'a [[u32; 4]],
}

/// How near the front of a disc is that is around a place, of which the half-width is seen in pixels.
fn disc_front(frame: &Frame, place: [u32; 4], half_width_px: f32) -> u32 {
    let [x, y, z, _] = place.map(f32::from_bits);
    let row = frame.view_from_world_z;
    let depth = row[0] * x + row[1] * y + row[2] * z + row[3];
    front_of(frame, depth, half_width_px)
}

/// Adds the light of the discs of one flame, of which [`flame_discs`](super::flame_discs) tells the
/// `bounds`; `steps` are the places of its way that they are around, and `skews`
/// empty where no particle has a matrix.
pub fn glow(
    discs: &[FlameDisc],
    steps: &[[u32; 4]],
    skews: &[[u32; 4]],
    [across, down, inner @ ..]: [u32; 4],
    onto: Onto<'_>,
) {
    let light = onto.light;
    let (left, right) = (across & 0xffff, across >> 16);
    let (top, bottom) = (down & 0xffff, down >> 16);
    let inner = inner.map(f32::from_bits);
    let mut sums = vec![Vec3::ZERO; (right - left) as usize];
    for y in top..bottom {
        sums.fill(Vec3::ZERO);
        let line = f32_of_u32(y) + 0.5;
        // From the root up in every pixel, as sums of floats depend on the order.
        for (age, (disc, step)) in discs.iter().zip(steps).enumerate() {
            let [place_x, place_y, inverse_width, inverse_height] = disc.place.map(f32::from_bits);
            let skew = skews.get(age).unwrap_or(&[0; 4]);
            let [skew_x, skew_y, tilt_x, tilt_y] = skew.map(f32::from_bits);
            let down = line - place_y;
            if skews.is_empty() && !less((down * inverse_height).abs(), 1.0) {
                continue;
            }
            let [center, rim] =
                [disc.center, disc.rim].map(|bits| Vec4::from(bits.map(f32::from_bits)));
            // What is farther has no share, and two pixels are more than rounding.
            let reach = 1.0 / inverse_width + 2.0;
            let (first, last) = match skews {
                [] => (place_x - reach, place_x + reach),
                _ => (0.0, f32::MAX),
            };
            let first = (first as u32).clamp(left, right);
            let last = (last as u32).clamp(first, right);
            let half_width = reciprocal(inverse_width.abs() + skew_x.abs());
            let front = disc_front(onto.frame, *step, half_width);
            for x in first..last {
                let off = f32_of_u32(x) + 0.5 - place_x;
                let mut across = off * inverse_width + down * skew_x;
                let mut along = off * skew_y + down * inverse_height;
                if !skews.is_empty() {
                    let share = share_of(off * tilt_x + (1.0 + down * tilt_y));
                    (across, along) = (across * share, along * share);
                }
                let lit = disc_light(center, rim, inner, center_share(across, along));
                let nearness = onto.nearness.get((y * light.width + x) as usize);
                let open = nearness.map_or(1.0, |nearness| open_share(*nearness, front));
                sums[(x - left) as usize] += lit * open;
            }
        }
        for (x, sum) in (left..right).zip(&sums) {
            if less(0.0, sum.x + sum.y + sum.z) {
                let first = (y * light.width + x) as usize * 3;
                for (channel, value) in sum.to_array().into_iter().enumerate() {
                    light.add(first + channel, steps_of(value));
                }
            }
        }
    }
}
