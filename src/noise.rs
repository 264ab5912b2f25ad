//! Band-limited noise in three dimensions with its exact gradient, the twin of `wgsl/lib/noise.wgsl`:
//! simplex noise (Perlin, "Noise Hardware", SIGGRAPH course notes 2001), the small-scale wind of
//! Perry (1994), 3.2.3.

use glam::{Vec3, Vec4};

use crate::exact::{at_least_zero, floor_exact, less, low_bits, shared_constants};

shared_constants! {
    /// Simplices a unit.
    pub const CELLS_PER_UNIT: f32 = 0.5;
    /// From places to the grid of cubes that simplices are cut from, and back.
    const SKEW: f32 = 0.333_333_34;
    const UNSKEW: f32 = 0.166_666_67;
    /// Kernels end at the square root of this.
    const REACH_SQUARED: f32 = 0.5;
    /// Makes the root mean square of the gradient 1, as measured.
    const GRADIENT_GAIN: f32 = 143.064_65;
    /// Gradients repeat after so many cells, less one.
    pub const CELL_MASK: u32 = 4095;
    const CELL_X: u32 = 0x8da6_b343;
    const CELL_Y: u32 = 0xd816_3841;
    const CELL_Z: u32 = 0xcb1a_b31f;
    const ROUND_A: u32 = 0x21f0_aaad;
    const ROUND_B: u32 = 0x735a_2d97;
    const ONE_BITS: u32 = 0x3f80_0000;
    const GRADIENT_MIDDLE: f32 = 1.499_511_7;
}

/// The noise repeats after this many units along each axis: offsets may be taken modulo it.
/// Skewing maps this many units to whole periods of [`CELL_MASK`] + 1 cells along all axes.
pub const PERIOD: f64 = 24_576.0;

/// What a cell's coordinates add to the hash of its corner.
#[inline(always)]
fn hash_share([x, y, z]: [u32; 3]) -> [u32; 3] {
    [
        (x & CELL_MASK).wrapping_mul(CELL_X),
        (y & CELL_MASK).wrapping_mul(CELL_Y),
        (z & CELL_MASK).wrapping_mul(CELL_Z),
    ]
}

/// The random gradient of a corner: components symmetric around zero, at most a half.
#[inline]
pub fn corner_gradient(x: u32, y: u32, z: u32, key: u32) -> Vec3 {
    gradient_of(hash_share([x, y, z]), key)
}

#[inline(always)]
fn gradient_of(share: [u32; 3], key: u32) -> Vec3 {
    let mut h = share.iter().fold(key, |sum, part| sum.wrapping_add(*part));
    h = (h ^ (h >> 16)).wrapping_mul(ROUND_A);
    h = (h ^ (h >> 15)).wrapping_mul(ROUND_B);
    h ^= h >> 15;
    Vec3::new(
        f32::from_bits(((h << 13) & 0x007f_e000) | ONE_BITS) - GRADIENT_MIDDLE,
        f32::from_bits(((h << 3) & 0x007f_e000) | ONE_BITS) - GRADIENT_MIDDLE,
        f32::from_bits(((h >> 7) & 0x007f_e000) | ONE_BITS) - GRADIENT_MIDDLE,
    )
}

/// What a corner adds, seen from it at `d`: the gradient and the value.
#[inline(always)]
fn from_corner(slope: Vec3, d: Vec3) -> (Vec3, f32) {
    let t = at_least_zero(REACH_SQUARED - (d.x * d.x + d.y * d.y + d.z * d.z));
    let t2 = t * t;
    let t4 = t2 * t2;
    let rise = slope.x * d.x + slope.y * d.y + slope.z * d.z;
    let inward = -8.0 * (t2 * t) * rise;
    (t4 * slope + inward * d, t4 * rise)
}

/// The gradient of the noise at `p`, per unit of `p`, and its value in w. `key` says which noise.
///
/// The root mean square of the gradient is 1, the value's standard deviation 0.2582.
#[inline]
pub fn noise(p: Vec3, key: u32) -> Vec4 {
    let (gradient, value) = gradient_and_value(p, key);
    gradient.extend(value)
}

/// What [`noise`] has in one vector, as numbers: loops over several places are vectorised, as long as
/// all of this is in them and nothing in it is a vector or a branch.
#[inline(always)]
pub(crate) fn gradient_and_value(p: Vec3, key: u32) -> (Vec3, f32) {
    let q = p * CELLS_PER_UNIT;
    let skew = (q.x + q.y + q.z) * SKEW;
    let skewed = Vec3::new(q.x + skew, q.y + skew, q.z + skew);
    let cell = Vec3::new(
        floor_exact(skewed.x),
        floor_exact(skewed.y),
        floor_exact(skewed.z),
    );
    let unskew = (cell.x + cell.y + cell.z) * UNSKEW;
    let d = q - (cell - Vec3::splat(unskew));
    let x = low_bits(cell.x);
    let y = low_bits(cell.y);
    let z = low_bits(cell.z);
    // The axes in descending order of d are those that the corners are reached by.
    let x_over_y = !less(d.x, d.y);
    let y_over_z = !less(d.y, d.z);
    let x_over_z = !less(d.x, d.z);
    // No short circuits: they would be branches that nobody foretells.
    let second = [
        x_over_y & x_over_z,
        !x_over_y & y_over_z,
        !x_over_z & !y_over_z,
    ];
    let third = [
        x_over_y | x_over_z,
        !x_over_y | y_over_z,
        !x_over_z | !y_over_z,
    ];
    let here = hash_share([x, y, z]);
    let beyond = hash_share([x, y, z].map(|at| at.wrapping_add(1)));
    let corner = |steps: [bool; 3]| {
        let share = std::array::from_fn(|axis| {
            if steps[axis] {
                beyond[axis]
            } else {
                here[axis]
            }
        });
        gradient_of(share, key)
    };
    let to = |steps: [bool; 3]| Vec3::from(steps.map(|step| if step { 1.0 } else { 0.0 }));
    let (slope_a, a) = from_corner(corner([false; 3]), d);
    let (slope_b, b) = from_corner(corner(second), (d - to(second)) + Vec3::splat(UNSKEW));
    let (slope_c, c) = from_corner(corner(third), (d - to(third)) + Vec3::splat(SKEW));
    let (slope_d, d) = from_corner(corner([true; 3]), d - Vec3::splat(0.5));
    let slope = (slope_a + slope_b) + (slope_c + slope_d);
    let value = (a + b) + (c + d);
    (
        slope * (GRADIENT_GAIN * CELLS_PER_UNIT),
        value * GRADIENT_GAIN,
    )
}
