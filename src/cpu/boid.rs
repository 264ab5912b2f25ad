//! What a boid is at first, and how it moves: the flocking article's Particle.update and its edges.
//! Twin of `wgsl/lib/boid.wgsl`.

use glam::{UVec4, Vec3};

use crate::exact::{
    dot3, floor_exact, inverse_square_root, less, less_equal, max_exact, shared_constants,
    square_root,
};
use crate::layout::{EDGES_BOUNCE, EDGES_INWARD, EDGES_TORUS, EDGES_WRAP, FlockFrame};
use crate::rng::{pcg4d, signed_float, unit_float};
use crate::transcendental::{cos_turns, sin_turns};

shared_constants! {
    /// Tells the draws of boids from those of particles, whose second word is a frame.
    pub const BOID_TAG: u32 = 0x626f_6964;
    /// Stream of the hash: where a boid is at first.
    pub const STREAM_START: u32 = 0;
    /// Stream of the hash: where it goes at first.
    pub const STREAM_HEADING: u32 = 1;
}

/// Where a boid is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// World units.
    pub position: Vec3,
    /// World units a frame.
    pub velocity: Vec3,
}

/// `v`, no longer than the limit, which is at least 2^-20.
#[inline]
pub fn limited(v: Vec3, limit: f32) -> Vec3 {
    let squared = dot3(v, v);
    let factor = if less(limit * limit, squared) {
        limit * inverse_square_root(squared)
    } else {
        1.0
    };
    v * Vec3::splat(factor)
}

/// A hash of who a boid is.
pub fn boid_id(flock: &FlockFrame, index: u32) -> u32 {
    pcg4d(UVec4::new(flock.members[2], BOID_TAG, index, STREAM_START)).x
}

/// The boid of that index as the flock begins: anywhere in the region, on its way anywhere.
pub fn newborn(flock: &FlockFrame, index: u32) -> Motion {
    let [_, _, key, _] = flock.members;
    let place = pcg4d(UVec4::new(key, BOID_TAG, index, STREAM_START));
    let aim = pcg4d(UVec4::new(key, BOID_TAG, index, STREAM_HEADING));
    let unit = Vec3::new(
        unit_float(place.x),
        unit_float(place.y),
        unit_float(place.z),
    );
    let turns = unit_float(aim.x);
    let z = if flock.ties[2] == 1 {
        signed_float(aim.y)
    } else {
        0.0
    };
    let around = square_root(max_exact(1.0 - z * z, 0.0));
    let heading = Vec3::new(around * cos_turns(turns), around * sin_turns(turns), z);
    Motion {
        position: Vec3::from_slice(&flock.region_min)
            + unit * Vec3::from_slice(&flock.region_extent),
        velocity: heading * Vec3::splat(flock.region_min[3]),
    }
}

/// A coordinate and its velocity after the edges along an axis.
#[inline]
fn edged(flock: &FlockFrame, [x, v]: [f32; 2], axis: usize) -> [f32; 2] {
    let (low, high) = (flock.edges_min[axis], flock.edges_max[axis]);
    let below = less_equal(x, low);
    let above = less_equal(high, x);
    match flock.members[3] {
        EDGES_WRAP => {
            let raised = if less(x, low) { high } else { x };
            [if less(high, raised) { low } else { raised }, v]
        }
        EDGES_TORUS => {
            let (extent, inverse) = (flock.torus[axis], flock.torus_inverse[axis]);
            [x - extent * floor_exact((x - low) * inverse), v]
        }
        EDGES_BOUNCE if below || above => [x, v * flock.edges_min[3]],
        EDGES_INWARD if below => [x, v.abs()],
        EDGES_INWARD if above => [x, -v.abs()],
        _ => [x, v],
    }
}

/// One frame: velocity, then position, then the limit, then the edges, as the article has it.
#[inline]
pub fn moved(flock: &FlockFrame, motion: Motion, acceleration: Vec3) -> Motion {
    let velocity = motion.velocity + acceleration;
    let position = motion.position + velocity;
    let slowed = limited(velocity, flock.region_extent[3]);
    let x = edged(flock, [position.x, slowed.x], 0);
    let y = edged(flock, [position.y, slowed.y], 1);
    let z = edged(flock, [position.z, slowed.z], 2);
    Motion {
        position: Vec3::new(x[0], y[0], z[0]),
        velocity: Vec3::new(x[1], y[1], z[1]),
    }
}
