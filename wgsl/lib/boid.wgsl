// What a boid is at first, and how it moves: the flocking article's Particle.update and its edges. Reads and writes no buffers. Twin of src/cpu/boid.rs.
// Invariant: in a plane, z never changes.
#define_import_path motes::boid

#import motes::exact::{dot3, floor_exact, inverse_square_root, less, less_equal, max_exact, square_root}
#import motes::layout::{Boid, EDGES_BOUNCE, EDGES_INWARD, EDGES_TORUS, EDGES_WRAP, FlockFrame}
#import motes::rng::{pcg4d, signed_float, unit_float}
#import motes::transcendental::{cos_turns, sin_turns}

// Tells the draws of boids from those of particles, whose second word is a frame.
const BOID_TAG: u32 = 0x626f6964u;
// Streams of the hash: which attributes a draw is for.
const STREAM_START: u32 = 0u;
const STREAM_HEADING: u32 = 1u;

struct Motion {
    position: vec3<f32>,
    velocity: vec3<f32>,
}

// The lower and the upper half of a word of 64 bits.
fn halves(word: u64) -> vec2<u32> {
    return vec2<u32>(u32(word), u32(word >> 32u));
}

// A boid of four words of 64 bits, as adapters that have them load it.
fn boid_of(words: vec4<u64>) -> Boid {
    return Boid(
        vec4<u32>(halves(words.x), halves(words.y)), vec4<u32>(halves(words.z), halves(words.w)),
    );
}

// v, no longer than the limit, which is at least 2^-20.
fn limited(v: vec3<f32>, limit: f32) -> vec3<f32> {
    let squared = dot3(v, v);
    let factor = select(1.0f, limit * inverse_square_root(squared), less(limit * limit, squared));
    return v * factor;
}

// The boid of that index as the flock begins: anywhere in the region, on its way anywhere.
fn newborn(flock: FlockFrame, index: u32) -> Motion {
    let place = pcg4d(vec4<u32>(flock.members.z, BOID_TAG, index, STREAM_START));
    let aim = pcg4d(vec4<u32>(flock.members.z, BOID_TAG, index, STREAM_HEADING));
    let unit = vec3<f32>(unit_float(place.x), unit_float(place.y), unit_float(place.z));
    let turns = unit_float(aim.x);
    let z = select(0.0f, signed_float(aim.y), flock.ties.z == 1u);
    let around = square_root(max_exact(1.0f - z * z, 0.0f));
    let heading = vec3<f32>(around * cos_turns(turns), around * sin_turns(turns), z);
    return Motion(
        flock.region_min.xyz + unit * flock.region_extent.xyz,
        heading * flock.region_min.w,
    );
}

// A coordinate and its velocity after the edges along an axis.
fn edged(flock: FlockFrame, x: f32, v: f32, low: f32, high: f32, torus: vec2<f32>) -> vec2<f32> {
    let kind = flock.members.w;
    if kind == EDGES_WRAP {
        let raised = select(x, high, less(x, low));
        return vec2<f32>(select(raised, low, less(high, raised)), v);
    }
    if kind == EDGES_TORUS {
        return vec2<f32>(x - torus.x * floor_exact((x - low) * torus.y), v);
    }
    let below = less_equal(x, low);
    let above = less_equal(high, x);
    if kind == EDGES_BOUNCE {
        return vec2<f32>(x, v * select(1.0f, flock.edges_min.w, below || above));
    }
    if kind == EDGES_INWARD {
        return vec2<f32>(x, select(select(v, -abs(v), above), abs(v), below));
    }
    return vec2<f32>(x, v);
}

// One frame: velocity, then position, then the limit, then the edges, as the article has it.
fn moved(flock: FlockFrame, motion: Motion, acceleration: vec3<f32>) -> Motion {
    let velocity = motion.velocity + acceleration;
    let position = motion.position + velocity;
    let slowed = limited(velocity, flock.region_extent.w);
    let low = flock.edges_min;
    let high = flock.edges_max;
    let x = edged(flock, position.x, slowed.x, low.x, high.x, vec2<f32>(flock.torus.x, flock.torus_inverse.x));
    let y = edged(flock, position.y, slowed.y, low.y, high.y, vec2<f32>(flock.torus.y, flock.torus_inverse.y));
    let z = edged(flock, position.z, slowed.z, low.z, high.z, vec2<f32>(flock.torus.z, flock.torus_inverse.z));
    return Motion(vec3<f32>(x.x, y.x, z.x), vec3<f32>(x.y, y.y, z.y));
}
