//! trace: the trajectory of a flame through a frame's wind. Twin of `wgsl/flames/trace.wgsl`.

use glam::Vec3;

use crate::cpu::flame::{Along, LEAST_EXTENT, small_wind, stepped};
use crate::cpu::wind::wind_at;
use crate::exact::{bits_of, max_exact, reciprocal};
use crate::layout::Flame;
use crate::plan::FrameInputs;

/// Writes the places of the flame's particle, from age 0 on: x, y, z as bits; w is 0. The kernel takes
/// these steps twice where the wind stops the particle, which it looks after in a loop of its own.
pub fn trace(inputs: &FrameInputs, flame: &Flame, steps: &mut [[u32; 4]]) {
    let fire = &inputs.fires[flame.fire() as usize];
    let (root, normal) = (Vec3::from(flame.root()), Vec3::from(flame.normal()));
    let motion = Vec3::from(flame.motion());
    let height = if flame.burns() {
        f32::from_bits(flame.look[0])
    } else {
        0.0
    };
    let inverse_height = reciprocal(max_exact(height, LEAST_EXTENT));
    let rise = Vec3::from_slice(&fire.rise) * fire.rise[3];
    let mut here = Along {
        position: root,
        velocity: normal * fire.motion[2],
    };
    for step in steps {
        let p = here.position;
        let [x, y, z] = p.to_array().map(bits_of);
        *step = [x, y, z, 0];
        let flow = (wind_at(&inputs.winds, p) - motion) * fire.motion[1];
        let wind = rise + flow + small_wind(fire, p, root, inverse_height);
        here = stepped(fire, here, wind, height, normal, flame.index());
    }
}
