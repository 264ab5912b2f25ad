//! advance: one frame of motion (Reeves 1983, 2.3). Twin of `wgsl/particles/advance.wgsl`.

use glam::Vec3;

use crate::exact::bits_of;
use crate::layout::{Particle, SystemFrame};

/// The particle one frame later: position += velocity, then velocity += acceleration.
#[inline]
pub fn advance(particle: &Particle, system: &SystemFrame) -> Particle {
    let velocity = Vec3::from(particle.velocity());
    let [x, y, z, _] = system.acceleration;
    let position = Vec3::from(particle.position()) + velocity;
    let next = velocity + Vec3::new(x, y, z);
    Particle {
        position_and_index: [
            bits_of(position.x),
            bits_of(position.y),
            bits_of(position.z),
            particle.position_and_index[3],
        ],
        velocity_and_birth: [
            bits_of(next.x),
            bits_of(next.y),
            bits_of(next.z),
            particle.velocity_and_birth[3],
        ],
    }
}
