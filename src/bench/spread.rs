//! One quantity, measured many times: its samples, and what is told of them.

use serde::{Deserialize, Serialize};

/// Who is counted as an outlier: Iglewicz and Hoaglin's rule (1993), which outliers themselves do not sway.
pub const OUTLIER_RULE: &str = "modified z-score above 3.5";

/// Above this modified z-score a sample is an outlier.
const MOST_SCORE: f64 = 3.5;

/// Milliseconds that samples are rounded to: a nanosecond.
const PER_MS: f64 = 1e6;

/// By which clock something was timed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Clock {
    /// The device's own, around the work of one kernel.
    #[serde(rename = "gpu timestamps")]
    GpuTimestamps,
    /// The machine's, around what the program waited for.
    #[default]
    #[serde(rename = "wall")]
    Wall,
}

impl Clock {
    /// As it is written in a record.
    pub fn name(self) -> &'static str {
        match self {
            Self::GpuTimestamps => "gpu timestamps",
            Self::Wall => "wall",
        }
    }
}

/// How many samples lie apart from the rest. They are counted, never left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outliers {
    /// Samples that the rule names.
    pub count: usize,
    /// The rule, in words: [`OUTLIER_RULE`].
    pub rule: String,
}

/// Times of one thing, milliseconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Half of the samples are below.
    pub median: f64,
    /// A tenth of the samples is below.
    pub p10: f64,
    /// Nine tenths of the samples are below.
    pub p90: f64,
    /// By which clock.
    #[serde(default)]
    pub clock: Clock,
    /// Samples apart from the rest.
    #[serde(default)]
    pub outliers: Outliers,
    /// Every sample in the order taken. Those of one run's passes stand frame beside frame. Empty
    /// where a record of another's making keeps none.
    #[serde(default)]
    pub samples: Vec<f64>,
}

impl Spread {
    /// What is told of these samples, milliseconds, which are rounded to nanoseconds. All zero if there are none.
    ///
    /// ```
    /// use motes::bench::{Clock, Spread};
    ///
    /// let spread = Spread::new(vec![3.0, 1.0, 2.0], Clock::Wall);
    /// assert_eq!((spread.p10, spread.median, spread.p90), (1.2, 2.0, 2.8));
    /// ```
    pub fn new(samples_ms: Vec<f64>, clock: Clock) -> Self {
        let round = |ms: f64| (ms * PER_MS).round() / PER_MS;
        let samples: Vec<f64> = samples_ms.into_iter().map(round).collect();
        let mut sorted = samples.clone();
        sorted.sort_by(f64::total_cmp);
        let at = |part| round(percentile(&sorted, part));
        Self {
            median: at(0.5),
            p10: at(0.1),
            p90: at(0.9),
            clock,
            outliers: Outliers {
                count: outliers(&sorted),
                rule: OUTLIER_RULE.to_owned(),
            },
            samples,
        }
    }

    /// The samples, or the median where there are none.
    pub fn samples_or_median(&self) -> &[f64] {
        match self.samples.as_slice() {
            [] => std::slice::from_ref(&self.median),
            samples => samples,
        }
    }

    /// (p90 - p10) / median; 0 where the median is.
    pub fn noise(&self) -> f64 {
        match self.median > 0.0 {
            true => (self.p90 - self.p10) / self.median,
            false => 0.0,
        }
    }
}

/// The value below which `part` (0 ..= 1) of the ascending values lie, between two of them by
/// linear interpolation; 0 if there are none.
pub fn percentile(ascending: &[f64], part: f64) -> f64 {
    let Some(last) = ascending.len().checked_sub(1) else {
        return 0.0;
    };
    let place = part.clamp(0.0, 1.0) * last as f64;
    let below = (place as usize).min(last);
    let above = (below + 1).min(last);
    let low = ascending[below];
    low + (ascending[above] - low) * (place - below as f64)
}

/// How many of the ascending values [`OUTLIER_RULE`] names.
fn outliers(ascending: &[f64]) -> usize {
    let median = percentile(ascending, 0.5);
    let mut deviations: Vec<f64> = ascending.iter().map(|it| (it - median).abs()).collect();
    deviations.sort_by(f64::total_cmp);
    // Normally distributed values have a standard deviation of 1 / 0.6745 of this.
    let typical = percentile(&deviations, 0.5);
    let most = MOST_SCORE / 0.6745 * typical;
    // Where more than half of all are equal, the rule has nothing to go by.
    let is_apart = |deviation: &&f64| typical > 0.0 && **deviation > most;
    deviations.iter().filter(is_apart).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_lie_between_samples() {
        let ascending = [1.0, 2.0, 4.0, 8.0, 16.0];
        let at = [0.0, 0.1, 0.25, 0.5, 0.9, 1.0].map(|part| percentile(&ascending, part));
        for (got, expected) in at.into_iter().zip([1.0, 1.4, 2.0, 4.0, 12.8, 16.0]) {
            assert!((got - expected).abs() < 1e-12, "{at:?}");
        }
        assert_eq!(percentile(&[], 0.5), 0.0);
        assert_eq!(percentile(&[7.0], 0.9), 7.0);
    }

    #[test]
    fn samples_keep_their_order_and_the_order_does_not_matter() {
        let spread = Spread::new(vec![5.0, 1.0, 3.0], Clock::GpuTimestamps);
        assert_eq!(spread.samples, [5.0, 1.0, 3.0]);
        let sorted = Spread::new(vec![1.0, 3.0, 5.0], Clock::GpuTimestamps);
        assert_eq!(
            (spread.median, spread.p10, spread.p90),
            (sorted.median, sorted.p10, sorted.p90)
        );
        assert!((spread.noise() - 3.2 / 3.0).abs() < 1e-9);
    }

    #[test]
    fn outliers_are_those_far_from_the_rest() {
        // The median is 10, the median deviation 1: the rule's bound is 5.189 on either side.
        let mut samples = vec![8.0, 9.0, 9.0, 10.0, 10.0, 11.0, 11.0, 12.0];
        samples.extend([15.18, 4.82]);
        assert_eq!(Spread::new(samples.clone(), Clock::Wall).outliers.count, 0);
        samples[8] = 15.2;
        samples[9] = 4.8;
        assert_eq!(Spread::new(samples, Clock::Wall).outliers.count, 2);
        // Nothing to go by.
        let equal = vec![1.0, 1.0, 1.0, 1.0, 9.0];
        assert_eq!(Spread::new(equal, Clock::Wall).outliers.count, 0);
    }
}
