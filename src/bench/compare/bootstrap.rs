//! How much longer something takes now than before, with an interval, by resampling what was
//! measured (Efron and Tibshirani 1993; Kalibera and Jones 2013 for runs within which samples lie).
//!
//! The estimate is the ratio of medians; over several records a side, the geometric mean of the
//! ratios of the pairs. One resampling draws pairs of records with replacement and within each
//! of them blocks of neighbouring samples, because neighbours in time are alike. Frames that stand at
//! the same place in both records are drawn together: they did the same work.
//!
//! One record a side cannot show how much two runs of one build differ. Its samples are drawn in at
//! least [`LEAST_BLOCKS`]-th parts of its time, and the interval is widened by what the caller allows
//! for that difference.
//!
//! Few records a side spread less than what they are drawn from, so the interval is widened by
//! the root of n / (n - 1) and by Student's distribution. The seed is fixed: the same records give the same answer.

use super::super::spread::percentile;
use super::student::reach;

/// Resamplings.
const DRAWS: usize = 1000;

/// Resamplings between whose percentiles the interval is read off before it is widened.
const READ_LEVEL: f64 = 0.95;

/// Normal distribution's reach at [`READ_LEVEL`].
const NORMAL_REACH: f64 = 1.959_964;

/// Blocks of time that the samples of a lone record are drawn in, about.
const LEAST_BLOCKS: usize = 10;

/// No time is taken to be shorter, ms: a ratio needs something below the line.
const LEAST_MS: f64 = 1e-9;

/// New time over old time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Best estimate.
    pub ratio: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// The change from `old` to `new`, each with the samples of one or more records, with an interval of
/// this level. In pairs, if there are equally many. Where a side has one record, its ends are moved
/// apart by `allowance`, a natural logarithm. `None` if nothing was sampled more than once.
pub(super) fn change(
    old: &[&[f64]],
    new: &[&[f64]],
    (level, allowance): (f64, f64),
    seed: u64,
) -> Option<Change> {
    let fewest = old.len().min(new.len());
    let least_samples = old.iter().chain(new).map(|it| it.len()).min()?;
    if fewest == 0 || least_samples == 0 || (fewest == 1 && least_samples < 2) {
        return None;
    }
    let is_paired = old.len() == new.len();
    let mut random = Random(seed);
    let length = |samples: &&[f64]| {
        let long = match fewest {
            1 => samples.len() / LEAST_BLOCKS,
            _ => 1,
        };
        block_length(samples).max(long)
    };
    let old_blocks: Vec<usize> = old.iter().map(length).collect();
    let new_blocks: Vec<usize> = new.iter().map(length).collect();
    let center = mean_log(new, median) - mean_log(old, median);
    let mut draws: Vec<f64> = (0..DRAWS)
        .map(|_| {
            let old_picks = random.picks(old.len());
            let new_picks = if is_paired {
                old_picks.clone()
            } else {
                random.picks(new.len())
            };
            let mut sum = [0.0; 2];
            for (at, &pick) in old_picks.iter().enumerate() {
                let samples = old[pick];
                let partner = is_paired.then(|| new[new_picks[at]]);
                let block = old_blocks[pick].max(partner.map_or(1, |_| new_blocks[pick]));
                let places = random.blocks(samples.len(), block);
                sum[0] += log(median_at(samples, &places));
                if let Some(partner) = partner {
                    let places = match partner.len() == samples.len() {
                        true => places,
                        false => random.blocks(partner.len(), new_blocks[pick]),
                    };
                    sum[1] += log(median_at(partner, &places));
                }
            }
            if !is_paired {
                for &pick in &new_picks {
                    let places = random.blocks(new[pick].len(), new_blocks[pick]);
                    sum[1] += log(median_at(new[pick], &places));
                }
            }
            sum[1] / new.len() as f64 - sum[0] / old.len() as f64
        })
        .collect();
    draws.sort_by(f64::total_cmp);
    let blocks = old_blocks
        .iter()
        .chain(&new_blocks)
        .copied()
        .max()
        .unwrap_or(1);
    let widening = match fewest {
        1 => reach(level, (least_samples / blocks).max(2) - 1) / NORMAL_REACH,
        records => {
            let records = records as f64;
            reach(level, fewest - 1) / NORMAL_REACH * (records / (records - 1.0)).sqrt()
        }
    };
    let edge = |part: f64| center + (percentile(&draws, part) - center) * widening;
    let tail = 0.5 * (1.0 - READ_LEVEL);
    let allowance = if fewest == 1 { allowance } else { 0.0 };
    Some(Change {
        ratio: center.exp(),
        low: (edge(tail).min(center) - allowance).exp(),
        high: (edge(1.0 - tail).max(center) + allowance).exp(),
    })
}

fn mean_log(records: &[&[f64]], of: impl Fn(&[f64]) -> f64) -> f64 {
    records.iter().map(|samples| log(of(samples))).sum::<f64>() / records.len() as f64
}

fn log(ms: f64) -> f64 {
    ms.max(LEAST_MS).ln()
}

/// The median of any number of values but none.
pub(super) fn median(values: &[f64]) -> f64 {
    median_of(&mut values.to_vec())
}

fn median_at(values: &[f64], places: &[usize]) -> f64 {
    median_of(&mut places.iter().map(|&at| values[at]).collect::<Vec<f64>>())
}

fn median_of(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    let is_even = values.len().is_multiple_of(2);
    let (below, &mut above, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    match is_even {
        true => 0.5 * (above + below.iter().copied().fold(f64::MIN, f64::max)),
        false => above,
    }
}

/// Samples that are drawn together: Carlstein's rule (1986) for a first-order autoregression, at
/// least the third root of their number and at most a quarter of it.
fn block_length(samples: &[f64]) -> usize {
    let count = samples.len() as f64;
    let likeness = likeness(samples);
    let carlstein = (2.0 * likeness / (1.0 - likeness * likeness)).powf(2.0 / 3.0) * count.cbrt();
    let most = (samples.len() / 4).max(1);
    (carlstein.max(count.cbrt()).round() as usize).clamp(1, most)
}

/// Correlation of neighbours, 0 ..= 0.95; samples far from the median are brought nearer first, for
/// one of them would drown the rest.
fn likeness(samples: &[f64]) -> f64 {
    let middle = median(samples);
    let deviations: Vec<f64> = samples.iter().map(|it| (it - middle).abs()).collect();
    let most = 3.0 * 1.4826 * median(&deviations);
    let clipped: Vec<f64> = samples
        .iter()
        .map(|it| (it - middle).clamp(-most, most))
        .collect();
    let mean = clipped.iter().sum::<f64>() / clipped.len() as f64;
    let centered: Vec<f64> = clipped.iter().map(|it| it - mean).collect();
    let squares: f64 = centered.iter().map(|it| it * it).sum();
    let products: f64 = centered.windows(2).map(|pair| pair[0] * pair[1]).sum();
    match squares > 0.0 {
        true => (products / squares).clamp(0.0, 0.95),
        false => 0.0,
    }
}

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.0;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        word ^ (word >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        ((u128::from(self.next()) * bound as u128) >> 64) as usize
    }

    /// As many of 0 .. `count`, with replacement.
    fn picks(&mut self, count: usize) -> Vec<usize> {
        (0..count).map(|_| self.below(count)).collect()
    }

    /// As many of 0 .. `count`, in blocks of neighbours; the first comes after the last.
    fn blocks(&mut self, count: usize, length: usize) -> Vec<usize> {
        let mut places = Vec::with_capacity(count);
        while places.len() < count {
            let start = self.below(count);
            let length = length.min(count - places.len());
            places.extend((start..start + length).map(|at| at % count));
        }
        places
    }
}
