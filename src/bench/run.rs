//! A scene at one count on several targets, measured frame by frame in turn.

use std::time::Instant;

use super::budget::Budget;
use super::error::BenchError;
use super::job::Job;
use super::lane::{FrameTimes, Lane};
use super::process;
use super::record::Run;
use super::steady::{Ask, Span, inputs_of, warm_up};
use super::target::Target;
use super::told::told;
use super::yard::{Yard, YardTimes};
use crate::layout::FrameStats;
use crate::plan::Plan;

/// Where a measurement is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress<'a> {
    /// What is measured: a scene's name, or `micro`.
    pub what: &'a str,
    /// At how many particles, where that was asked for.
    pub particles: Option<u32>,
    /// Whether what is run now counts.
    pub is_warm_up: bool,
    /// Frames, or rounds of kernels, so far.
    pub frames: u32,
}

/// Is told where a measurement is, before each of its frames, and says whether to go on.
pub type Watch<'a> = dyn FnMut(&Progress) -> bool + 'a;

/// What is known of one lane so far.
pub(super) struct Taken {
    pub(super) frames: Vec<FrameTimes>,
    pub(super) frame_ms: Vec<f64>,
    pub(super) stats: Vec<FrameStats>,
    pub(super) cpu_seconds: Option<f64>,
    pub(super) copies: YardTimes,
    /// Seconds that its frames took.
    secs: f64,
}

/// Measures a scene on all targets at once, frame by frame in turn, so that whatever else the
/// machine does falls on all alike; a run for each target. Copies are measured beside them, all through
/// the run, and shares are of their rates.
///
/// # Errors
/// [`BenchError`]: the scene cannot be run at that count, a machine fails, or `watch` says stop.
pub fn run(
    targets: &[Target],
    job: &Job,
    budget: &Budget,
    watch: &mut Watch,
) -> Result<Vec<Run>, BenchError> {
    let mut yards = targets
        .iter()
        .map(Yard::new)
        .collect::<Result<Vec<_>, _>>()?;
    run_in(&mut yards, targets, job, budget, watch)
}

/// The same, held against copies that are there already, one set a target.
pub(super) fn run_in(
    yards: &mut [Yard],
    targets: &[Target],
    job: &Job,
    budget: &Budget,
    watch: &mut Watch,
) -> Result<Vec<Run>, BenchError> {
    let scene = job.scaled()?;
    let span = Span::new(&scene, &Plan::new(&scene, 1)?, budget);
    let end = span.warm_end + i64::from(span.most);
    let plan = Plan::new(&scene, u32::try_from(end).unwrap_or(u32::MAX))?;
    process::forget_peak();
    let mut lanes = Vec::new();
    for target in targets {
        lanes.push(Lane::start(target, &plan)?);
    }
    let mut ask = |is_warm_up: bool, frames: u32| {
        let go_on = watch(&Progress {
            what: &scene.name,
            particles: job.particles,
            is_warm_up,
            frames,
        });
        if go_on {
            Ok(())
        } else {
            Err(BenchError::Stopped)
        }
    };
    let begin = warm_up(&plan, &span, &mut lanes, &mut ask)?;
    let span_measured = (begin, span.most);
    let taken = measure(&plan, budget, span_measured, &mut lanes, yards, &mut ask)?;
    let peak_memory_bytes = process::peak_memory_bytes();
    let runs = lanes.iter_mut().zip(taken).map(|(lane, taken)| {
        let warm_up_frames = (begin - span.first) as u32;
        let run = told(job, &plan, budget, lane, taken)?;
        Ok(Run {
            warm_up_frames,
            peak_memory_bytes,
            ..run
        })
    });
    runs.collect()
}

fn measure(
    plan: &Plan,
    budget: &Budget,
    (begin, most): (i64, u32),
    lanes: &mut [Lane],
    yards: &mut [Yard],
    ask: &mut Ask,
) -> Result<Vec<Taken>, BenchError> {
    let empty = |_: &mut Lane| Taken {
        frames: Vec::new(),
        frame_ms: Vec::new(),
        stats: Vec::new(),
        cpu_seconds: process::cpu_seconds().map(|_| 0.0),
        copies: YardTimes::default(),
        secs: 0.0,
    };
    let mut taken: Vec<Taken> = lanes.iter_mut().map(empty).collect();
    let begun = Instant::now();
    for count in 0..most {
        ask(false, count)?;
        let inputs = inputs_of(plan, begin + i64::from(count));
        let mut order: Vec<usize> = (0..lanes.len()).collect();
        if count % 2 == 1 {
            order.reverse();
        }
        for at in order {
            let (lane, taken) = (&mut lanes[at], &mut taken[at]);
            let before = process::cpu_seconds();
            let frame_begun = Instant::now();
            let times = lane.frame(&inputs)?;
            let after = process::cpu_seconds();
            if let (Some(sum), Some(before), Some(after)) = (&mut taken.cpu_seconds, before, after)
            {
                *sum += after - before;
            }
            taken
                .frame_ms
                .push(times.passes.iter().map(|pass| pass.ms).sum());
            taken.frames.push(times);
            taken.stats.extend(lane.statistics()?);
            taken.secs += frame_begun.elapsed().as_secs_f64();
            yards[at].measure_beside(&mut taken.copies, taken.secs)?;
        }
        let secs = begun.elapsed().as_secs_f64();
        if taken.iter().all(|of| budget.is_enough(&of.frame_ms, secs)) {
            break;
        }
    }
    for (yard, taken) in yards.iter_mut().zip(&mut taken) {
        yard.measure_enough(&mut taken.copies)?;
    }
    Ok(taken)
}
