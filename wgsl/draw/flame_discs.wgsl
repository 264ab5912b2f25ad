// flame_discs: the particles along a flame as they are seen, and which pixels they touch.
//
// Perry 1994, 3.2.1 and 3.2.2: each of the 25 steps is a particle that faces the viewer, scaled in x
// and y by its age. One invocation a flame.
// Reads: frame, age_looks, flames, flame_steps, layer_planes. Writes: flame_discs,
// flame_bounds (first column and line of pixels, one past the last ones; all 0 for none).
// Invariant: what is not drawn has no light.

#import motes::disc::LEAST_HALF_AXIS_PX
#import motes::dispatch::linear_index
#import motes::exact::{bits_of, dot3, f32_of_i32, less, max_exact, reciprocal, to_i32}
#import motes::layout::{AgeLook, FLAME_STEPS, Flame, FlameDisc, Frame}
#import motes::projection::project
#import motes::sprite::next_layer

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};
// Half-axes in pixels, at most.
const MOST_HALF_AXIS_PX: f32 = 16384.0f;

struct Work {
    flame_count: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> age_looks: array<AgeLook>;
@group(0) @binding(2) var<storage, read> flames: array<Flame>;
@group(0) @binding(3) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> flame_discs: array<FlameDisc>;
@group(0) @binding(6) var<storage, read_write> flame_bounds: array<vec4<u32>>;

// The layer, from 1, that a world place is in.
fn layer_of(world: vec3<f32>) -> u32 {
    var layer = 0u;
    for (var at = 0u; at < frame.layer_plane_count; at += 1u) {
        let plane = layer_planes[at];
        layer = next_layer(layer, at, dot3(plane.xyz, world) - plane.w);
    }
    return select(layer, frame.layer_plane_count + 1u, layer == 0u);
}

fn bits_of_four(v: vec4<f32>) -> vec4<u32> {
    return vec4<u32>(bits_of(v.x), bits_of(v.y), bits_of(v.z), bits_of(v.w));
}

// A half-axis that is drawn, and how much fainter it is for that.
fn half_axis(pixels: f32) -> vec2<f32> {
    let drawn = max_exact(pixels, LEAST_HALF_AXIS_PX);
    return vec2<f32>(drawn, pixels * reciprocal(drawn));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn flame_discs_of(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= work.flame_count {
        return;
    }
    let flame = flames[at];
    let slot = flame.root_and_fire.w;
    let half_width = 0.5f * bitcast<f32>(flame.look.y);
    let brightness = bitcast<f32>(flame.look.z);
    let here = !LAYERS || frame.layer == 0u
        || layer_of(bitcast<vec3<f32>>(flame.root_and_fire.xyz)) == frame.layer;
    let burns = here && flame.look.w == 1u;
    let size = vec2<i32>(i32(frame.width), i32(frame.height));
    var low = size;
    var high = vec2<i32>(0, 0);
    for (var age = 0u; age < FLAME_STEPS; age += 1u) {
        let look = age_looks[slot * FLAME_STEPS + age];
        let step = flame_steps[at * FLAME_STEPS + age];
        let seen = project(frame, bitcast<vec3<f32>>(step.xyz));
        let across = half_axis(half_width * look.scale.x * seen.scale);
        let along = half_axis(half_width * look.scale.y * seen.scale);
        let is_near = less(MOST_HALF_AXIS_PX, across.x) || less(MOST_HALF_AXIS_PX, along.x);
        let is_seen = burns && !is_near && !less(seen.depth, frame.near);
        let opacity = select(0.0f, brightness * across.y * along.y, is_seen);
        flame_discs[at * FLAME_STEPS + age] = FlameDisc(
            vec4<u32>(
                bits_of(seen.x), bits_of(seen.y), bits_of(reciprocal(across.x)), bits_of(reciprocal(along.x)),
            ),
            bits_of_four(vec4<f32>(look.center.xyz, look.center.w * opacity)),
            bits_of_four(vec4<f32>(look.rim.xyz, look.rim.w * opacity)),
        );
        if is_seen {
            let first = vec2<i32>(to_i32(seen.x - across.x), to_i32(seen.y - along.x));
            let last = vec2<i32>(to_i32(seen.x + across.x) + 1, to_i32(seen.y + along.x) + 1);
            low = min(low, first);
            high = max(high, last);
        }
    }
    low = max(low, vec2<i32>(0, 0));
    high = min(high, size);
    let is_some = low.x < high.x && low.y < high.y;
    let bounds = vec4<u32>(vec2<u32>(low), vec2<u32>(high));
    flame_bounds[at] = select(vec4<u32>(0u), bounds, is_some);
}
