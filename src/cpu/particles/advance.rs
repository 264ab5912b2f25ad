//! advance: one frame of motion (Reeves 1983, 2.3), in the wind (Perry 1994, 3.2.3). Twin of
//! `wgsl/particles/advance.wgsl`.

use glam::Vec3;

use crate::cpu::projection::world_of;
use crate::cpu::wind::wind_at;
use crate::exact::bits_of;
use crate::layout::{Particle, SYSTEM_STILL, SystemFrame, Wind};

/// What drag adds to a velocity in a frame: a part of what it lacks of the wind's, in the system's
/// space.
#[inline]
fn drag_on(system: &SystemFrame, winds: &[Wind], position: Vec3, velocity: Vec3) -> Vec3 {
    let flow = wind_at(winds, world_of(system, position));
    let x_row = Vec3::from_slice(&system.world_from_system_x);
    let y_row = Vec3::from_slice(&system.world_from_system_y);
    let z_row = Vec3::from_slice(&system.world_from_system_z);
    let flow_here = x_row * flow.x + y_row * flow.y + z_row * flow.z;
    (flow_here - velocity) * system.acceleration[3]
}

/// The particle one frame later: position += velocity, then velocity += acceleration and drag.
#[inline]
pub fn advance(particle: &Particle, system: &SystemFrame, winds: &[Wind]) -> Particle {
    let velocity = Vec3::from(particle.velocity());
    let place = Vec3::from(particle.position());
    let mut acceleration = Vec3::from_slice(&system.acceleration);
    // Without drag there is nothing to add: what is 0 times a wind is 0.
    if system.acceleration[3] != 0.0 {
        acceleration += drag_on(system, winds, place, velocity);
    }
    let stays = system.flags & SYSTEM_STILL != 0;
    let position = if stays { place } else { place + velocity };
    let next = if stays {
        velocity
    } else {
        velocity + acceleration
    };
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
