//! emit: the attributes of one newborn (Reeves 1983, 2.2). Twin of `wgsl/particles/emit.wgsl`.

use glam::Vec3;

use crate::cpu::particle::{Identity, STREAM_MOTION, STREAM_PLACE, draw};
use crate::exact::{bits_of, max_exact, square_root};
use crate::layout::{Particle, SHAPE_CIRCLE, SHAPE_SPHERE, SystemRow};
use crate::rng::{signed_float, unit_float};
use crate::transcendental::{cos_turns, cube_root, sin_turns};

/// The unit vector at height z on the sphere, `turns` around the z axis.
#[inline]
fn on_sphere(z: f32, turns: f32) -> Vec3 {
    let ring = square_root(max_exact(1.0 - z * z, 0.0));
    Vec3::new(ring * cos_turns(turns), ring * sin_turns(turns), z)
}

/// The newborn `who` of the system in `slot`, in the system's space.
#[inline]
pub fn emit(who: Identity, slot: u32, row: &SystemRow) -> Particle {
    let extents = row.shape;
    let speeds = row.speed_and_lifetime;
    let shape = row.kinds[0];

    let place = draw(who, STREAM_PLACE);
    let motion = draw(who, STREAM_MOTION);
    let direction;
    let position;
    if shape == SHAPE_SPHERE {
        direction = on_sphere(signed_float(place.x), unit_float(place.y));
        position = direction * (cube_root(unit_float(place.z)) * extents[0]);
    } else {
        let cosine = 1.0 - unit_float(motion.x) * (1.0 - extents[3]);
        direction = on_sphere(cosine, unit_float(motion.y));
        if shape == SHAPE_CIRCLE {
            let distance = square_root(unit_float(place.x)) * extents[0];
            let turns = unit_float(place.y);
            position = Vec3::new(
                distance * cos_turns(turns),
                distance * sin_turns(turns),
                0.0,
            );
        } else {
            position = Vec3::new(
                signed_float(place.x) * extents[0],
                signed_float(place.y) * extents[1],
                0.0,
            );
        }
    }
    let speed = speeds[0] + signed_float(motion.z) * speeds[1];
    let velocity = direction * speed;
    Particle {
        position_and_index: [
            bits_of(position.x),
            bits_of(position.y),
            bits_of(position.z),
            who.index,
        ],
        velocity_and_birth: [
            bits_of(velocity.x),
            bits_of(velocity.y),
            bits_of(velocity.z),
            (slot << 16) | (who.birth_frame & 0xffff),
        ],
    }
}
