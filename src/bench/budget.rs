//! When to stop measuring: by noise, with a bound on time (as nvbench does).

use super::spread::percentile;

/// Samples without which nothing is told.
const LEAST: usize = 15;

/// Samples after which more tell nothing new.
const MOST: usize = 1000;

/// How long to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Exactly so many samples, 1 ..= 1,000; the rest is of no account then.
    pub frames: Option<u32>,
    /// Half-width of the 95 % confidence interval of the median, as a share of it, that is good
    /// enough. Default 0.01.
    pub noise: f64,
    /// Seconds after which measuring ends in any case, warm-up not counted. Default 10.
    pub secs: f64,
}

impl Default for Budget {
    fn default() -> Self {
        Self {
            frames: None,
            noise: 0.01,
            secs: 10.0,
        }
    }
}

impl Budget {
    /// Most samples that can be taken.
    pub(super) fn most(&self) -> u32 {
        self.frames.unwrap_or(MOST as u32)
    }

    /// Whether these samples, taken in `secs`, are enough.
    pub(super) fn is_enough(&self, samples_ms: &[f64], secs: f64) -> bool {
        let taken = samples_ms.len();
        if let Some(frames) = self.frames {
            return taken >= frames as usize;
        }
        // Three samples are a median with one on either side: very slow frames have no more.
        let out_of_time = taken >= 3 && secs >= self.secs;
        let quiet = || uncertainty(samples_ms) <= self.noise;
        taken >= MOST || out_of_time || (taken >= LEAST && quiet())
    }

    /// What to warn of, if these samples are noisier than was asked for.
    pub(super) fn warning(&self, samples_ms: &[f64]) -> Option<String> {
        if self.frames.is_some() {
            return None;
        }
        let uncertainty = uncertainty(samples_ms);
        (uncertainty > self.noise).then(|| {
            format!(
                "the median of {} frames is uncertain by {:.1} %, more than the {:.1} % asked for",
                samples_ms.len(),
                uncertainty * 100.0,
                self.noise * 100.0
            )
        })
    }
}

/// Half-width of the 95 % confidence interval of the samples' median, as a share of it: order
/// statistics, which assume nothing about the distribution. Infinite for fewer than three.
pub(super) fn uncertainty(samples: &[f64]) -> f64 {
    if samples.len() < 3 {
        return f64::INFINITY;
    }
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len() as f64;
    // Ranks of binomially distributed places: 1.96 standard deviations of n / 4 on either side.
    let reach = 0.98 * count.sqrt();
    let at = |rank: f64| sorted[(rank.max(0.0) as usize).min(sorted.len() - 1)];
    let low = at((count / 2.0 - reach).floor());
    let high = at((count / 2.0 + reach).ceil());
    let median = percentile(&sorted, 0.5);
    if median > 0.0 {
        (high - low) / 2.0 / median
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uncertainty_falls_with_the_root_of_the_samples() {
        // Ranks of a straight line: the interval of n samples in 1 ..= 2 is 0.98 / sqrt(n) wide
        // on either side of 1.5.
        let line = |n: usize| -> Vec<f64> { (0..n).map(|i| 1.0 + i as f64 / n as f64).collect() };
        for n in [100, 400, 10_000] {
            let expected = 0.98 / (n as f64).sqrt() / 1.5;
            let got = uncertainty(&line(n));
            assert!(
                (got - expected).abs() < 2.0 / n as f64,
                "{n}: {got}, not {expected}"
            );
        }
        assert_eq!(uncertainty(&[1.0, 2.0]), f64::INFINITY);
        assert_eq!(uncertainty(&[0.0; 9]), 0.0);
    }

    #[test]
    fn measuring_ends_by_count_noise_or_time() {
        let rule = Budget::default();
        let quiet = [5.0; 20];
        assert!(rule.is_enough(&quiet, 0.0) && !rule.is_enough(&quiet[..14], 0.0));
        let loud: Vec<f64> = (0..20).map(|at| 1.0 + f64::from(at)).collect();
        assert!(!rule.is_enough(&loud, 9.9) && rule.is_enough(&loud, 10.0));
        assert!(!rule.is_enough(&loud[..2], 100.0));
        assert!(rule.warning(&loud).is_some() && rule.warning(&quiet).is_none());
        let counted = Budget {
            frames: Some(4),
            ..rule
        };
        assert!(!counted.is_enough(&quiet[..3], 99.0) && counted.is_enough(&loud[..4], 0.0));
        assert!(counted.warning(&loud).is_none());
    }
}
