//! Light in fixed point: 64-bit counts of 2^-20 steps. Twin of `wgsl/lib/light.wgsl`, whose two
//! 32-bit limbs are one integer here.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use crate::exact::{f32_of_u32, shared_constants, to_i32, to_u32};

shared_constants! {
    /// Steps of light in 1.0.
    pub const LIGHT_STEPS: f32 = 1_048_576.0;
}

/// A contribution in steps, to the nearest.
#[inline]
pub fn steps_of(light: f32) -> u32 {
    to_u32(light * LIGHT_STEPS + 0.5)
}

/// Below so many steps [`few_steps_of`] holds.
pub(crate) const FEW_STEPS: f32 = 4_194_304.0;

/// [`steps_of`] where these are fewer than [`FEW_STEPS`] and light is not negative. The processor's
/// vectors have no conversion that clamps, as that of the language does; so this rounds by adding 2^23, beside
/// which floats are 1 apart.
#[inline]
pub(crate) fn few_steps_of(light: f32) -> u32 {
    const WHOLE_FROM: f32 = 8_388_608.0;
    let steps = light * LIGHT_STEPS + 0.5;
    let raised = steps + WHOLE_FROM;
    let is_above = raised - WHOLE_FROM > steps;
    (raised.to_bits().wrapping_sub(WHOLE_FROM.to_bits())).wrapping_sub(u32::from(is_above))
}

/// The light that the two limbs hold.
#[inline]
pub fn light_of(low: u32, high: u32) -> f32 {
    let fraction = f32_of_u32(low & 0xfff) * 9.536_743e-7;
    let middle = f32_of_u32(low >> 12) * 0.003_906_25;
    f32_of_u32(high.min(0x00ff_ffff)) * 4096.0 + (middle + fraction)
}

/// The sums of light of an image: three channels a pixel, rows from the top.
#[derive(Debug)]
pub struct LightSums {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    sums: Vec<AtomicU64>,
}

impl LightSums {
    /// A dark image.
    pub fn new(width: u32, height: u32) -> Self {
        let channels = width as usize * height as usize * 3;
        let mut sums = Vec::with_capacity(channels);
        sums.resize_with(channels, AtomicU64::default);
        Self {
            width,
            height,
            sums,
        }
    }

    /// Makes it dark again.
    pub fn clear(&mut self) {
        let sums = self.sums.par_iter_mut().with_min_len(1 << 16);
        sums.for_each(|sum| *sum.get_mut() = 0);
    }

    /// Adds light to channel `at` = 3 pixel + channel. Sums do not depend on the order.
    #[inline]
    pub fn add(&self, at: usize, steps: u32) {
        // A zero is most often an uncovered channel: not worth a locked instruction.
        if steps != 0 {
            self.sums[at].fetch_add(u64::from(steps), Ordering::Relaxed);
        }
    }

    /// Leaves of each pixel what shows of it behind the planet's; the fourth word of a planet's pixel
    /// is how much, as bits.
    pub(super) fn hide(&mut self, planet: &[[u32; 4]]) {
        for (channels, pixel) in self.sums.chunks_exact_mut(3).zip(planet) {
            let share = to_i32(f32::from_bits(pixel[3]) * 65_536.0 + 0.5) as u64;
            for sum in channels {
                let (high, low) = (*sum.get_mut() >> 32, *sum.get_mut() & 0xffff_ffff);
                let whole = (high.min(0xffff) << 32) | low;
                *sum.get_mut() = ((u128::from(whole) * u128::from(share)) >> 16) as u64;
            }
        }
    }

    /// The image in bands of so many rows, the last perhaps of fewer: each may be added to by itself.
    pub(super) fn bands_mut(
        &mut self,
        rows: usize,
    ) -> impl IndexedParallelIterator<Item = &mut [AtomicU64]> {
        let row = 3 * self.width as usize;
        self.sums.par_chunks_mut(rows * row)
    }

    /// The low and the high limb of channel `at`.
    #[inline]
    pub fn limbs(&self, at: usize) -> (u32, u32) {
        let sum = self.sums[at].load(Ordering::Relaxed);
        (sum as u32, (sum >> 32) as u32)
    }

    /// Number of channels in all.
    pub fn len(&self) -> usize {
        self.sums.len()
    }

    /// Whether the image has no pixels.
    pub fn is_empty(&self) -> bool {
        self.sums.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_steps_are_the_same_steps() {
        let most = FEW_STEPS / LIGHT_STEPS;
        let mut looked_at = 0;
        // All floats would take minutes: one of some thousand of each exponent, and halves of steps.
        for bits in (0..most.to_bits()).step_by(4093) {
            let light = f32::from_bits(bits);
            assert_eq!(few_steps_of(light), steps_of(light), "{light}");
            looked_at += 1;
        }
        assert!(looked_at > 200_000);
        for half in 0..1 << 20 {
            let light = (half as f32 * 3.5) / LIGHT_STEPS;
            for light in [light, light.next_down().max(0.0), light.next_up()] {
                assert_eq!(few_steps_of(light), steps_of(light), "{light}");
            }
        }
    }
}
