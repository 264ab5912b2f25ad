//! shine: flames give their light to the point lights that stand for them (Perry 1994, 3.2.4). Twin
//! of `wgsl/flames/shine.wgsl`.

use glam::Vec3;

use crate::cpu::flame::light_seed;
use crate::exact::{clamp_unit, dot3, less, to_u32};
use crate::layout::{FireFrame, Flame, LIGHT_WEIGHT_STEPS};

/// The light whose root is nearest; of two as near, the first.
fn nearest_light(fire: &FireFrame, flames: &[Flame], root: Vec3) -> u32 {
    let mut nearest = 0;
    let mut least = 0.0;
    for light in 0..fire.lights[1] {
        let seed = &flames[light_seed(fire, light) as usize];
        let away = Vec3::from(seed.root()) - root;
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
    fire: &FireFrame,
    flame: &Flame,
    steps: &[[u32; 4]],
    flames: &[Flame],
) -> Option<(u32, [u32; 4])> {
    let [first, count, youngest, oldest] = fire.lights;
    if !flame.burns() || count == 0 {
        return None;
    }
    let mut sum = Vec3::ZERO;
    for step in &steps[youngest as usize..=oldest as usize] {
        let [x, y, z, _] = step.map(f32::from_bits);
        sum += Vec3::new(x, y, z);
    }
    let light = nearest_light(fire, flames, Vec3::from(flame.root()));
    let root = Vec3::from(flames[light_seed(fire, light) as usize].root());
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
