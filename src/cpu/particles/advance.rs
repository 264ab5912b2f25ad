//! advance: one frame of motion (Reeves 1983, 2.3), in the wind (Perry 1994, 3.2.3). Twin of
//! `wgsl/particles/advance.wgsl`.

use glam::Vec3;

use crate::cpu::projection::world_of;
use crate::cpu::wind::{LANES, Lanes, lane_of, set_lane, wind_at, wind_at_lanes};
use crate::exact::bits_of;
use crate::layout::{Particle, SYSTEM_STILL, SystemFrame, Wind};

/// What drag adds to a velocity in a frame: a part of what it lacks of the wind's `flow`, in the
/// system's space.
#[inline]
fn drag_on(system: &SystemFrame, flow: Vec3, velocity: Vec3) -> Vec3 {
    let x_row = Vec3::from_slice(&system.world_from_system_x);
    let y_row = Vec3::from_slice(&system.world_from_system_y);
    let z_row = Vec3::from_slice(&system.world_from_system_z);
    let flow_here = x_row * flow.x + y_row * flow.y + z_row * flow.z;
    (flow_here - velocity) * system.acceleration[3]
}

/// The particle one frame later: position += velocity, then velocity += acceleration and drag.
#[inline]
pub fn advance(particle: &Particle, system: &SystemFrame, winds: &[Wind]) -> Particle {
    // Without drag there is nothing to add: what is 0 times a wind is 0.
    let flow = (system.acceleration[3] != 0.0)
        .then(|| wind_at(winds, world_of(system, Vec3::from(particle.position()))));
    moved(particle, system, flow)
}

/// The particle one frame later in that wind, if it drags at all.
#[inline(always)]
fn moved(particle: &Particle, system: &SystemFrame, flow: Option<Vec3>) -> Particle {
    let velocity = Vec3::from(particle.velocity());
    let place = Vec3::from(particle.position());
    let mut acceleration = Vec3::from_slice(&system.acceleration);
    if let Some(flow) = flow {
        acceleration += drag_on(system, flow, velocity);
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

/// [`advance`] of one particle after another, in their order. Those of one system, whom the wind drags,
/// are taken several at a time.
pub fn advance_all<'a>(
    particles: impl Iterator<Item = &'a Particle>,
    places: &mut [Particle],
    systems: &[SystemFrame],
    winds: &[Wind],
) {
    let mut particles = particles;
    let (blocks, rest) = places.as_chunks_mut::<LANES>();
    for block in blocks {
        for place in block.iter_mut() {
            // There are as many as places.
            *place = particles.next().copied().unwrap_or_default();
        }
        advance_block(block, systems, winds);
    }
    for (place, particle) in rest.iter_mut().zip(particles) {
        *place = advance(particle, &systems[particle.slot() as usize], winds);
    }
}

fn advance_block(block: &mut [Particle; LANES], systems: &[SystemFrame], winds: &[Wind]) {
    let slot = block[0].slot();
    let system = &systems[slot as usize];
    let is_of_one = block.iter().all(|particle| particle.slot() == slot);
    if !is_of_one || system.acceleration[3] == 0.0 {
        for particle in block {
            let system = &systems[particle.slot() as usize];
            *particle = advance(particle, system, winds);
        }
        return;
    }
    let mut worlds = Lanes::default();
    for (lane, particle) in block.iter().enumerate() {
        let place = Vec3::from(particle.position());
        set_lane(&mut worlds, lane, world_of(system, place));
    }
    let flow = wind_at_lanes(winds, &worlds);
    for (lane, particle) in block.iter_mut().enumerate() {
        *particle = moved(particle, system, Some(lane_of(&flow, lane)));
    }
}
