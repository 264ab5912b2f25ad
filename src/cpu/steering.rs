//! Steering (Reynolds 1987, as the flocking article has it). Twin of `wgsl/lib/steering.wgsl`, whose
//! sums of several limbs are one integer here.

use glam::Vec3;

use crate::cpu::boid::limited;
use crate::exact::{
    Limbs3, dot3, f32_of_u32, inverse_square_root, less, limbs3, min_exact, normalize_exact,
    shared_constants,
};
use crate::layout::{FlockFrame, RELATION_AVOID, RELATION_FLOCK, Relation, SUM_STEPS};

shared_constants! {
    /// Inverse of [`SUM_STEPS`].
    pub const SUM_STEP: f32 = 1.862_645_1e-9;
    /// How much more than one at the radius a near one counts at most.
    pub const MOST_NEARNESS: f32 = 512.0;
    /// Steps of what counts by nearness.
    pub const NEARNESS_STEPS: f32 = 1_048_576.0;
}

/// Three sums in steps.
type Sum = [i64; 3];

/// What a boid perceives of a flock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Perceived {
    /// How many.
    pub count: u32,
    /// Unit vectors away from each, or pushes by each.
    pub away: Sum,
    /// Velocities.
    pub along: Sum,
    /// Offsets.
    pub toward: Sum,
}

/// The sum with a term more, to the nearest step.
#[inline]
fn plus(sum: Sum, term: Vec3) -> Sum {
    let Limbs3 { coarse, fine } = limbs3(term);
    let whole = |coarse: i32, fine: i32| i64::from(coarse) * 65_536 + i64::from(fine);
    let [x, y, z] = sum;
    [
        x + whole(coarse.x, fine.x),
        y + whole(coarse.y, fine.y),
        z + whole(coarse.z, fine.z),
    ]
}

/// What a sum holds, in units.
#[inline]
fn value_of(sum: i64) -> f32 {
    let magnitude = sum.unsigned_abs();
    let (below, above) = (magnitude as u32, (magnitude >> 32) as u32);
    let steps = f32_of_u32(above) * 4_294_967_296.0
        + (f32_of_u32(below >> 12) * 4096.0 + f32_of_u32(below & 0xfff));
    (if sum < 0 { -steps } else { steps }) * SUM_STEP
}

#[inline]
fn values_of(sum: Sum) -> Vec3 {
    Vec3::from(sum.map(value_of))
}

/// One that is perceived: the way to it, its squared length, and its velocity.
#[derive(Clone, Copy, Debug)]
pub struct Neighbour {
    /// World units.
    pub offset: Vec3,
    /// Squared world units.
    pub squared: f32,
    /// World units a frame.
    pub velocity: Vec3,
}

/// Whether one that goes that way sees what the offset leads to, of that squared length; who does not
/// move sees all around.
#[inline]
pub fn sees(heading: Vec3, offset: Vec3, squared: f32, relation: &Relation) -> bool {
    let ahead = dot3(heading, offset);
    let moves = less(0.0, dot3(heading, heading));
    !moves || !less(ahead * ahead.abs(), relation.sight[0] * squared)
}

/// What is perceived with one more; `own` is the velocity of who perceives.
#[inline]
pub fn perceiving(
    perceived: Perceived,
    relation: &Relation,
    other: &FlockFrame,
    neighbour: Neighbour,
    own: Vec3,
) -> Perceived {
    let Neighbour {
        offset,
        squared,
        velocity,
    } = neighbour;
    let mut more = perceived;
    more.count += 1;
    if relation.kinds[0] == RELATION_FLOCK {
        // Zero for one that is at the same place.
        let inverse = inverse_square_root(squared);
        let nearness = min_exact(inverse * relation.reach[1], MOST_NEARNESS) * NEARNESS_STEPS;
        let factor = if relation.kinds[2] == 1 {
            nearness
        } else {
            SUM_STEPS
        };
        let unit = -offset * Vec3::splat(inverse);
        more.away = plus(perceived.away, unit * Vec3::splat(factor));
        more.along = plus(perceived.along, velocity * Vec3::splat(other.grid_min[3]));
        more.toward = plus(perceived.toward, offset * Vec3::splat(relation.reach[2]));
        return more;
    }
    let push = if relation.kinds[0] == RELATION_AVOID {
        -offset - own
    } else {
        offset
    };
    let push = limited(push, relation.separation[3]);
    more.away = plus(perceived.away, push * Vec3::splat(relation.reach[3]));
    more
}

/// A rule's acceleration: the wanted velocity less the own, at most the limit. Where there is no
/// way to want, it brakes.
#[inline]
pub(crate) fn steering([weight, speed, limit, _]: [f32; 4], way: Vec3, own: Vec3) -> Vec3 {
    let wanted = normalize_exact(way) * Vec3::splat(speed);
    limited(wanted - own, limit) * Vec3::splat(weight)
}

/// The acceleration that comes of what is perceived.
#[inline]
pub fn answer(perceived: &Perceived, relation: &Relation, own: Vec3, inverse_mass: f32) -> Vec3 {
    if perceived.count == 0 {
        return Vec3::ZERO;
    }
    let away = values_of(perceived.away);
    if relation.kinds[0] == RELATION_FLOCK {
        return steering(relation.separation, away, own)
            + steering(relation.alignment, values_of(perceived.along), own)
            + steering(relation.cohesion, values_of(perceived.toward), own);
    }
    // Steering is an acceleration; a pull is a force.
    let factor = if relation.kinds[0] == RELATION_AVOID {
        1.0
    } else {
        inverse_mass
    };
    away * Vec3::splat(relation.alignment[3] * factor)
}
