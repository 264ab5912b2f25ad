// gather: the point lights that stand for flames, from the sums of what each flame gives.
//
// Perry 1994, 3.2.4: one invocation a light.
// Reads: fires, flames, flame_sums, light_roots. Writes: flame_lights.
// Invariant: a light that no flame gives to is dark.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, f32_of_u32, reciprocal}
#import motes::flame::{light_seed, tells_roots}
#import motes::layout::{FLAME_LIGHTS, FireFrame, Flame, FlameLight}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    fire_count: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(1) var<storage, read> flames: array<Flame>;
@group(0) @binding(2) var<storage, read> flame_sums: array<u32>;
@group(0) @binding(3) var<storage, read_write> flame_lights: array<FlameLight>;
@group(0) @binding(4) var<storage, read> light_roots: array<vec4<f32>>;

// A sum in whole weights: two limbs, in steps of 2^-30.
fn weight_of(at: u32) -> f32 {
    let low = flame_sums[at];
    let high = f32_of_u32(flame_sums[at + 1u]) * 4.0f;
    return high + (f32_of_u32(low >> 8u) * 2.3841858e-7f + f32_of_u32(low & 0xffu) * 9.313226e-10f);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn gather(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= FLAME_LIGHTS {
        return;
    }
    var slot = work.fire_count;
    for (var fire = 0u; fire < work.fire_count; fire += 1u) {
        let own = fires[fire].lights;
        if at >= own.x && at < own.x + own.y {
            slot = fire;
        }
    }
    let first = at * 8u;
    let weight = weight_of(first);
    if slot == work.fire_count || bits_of(weight) == 0u {
        flame_lights[at] = FlameLight(vec4<u32>(0u), vec4<u32>(0u));
        return;
    }
    let fire = fires[slot];
    var root = light_roots[at].xyz;
    if !tells_roots(fire) {
        root = bitcast<vec3<f32>>(flames[light_seed(fire, at - fire.lights.x)].root_and_fire.xyz);
    }
    let share = reciprocal(weight);
    let sums = vec3<f32>(weight_of(first + 2u), weight_of(first + 4u), weight_of(first + 6u));
    let place = root + (sums * share * 2.0f - 1.0f) * fire.light_scale.y;
    let color = fire.light.xyz * weight;
    flame_lights[at] = FlameLight(
        vec4<u32>(bits_of(place.x), bits_of(place.y), bits_of(place.z), bits_of(fire.light.w)),
        vec4<u32>(bits_of(color.x), bits_of(color.y), bits_of(color.z), 0u),
    );
}
