// Steering (Reynolds 1987, as the flocking article has it): the way a boid wants, less the way it
// goes, limited. Sums over neighbours are integers, so that they depend neither on the order of the
// neighbours nor on the grid. Reads and writes no buffers.
// Twin of src/cpu/steering.rs.
#define_import_path motes::steering

#import motes::boid::limited
#import motes::exact::{dot3, f32_of_u32, inverse_square_root, less, limbs3, min_exact, normalize_exact}
#import motes::layout::{FlockFrame, RELATION_AVOID, RELATION_FLOCK, Relation, SUM_STEPS}

// Inverse of SUM_STEPS.
const SUM_STEP: f32 = 1.8626451e-9f;
// How much more than one at the radius a near one counts at most, and steps of what counts so.
const MOST_NEARNESS: f32 = 512.0f;
const NEARNESS_STEPS: f32 = 1048576.0f;

// Three sums: 2^32 .high + 2^16 .coarse + .fine. The lower limbs hold 60,000 terms before they have to
// be carried.
struct Sum {
    high: vec3<i32>,
    coarse: vec3<i32>,
    fine: vec3<i32>,
}

// What a boid perceives of a flock.
struct Perceived {
    count: u32,
    // Unit vectors away from each, or pushes by each.
    away: Sum,
    // Velocities.
    along: Sum,
    // Offsets.
    toward: Sum,
}

fn nothing() -> Perceived {
    let zero = Sum(vec3<i32>(0i), vec3<i32>(0i), vec3<i32>(0i));
    return Perceived(0u, zero, zero, zero);
}

// The sum with a term more, to the nearest step.
fn plus(sum: Sum, term: vec3<f32>) -> Sum {
    let limbs = limbs3(term);
    return Sum(sum.high, sum.coarse + limbs.coarse, sum.fine + limbs.fine);
}

// The same sum, its lower limbs in 0 .. 2^16.
fn carried(sum: Sum) -> Sum {
    let coarse = sum.coarse + (sum.fine >> vec3<u32>(16u));
    return Sum(
        sum.high + (coarse >> vec3<u32>(16u)),
        coarse & vec3<i32>(0xffffi),
        sum.fine & vec3<i32>(0xffffi),
    );
}

// The same, its sums carried.
fn all_carried(perceived: Perceived) -> Perceived {
    return Perceived(
        perceived.count, carried(perceived.away), carried(perceived.along), carried(perceived.toward),
    );
}

// What 64 bits hold, in units: a step is SUM_STEP of one.
fn value_of(low: u32, high: i32) -> f32 {
    let negative = high < 0i;
    let below = select(low, ~low + 1u, negative);
    let above = select(u32(high), ~u32(high) + select(0u, 1u, low == 0u), negative);
    let steps = f32_of_u32(above) * 4294967296.0f
        + (f32_of_u32(below >> 12u) * 4096.0f + f32_of_u32(below & 0xfffu));
    return select(steps, -steps, negative) * SUM_STEP;
}

fn values_of(sum: Sum) -> vec3<f32> {
    let all = carried(sum);
    let low = bitcast<vec3<u32>>((all.coarse << vec3<u32>(16u)) | all.fine);
    return vec3<f32>(
        value_of(low.x, all.high.x),
        value_of(low.y, all.high.y),
        value_of(low.z, all.high.z),
    );
}

// Whether one that goes that way sees what the offset leads to, of that squared length; who does not
// move sees all around.
fn sees(heading: vec3<f32>, offset: vec3<f32>, squared: f32, relation: Relation) -> bool {
    let ahead = dot3(heading, offset);
    let moves = less(0.0f, dot3(heading, heading));
    return !moves || !less(ahead * abs(ahead), relation.sight.x * squared);
}

// What is perceived with one more: `offset` leads to it, of that squared length; `own` is the
// velocity of who perceives.
fn perceiving(
    perceived: Perceived,
    relation: Relation,
    other: FlockFrame,
    offset: vec3<f32>,
    squared: f32,
    own: vec3<f32>,
    velocity: vec3<f32>,
) -> Perceived {
    // Straight code for all kinds, for software drivers go through both branches: what is not asked for
    // is added up in vain.
    let flocks = relation.kinds.x == RELATION_FLOCK;
    let push = select(offset, -offset - own, relation.kinds.x == RELATION_AVOID);
    let length_squared = select(dot3(push, push), squared, flocks);
    // Zero for one that is at the same place.
    let inverse = inverse_square_root(length_squared);
    let nearness = min_exact(inverse * relation.reach.y, MOST_NEARNESS) * NEARNESS_STEPS;
    let steps = select(SUM_STEPS, nearness, relation.kinds.z == 1u);
    let limit = relation.separation.w;
    let slowed = select(1.0f, limit * inverse, less(limit * limit, length_squared));
    let pushed = select(push, -offset, flocks) * select(slowed, inverse, flocks);
    return Perceived(
        perceived.count + 1u,
        plus(perceived.away, pushed * select(relation.reach.w, steps, flocks)),
        plus(perceived.along, velocity * other.grid_min.w),
        plus(perceived.toward, offset * relation.reach.z),
    );
}

// A rule's acceleration: the wanted velocity less the own, at most the limit. Where there is no
// way to want, it brakes.
fn steering(rule: vec4<f32>, way: vec3<f32>, own: vec3<f32>) -> vec3<f32> {
    return limited(normalize_exact(way) * rule.y - own, rule.z) * rule.x;
}

// The acceleration that comes of what is perceived.
fn answer(perceived: Perceived, relation: Relation, own: vec3<f32>, inverse_mass: f32) -> vec3<f32> {
    if perceived.count == 0u {
        return vec3<f32>(0.0f);
    }
    let away = values_of(perceived.away);
    if relation.kinds.x == RELATION_FLOCK {
        return steering(relation.separation, away, own)
            + steering(relation.alignment, values_of(perceived.along), own)
            + steering(relation.cohesion, values_of(perceived.toward), own);
    }
    // Steering is an acceleration; a pull is a force.
    let factor = select(inverse_mass, 1.0f, relation.kinds.x == RELATION_AVOID);
    return away * (relation.alignment.w * factor);
}
