// cluster: the point lights that stand for particles, from the sums of what these give.
//
// Reeves 1983, section 3: light from particles. A light stands at the mean of the places that its light comes
// from, and is as wide as they are spread. One invocation a corner of cells.
// Reads: cluster_span, cluster_sums. Writes: cluster_lights (how many there are, in place.x of the first; then
// those, in the order of their corners; then dark ones).
// Invariant: there are as many lights as corners that get light.

#import motes::cluster::{Span, WIDENING, span_of}
#import motes::dispatch::linear_index
#import motes::exact::{at_least_zero, bits_of, dot3, f32_of_u32, reciprocal}
#import motes::layout::{CLUSTER_LIGHTS, CLUSTERS_ACROSS, FlameLight}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<storage, read> cluster_span: array<u32>;
@group(0) @binding(1) var<storage, read> cluster_sums: array<u32>;
@group(0) @binding(2) var<storage, read_write> cluster_lights: array<FlameLight>;

// A sum in whole weights: two limbs, in steps of 2^-30.
fn weight_of(at: u32) -> f32 {
    let low = cluster_sums[at];
    let high = f32_of_u32(cluster_sums[at + 1u]) * 4.0f;
    return high + (f32_of_u32(low >> 8u) * 2.3841858e-7f + f32_of_u32(low & 0xffu) * 9.313226e-10f);
}

// Whether anything is given to a corner that shows.
fn is_lit(corner: u32) -> bool {
    return (cluster_sums[corner * 16u + 6u] | cluster_sums[corner * 16u + 7u]) != 0u;
}

fn light_at(corner: u32, cube: Span) -> FlameLight {
    let first = corner * 16u;
    let share = reciprocal(weight_of(first + 6u));
    let means = vec3<f32>(weight_of(first + 8u), weight_of(first + 10u), weight_of(first + 12u)) * share;
    let away = means * 2.0f - 1.0f;
    let squared = weight_of(first + 14u) * share * 3.0f;
    let spread = at_least_zero(squared - dot3(away, away)) * WIDENING * cube.width * cube.width;
    let cell = vec3<f32>(
        f32_of_u32(corner % CLUSTERS_ACROSS),
        f32_of_u32(corner / CLUSTERS_ACROSS % CLUSTERS_ACROSS),
        f32_of_u32(corner / (CLUSTERS_ACROSS * CLUSTERS_ACROSS)),
    );
    let place = cube.corner + (cell + away) * cube.width;
    let color = vec3<f32>(weight_of(first), weight_of(first + 2u), weight_of(first + 4u)) * cube.most;
    return FlameLight(
        vec4<u32>(bits_of(place.x), bits_of(place.y), bits_of(place.z), bits_of(spread)),
        vec4<u32>(bits_of(color.x), bits_of(color.y), bits_of(color.z), 0u),
    );
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn cluster(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let corner = linear_index(global_id, WORKGROUP_SIZE);
    if corner >= CLUSTER_LIGHTS {
        return;
    }
    var before = 0u;
    var all = 0u;
    for (var other = 0u; other < CLUSTER_LIGHTS; other += 1u) {
        let lit = select(0u, 1u, is_lit(other));
        before += select(0u, lit, other < corner);
        all += lit;
    }
    if corner == 0u {
        cluster_lights[0] = FlameLight(vec4<u32>(all, 0u, 0u, 0u), vec4<u32>(0u));
    }
    if corner >= all {
        cluster_lights[1u + corner] = FlameLight(vec4<u32>(0u), vec4<u32>(0u));
    }
    if is_lit(corner) {
        let high = vec3<u32>(cluster_span[0], cluster_span[1], cluster_span[2]);
        let low = vec3<u32>(cluster_span[3], cluster_span[4], cluster_span[5]);
        cluster_lights[1u + before] = light_at(corner, span_of(high, low, cluster_span[6]));
    }
}
