//! hatch: the boids of a flock as it begins. Twin of `wgsl/flock/hatch.wgsl`.

use crate::cpu::boid::newborn;
use crate::exact::bits_of;
use crate::layout::{Boid, FlockFrame};

/// The boid of that index of the flock in that slot.
pub fn hatch(flock: &FlockFrame, slot: u32, index: u32) -> Boid {
    let start = newborn(flock, index);
    let [x, y, z] = start.position.to_array().map(bits_of);
    let [vx, vy, vz] = start.velocity.to_array().map(bits_of);
    Boid {
        position_and_flock: [x, y, z, slot],
        velocity_and_index: [vx, vy, vz, index],
    }
}
