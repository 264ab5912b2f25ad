//! A scene at one count on several targets, measured frame by frame in turn.

use std::time::Instant;

use super::budget::Budget;
use super::copy::{Copy, MOST_BESIDE};
use super::error::BenchError;
use super::lane::{FrameTimes, Lane};
use super::process;
use super::record::{Measure, Part, Run, gb_per_s};
use super::spread::{Clock, Spread, percentile};
use super::target::Target;
use crate::layout::FrameStats;
use crate::plan::{FrameInputs, Plan};
use crate::scene::Scene;

/// Most births a frame that a system may have, as scene files have it.
const MOST_BIRTHS: f32 = 16e6;

/// A population is steady when its count has stayed within [`STEADY`] over so many frames.
const STEADY_FRAMES: usize = 48;
/// See [`STEADY_FRAMES`].
const STEADY: f64 = 0.005;

/// How far the living may be from those asked for, or stray while they are measured.
const MOST_DEVIATION: f64 = 0.02;

/// What is to be measured.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Particles alive, 1 ..= 10^9: births are scaled to reach them. `None` for the scene as it is.
    pub particles: Option<u32>,
}

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

impl Job<'_> {
    /// The scene as it will be run.
    ///
    /// # Errors
    /// The input's fault: nobody has said how the scene scales, or so many births are too many.
    pub fn scaled(&self) -> Result<Scene, BenchError> {
        let Some(particles) = self.particles else {
            return Ok(self.scene.clone());
        };
        let Some(steady) = self.scene.steady_particles else {
            return Err(BenchError::input(
                format!(
                    "the scene `{}` does not say how its particles scale",
                    self.scene.name
                ),
                "give it `steady_particles`, the number alive once births and deaths balance, or \
                 leave --particles out",
            ));
        };
        let scaled = self
            .scene
            .with_births(f64::from(particles) / f64::from(steady));
        let most = |scene: &Scene| {
            let births = scene.systems.iter().map(|system| {
                let bursts = system.bursts.iter().map(|burst| burst.parts.mean);
                bursts.fold(system.births.initial_mean_parts, f32::max)
            });
            births.fold(0.0, f32::max)
        };
        let births = most(&scaled);
        if births > MOST_BIRTHS {
            let possible = f64::from(particles) * f64::from(MOST_BIRTHS) / f64::from(births);
            return Err(BenchError::input(
                format!(
                    "{particles} particles of `{}` take {births} births a frame in one system",
                    scaled.name
                ),
                format!("at most {} particles", possible as u64),
            ));
        }
        Ok(scaled)
    }
}

/// From which frame on to measure, and how many.
struct Span {
    first: i64,
    /// Where the warm-up ends at the latest.
    warm_end: i64,
    /// Frames to measure at most.
    most: u32,
}

impl Span {
    fn new(scene: &Scene, plan: &Plan, budget: &Budget) -> Self {
        let first = i64::from(plan.first_frame);
        let frames = i64::from(scene.frames);
        let is_steady = scene.steady_particles.is_some();
        // A scene that never becomes steady is measured in its second half at the latest.
        let latest = if is_steady { frames } else { frames / 2 };
        let all_have_lived = first + i64::from(plan.lifetime_bound);
        let warm_end = all_have_lived.min(latest).max(0).max(first + 1);
        let most = match budget.frames {
            None if !is_steady => budget.most().min((frames - warm_end).max(3) as u32),
            _ => budget.most(),
        };
        Self {
            first,
            warm_end,
            most,
        }
    }
}

/// What is known of one lane so far.
struct Taken {
    frames: Vec<FrameTimes>,
    frame_ms: Vec<f64>,
    copy_ms: Vec<f64>,
    copy_clock: Clock,
    stats: Vec<FrameStats>,
    cpu_seconds: Option<f64>,
}

/// Measures a scene on all targets at once, frame by frame in turn, so that whatever else the
/// machine does falls on all alike; a run for each target. The fastest copy of as many records (at
/// most 4,194,304) is measured beside each frame, and shares are of its rate.
///
/// # Errors
/// [`BenchError`]: the scene cannot be run at that count, a machine fails, or `watch` says stop.
pub fn run(
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
    let (begin, live) = warm_up(&plan, &span, &mut lanes, &mut ask)?;
    let mut copies = Vec::new();
    for target in targets {
        copies.push(Copy::fastest(target, live.clamp(1, MOST_BESIDE))?);
    }
    let taken = measure(
        &plan,
        budget,
        (begin, span.most),
        &mut lanes,
        &mut copies,
        &mut ask,
    )?;
    let peak_memory_bytes = process::peak_memory_bytes();
    let lanes = lanes.iter_mut().zip(&copies).zip(taken);
    let runs = lanes.map(|((lane, copy), taken)| {
        let warm_up_frames = (begin - span.first) as u32;
        let run = told(job, &plan, budget, lane, copy, taken)?;
        Ok(Run {
            warm_up_frames,
            peak_memory_bytes,
            ..run
        })
    });
    runs.collect()
}

type Ask<'a> = dyn FnMut(bool, u32) -> Result<(), BenchError> + 'a;

fn inputs_of(plan: &Plan, frame: i64) -> FrameInputs {
    plan.inputs((frame as i32).cast_unsigned())
}

/// Steps until the population is steady; the next frame, and how many live.
fn warm_up(
    plan: &Plan,
    span: &Span,
    lanes: &mut [Lane],
    ask: &mut Ask,
) -> Result<(i64, u32), BenchError> {
    let mut counts: Vec<u32> = Vec::new();
    let mut frame = span.first;
    while frame < span.warm_end {
        ask(true, (frame - span.first) as u32)?;
        let inputs = inputs_of(plan, frame);
        for lane in &mut *lanes {
            lane.backend().step(&inputs)?;
        }
        frame += 1;
        if frame % 16 == 0 || frame == span.warm_end {
            for (at, lane) in lanes.iter_mut().enumerate() {
                let stats = lane.statistics()?;
                if at == 0 {
                    let lives = |line: &FrameStats| line.live.saturating_add(plan.boid_count);
                    counts.extend(stats.iter().map(lives));
                }
            }
            if frame > 0 && is_steady(&counts) {
                break;
            }
        }
    }
    // What draws is compiled when it is first used.
    let inputs = inputs_of(plan, frame - 1);
    for lane in &mut *lanes {
        for _ in 0..2 {
            lane.backend().draw(&inputs)?;
        }
        lane.statistics()?;
    }
    Ok((frame, counts.last().copied().unwrap_or(0)))
}

fn is_steady(counts: &[u32]) -> bool {
    let Some(recent) = counts.len().checked_sub(STEADY_FRAMES) else {
        return false;
    };
    strays(&counts[recent..]).is_some_and(|strays| strays <= STEADY)
}

/// How far counts lie apart, as a share of the greatest; `None` if that is 0.
fn strays(counts: &[u32]) -> Option<f64> {
    let most = counts.iter().copied().max().filter(|most| *most > 0)?;
    let least = counts.iter().copied().min()?;
    Some(f64::from(most - least) / f64::from(most))
}

fn measure(
    plan: &Plan,
    budget: &Budget,
    (begin, most): (i64, u32),
    lanes: &mut [Lane],
    copies: &mut [Copy],
    ask: &mut Ask,
) -> Result<Vec<Taken>, BenchError> {
    let empty = |_: &mut Lane| Taken {
        frames: Vec::new(),
        frame_ms: Vec::new(),
        copy_ms: Vec::new(),
        copy_clock: Clock::Wall,
        stats: Vec::new(),
        cpu_seconds: process::cpu_seconds().map(|_| 0.0),
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
            let (ms, clock) = copies[at].run()?;
            taken.copy_ms.push(ms);
            taken.copy_clock = clock;
        }
        let secs = begun.elapsed().as_secs_f64();
        if taken.iter().all(|of| budget.is_enough(&of.frame_ms, secs)) {
            break;
        }
    }
    Ok(taken)
}

/// What is told of a lane.
fn told(
    job: &Job,
    plan: &Plan,
    budget: &Budget,
    lane: &mut Lane,
    copy: &Copy,
    taken: Taken,
) -> Result<Run, BenchError> {
    // Boids live all along.
    let lives = |line: &FrameStats| line.live.saturating_add(plan.boid_count);
    let counts: Vec<u32> = taken.stats.iter().map(lives).collect();
    let middle = |of: fn(&FrameStats) -> u32| {
        let mut all: Vec<f64> = taken.stats.iter().map(|line| of(line).into()).collect();
        all.sort_by(f64::total_cmp);
        percentile(&all, 0.5).round() as u32
    };
    let typical = FrameStats {
        live: middle(|line| line.live),
        born: middle(|line| line.born),
        died: middle(|line| line.died),
        ..FrameStats::default()
    };
    let live = lives(&typical);
    let load = lane.load(plan, &typical)?;
    let clock = lane.clock();
    let copied = Spread::new(taken.copy_ms, taken.copy_clock);
    let copy_rate = gb_per_s(copy.bytes(), copied.median);
    let names: Vec<_> = taken.frames.first().map_or(Vec::new(), |first| {
        first
            .passes
            .iter()
            .map(|pass| (pass.name, pass.part))
            .collect()
    });
    let pass = |(at, (name, part)): (usize, &(&'static str, Part))| {
        let samples = taken
            .frames
            .iter()
            .filter_map(|frame| Some(frame.passes.get(at)?.ms));
        let counted = lane.traffic(name, &load);
        let of = counted.unwrap_or_default();
        Measure {
            part: Some(*part),
            note: counted
                .is_none()
                .then(|| "nobody has counted its bytes".into()),
            ..Measure::new(
                *name,
                samples.collect(),
                clock,
                of.items,
                of.bytes,
                copy_rate,
            )
        }
    };
    let passes = names.iter().enumerate().map(pass).collect();
    let part = |part| {
        let samples = taken.frames.iter().map(|frame| frame.part_ms(part));
        Spread::new(samples.collect(), clock)
    };
    let walls = taken.frames.iter().map(|frame| frame.wall_ms);
    let mut run = Run {
        scene: job.scene.name.clone(),
        particles: job.particles.unwrap_or(live).into(),
        live: Some(live.into()),
        dropped: taken.stats.iter().map(|line| u64::from(line.dropped)).sum(),
        image_px: Some([plan.width, plan.height]),
        frames: taken.frames.len() as u32,
        frame_ms: Spread::new(taken.frame_ms.clone(), clock),
        step_ms: part(Part::Step),
        draw_ms: part(Part::Draw),
        wall_ms: Some(Spread::new(walls.collect(), Clock::Wall)),
        cpu_seconds: taken.cpu_seconds,
        gpu_memory_bytes: lane.device_bytes(),
        copy_kernel_gb_per_s: copy_rate,
        passes,
        ..Run::default()
    };
    run.warnings = warnings(&run, &counts, job.particles);
    run.warnings.extend(budget.warning(&taken.frame_ms));
    Ok(run)
}

/// What a reader should know of a run before believing it.
fn warnings(run: &Run, counts: &[u32], asked: Option<u32>) -> Vec<String> {
    let mut warnings = Vec::new();
    let live = run.live.unwrap_or(0) as f64;
    if let Some(asked) = asked {
        let off = live / f64::from(asked) - 1.0;
        if off.abs() > MOST_DEVIATION {
            warnings.push(format!(
                "{live} particles live, {:+.1} % off the {asked} asked for",
                off * 100.0
            ));
        }
    }
    match strays(counts) {
        None => warnings.push("no particle lived while it was measured".into()),
        Some(strays) if strays > MOST_DEVIATION => warnings.push(format!(
            "the population is not steady: it strayed by {:.1} % while it was measured, and so did \
             the work",
            strays * 100.0
        )),
        Some(_) => {}
    }
    if run.dropped > 0 {
        let dropped = run.dropped;
        warnings.push(format!("{dropped} births were dropped for want of room"));
    }
    if run.frame_ms.clock == Clock::Wall && run.gpu_memory_bytes.is_some() {
        warnings.push("the adapter has no clock: every kernel was waited for".into());
    }
    warnings
}
