// The noise that was not taken, to be measured against the one that was: gradients on a cubic
// lattice, blended by quintics.
//
// Perlin, "Improving Noise", SIGGRAPH 2002, with gradients from a hash and an analytic gradient.
// One invocation a sample. Reads: source. Writes: destination.
// Invariant: as much is read and written as by bench/copy, and the same samples are taken as by
// bench/noise_simplex.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, f32_of_u32, floor_exact, to_i32}
#import motes::layout::Particle
#import motes::noise::corner_gradient

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read> source: array<Particle>;
@group(0) @binding(1) var<storage, read_write> destination: array<Particle>;

fn fade(t: vec3<f32>) -> vec3<f32> {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

fn fade_slope(t: vec3<f32>) -> vec3<f32> {
    return 30.0f * t * t * (t * (t - 2.0f) + 1.0f);
}

fn corner(x: u32, y: u32, z: u32, key: u32, d: vec3<f32>) -> vec4<f32> {
    let slope = corner_gradient(x, y, z, key);
    return vec4<f32>(slope, slope.x * d.x + slope.y * d.y + slope.z * d.z);
}

fn sample(p: vec3<f32>, key: u32) -> vec4<f32> {
    let cell = vec3<f32>(floor_exact(p.x), floor_exact(p.y), floor_exact(p.z));
    let d = p - cell;
    let x = u32(to_i32(cell.x));
    let y = u32(to_i32(cell.y));
    let z = u32(to_i32(cell.z));
    let u = fade(d);
    let du = fade_slope(d);
    let a = corner(x, y, z, key, d);
    let b = corner(x + 1u, y, z, key, d - vec3<f32>(1.0f, 0.0f, 0.0f));
    let c = corner(x, y + 1u, z, key, d - vec3<f32>(0.0f, 1.0f, 0.0f));
    let e = corner(x + 1u, y + 1u, z, key, d - vec3<f32>(1.0f, 1.0f, 0.0f));
    let f = corner(x, y, z + 1u, key, d - vec3<f32>(0.0f, 0.0f, 1.0f));
    let g = corner(x + 1u, y, z + 1u, key, d - vec3<f32>(1.0f, 0.0f, 1.0f));
    let h = corner(x, y + 1u, z + 1u, key, d - vec3<f32>(0.0f, 1.0f, 1.0f));
    let i = corner(x + 1u, y + 1u, z + 1u, key, d - 1.0f);
    // Along x, then y, then z; differences across each axis give that axis its slope.
    let ab = a + (b - a) * u.x;
    let ce = c + (e - c) * u.x;
    let fg = f + (g - f) * u.x;
    let hi = h + (i - h) * u.x;
    let low = ab + (ce - ab) * u.y;
    let high = fg + (hi - fg) * u.y;
    let all = low + (high - low) * u.z;
    let across_x_low = (b.w - a.w) + ((e.w - c.w) - (b.w - a.w)) * u.y;
    let across_x_high = (g.w - f.w) + ((i.w - h.w) - (g.w - f.w)) * u.y;
    let across_x = across_x_low + (across_x_high - across_x_low) * u.z;
    let across_y = (ce.w - ab.w) + ((hi.w - fg.w) - (ce.w - ab.w)) * u.z;
    let slope = all.xyz + vec3<f32>(across_x * du.x, across_y * du.y, (high.w - low.w) * du.z);
    return vec4<f32>(slope, all.w);
}

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn noise_lattice(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= records.count {
        return;
    }
    let from_words = source[at].position_and_index;
    // Random words below 2^20, in steps of 2^-10: places all over the noise.
    let place = vec3<f32>(
        f32_of_u32(from_words.x >> 12u),
        f32_of_u32(from_words.y >> 12u),
        f32_of_u32(from_words.z >> 12u),
    ) * 0.0009765625f;
    let sum = sample(place, 1u);
    let words = vec4<u32>(bits_of(sum.x), bits_of(sum.y), bits_of(sum.z), bits_of(sum.w));
    destination[at] = Particle(words, source[at].velocity_and_birth);
}
