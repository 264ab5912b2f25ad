//! What is told of a run that was measured.

use super::budget::Budget;
use super::error::BenchError;
use super::job::Job;
use super::lane::{FrameTimes, Lane, PassTime};
use super::record::{Measure, Part, Run};
use super::run::Taken;
use super::spread::{Clock, Spread, percentile};
use super::steady::strays;
use crate::layout::{Boid, FrameStats};
use crate::plan::Plan;
use crate::simulation::FlockMetrics;

/// How far the living may be from those asked for, or stray while they are measured.
const MOST_DEVIATION: f64 = 0.02;

/// What is told of a lane.
pub(super) fn told(
    job: &Job,
    plan: &Plan,
    budget: &Budget,
    lane: &mut Lane,
    taken: Taken,
) -> Result<Run, BenchError> {
    // Boids live all along, and so do flames that no control point drops.
    let all_along = plan.boid_count + plan.flame_count - plan.dropped_capacity;
    let lives = |line: &FrameStats| line.live.saturating_add(all_along + line.flames_live);
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
        points_live: middle(|line| line.points_live),
        flames_live: middle(|line| line.flames_live),
        ..FrameStats::default()
    };
    let live = lives(&typical);
    let load = lane.load(plan, &typical)?;
    let clock = lane.clock();
    let rates = taken.copies.rates();
    let pass = |typical: &PassTime| {
        let name = typical.name;
        // Where a frame does without a pass, that takes no time in it.
        let samples = taken.frames.iter().map(|frame| {
            let same = frame.passes.iter().find(|pass| pass.name == name);
            same.map_or(0.0, |pass| pass.ms)
        });
        let counted = lane.traffic(name, &load);
        let of = counted.unwrap_or_default();
        let measure = Measure::new(name, samples.collect(), clock, of.items, of.bytes, None);
        Measure {
            part: Some(typical.part),
            note: counted
                .is_none()
                .then(|| "nobody has counted its bytes".into()),
            dispatches: (typical.dispatches != 1).then_some(typical.dispatches),
            ..measure.held_against(rates.floor_ms(of.bytes, lane.is_command(name)))
        }
    };
    let passes = passes_of(&taken.frames).into_iter().map(pass).collect();
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
        neighbour_reads: neighbour_reads(plan, lane)?,
        gpu_memory_bytes: lane.device_bytes(),
        copy_kernel_gb_per_s: rates.kernel,
        copy_in_cache_gb_per_s: rates.near,
        copy_buffer_gb_per_s: rates.buffer,
        copy_ms: Some(rates.copy_ms),
        dispatch_ms: rates.dispatch_ms,
        passes,
        ..Run::default()
    };
    run.warnings = warnings(&run, &counts, job.particles);
    run.warnings.extend(budget.warning(&taken.frame_ms));
    Ok(run)
}

/// How many boids of flocks alone see of their own flock, where they look at anybody.
fn neighbour_reads(plan: &Plan, lane: &mut Lane) -> Result<Option<u64>, BenchError> {
    if plan.boid_count == 0 || plan.system_count > 0 {
        return Ok(None);
    }
    let words = lane.backend().read("boids")?;
    let boids: &[Boid] = bytemuck::cast_slice(&words);
    let inputs = plan.inputs(0);
    let flocks = inputs.flocks.iter().filter(|flock| flock.ties[1] > 0);
    let seen = flocks.map(|flock| {
        let [first, count, ..] = flock.members.map(|word| word as usize);
        let metrics = FlockMetrics::of(flock, &boids[first..first + count]);
        (metrics.mean_neighbours * f64::from(metrics.count)).round() as u64
    });
    Ok(Some(seen.sum()))
}

/// All passes that any of the frames had, in the order of the longest, each as it was there first.
fn passes_of(frames: &[FrameTimes]) -> Vec<&PassTime> {
    let longest = frames.iter().max_by_key(|frame| frame.passes.len());
    let mut all: Vec<&PassTime> = longest.map_or(Vec::new(), |frame| frame.passes.iter().collect());
    for pass in frames.iter().flat_map(|frame| &frame.passes) {
        if !all.iter().any(|known| known.name == pass.name) {
            all.push(pass);
        }
    }
    all
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
