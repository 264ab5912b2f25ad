//! Whether times fall into two groups: a machine that changes its pace, not a program that does.

use super::spread::percentile;

/// Samples without which nothing is told.
const LEAST: usize = 12;

/// Part of the samples at either end that are passed over: outliers are no group.
const PASSED_OVER: f64 = 0.03;

/// Part of the samples that a group has at least: fewer sway no median.
const LEAST_PART: f64 = 0.2;

/// How far apart the groups' medians are at least.
const LEAST_RATIO: f64 = 1.15;

/// Part of the variance that the two groups explain at least. The best cut explains 64 % of a normal
/// distribution's and 75 % of a uniform one's.
const LEAST_EXPLAINED: f64 = 0.82;

/// Two groups of times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Groups {
    /// The slower group's median over the faster one's.
    pub(super) ratio: f64,
    /// Part of the samples in the slower one.
    pub(super) slow: f64,
}

/// The two groups that these times fall into, if they do: cut where the variance of the logarithms
/// within the groups is least (Otsu 1979).
pub(super) fn groups(samples_ms: &[f64]) -> Option<Groups> {
    if samples_ms.len() < LEAST {
        return None;
    }
    let mut sorted: Vec<f64> = samples_ms.to_vec();
    sorted.sort_by(f64::total_cmp);
    let passed = (sorted.len() as f64 * PASSED_OVER) as usize;
    let kept = &sorted[passed..sorted.len() - passed];
    if kept[0] <= 0.0 {
        return None;
    }
    let logs: Vec<f64> = kept.iter().map(|ms| ms.ln()).collect();
    let count = logs.len() as f64;
    let mean = logs.iter().sum::<f64>() / count;
    let all: f64 = logs.iter().map(|it| (it - mean).powi(2)).sum();
    let least = (count * LEAST_PART).ceil() as usize;
    let mut sum = 0.0;
    let mut best = (0.0, 0);
    for (at, log) in logs.iter().enumerate() {
        let below = at as f64;
        if at >= least && logs.len() - at >= least {
            let apart = sum / below - (count * mean - sum) / (count - below);
            let between = below * (count - below) / count * apart * apart;
            if between > best.0 {
                best = (between, at);
            }
        }
        sum += log;
    }
    let (between, cut) = best;
    if cut == 0 || between < LEAST_EXPLAINED * all {
        return None;
    }
    let ratio = percentile(&kept[cut..], 0.5) / percentile(&kept[..cut], 0.5);
    (ratio >= LEAST_RATIO).then(|| Groups {
        ratio,
        slow: 1.0 - cut as f64 / count,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Standard normal deviates, by the sum of twelve.
    fn normal(seed: &mut u64) -> f64 {
        let mut uniform = || {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (*seed >> 33) as f64 / (1u64 << 31) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }

    #[test]
    fn two_paces_are_seen_and_one_is_not() {
        let mut seed = 7;
        for trial in 0..50 {
            let noise = 0.02 + 0.01 * f64::from(trial % 5);
            let mut times = |slow_from: usize| -> Vec<f64> {
                let one = |at| if at >= slow_from { 1.6 } else { 1.0 };
                (0..80)
                    .map(|at| one(at) * (noise * normal(&mut seed)).exp())
                    .collect()
            };
            assert_eq!(groups(&times(80)), None, "{trial}");
            let found = groups(&times(50)).expect("there are two");
            assert!((found.ratio / 1.6 - 1.0).abs() < 0.05, "{found:?}");
            assert!((found.slow - 30.0 / 80.0).abs() < 0.05, "{found:?}");
        }
    }

    #[test]
    fn outliers_and_even_spreads_are_no_groups() {
        let mut times: Vec<f64> = (0..60).map(|at| 1.0 + 0.001 * f64::from(at % 7)).collect();
        times[10] = 9.0;
        assert_eq!(groups(&times), None);
        let line: Vec<f64> = (0..60).map(|at| 1.0 + f64::from(at) / 60.0).collect();
        assert_eq!(groups(&line), None);
        assert_eq!(groups(&[1.0, 2.0, 1.0, 2.0]), None);
        assert_eq!(groups(&[0.0; 40]), None);
    }
}
