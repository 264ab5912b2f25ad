//! Which of the old times belongs to which of the new.

use std::fmt;

use rayon::prelude::*;

use super::super::groups::groups;
use super::super::record::{Measure, Record};
use super::super::spread::Spread;
use super::super::units::grouped;
use super::warnings::warnings;
use super::{
    BETWEEN_RUNS, Change, Compared, Comparison, Kind, LEAST_MS, LEAST_SHARE, LEVEL, bootstrap,
    identity,
};

/// Other passes without which no pace can be told.
const LEAST_OTHERS: usize = 3;

/// Samples of the same thing, from each record of a side that has it, and the thing's share of the frame.
#[derive(Default)]
struct Side<'a> {
    spreads: Vec<&'a Spread>,
    shares: Vec<f64>,
    /// Of the copies beside it, GB/s.
    copies: Vec<f64>,
}

/// What identifies a thing that was timed.
#[derive(Clone, PartialEq)]
struct Key {
    run: Option<(String, u64)>,
    kind: Kind,
    name: String,
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.run {
            Some((scene, particles)) => {
                write!(
                    f,
                    "{} of {scene} at {} particles",
                    self.name,
                    grouped(*particles)
                )
            }
            None => write!(f, "{} alone", self.name),
        }
    }
}

pub(super) fn one_adapter(old: &[Record], new: &[Record]) -> Comparison {
    let (old_sides, new_sides) = (sides(old), sides(new));
    let find = |key: &Key| new_sides.iter().find(|(other, _)| other == key);
    let missing = |from: &[(Key, Side)], others: &[(Key, Side)]| -> Vec<String> {
        let is_missing = |key: &Key| !others.iter().any(|(other, _)| other == key);
        from.iter()
            .filter(|(key, _)| is_missing(key))
            .map(|(key, _)| key.to_string())
            .collect()
    };
    let both: Vec<(&Key, &Side, &Side)> = old_sides
        .iter()
        .filter_map(|(key, side)| Some((key, side, &find(key)?.1)))
        .collect();
    let mut all: Vec<Compared> = both
        .par_iter()
        .map(|(key, old, new)| compared(key, old, new))
        .collect();
    let rest: Vec<Option<Change>> = both
        .par_iter()
        .map(|(key, old, new)| against_rest(key, (old, new), &both))
        .collect();
    for (compared, change) in all.iter_mut().zip(rest) {
        compared.against_rest = change;
    }
    Comparison {
        adapter: old.first().map(identity).unwrap_or_default(),
        new_adapter: new.first().map(identity).unwrap_or_default(),
        old_records: old.len(),
        new_records: new.len(),
        compared: all,
        only_old: missing(&old_sides, &new_sides),
        only_new: missing(&new_sides, &old_sides),
        warnings: warnings(old, new),
    }
}

/// All that the records timed, in their order.
fn sides(records: &[Record]) -> Vec<(Key, Side<'_>)> {
    let mut sides: Vec<(Key, Side)> = Vec::new();
    let mut add = |key: Key, ms, share: Option<f64>, copy: Option<f64>| {
        let at = sides
            .iter()
            .position(|(other, _)| *other == key)
            .unwrap_or_else(|| {
                sides.push((key, Side::default()));
                sides.len() - 1
            });
        sides[at].1.spreads.push(ms);
        sides[at].1.shares.extend(share);
        sides[at].1.copies.extend(copy.filter(|rate| *rate > 0.0));
    };
    for record in records {
        for Measure { name, ms, .. } in &record.micro {
            let key = Key {
                run: None,
                kind: Kind::Micro,
                name: name.clone(),
            };
            add(key, ms, None, record.copy_kernel_gb_per_s);
        }
        for run in &record.runs {
            let copy = run.copy_kernel_gb_per_s.or(record.copy_kernel_gb_per_s);
            let of_run = Some((run.scene.clone(), run.particles));
            let passes = run
                .passes
                .iter()
                .map(|pass| (Kind::Pass, pass.name.as_str(), &pass.ms));
            let whole = [
                ("step", &run.step_ms),
                ("draw", &run.draw_ms),
                ("frame", &run.frame_ms),
            ];
            let whole = whole.map(|(name, ms)| (Kind::Whole, name, ms));
            for (kind, name, ms) in passes.chain(whole) {
                let key = Key {
                    run: of_run.clone(),
                    kind,
                    name: name.to_owned(),
                };
                add(key, ms, run.share_of_frame(ms), copy);
            }
        }
    }
    sides
}

fn compared(key: &Key, old: &Side, new: &Side) -> Compared {
    fn samples<'a>(side: &Side<'a>) -> Vec<&'a [f64]> {
        side.spreads
            .iter()
            .map(|ms| ms.samples_or_median())
            .collect()
    }
    let told = |side: &Side| {
        let medians: Vec<f64> = side.spreads.iter().map(|ms| ms.median).collect();
        bootstrap::median(&medians)
    };
    let (old_ms, new_ms) = (told(old), told(new));
    let seed = seed_of(key);
    let is_timed = old_ms > 0.0 && new_ms > 0.0;
    let level = (LEVEL, allowance(old, new));
    let change = || bootstrap::change(&samples(old), &samples(new), level, seed);
    Compared {
        run: key.run.clone(),
        kind: key.kind,
        name: key.name.clone(),
        old_ms,
        new_ms,
        share_of_frame: (!new.shares.is_empty()).then(|| bootstrap::median(&new.shares)),
        change: is_timed.then(change).flatten(),
        against_rest: None,
    }
}

fn seed_of(key: &Key) -> u64 {
    let name = key.to_string();
    name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// A pass against the pace of the others of its frames: what a machine does to all alike cancels out.
/// The pace of a frame is the median of how much longer each of the others that matter took than it
/// typically does, so that one of them may change by itself. `None` for too few others.
fn against_rest(
    key: &Key,
    (old, new): (&Side, &Side),
    all: &[(&Key, &Side, &Side)],
) -> Option<Change> {
    if key.kind != Kind::Pass {
        return None;
    }
    let matters = |side: &Side| {
        let least = |values: Vec<f64>| values.into_iter().fold(f64::INFINITY, f64::min);
        let ms = least(side.spreads.iter().map(|ms| ms.median).collect());
        ms >= LEAST_MS && least(side.shares.clone()) >= LEAST_SHARE
    };
    let others = all.iter().filter(|(other, before, now)| {
        let is_same = other.run == key.run && other.kind == Kind::Pass && other.name != key.name;
        is_same && matters(before) && matters(now)
    });
    let others: Vec<(&Side, &Side)> = others.map(|(_, before, now)| (*before, *now)).collect();
    if others.len() < LEAST_OTHERS {
        return None;
    }
    // What each of them typically takes, over both sides.
    let typical = |(before, now): &(&Side, &Side)| {
        let medians = before.spreads.iter().chain(&now.spreads);
        let medians: Vec<f64> = medians.map(|ms| ms.median).collect();
        bootstrap::median(&medians)
    };
    let typical: Vec<f64> = others.iter().map(typical).collect();
    let relative = |side: &Side, others: &[&Side]| -> Option<(Vec<Vec<f64>>, Vec<f64>)> {
        let mut runs = Vec::new();
        let mut paces = Vec::new();
        for (at, ms) in side.spreads.iter().enumerate() {
            let beside: Vec<&[f64]> = others
                .iter()
                .map(|other| other.spreads.get(at).map(|ms| ms.samples.as_slice()))
                .collect::<Option<_>>()?;
            let frames = ms.samples.len();
            if frames < 2 || beside.iter().any(|samples| samples.len() != frames) {
                return None;
            }
            let pace = |frame: usize| {
                let slow = beside
                    .iter()
                    .zip(&typical)
                    .map(|(ms, usual)| ms[frame] / usual);
                bootstrap::median(&slow.collect::<Vec<f64>>()).max(1e-6)
            };
            let pace: Vec<f64> = (0..frames).map(pace).collect();
            runs.push(
                ms.samples
                    .iter()
                    .zip(&pace)
                    .map(|(ms, pace)| ms / pace)
                    .collect(),
            );
            paces.push(bootstrap::median(&pace));
        }
        Some((runs, paces))
    };
    let (before, now): (Vec<&Side>, Vec<&Side>) = others.into_iter().unzip();
    let ((old, old_pace), (new, new_pace)) = (relative(old, &before)?, relative(new, &now)?);
    // Not all passes follow the machine's pace alike: of lone runs at different paces, that is allowed for.
    let paces = (bootstrap::median(&new_pace) / bootstrap::median(&old_pace))
        .ln()
        .abs();
    let groups = old
        .iter()
        .chain(&new)
        .filter_map(|it| Some(groups(it)?.ratio.ln()));
    let allowance = groups.chain([paces]).fold(BETWEEN_RUNS.ln(), f64::max);
    fn slices(runs: &[Vec<f64>]) -> Vec<&[f64]> {
        runs.iter().map(Vec::as_slice).collect()
    }
    bootstrap::change(
        &slices(&old),
        &slices(&new),
        (LEVEL, allowance),
        !seed_of(key),
    )
}

/// How far one run of a build may lie from another, as a natural logarithm: what is allowed always,
/// or more where the data show more: another rate of the copies beside it, or times in two groups.
fn allowance(old: &Side, new: &Side) -> f64 {
    let rate = |side: &Side| (!side.copies.is_empty()).then(|| bootstrap::median(&side.copies));
    let machine = rate(old)
        .zip(rate(new))
        .map(|(old, new)| (new / old).ln().abs());
    let spreads = old.spreads.iter().chain(&new.spreads);
    let paces = spreads.filter_map(|ms| Some(groups(&ms.samples)?.ratio.ln()));
    let all = machine.into_iter().chain(paces);
    all.fold(BETWEEN_RUNS.ln(), f64::max)
}
