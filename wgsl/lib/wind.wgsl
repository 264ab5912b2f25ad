// The wind field: u = -k_g g + w_L + w_S, the sum of the parts that a scene lists.
//
// Perry 1994, 3.2.3: buoyancy against gravity, a large-scale wind and a small-scale one that is the
// gradient of a band-limited noise. Small scales add octaves whose power falls as 1/f^beta (2.1.2,
// after Perlin) and have a scale of their own along each axis (Sakas and Westermann).
// A curl is the product of two gradients; its place holds weights, one an axis, that keep it from
// diverging where axes have scales of their own. A vortex is that of Scully, a source the
// potential flow out of a point, both without the pole.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/wind.rs.
#define_import_path motes::wind

#import motes::exact::{cross3, dot3, inverse_square_root, less}
#import motes::layout::{
    WIND_ATTRACTOR, WIND_CURL, WIND_NOISE, WIND_SOURCE, WIND_VORTEX, Wind,
}
#import motes::noise::noise

// Makes the second noise of a curl another than the first.
const CURL_KEY: u32 = 0x9e3779b9u;
// Makes each octave another noise.
const OCTAVE_KEY: u32 = 0x85ebca6bu;

// Where the world place `p` is in the noise.
fn in_noise(wind: Wind, p: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        p.x * wind.scale.x + wind.offset.x,
        p.y * wind.scale.y + wind.offset.y,
        p.z * wind.scale.z + wind.offset.z,
    );
}

// The gradient of one octave, `weight` times, at a place of the noise.
fn octave_at(wind: Wind, at: vec3<f32>, key: u32, weight: f32, folds: bool) -> vec3<f32> {
    let sample = noise(at, key);
    if !folds {
        return sample.xyz * weight;
    }
    let folded = (wind.kinds.w == 1u) & less(sample.w, 0.0f);
    return sample.xyz * select(weight, -weight, folded);
}

// The gradient of `octaves` octaves of noise at the world place `p`.
fn turbulence(
    wind: Wind, p: vec3<f32>, octaves: u32, first_key: u32, folds: bool,
) -> vec3<f32> {
    var at = in_noise(wind, p);
    var key = first_key;
    var weight = 1.0f;
    var sum = vec3<f32>(0.0f);
    for (var octave = 0u; octave < octaves; octave += 1u) {
        sum += octave_at(wind, at, key, weight, folds);
        at = at * 2.0f;
        weight *= wind.scale.w;
        key += OCTAVE_KEY;
    }
    return sum;
}

// What parts of the wind there are: flows around or out of a place, noises, noises of more than
// one octave, of absolute values, curls.
struct Kinds {
    flows: bool,
    noises: bool,
    octaves: bool,
    folds: bool,
    curls: bool,
}

// As turbulence, of at most one octave where there are no more: loops are slow on software drivers.
fn gradient(wind: Wind, p: vec3<f32>, count: u32, key: u32, has: Kinds) -> vec3<f32> {
    if has.octaves {
        return turbulence(wind, p, count, key, has.folds);
    }
    return octave_at(wind, in_noise(wind, p), key, 1.0f, has.folds);
}

// What a flow around or out of a place adds at the world place `p`; else what is the same everywhere.
fn flow_of(wind: Wind, p: vec3<f32>) -> vec3<f32> {
    let kind = wind.kinds.x;
    let radius = wind.place.w;
    let strength = wind.aim.w;
    let away = p - wind.place.xyz;
    let around = cross3(wind.aim.xyz, away);
    let inverse_distance = inverse_square_root(dot3(away, away) + radius * radius);
    let inverse_swirl = inverse_square_root(dot3(around, around) + radius * radius);
    let swirl = 2.0f * radius * strength * inverse_swirl * inverse_swirl;
    let outflow = strength * inverse_distance * inverse_distance * inverse_distance;
    var flow = wind.aim.xyz;
    flow = select(flow, around * swirl, kind == WIND_VORTEX);
    flow = select(flow, away * outflow, kind == WIND_SOURCE);
    return select(flow, away * (-strength * inverse_distance), kind == WIND_ATTRACTOR);
}

// What one part adds to the wind at the world place `p`. Drivers that run all branches run no
// loop that no invocation enters: kinds without noise ask for no octaves.
fn wind_of(wind: Wind, p: vec3<f32>, has: Kinds) -> vec3<f32> {
    let kind = wind.kinds.x;
    let strength = wind.aim.w;
    var flow = wind.aim.xyz;
    if has.flows {
        flow = flow_of(wind, p);
    }
    if !has.noises {
        return flow;
    }
    let first = gradient(wind, p, wind.kinds.y, wind.kinds.z, has);
    flow = select(flow, first * strength, kind == WIND_NOISE);
    if has.curls {
        let second_octaves = select(0u, wind.kinds.y, kind == WIND_CURL);
        let second_key = wind.kinds.z ^ CURL_KEY;
        let second = gradient(wind, p, second_octaves, second_key, has);
        let curl = cross3(first, second);
        let weights = wind.place.xyz;
        let swirling = vec3<f32>(curl.x * weights.x, curl.y * weights.y, curl.z * weights.z);
        flow = select(flow, swirling * strength, kind == WIND_CURL);
    }
    return flow;
}
