// What a borne system has of its kind, of its parent and of its own (Reeves 1983, 2.6 and 3).
//
// Each parameter is its kind's mean plus Rand() times the half-width that the kind says; of colour,
// transparency and size also what its parent has beyond the parent's own kind.
// Reads and writes no buffers. Invariant: it depends on the key, the kinds and the parent's row
// alone; twin of src/cpu/tree/inherit.rs.
#define_import_path motes::inherit

#import motes::exact::{
    at_least_zero, clamp_exact, clamp_unit, less, max_exact, snap4, to_i32,
}
#import motes::layout::{
    BROOD_BURSTS, BROOD_SHRINKS, Brood, NO_SLOT, SHAPE_CURVE, SHAPE_MESH, SHAPE_RING, SystemRow,
}
#import motes::particle::LEAST_SIZE
#import motes::transcendental::cos_turns
#import motes::tree::{own_numbers, polynomial}

fn at_least_zero4(v: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(at_least_zero(v.x), at_least_zero(v.y), at_least_zero(v.z), at_least_zero(v.w));
}

// The row of a kind, with what this system has of its own and from its parent.
fn own_row(
    key: u32,
    kind: SystemRow,
    spread: SystemRow,
    parent: SystemRow,
    parent_kind: SystemRow,
    scale: f32,
) -> SystemRow {
    let shape_kind = kind.kinds.x;
    let is_stored = shape_kind == SHAPE_CURVE || shape_kind == SHAPE_MESH;
    let rest = kind.shape * select(scale, 1.0f, is_stored);
    let shape = snap4(vec4<f32>(
        kind.shape.x * scale, rest.y, rest.z, select(kind.shape.w, rest.w, shape_kind == SHAPE_RING),
    ));
    let light = own_numbers(key, 1u);
    let turns = clamp_exact(
        kind.ejection_and_light.y + spread.ejection_and_light.y * light.y, 0.0f, 0.5f,
    );
    let ejection_and_light = snap4(vec4<f32>(
        cos_turns(turns), turns, kind.ejection_and_light.z,
        at_least_zero(kind.ejection_and_light.w + spread.ejection_and_light.w * light.w),
    ));
    let motion = kind.speed_and_lifetime + spread.speed_and_lifetime * own_numbers(key, 2u);
    let speed_and_lifetime = snap4(vec4<f32>(
        motion.x, at_least_zero(motion.y), motion.z, at_least_zero(motion.w),
    ));
    let size = kind.size_and_threshold + spread.size_and_threshold * own_numbers(key, 3u)
        + (parent.size_and_threshold - parent_kind.size_and_threshold);
    let size_and_threshold = snap4(vec4<f32>(
        max_exact(size.x, LEAST_SIZE), at_least_zero(size.y), size.z, kind.size_and_threshold.w,
    ));
    let mean = kind.color_mean + spread.color_mean * own_numbers(key, 4u)
        + (parent.color_mean - parent_kind.color_mean);
    let color_mean = snap4(vec4<f32>(
        at_least_zero(mean.x), at_least_zero(mean.y), at_least_zero(mean.z), clamp_unit(mean.w),
    ));
    let color_var = snap4(at_least_zero4(
        kind.color_var + spread.color_var * own_numbers(key, 5u)
            + (parent.color_var - parent_kind.color_var),
    ));
    let color_rate = snap4(
        kind.color_rate + spread.color_rate * own_numbers(key, 6u)
            + (parent.color_rate - parent_kind.color_rate),
    );
    let color_rate_var = snap4(at_least_zero4(
        kind.color_rate_var + spread.color_rate_var * own_numbers(key, 7u)
            + (parent.color_rate_var - parent_kind.color_rate_var),
    ));
    return SystemRow(
        shape, ejection_and_light, speed_and_lifetime, size_and_threshold,
        color_mean, color_var, color_rate, color_rate_var, kind.kinds,
    );
}

// Mean births and their half-width, bursts and theirs, at an age.
fn births_at(brood: Brood, own: vec4<f32>, age: u32) -> vec4<f32> {
    var births = vec4<f32>(0.0f);
    let has_ended = brood.spans.y != NO_SLOT && age >= brood.spans.y;
    if age >= brood.spans.x && !has_ended {
        let since = age - brood.spans.x;
        let mean = polynomial(brood.mean_parts, since);
        let shrunk = (brood.ties.z & BROOD_SHRINKS) != 0u && !less(0.0f, mean);
        births.x = select(mean + brood.spread.x * own.x, 0.0f, shrunk);
        let var_parts = at_least_zero(polynomial(brood.var_parts, since) + brood.spread.y * own.y);
        births.y = select(var_parts, 0.0f, shrunk);
    }
    if (brood.ties.z & BROOD_BURSTS) != 0u && u32(to_i32(brood.burst.z)) == age {
        births.z = brood.burst.x;
        births.w = brood.burst.y;
    }
    return births;
}
