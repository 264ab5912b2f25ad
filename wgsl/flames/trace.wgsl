// trace: the trajectories of flames through this frame's wind.
//
// Perry 1994, 3.2.2 and 3.2.3: a flame is the whole trajectory of one particle, 25 steps, all in the
// wind of one moment, as a long exposure shows it. One invocation a flame.
// Reads: frame, fires, flames, winds. Writes: flame_steps (x, y, z as bits; w unused).
// Invariant: no flame looks at another; those that do not burn stay at their roots.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, max_exact, normalize_exact, reciprocal}
#import motes::flame::{Along, LEAST_EXTENT, is_normalised, is_stopped, moved, small_wind, stepped}
#import motes::layout::{FLAME_STEPS, FireFrame, Flame, Frame, Wind}
#import motes::wind::{Kinds, wind_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether the wind has such parts.
const MANY_WINDS: bool = #{MANY_WINDS};
const FLOWS: bool = #{FLOWS};
const NOISES: bool = #{NOISES};
const OCTAVES: bool = #{OCTAVES};
const FOLDS: bool = #{FOLDS};
const CURLS: bool = #{CURLS};

struct Work {
    // Flames of a page, and the first of them among all.
    flame_count: u32,
    first: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> flames: array<Flame>;
@group(0) @binding(3) var<storage, read> winds: array<Wind>;
@group(0) @binding(4) var<storage, read_write> flame_steps: array<vec4<u32>>;

// w_L at the place `p`.
fn large_wind(lone_wind: Wind, p: vec3<f32>) -> vec3<f32> {
    var flow = vec3<f32>(0.0f);
    let has = Kinds(FLOWS, NOISES, OCTAVES, FOLDS, CURLS);
    if MANY_WINDS {
        for (var at = 0u; at < frame.wind_count; at += 1u) {
            flow += wind_of(winds[at], p, has);
        }
    } else if frame.wind_count == 1u {
        flow = wind_of(lone_wind, p, has);
    }
    return flow;
}

// A flame with what does not change along it.
struct Traced {
    root: vec3<f32>,
    motion: vec3<f32>,
    inverse_height: f32,
}

// u at the place `p` of a flame.
fn wind_along(lone_wind: Wind, fire: FireFrame, flame: Traced, p: vec3<f32>) -> vec3<f32> {
    let rise = fire.rise.xyz * fire.rise.w;
    let flow = (large_wind(lone_wind, p) - flame.motion) * fire.motion.y;
    return rise + flow + small_wind(fire, p, flame.root, flame.inverse_height);
}

fn write_step(at: u32, age: u32, p: vec3<f32>) {
    flame_steps[at * FLAME_STEPS + age] = vec4<u32>(bits_of(p.x), bits_of(p.y), bits_of(p.z), 0u);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn trace(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let lone_wind = winds[0];
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= work.flame_count {
        return;
    }
    let flame = flames[work.first + at];
    let fire = fires[flame.root_and_fire.w];
    let index = flame.motion_and_index.w;
    let root = bitcast<vec3<f32>>(flame.root_and_fire.xyz);
    let normal = bitcast<vec3<f32>>(flame.normal_and_birth.xyz);
    let motion = bitcast<vec3<f32>>(flame.motion_and_index.xyz);
    let burns = flame.look.w == 1u;
    let height = select(0.0f, bitcast<f32>(flame.look.x), burns);
    let traced = Traced(root, motion, reciprocal(max_exact(height, LEAST_EXTENT)));
    let start = Along(root, normal * fire.motion.z);
    let has_length_one = is_normalised(fire);
    var stops = false;
    var here = start;
    for (var age = 0u; age < FLAME_STEPS; age += 1u) {
        write_step(at, age, here.position);
        let next = moved(fire, here, wind_along(lone_wind, fire, traced, here.position), height);
        stops = stops || (has_length_one && is_stopped(next.velocity));
        let velocity = select(next.velocity, normalize_exact(next.velocity), has_length_one);
        here = Along(next.position, velocity);
    }
    // Software drivers run both sides of a branch in every turn of a loop, so what few flames need, where
    // the wind stops the particle, is in a loop of its own, which none enters that goes on.
    here = start;
    for (var age = select(FLAME_STEPS, 0u, stops); age < FLAME_STEPS; age += 1u) {
        write_step(at, age, here.position);
        let wind = wind_along(lone_wind, fire, traced, here.position);
        here = stepped(fire, here, wind, height, normal, index);
    }
}
