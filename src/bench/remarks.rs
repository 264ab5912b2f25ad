//! What a reader should know before believing a record: what the measurer noted, and what the samples show.

use super::groups::{Groups, groups};
use super::record::{Measure, Record, Run};
use super::spread::{OUTLIER_RULE, Spread};
use super::units::percent;

/// Above this share of outliers a measurement is called disturbed.
const MANY_OUTLIERS: f64 = 0.1;

/// Above this (p90 - p10) / median a frame's time is called noisy.
const MUCH_NOISE: f64 = 0.3;

/// Below this many samples percentiles are rough.
const FEW_SAMPLES: usize = 10;

/// Of the kernels alone.
pub(super) fn of_micro(record: &Record) -> Vec<String> {
    disturbed(&record.micro).into_iter().collect()
}

/// Of one run.
pub(super) fn of_run(run: &Run) -> Vec<String> {
    let mut remarks = run.warnings.clone();
    let frame = &run.frame_ms;
    let samples = frame.samples.len();
    if samples > 0 && samples < FEW_SAMPLES {
        let few = match samples {
            1 => "1 sample is".to_owned(),
            samples => format!("{samples} samples are"),
        };
        remarks.push(format!(
            "{few} few, and percentiles rough: take more frames"
        ));
    }
    if let Some(Groups { ratio, slow }) = groups(&frame.samples) {
        remarks.push(format!(
            "the frames fall into two groups, {ratio:.2} times apart, {} of them in the slower: the machine changed \
             its pace, and the median is of one group or the other",
            percent(slow)
        ));
    } else if frame.noise() > MUCH_NOISE {
        remarks.push(format!(
            "p10 and p90 of the frame are {} of its median apart: the machine is busy, or frames differ",
            percent(frame.noise())
        ));
    }
    if samples >= FEW_SAMPLES && is_slow_at_first(frame) {
        remarks.push("the first frame is the slowest by far: warm up longer".to_owned());
    }
    // Outliers of a machine that changes its pace say nothing more.
    if groups(&frame.samples).is_none() {
        remarks.extend(disturbed(&run.passes));
    }
    remarks
}

/// Whether the first sample is the largest, and further from the median than all others together spread.
fn is_slow_at_first(ms: &Spread) -> bool {
    let [first, rest @ ..] = ms.samples.as_slice() else {
        return false;
    };
    let most = rest.iter().copied().fold(f64::MIN, f64::max);
    let least = rest.iter().copied().fold(f64::MAX, f64::min);
    first - most > most - least
}

/// Names what has many outliers.
fn disturbed(measures: &[Measure]) -> Option<String> {
    let share = |ms: &Spread| ms.outliers.count as f64 / ms.samples.len().max(1) as f64;
    let many = measures.iter().filter(|it| share(&it.ms) > MANY_OUTLIERS);
    let worst = many
        .clone()
        .max_by(|a, b| share(&a.ms).total_cmp(&share(&b.ms)))?;
    let others = match many.count() - 1 {
        0 => String::new(),
        1 => ", and of one other many".to_owned(),
        others => format!(", and of {others} others many"),
    };
    let (count, samples) = (worst.ms.outliers.count, worst.ms.samples.len());
    Some(format!(
        "{count} of {samples} samples of {} are outliers ({OUTLIER_RULE}){others}: medians stand, but quiet the machine",
        worst.name
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Clock;

    fn run(frame_ms: Vec<f64>) -> Run {
        Run {
            frame_ms: Spread::new(frame_ms, Clock::Wall),
            ..Run::default()
        }
    }

    #[test]
    fn a_quiet_run_needs_no_words() {
        let quiet = (0..20).map(|at| 10.0 + f64::from(at % 5) * 0.1).collect();
        assert_eq!(of_run(&run(quiet)), Vec::<String>::new());
    }

    #[test]
    fn what_the_samples_show_is_said() {
        let said = |samples: Vec<f64>, words: &str| {
            let remarks = of_run(&run(samples));
            assert!(remarks.iter().any(|it| it.contains(words)), "{remarks:?}");
        };
        said(vec![1.0, 1.1, 1.0], "3 samples are few");
        said((0..20).map(|at| 10.0 + f64::from(at)).collect(), "apart");
        let mut cold: Vec<f64> = (0..20).map(|at| 10.0 + f64::from(at % 5) * 0.1).collect();
        cold[0] = 14.0;
        said(cold, "warm up longer");
        let steps = (0..20).map(|at| if at % 7 == 0 { 99.0 } else { f64::from(at % 3) });
        let pass = Measure::new("advance", steps.collect(), Clock::Wall, 1, 1, None);
        let busy = Run {
            passes: vec![
                pass.clone(),
                Measure {
                    name: "cull".into(),
                    ..pass
                },
            ],
            ..run(vec![])
        };
        let remarks = of_run(&busy);
        assert!(
            remarks[0].contains("3 of 20 samples of cull are outliers"),
            "{remarks:?}"
        );
        assert!(remarks[0].contains("of one other many"), "{remarks:?}");
    }
}
