//! cull: who lives on, and what the others die of (Reeves 1983, 2.4). Twin of
//! `wgsl/particles/cull.wgsl`.

use glam::Vec3;

use crate::cpu::particle::{appearance_of, identity_of, intensity_of, lifetime_of, row_index};
use crate::cpu::projection::world_of;
use crate::exact::{dot3, less};
use crate::layout::{BOUND_BOX, BOUND_PLANE, Bound, PARTICLE_STROKE, Particle, SystemRow};
use crate::plan::FrameInputs;

/// What becomes of a particle; the first cause of death that holds counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It lives through the frame.
    Lives,
    /// Its lifetime is over.
    DiesOfAge,
    /// Its intensity is below its system's threshold.
    DiesOfIntensity,
    /// It comes where its system's bounds forbid.
    DiesOfBounds,
}

/// Whether a world place is beyond the plane, outside what must hold it, or inside what must not.
#[inline]
fn is_forbidden(bound: &Bound, world: Vec3) -> bool {
    let [low, high] = [bound.place, bound.extent].map(|corner| Vec3::from_slice(&corner));
    let limit = bound.place[3];
    let outside_kills = bound.kinds[1] == 1;
    match bound.kinds[0] {
        BOUND_PLANE => less(limit, dot3(low, world)),
        BOUND_BOX => {
            let is_outside = less(world.x, low.x)
                || less(high.x, world.x)
                || less(world.y, low.y)
                || less(high.y, world.y)
                || less(world.z, low.z)
                || less(high.z, world.z);
            is_outside == outside_kills
        }
        _ => {
            let away = world - low;
            let distance_squared = dot3(away, away);
            if outside_kills {
                less(limit, distance_squared)
            } else {
                less(distance_squared, limit)
            }
        }
    }
}

/// What becomes of the particle in the frame of `inputs`.
#[inline]
pub fn fate_of(particle: &Particle, inputs: &FrameInputs, rows: &[SystemRow]) -> Fate {
    let (who, age) = identity_of(particle, inputs);
    let row = &rows[row_index(particle.slot(), who.birth_frame, inputs.frame.row_mask)];
    let ages = row.kinds[1] != PARTICLE_STROKE;
    if ages && age >= lifetime_of(who, row.speed_and_lifetime) {
        return Fate::DiesOfAge;
    }
    let threshold = row.size_and_threshold[3];
    if !less(threshold, 0.0) {
        let look = appearance_of(who, row, age + 1);
        if less(intensity_of(&look, row.kinds[3]), threshold) {
            return Fate::DiesOfIntensity;
        }
    }
    let system = &inputs.systems[particle.slot() as usize];
    let first = system.first_bound as usize;
    let bounds = &inputs.bounds[first..first + system.bound_count as usize];
    let next = Vec3::from(particle.position()) + Vec3::from(particle.velocity());
    let world = world_of(system, next);
    if bounds.iter().any(|bound| is_forbidden(bound, world)) {
        return Fate::DiesOfBounds;
    }
    Fate::Lives
}
