//! shine: flames give their light to the point lights that stand for them (Perry 1994, 3.2.4). Twin
//! of `wgsl/flames/shine.wgsl`.

use glam::Vec3;

use crate::cpu::flame::{light_seed, tells_roots};
use crate::exact::{clamp_unit, dot3, less, to_u32};
use crate::layout::{FireFrame, Flame, LIGHT_WEIGHT_STEPS};
use crate::plan::FrameInputs;

/// The place that a light's is counted from.
pub(super) fn root_of_light(
    inputs: &FrameInputs,
    fire: &FireFrame,
    flames: &[Flame],
    light: u32,
) -> Vec3 {
    if tells_roots(fire) {
        let at = fire.lights[0] + light;
        return Vec3::from_slice(&inputs.light_roots[at as usize]);
    }
    Vec3::from(flames[light_seed(fire, light) as usize].root())
}

/// The light whose root is nearest; of two as near, the first.
fn nearest_light(inputs: &FrameInputs, fire: &FireFrame, flames: &[Flame], root: Vec3) -> u32 {
    let mut nearest = 0;
    let mut least = 0.0;
    for light in 0..fire.lights[1] {
        let away = root_of_light(inputs, fire, flames, light) - root;
        let squared = dot3(away, away);
        if light == 0 || less(squared, least) {
            nearest = light;
            least = squared;
        }
    }
    nearest
}

/// Which light a flame gives to, and how many steps: a weight, and x, y and z. `steps` are the places
/// of its particle, `flames` all there are.
pub fn shine(
    inputs: &FrameInputs,
    flame: &Flame,
    steps: &[[u32; 4]],
    flames: &[Flame],
) -> Option<(u32, [u32; 4])> {
    let fire = &inputs.fires[flame.fire() as usize];
    let [first, count, youngest, oldest] = fire.lights;
    if !flame.burns() || count == 0 {
        return None;
    }
    let mut sum = Vec3::ZERO;
    for step in &steps[youngest as usize..=oldest as usize] {
        let [x, y, z, _] = step.map(f32::from_bits);
        sum += Vec3::new(x, y, z);
    }
    let light = nearest_light(inputs, fire, flames, Vec3::from(flame.root()));
    let root = root_of_light(inputs, fire, flames, light);
    let away = (sum * fire.light_scale[3] - root) * fire.light_scale[2];
    let [_, width, brightness, _] = flame.look.map(f32::from_bits);
    let half_width = 0.5 * width;
    let weight = brightness * half_width * half_width;
    let steps = clamp_unit(weight * fire.light_scale[0]) * LIGHT_WEIGHT_STEPS;
    let [x, y, z] = away
        .to_array()
        .map(|away| to_u32(clamp_unit(away + 0.5) * steps));
    Some((first + light, [to_u32(steps), x, y, z]))
}
