// shine: flames give their light to the point lights that stand for them.
//
// Perry 1994, 3.2.4: the light of a flame is at a function of its particle's places, such as their
// mean. A fire has a few point lights, each for the flames whose roots are nearest to that of one of
// them, or to a place on what burns. What each gets is added up in whole steps: weights, and places times weights, counted from
// that root. One invocation a flame.
// Reads: frame, fires, flames, flame_steps, light_roots. Writes, by atomic adds: flame_sums (the two limbs of a
// weight and of x, y and z of each light).
// Invariant: sums do not depend on the order of flames.

#import motes::dispatch::linear_index
#import motes::exact::{clamp_unit, dot3, less, to_u32}
#import motes::flame::{light_seed, tells_roots}
#import motes::layout::{FLAME_STEPS, FireFrame, Flame, LIGHT_WEIGHT_STEPS}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    // Flames of a page, and the first of them among all.
    flame_count: u32,
    first: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(1) var<storage, read> flames: array<Flame>;
@group(0) @binding(2) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> flame_sums: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read> light_roots: array<vec4<f32>>;

fn add_to_limbs(at: u32, steps: u32) {
    let before = atomicAdd(&flame_sums[at], steps);
    if before > 0xffffffffu - steps {
        atomicAdd(&flame_sums[at + 1u], 1u);
    }
}

fn root_of_light(fire: FireFrame, light: u32) -> vec3<f32> {
    if tells_roots(fire) {
        return light_roots[fire.lights.x + light].xyz;
    }
    return bitcast<vec3<f32>>(flames[light_seed(fire, light)].root_and_fire.xyz);
}

// The light whose root is nearest; of two as near, the first.
fn nearest_light(fire: FireFrame, root: vec3<f32>) -> u32 {
    var nearest = 0u;
    var least = 0.0f;
    for (var light = 0u; light < fire.lights.y; light += 1u) {
        let away = root_of_light(fire, light) - root;
        let squared = dot3(away, away);
        if light == 0u || less(squared, least) {
            nearest = light;
            least = squared;
        }
    }
    return nearest;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn shine(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= work.flame_count {
        return;
    }
    let flame = flames[work.first + at];
    let fire = fires[flame.root_and_fire.w];
    if flame.look.w != 1u || fire.lights.y == 0u {
        return;
    }
    var sum = vec3<f32>(0.0f);
    for (var age = fire.lights.z; age <= fire.lights.w; age += 1u) {
        sum += bitcast<vec3<f32>>(flame_steps[at * FLAME_STEPS + age].xyz);
    }
    let light = nearest_light(fire, bitcast<vec3<f32>>(flame.root_and_fire.xyz));
    let root = root_of_light(fire, light);
    let away = (sum * fire.light_scale.w - root) * fire.light_scale.z;
    let half_width = 0.5f * bitcast<f32>(flame.look.y);
    let weight = bitcast<f32>(flame.look.z) * half_width * half_width;
    let steps = clamp_unit(weight * fire.light_scale.x) * LIGHT_WEIGHT_STEPS;
    let first = (fire.lights.x + light) * 8u;
    add_to_limbs(first, to_u32(steps));
    add_to_limbs(first + 2u, to_u32(clamp_unit(away.x + 0.5f) * steps));
    add_to_limbs(first + 4u, to_u32(clamp_unit(away.y + 0.5f) * steps));
    add_to_limbs(first + 6u, to_u32(clamp_unit(away.z + 0.5f) * steps));
}
