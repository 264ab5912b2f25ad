// Band-limited noise in three dimensions with its exact gradient.
//
// Simplex noise (Perlin, "Noise Hardware", SIGGRAPH course notes 2001): each corner of the simplex
// around a point adds the slope of its own random gradient under a kernel that is smooth and ends
// within the neighbouring simplices, so the gradient is a sum of four polynomials and the noise
// has no seams. Perry 1994, 3.2.3, asks for the gradient of such a noise as small-scale wind.
// Measured on lavapipe, noise on a cubic lattice (bench/noise_lattice) costs the same; simplices
// have no preferred axes. Its power lies between 1/4 and 2 cycles a unit; the root mean square of its gradient is 1.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/noise.rs.
#define_import_path motes::noise

#import motes::exact::{at_least_zero, floor_exact, less, low_bits}

// Simplices a unit.
const CELLS_PER_UNIT: f32 = 0.5f;
// From places to the grid of cubes that simplices are cut from, and back.
const SKEW: f32 = 0.333333333f;
const UNSKEW: f32 = 0.166666667f;
// Kernels end at the square root of this.
const REACH_SQUARED: f32 = 0.5f;
// Makes the root mean square of the gradient 1, as measured.
const GRADIENT_GAIN: f32 = 143.06465f;
// Gradients repeat after so many cells, less one.
const CELL_MASK: u32 = 4095u;
// Large odd numbers, one an axis, and the rounds of an integer hash.
const CELL_X: u32 = 0x8da6b343u;
const CELL_Y: u32 = 0xd8163841u;
const CELL_Z: u32 = 0xcb1ab31fu;
const ROUND_A: u32 = 0x21f0aaadu;
const ROUND_B: u32 = 0x735a2d97u;
// The bits of 1.0, and what makes the numbers from 1 to 2 - 2^-10 in steps of 2^-10 symmetric.
const ONE_BITS: u32 = 0x3f800000u;
const GRADIENT_MIDDLE: f32 = 1.49951171875f;

// What a cell's coordinates add to the hash of its corner.
fn hash_share(x: u32, y: u32, z: u32) -> vec3<u32> {
    return vec3<u32>(
        (x & CELL_MASK) * CELL_X, (y & CELL_MASK) * CELL_Y, (z & CELL_MASK) * CELL_Z,
    );
}

// The random gradient of a corner: components symmetric around zero, at most a half.
fn corner_gradient(x: u32, y: u32, z: u32, key: u32) -> vec3<f32> {
    return gradient_of(hash_share(x, y, z), key);
}

fn gradient_of(share: vec3<u32>, key: u32) -> vec3<f32> {
    var h = share.x + share.y + share.z + key;
    h = (h ^ (h >> 16u)) * ROUND_A;
    h = (h ^ (h >> 15u)) * ROUND_B;
    h ^= h >> 15u;
    return vec3<f32>(
        bitcast<f32>(((h << 13u) & 0x7fe000u) | ONE_BITS) - GRADIENT_MIDDLE,
        bitcast<f32>(((h << 3u) & 0x7fe000u) | ONE_BITS) - GRADIENT_MIDDLE,
        bitcast<f32>(((h >> 7u) & 0x7fe000u) | ONE_BITS) - GRADIENT_MIDDLE,
    );
}

// What a corner adds, seen from it at `d`: the gradient, and the value in w.
fn from_corner(slope: vec3<f32>, d: vec3<f32>) -> vec4<f32> {
    let t = at_least_zero(REACH_SQUARED - (d.x * d.x + d.y * d.y + d.z * d.z));
    let t2 = t * t;
    let t4 = t2 * t2;
    let rise = slope.x * d.x + slope.y * d.y + slope.z * d.z;
    let inward = -8.0f * (t2 * t) * rise;
    return vec4<f32>(t4 * slope + inward * d, t4 * rise);
}

// The gradient of the noise at `p`, and its value in w. `key` says which noise.
fn noise(p: vec3<f32>, key: u32) -> vec4<f32> {
    let q = p * CELLS_PER_UNIT;
    let skew = (q.x + q.y + q.z) * SKEW;
    let skewed = vec3<f32>(q.x + skew, q.y + skew, q.z + skew);
    let cell = vec3<f32>(floor_exact(skewed.x), floor_exact(skewed.y), floor_exact(skewed.z));
    let unskew = (cell.x + cell.y + cell.z) * UNSKEW;
    let d = q - (cell - unskew);
    let x = low_bits(cell.x);
    let y = low_bits(cell.y);
    let z = low_bits(cell.z);
    let here = hash_share(x, y, z);
    let beyond = hash_share(x + 1u, y + 1u, z + 1u);
    // The axes in descending order of d are those that the corners are reached by.
    let x_over_y = !less(d.x, d.y);
    let y_over_z = !less(d.y, d.z);
    let x_over_z = !less(d.x, d.z);
    let second_x = x_over_y && x_over_z;
    let second_y = !x_over_y && y_over_z;
    let second_z = !x_over_z && !y_over_z;
    let third_x = x_over_y || x_over_z;
    let third_y = !x_over_y || y_over_z;
    let third_z = !x_over_z || !y_over_z;
    let second = vec3<bool>(second_x, second_y, second_z);
    let third = vec3<bool>(third_x, third_y, third_z);
    let to_second = select(vec3<f32>(0.0f), vec3<f32>(1.0f), second);
    let to_third = select(vec3<f32>(0.0f), vec3<f32>(1.0f), third);
    let near_corners = from_corner(gradient_of(here, key), d)
        + from_corner(
            gradient_of(select(here, beyond, second), key), (d - to_second) + UNSKEW,
        );
    let far_corners = from_corner(
            gradient_of(select(here, beyond, third), key), (d - to_third) + SKEW,
        )
        + from_corner(gradient_of(beyond, key), d - 0.5f);
    let sum = near_corners + far_corners;
    // By the chain rule, the gradient carries the cells a unit, which the value does not.
    return vec4<f32>(sum.xyz * (GRADIENT_GAIN * CELLS_PER_UNIT), sum.w * GRADIENT_GAIN);
}
