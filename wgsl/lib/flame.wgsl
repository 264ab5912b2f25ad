// Where a flame stands, and how its particle moves.
//
// Perry 1994, 3.2.3 and 3.4: the particle starts at the root along the surface's normal; the wind
// changes its velocity in each step, u = -k_g g + w_L + w_S, by explicit Euler steps of mass 1. The
// small-scale wind w_S = (height above the root) C N (equation 3.1) has its height counted in steps
// of the flame, and N is the gradient of a noise at k_p p - k_s T j. The root's own motion is wind
// from ahead.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/flame.rs.
#define_import_path motes::flame

#import motes::exact::{
    clamp3, cross3, dot3, f32_of_u32, less, max_exact, normalize_exact, reciprocal, square_root,
}
#import motes::layout::{FIRE_NORMALISED, FireFrame, ROOTS_CIRCLE, ROOTS_DISC, ROOTS_LINE}
#import motes::noise::noise
#import motes::rng::{pcg4d, signed_float, unit_float}
#import motes::transcendental::{cos_turns, sin_turns}

// Tells the draws of flames from others, whose second word is a frame.
const FLAME_TAG: u32 = 0x666c616du;
// Streams of the hash: the root; height and width; the way along a ceiling.
const STREAM_ROOT: u32 = 0u;
const STREAM_SHAPE: u32 = 1u;
const STREAM_CEILING: u32 = 2u;
// The least height and width.
const LEAST_EXTENT: f32 = 0.000001f;
// The square of the least speed that has a direction.
const LEAST_SPEED_SQUARED: f32 = 1e-12f;
// How far a flame that a ceiling stops is pushed aside.
const NUDGE: f32 = 0.001f;
// Faster along any axis is no particle: noise may grow with what it moves.
const MOST_SPEED: f32 = 1000000.0f;

fn flame_draw(fire: FireFrame, index: u32, stream: u32) -> vec4<u32> {
    return pcg4d(vec4<u32>(fire.kinds.y, FLAME_TAG, index, stream));
}

// Where the flame `nth` of those that are not listed stands, on what is no mesh; `place` is random.
fn root_on(fire: FireFrame, nth: u32, place: vec4<u32>) -> vec3<f32> {
    let kind = fire.kinds.x;
    let extent = fire.roots.x;
    let n = f32_of_u32(nth);
    let on_disc = kind == ROOTS_DISC;
    let turns = select(n * fire.roots.y, unit_float(place.y), on_disc);
    let distance = extent * select(1.0f, square_root(unit_float(place.x)), on_disc);
    let around = vec3<f32>(distance * cos_turns(turns), 0.0f, distance * sin_turns(turns));
    let along = vec3<f32>(extent * ((n + 0.5f) * fire.roots.y - 0.5f), 0.0f, 0.0f);
    return select(along, around, kind == ROOTS_CIRCLE || on_disc);
}

// Height and width of the flame, before what is its own.
fn extents_of(fire: FireFrame, index: u32) -> vec2<f32> {
    let random = flame_draw(fire, index, STREAM_SHAPE);
    let height = fire.extents.x + signed_float(random.x) * fire.extents.y;
    let width = fire.extents.z + signed_float(random.y) * fire.extents.w;
    return vec2<f32>(max_exact(height, LEAST_EXTENT), max_exact(width, LEAST_EXTENT));
}

// How much of its size a flame has that was kindled `age` frames ago: less when it begins and ends.
fn growth_of(fire: FireFrame, age: i32) -> f32 {
    let frames = fire.times.w;
    if frames == 0u {
        return 1.0f;
    }
    var least = u32(age) + 1u;
    if fire.times.z > 0u {
        least = min(least, fire.times.z - u32(age));
    }
    return f32_of_u32(min(least, frames)) * reciprocal(f32_of_u32(frames));
}

// Whether a flame burns that was kindled `age` frames ago.
fn burns_at(fire: FireFrame, age: i32) -> bool {
    return age >= 0 && (fire.times.z == 0u || u32(age) < fire.times.z);
}

// What a particle is in: its place, and its velocity in steps.
struct Along {
    position: vec3<f32>,
    velocity: vec3<f32>,
}

// w_S at the place `p` of a flame of that height with its root there.
fn small_wind(fire: FireFrame, p: vec3<f32>, root: vec3<f32>, inverse_height: f32) -> vec3<f32> {
    let above = dot3(p - root, fire.rise.xyz) * inverse_height;
    let at = p * fire.noise.w + fire.noise.xyz;
    return noise(at, fire.kinds.z).xyz * (above * fire.motion.x);
}

// A velocity of length 1. Where the wind stops the particle, as below a ceiling, it goes where the
// wind does along the surface, and where that does not blow, on and a little aside.
fn of_length_one(fire: FireFrame, next: vec3<f32>, before: vec3<f32>, wind: vec3<f32>, normal: vec3<f32>, index: u32) -> vec3<f32> {
    var way = next;
    if is_stopped(next) {
        way = wind - normal * dot3(wind, normal);
        if is_stopped(way) {
            let random = flame_draw(fire, index, STREAM_CEILING);
            let turns = unit_float(random.x);
            let z = signed_float(random.y);
            let ring = square_root(1.0f - z * z);
            let any = vec3<f32>(ring * cos_turns(turns), ring * sin_turns(turns), z);
            way = before + normalize_exact(cross3(normal, any)) * NUDGE;
        }
    }
    return normalize_exact(way);
}

// Whether velocities have length 1.
fn is_normalised(fire: FireFrame) -> bool {
    return (fire.kinds.w & FIRE_NORMALISED) != 0u;
}

// One step through the wind u before velocities are normalised: the place by the velocity, then the velocity
// by the wind.
fn moved(fire: FireFrame, from_here: Along, wind: vec3<f32>, height: f32) -> Along {
    let position = from_here.position + from_here.velocity * (height * fire.motion.w);
    let velocity = from_here.velocity + wind;
    return Along(position, clamp3(velocity, vec3<f32>(-MOST_SPEED), vec3<f32>(MOST_SPEED)));
}

// Whether the wind stops the particle so that its velocity has no direction.
fn is_stopped(velocity: vec3<f32>) -> bool {
    return less(dot3(velocity, velocity), LEAST_SPEED_SQUARED);
}

// One step through the wind u.
fn stepped(fire: FireFrame, from_here: Along, wind: vec3<f32>, height: f32, normal: vec3<f32>, index: u32) -> Along {
    let next = moved(fire, from_here, wind, height);
    var velocity = next.velocity;
    if is_normalised(fire) {
        velocity = of_length_one(fire, velocity, from_here.velocity, wind, normal, index);
    }
    return Along(next.position, velocity);
}

// Whether the places are told that the point lights' are counted from.
fn tells_roots(fire: FireFrame) -> bool {
    return fire.faces.z == 1u;
}

// The flame whose root a point light's place is counted from: one of every so many.
fn light_seed(fire: FireFrame, light: u32) -> u32 {
    return fire.members.x + (2u * light + 1u) * fire.members.y / (2u * fire.lights.y);
}
