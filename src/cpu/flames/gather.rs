//! gather: the point lights that stand for flames (Perry 1994, 3.2.4). Twin of
//! `wgsl/flames/gather.wgsl`.

use glam::Vec3;

use super::shine::root_of_light;
use crate::exact::{bits_of, f32_of_u32, reciprocal};
use crate::layout::{FireFrame, Flame, FlameLight};
use crate::plan::FrameInputs;

/// A sum in whole weights, of one in steps of 2^-30.
fn weight_of(sum: u64) -> f32 {
    let (low, high) = (sum as u32, (sum >> 32) as u32);
    let high = f32_of_u32(high) * 4.0;
    high + (f32_of_u32(low >> 8) * 2.384_185_8e-7 + f32_of_u32(low & 0xff) * 9.313_226e-10)
}

/// The light at that place among all, from its weight and the sums of its x, y and z.
pub fn gather(inputs: &FrameInputs, flames: &[Flame], at: u32, sums: [u64; 4]) -> FlameLight {
    let is_own = |fire: &&FireFrame| {
        let [first, count, ..] = fire.lights;
        (first..first + count).contains(&at)
    };
    let weight = weight_of(sums[0]);
    let Some(fire) = inputs
        .fires
        .iter()
        .find(is_own)
        .filter(|_| bits_of(weight) != 0)
    else {
        return FlameLight::default();
    };
    let root = root_of_light(inputs, fire, flames, at - fire.lights[0]);
    let share = reciprocal(weight);
    let sums = Vec3::new(weight_of(sums[1]), weight_of(sums[2]), weight_of(sums[3]));
    let place = root + (sums * share * 2.0 - 1.0) * fire.light_scale[1];
    let color = Vec3::from_slice(&fire.light) * weight;
    let with = |v: Vec3, w: f32| [v.x, v.y, v.z, w].map(bits_of);
    FlameLight {
        place: with(place, fire.light[3]),
        color: with(color, 0.0),
    }
}
