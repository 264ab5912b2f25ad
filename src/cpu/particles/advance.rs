//! advance: one frame of motion (Reeves 1983, 2.3), in the wind (Perry 1994, 3.2.3). Twin of
//! `wgsl/particles/advance.wgsl`.

use glam::Vec3;

use crate::cpu::lanes::{LANES, VecLanes, lane_of, set_lane};
use crate::cpu::projection::world_of;
use crate::cpu::wind::{wind_at, wind_at_lanes};
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
    let mut worlds = VecLanes::default();
    for (lane, particle) in block.iter().enumerate() {
        let place = Vec3::from(particle.position());
        set_lane(&mut worlds, lane, world_of(system, place));
    }
    let flow = wind_at_lanes(winds, &worlds);
    for (lane, particle) in block.iter_mut().enumerate() {
        *particle = moved(particle, system, Some(lane_of(&flow, lane)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::{WIND_ATTRACTOR, WIND_CURL, WIND_NOISE, WIND_SOURCE, WIND_VORTEX};
    use crate::rng::{pcg4d, signed_float};
    use glam::UVec4;

    /// As many particles of systems whose slots `slot_of` tells.
    fn particles(count: u32, slot_of: impl Fn(u32) -> u32) -> Vec<Particle> {
        let particle = |at: u32| {
            let [place, velocity] = [0, 1].map(|stream| {
                let random = pcg4d(UVec4::new(7, 3, at, stream));
                [random.x, random.y, random.z].map(|word| bits_of(3.0 * signed_float(word)))
            });
            let with = |[x, y, z]: [u32; 3], w: u32| [x, y, z, w];
            Particle {
                position_and_index: with(place, at),
                velocity_and_birth: with(velocity, slot_of(at) << 16),
            }
        };
        let particles: Vec<Particle> = (0..count).map(particle).collect();
        let slots = particles.iter().enumerate();
        slots.for_each(|(at, it)| assert_eq!(it.slot(), slot_of(at as u32)));
        particles
    }

    /// Two turned and moved systems whom the wind drags, one whom it does not, and one that stays.
    fn systems() -> Vec<SystemFrame> {
        let system = |drag: f32, flags: u32| SystemFrame {
            world_from_system_x: [0.6, -0.8, 0.0, 0.3 + drag],
            world_from_system_y: [0.8, 0.6, 0.0, -1.2],
            world_from_system_z: [0.0, 0.0, 1.0, 0.7],
            acceleration: [0.01, -0.02, 0.005, drag],
            flags,
            ..SystemFrame::default()
        };
        vec![
            system(0.12, 0),
            system(0.5, 0),
            system(0.0, 0),
            system(0.2, SYSTEM_STILL),
        ]
    }

    /// Winds of every kind; noise of several octaves, folded and not.
    fn winds() -> Vec<Wind> {
        let kinds = [
            [WIND_NOISE, 1, 5, 0],
            [WIND_NOISE, 3, 6, 1],
            [WIND_CURL, 2, 7, 0],
            [WIND_VORTEX, 0, 0, 0],
            [WIND_SOURCE, 0, 0, 0],
            [WIND_ATTRACTOR, 0, 0, 0],
            [0; 4],
        ];
        let wind = |kinds: [u32; 4]| Wind {
            kinds,
            place: [0.3, -0.4, 0.5, 0.8],
            aim: [0.0, 0.6, 0.8, 0.03],
            scale: [0.9, 1.3, 0.7, 0.5],
            offset: [0.1, 0.2, 0.3, 0.0],
        };
        kinds.map(wind).to_vec()
    }

    #[test]
    fn several_at_a_time_are_each_alone() {
        let systems = systems();
        let every = winds();
        // The last: blocks of one system, of two, of those without drag and of those that stay.
        let slots: [&dyn Fn(u32) -> u32; 5] =
            [&|_| 0, &|_| 2, &|_| 3, &|at| at / 9, &|at| (at / 20) % 4];
        for winds in (0..every.len())
            .map(|at| &every[at..=at])
            .chain([&every[..], &[]])
        {
            for (case, slot_of) in slots.iter().enumerate() {
                for count in [0, 1, 15, 16, 17, 33, 80] {
                    if case == 3 && count > 36 {
                        continue;
                    }
                    let particles = particles(count, slot_of);
                    let mut got = vec![Particle::default(); particles.len()];
                    advance_all(particles.iter(), &mut got, &systems, winds);
                    let alone = |it: &Particle| advance(it, &systems[it.slot() as usize], winds);
                    let expected: Vec<Particle> = particles.iter().map(alone).collect();
                    assert!(
                        got == expected,
                        "{count} particles of case {case}, {} winds of kinds {:?}",
                        winds.len(),
                        winds.first().map(|wind| wind.kinds)
                    );
                }
            }
        }
    }
}
