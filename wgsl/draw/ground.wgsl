// ground: a plane behind everything, in the light of flames.
//
// Perry 1994, 3.2.4: flames light surfaces through point lights. The light of each falls with the
// squared distance and the slant; pillars stand in its way. They are seen themselves before it
// (draw/surface).
// One invocation a pixel: the line of sight meets the plane, or not.
// Reads: frame, grounds, pillars, lamps, flame_lights, cluster_lights. Writes: ground_pixels (red, green, blue and
// what shows of what is behind, as bits).
// Invariant: a pixel depends on the frame, the surfaces and the lights alone.

#import motes::cluster::{fallen, way_to}
#import motes::dispatch::linear_index
#import motes::exact::{
    at_least_zero, bits_of, clamp_unit, dot3, f32_of_u32, inverse_square_root, less, reciprocal,
}
#import motes::layout::{FlameLight, Frame, Ground, Lamp, Pillar}
#import motes::noise::noise
#import motes::pillar::passed

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether there is a pillar.
const PILLARS: bool = #{PILLARS};
// Whether particles, lamps and flames throw light.
const CLUSTERS: bool = #{CLUSTERS};
const LAMPS: bool = #{LAMPS};
const LIGHTS: bool = #{LIGHTS};
// Whether there may be more lights of flames than are held.
const MOST_LIGHTS: bool = #{MOST_LIGHTS};
#if MORE_LIGHTS == true
const HELD: u32 = 32u;
#else
const HELD: u32 = 16u;
#endif
// Ways to the ground, in lengths of the way, at most.
const FARTHEST_GROUND: f32 = 1e6f;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> grounds: array<Ground>;
@group(0) @binding(2) var<storage, read> pillars: array<Pillar>;
@group(0) @binding(3) var<storage, read> lamps: array<Lamp>;
@group(0) @binding(4) var<storage, read> flame_lights: array<FlameLight>;
@group(0) @binding(5) var<storage, read_write> ground_pixels: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read> cluster_lights: array<FlameLight>;

// Lights of flames, loaded before the first branch, where software drivers load what is uniform once.
var<private> held_places: array<vec4<f32>, HELD>;
var<private> held_colors: array<vec3<f32>, HELD>;

fn hold_lights(count: u32) {
    for (var at = 0u; at < HELD; at += 1u) {
        let is_one = at < count;
        let flame = flame_lights[at];
        held_places[at] = select(vec4<f32>(1.0f), bitcast<vec4<f32>>(flame.place), is_one);
        held_colors[at] = select(vec3<f32>(0.0f), bitcast<vec3<f32>>(flame.color.xyz), is_one);
    }
}

// The light of a point light of that colour a unit away and that squared extent.
fn from_point(ground: Ground, spot: vec3<f32>, light: vec3<f32>, extent: f32, color: vec3<f32>) -> vec3<f32> {
    let away = light - spot;
    let near = inverse_square_root(dot3(away, away) + extent);
    var seen = at_least_zero(dot3(ground.plane.xyz, away) * near);
    if PILLARS {
        for (var at = 0u; at < ground.counts.x; at += 1u) {
            seen *= passed(pillars[at], spot, light);
        }
    }
    return color * (seen * near * near);
}

// The light of particles.
fn from_cluster(ground: Ground, spot: vec3<f32>, light: FlameLight) -> vec3<f32> {
    let way = way_to(light, spot, ground.plane.xyz);
    var falls = fallen(way, ground.plane.xyz);
    if PILLARS {
        for (var at = 0u; at < ground.counts.x; at += 1u) {
            falls *= passed(pillars[at], spot, spot + way);
        }
    }
    return bitcast<vec3<f32>>(light.color.xyz) * falls;
}

fn light_on(ground: Ground, spot: vec3<f32>) -> vec3<f32> {
    let straight = at_least_zero(dot3(ground.plane.xyz, ground.light_from.xyz));
    var light = ground.ambient.xyz + ground.light_color.xyz * straight;
    if LAMPS {
        for (var at = 0u; at < ground.kinds.z; at += 1u) {
            let lamp = lamps[at];
            let place = lamp.place.xyz + ground.lamps_from.xyz;
            light += from_point(ground, spot, place, 0.0f, lamp.color.xyz * lamp.place.w);
        }
    }
    if LIGHTS {
        for (var at = 0u; at < HELD; at += 1u) {
            let place = held_places[at];
            light += from_point(ground, spot, place.xyz, place.w, held_colors[at]);
        }
    }
    if MOST_LIGHTS {
        for (var at = HELD; at < ground.kinds.w; at += 1u) {
            let flame = flame_lights[at];
            let place = bitcast<vec4<f32>>(flame.place);
            let color = bitcast<vec3<f32>>(flame.color.xyz);
            light += from_point(ground, spot, place.xyz, place.w, color);
        }
    }
    if CLUSTERS {
        for (var at = 1u; at <= cluster_lights[0].place.x; at += 1u) {
            light += from_cluster(ground, spot, cluster_lights[at]);
        }
    }
    return light;
}

// The share of its colour that the ground has at a place: octaves of noise, those left out that are
// finer than `seen` there.
fn shade_at(ground: Ground, place: vec3<f32>, seen: f32) -> f32 {
    var sum = 0.0f;
    var scale = ground.light_from.w;
    var weight = ground.color.w;
    if ground.kinds.x > 0u {
        // A loop that looks at its end last: others are gone through once more by software drivers.
        var octave = 0u;
        loop {
            let clear = clamp_unit(2.0f - 2.0f * seen * scale);
            sum += noise(place * scale, ground.kinds.y + octave).w * (weight * clear);
            scale *= 2.0f;
            weight *= 0.6f;
            octave += 1u;
            continuing {
                break if octave >= ground.kinds.x;
            }
        }
    }
    return at_least_zero(1.0f + sum);
}

// Light of the plane where the way from the eye meets it, and how much of it is seen.
fn plane_at(ground: Ground, way: vec3<f32>, pixel: f32) -> vec4<f32> {
    let slant = dot3(way, ground.plane.xyz);
    let far = -ground.plane.w * reciprocal(slant);
    if !less(0.0f, far) || less(FARTHEST_GROUND, far) {
        return vec4<f32>(0.0f);
    }
    let place = ground.eye.xyz + way * far;
    let from_middle = place - ground.middle.xyz;
    let near = at_least_zero(1.0f - dot3(from_middle, from_middle) * ground.middle.w);
    let covered = select(0.0f, near * near, less(0.0f, ground.middle.w));
    if !less(0.0f, covered) {
        return vec4<f32>(0.0f);
    }
    let shade = shade_at(ground, place, abs(far * pixel * reciprocal(slant)));
    return vec4<f32>(ground.color.xyz * shade * light_on(ground, place), covered);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn ground(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let ground = grounds[0];
    if LIGHTS {
        hold_lights(ground.kinds.w);
    }
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= frame.width * frame.height {
        return;
    }
    let x = f32_of_u32(at % frame.width) + 0.5f;
    let y = f32_of_u32(at / frame.width) + 0.5f;
    let pixel = reciprocal(frame.focal_px);
    let way = frame.view_from_world_z.xyz
        + frame.view_from_world_x.xyz * ((x - frame.center_x_px) * pixel)
        + frame.view_from_world_y.xyz * ((frame.center_y_px - y) * pixel);
    let light = plane_at(ground, way, pixel);
    let sum = light.xyz * light.w;
    ground_pixels[at] = vec4<u32>(
        bits_of(sum.x), bits_of(sum.y), bits_of(sum.z), bits_of(1.0f - light.w),
    );
}
