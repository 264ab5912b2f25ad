//! The picture as linear light: what the sums of light are before they are clamped to bytes, through
//! the inverse of the sRGB curve (IEC 61966-2-1), which goes on above 1.
//!
//! Everything here is `+ - * /` and conversions, which IEEE 754 leaves no choice in: the same sums give
//! the same floats on every processor.

use rayon::prelude::*;

use super::{Simulation, SimulationError};
use crate::cpu::draw::resolve::{Behind, behind};
use crate::cpu::light::light_of;

/// Display-referred value up to which the curve is a line. It is where line and power meet, which the
/// standard rounds to 0.04045 and so leaves a step of 2.3e-9.
const LINE_END: f64 = 0.040_448_236_277_108_19;

/// Bits of a float whose fifth is added to a fifth of y's for a start value of y^(1/5), at most 3.5 % off.
const FIFTH_ROOT_START: u64 = 0x3325_d300_0000_0000;

impl Simulation {
    /// The image drawn last as linear light: red, green and blue of every pixel, rows from the top,
    /// `3 * width * height` values.
    ///
    /// Each is [`linear_of`] of v = background + light × exposure, or where something covers, of its
    /// colour × exposure, what shows of the background, and light × exposure. The byte of [`Simulation::image`] is
    /// v, clamped, times 255, to the nearest: v as it comes back out of the float gives the same byte,
    /// unless 255 v lies within 5e-5 of halfway between two (as a background of 0.1 does). Bits are the
    /// same on every exact adapter. Before the first drawing everything is 0.
    ///
    /// # Errors
    /// The machine fails.
    pub fn radiance(&mut self) -> Result<Vec<f32>, SimulationError> {
        let low = self.backend.read("light_low")?;
        let high = self.backend.read("light_high")?;
        let Some(frame) = self.drawn else {
            return Ok(vec![0.0; low.len()]);
        };
        let [rg, bt] = ["cover_rg", "cover_bt"].map(|name| self.backend.read(name));
        let (rg, bt) = (rg?, bt?);
        let (rg, bt) = (rg.as_chunks::<2>().0, bt.as_chunks::<2>().0);
        let [ground, planet] =
            ["ground_pixels", "planet_pixels"].map(|name| self.backend.read(name));
        let (ground, planet) = (ground?, planet?);
        let (ground, planet) = (ground.as_chunks::<4>().0, planet.as_chunks::<4>().0);
        let surface = self.backend.read("surface_pixels")?;
        let surface = surface.as_chunks::<4>().0;
        let value = |(at, (low, high)): (usize, (&u32, &u32))| {
            let covers = rg.get(at / 3).copied().zip(bt.get(at / 3).copied());
            // As `resolve` has it, so that bytes and floats are of the same value.
            let what = Behind {
                ground: ground.get(at / 3).copied(),
                planet: planet.get(at / 3).copied(),
                surface: surface.get(at / 3).copied(),
                covers,
            };
            let behind = behind(&frame, what, at % 3);
            linear_of(light_of(*low, *high) * frame.exposure + behind)
        };
        let limbs = low.par_iter().zip(&high).enumerate();
        Ok(limbs.with_min_len(1 << 12).map(value).collect())
    }
}

/// Linear light of a display-referred value, 0 or more, by the sRGB curve: 1 stays 1, and above it the
/// curve goes on. Never falls where `display` rises; within 0.51 ULP of the curve.
#[must_use]
pub fn linear_of(display: f32) -> f32 {
    let value = f64::from(display);
    if value <= LINE_END {
        return (value / 12.92) as f32;
    }
    // base^2.4 is base^2 · (base^(1/5))^2.
    let base = (value + 0.055) / 1.055;
    let root = base * fifth_root(base);
    (root * root) as f32
}

/// y^(1/5) for y of at least 2^-4, by Newton's method: each step squares the relative error and doubles it.
fn fifth_root(y: f64) -> f64 {
    let mut root = f64::from_bits(y.to_bits() / 5 + FIFTH_ROOT_START);
    for _ in 0..4 {
        let squared = root * root;
        root -= (root - y / (squared * squared)) / 5.0;
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The standard's formula, by the host's power.
    fn standard(display: f64) -> f64 {
        if display <= 0.04045 {
            display / 12.92
        } else {
            ((display + 0.055) / 1.055).powf(2.4)
        }
    }

    /// Values over the whole range, dense around the joint and 1.
    fn values() -> Vec<f32> {
        let near = |centre: f32| {
            let bits = centre.to_bits();
            (bits - 40_000..bits + 40_000).map(f32::from_bits)
        };
        let mut all: Vec<f32> = (0..0x5700_0000u32)
            .step_by(4001)
            .map(f32::from_bits)
            .chain(near(0.040_448_237))
            .chain(near(1.0))
            .collect();
        all.sort_by(f32::total_cmp);
        all
    }

    #[test]
    fn the_curve_is_the_standards_to_half_a_ulp() {
        let mut worst = 0.0f64;
        for display in values() {
            // Between the exact joint and the rounded one, the standard's line is off.
            if (0.04044..=0.04045).contains(&display) {
                continue;
            }
            let (got, wanted) = (linear_of(display), standard(f64::from(display)));
            let ulp = f64::from(f32::from_bits((wanted as f32).to_bits() + 1) - wanted as f32);
            let error = (f64::from(got) - wanted).abs() / ulp;
            worst = worst.max(error);
            assert!(
                error <= 0.51,
                "{display}: {got} for {wanted}, {error} ULP off"
            );
        }
        println!("at most {worst} ULP off");
        assert_eq!([0.0, 1.0].map(linear_of), [0.0, 1.0]);
    }

    #[test]
    fn the_curve_rises_and_has_no_step() {
        let values = values();
        for two in values.windows(2) {
            let (low, high) = (linear_of(two[0]), linear_of(two[1]));
            assert!(low <= high, "{two:?} give {low} and {high}");
            // No steeper than the power is anywhere, and 3e-7 for rounding: the standard's step is 7e-7.
            let relative = f64::from(two[1] - two[0]) / f64::from(two[0]);
            let steep = relative * (2.4 + 2.0 * relative) + 3e-7;
            if two[0] > 1e-30 {
                let rise = f64::from(high - low) / f64::from(low);
                assert!(rise <= steep, "{two:?} give {low} and {high}");
            }
        }
    }
}
