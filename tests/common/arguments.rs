//! Arguments to evaluate functions of floats and words on: awkward ones, and random bit patterns.

use std::f32::consts::{FRAC_1_SQRT_2, SQRT_2};

use glam::{UVec4, Vec3, Vec4};
use motes::exact::snap;

use super::hash;

/// The arguments of one invocation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arguments {
    /// As they come from storage: finite and snapped. The last two stay near 1.
    pub(crate) a: f32,
    pub(crate) b: f32,
    pub(crate) c: f32,
    pub(crate) d: f32,
    /// Any float but NaN: denormals, zeros of both signs, infinities.
    pub(crate) p: f32,
    pub(crate) q: f32,
    /// Any 32 bits.
    pub(crate) w: u32,
    pub(crate) i: u32,
}

impl Arguments {
    pub(crate) fn f(&self) -> f32 {
        f32::from_bits(self.w)
    }

    pub(crate) fn abc(&self) -> Vec3 {
        Vec3::new(self.a, self.b, self.c)
    }

    pub(crate) fn dcb(&self) -> Vec3 {
        Vec3::new(self.d, self.c, self.b)
    }

    pub(crate) fn cdd(&self) -> Vec3 {
        Vec3::new(self.c, self.d, self.d)
    }

    pub(crate) fn raw4(&self) -> Vec4 {
        Vec4::new(self.p, self.q, self.f(), self.c)
    }

    pub(crate) fn words(&self) -> UVec4 {
        UVec4::new(self.w, self.i, self.a.to_bits(), self.c.to_bits())
    }
}

/// `count` sets of arguments: every pair of awkward values first, then random bit patterns.
pub(crate) fn arguments(count: u32) -> Vec<Arguments> {
    let awkward = awkward();
    let len = awkward.len() as u32;
    (0..count)
        .map(|at| {
            let random = |stream: u32| hash(at.wrapping_mul(16).wrapping_add(stream));
            let awkward = |index: u32| awkward[(index % len) as usize];
            let is_special = at < len * len;
            let raw = |stream: u32, index: u32| {
                let x = if is_special {
                    awkward(index)
                } else {
                    f32::from_bits(random(stream))
                };
                if x.is_nan() {
                    f32::from_bits(x.to_bits() & 0x803f_ffff)
                } else {
                    x
                }
            };
            let stored = |x: f32| snap(x.clamp(f32::MIN, f32::MAX));
            // Exponents -12 ..= 11 of 2, and multiples of 1/8: turns and powers of interest.
            let moderate = |stream: u32| {
                let word = random(stream);
                match word % 8 {
                    0 => (word >> 20) as f32 * 0.125 - 256.0,
                    _ => f32::from_bits(word & 0x807f_ffff | (115 + (word >> 3) % 24) << 23),
                }
            };
            let a = stored(raw(0, at / len));
            let next =
                |x: f32| f32::from_bits(x.to_bits().wrapping_add(random(1) % 3).wrapping_sub(1));
            Arguments {
                a,
                b: if is_special || random(2) % 2 == 0 {
                    stored(raw(3, at))
                } else {
                    stored(if a == 0.0 { 0.0 } else { next(a) })
                },
                c: moderate(4),
                d: moderate(5),
                p: raw(6, at / len),
                q: raw(7, at),
                w: if is_special {
                    awkward(at).to_bits()
                } else {
                    random(8)
                },
                i: match random(9) % 4 {
                    0 => (1 << 24) + random(10) % 5 - 2,
                    1 => (random(10) % 9).wrapping_sub(4) << (random(10) >> 27),
                    _ => random(10),
                },
            }
        })
        .collect()
}

/// Floats that trip conversions and comparisons.
fn awkward() -> Vec<f32> {
    let powers = [
        -149, -127, -126, -80, -41, -40, -39, -24, -1, 0, 1, 23, 24, 29, 30, 31, 32,
    ];
    let large = [39, 40, 41, 59, 60, 61, 79, 80, 81, 100, 126, 127];
    let positive = powers
        .into_iter()
        .chain(large)
        .map(|n: i32| 2f64.powi(n) as f32)
        .chain([FRAC_1_SQRT_2, SQRT_2])
        .flat_map(|x| [x.next_down(), x, x.next_up()])
        .chain([0.0, 0.5, 1.5, 2.5, 3.0, f32::MAX, f32::INFINITY, f32::NAN]);
    positive.flat_map(|x| [x, -x]).collect()
}

/// The arguments as the kernels read them.
pub(crate) fn words_of(arguments: &[Arguments]) -> Vec<u32> {
    arguments
        .iter()
        .flat_map(|r| {
            let floats = [r.a, r.b, r.c, r.d, r.p, r.q].map(f32::to_bits);
            floats.into_iter().chain([r.w, r.i])
        })
        .collect()
}
