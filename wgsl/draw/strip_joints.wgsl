// strip_joints: where the strips along flames bend.
//
// Perry 1994, 4.2: polygons erected around the trajectory. A strip faces the viewer: it is as wide as the
// flame's particles, and across the way from the joint before to the one behind. One invocation a flame.
// Reads: frame, fires, age_looks, flames, flame_steps, layer_planes. Writes: strip_joints.
// Invariant: what is not drawn is not seen at any joint.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, dot3, less, max_exact, reciprocal, square_root}
#import motes::fan::LEAST_HALF_AXIS_PX
#import motes::layout::{AgeLook, FIRE_STRIP, FLAME_STEPS, FireFrame, Flame, Frame, StripJoint}
#import motes::projection::project
#import motes::sprite::next_layer
#import motes::strip::{direction_of, overlap_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};
// Half-widths in pixels, at most.
const MOST_HALF_WIDTH_PX: f32 = 16384.0f;

struct Work {
    // Flames of a page, and the first of them among all.
    flame_count: u32,
    first: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> age_looks: array<AgeLook>;
@group(0) @binding(3) var<storage, read> flames: array<Flame>;
@group(0) @binding(4) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> strip_joints: array<StripJoint>;

// The layer, from 1, that a world place is in. No branch and no loop asks uniforms alone, see
// motes::sprite::next_layer.
fn layer_of(world: vec3<f32>) -> u32 {
    var layer = 0u;
    for (var at = 0u; (at < frame.layer_plane_count) & (layer == 0u); at += 1u) {
        let plane = layer_planes[at];
        layer = next_layer(layer, at, dot3(plane.xyz, world) - plane.w);
    }
    return select(layer, frame.layer_plane_count + 1u, layer == 0u);
}

fn place_of(flame: u32, age: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(flame_steps[flame * FLAME_STEPS + age].xyz);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn strip_joints_of(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= work.flame_count {
        return;
    }
    let flame = flames[work.first + at];
    let slot = flame.root_and_fire.w;
    let fire = fires[slot];
    let half_width = 0.5f * bitcast<f32>(flame.look.y);
    let here = !LAYERS || ((frame.layer == 0u)
        | (layer_of(bitcast<vec3<f32>>(flame.root_and_fire.xyz)) == frame.layer));
    let burns = here && flame.look.w == 1u && (fire.kinds.w & FIRE_STRIP) != 0u;
    var place = place_of(at, 0u);
    var seen = project(frame, place);
    var before = vec2<f32>(seen.x, seen.y);
    var spacing = 0.0f;
    for (var age = 0u; age < FLAME_STEPS; age += 1u) {
        let look = age_looks[slot * FLAME_STEPS + age];
        let is_last = age + 1u == FLAME_STEPS;
        let behind = place_of(at, min(age + 1u, FLAME_STEPS - 1u));
        let seen_behind = project(frame, behind);
        let apart = behind - place;
        spacing = select(square_root(dot3(apart, apart)), spacing, is_last);
        let way = direction_of(vec2<f32>(seen_behind.x - before.x, seen_behind.y - before.y));
        let wide = half_width * look.scale.x * seen.scale;
        let drawn = max_exact(wide, LEAST_HALF_AXIS_PX);
        let is_near = less(MOST_HALF_WIDTH_PX, drawn);
        let is_seen = burns && !is_near && !less(seen.depth, frame.near);
        let overlap = overlap_of(half_width * look.scale.y, spacing);
        let opacity = bitcast<f32>(flame.look.z) * (wide * reciprocal(drawn)) * overlap;
        strip_joints[at * FLAME_STEPS + age] = StripJoint(
            vec4<u32>(bits_of(seen.x), bits_of(seen.y), bits_of(way.x), bits_of(way.y)),
            vec4<u32>(bits_of(drawn), bits_of(opacity), select(0u, 1u, is_seen), bits_of(seen.depth)),
        );
        before = vec2<f32>(seen.x, seen.y);
        place = behind;
        seen = seen_behind;
    }
}
