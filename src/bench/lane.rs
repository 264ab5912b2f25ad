//! One run of a plan on one target, frame by frame, with the time of each of its passes.

use std::time::Instant;

use super::error::BenchError;
use super::record::Part;
use super::spread::Clock;
use super::target::Target;
use crate::backend::{Backend, BackendError};
use crate::cpu::CpuBackend;
use crate::gpu::{
    GpuBackend, GpuOptions, Load, STAGE_KERNELS, Traffic, stage_traffic, stages_of, traffic,
};
use crate::layout::{
    COVERS_OF_BOIDS, COVERS_OF_MARKS, COVERS_OF_PARTICLES, COVERS_OF_STROKES, COVERS_SEEN,
    FrameStats,
};
use crate::plan::{FrameInputs, Plan, STAGES, Stage};
use crate::scene;

/// A run under measurement.
pub(super) struct Lane {
    backend: Bound,
    /// The plan's.
    stages: Vec<Stage>,
}

enum Bound {
    Cpu(Box<CpuBackend>),
    Gpu(Box<GpuBackend>),
}

/// What one pass took.
pub(super) struct PassTime {
    pub(super) name: &'static str,
    pub(super) part: Part,
    pub(super) ms: f64,
    /// Dispatches timed one by one.
    pub(super) dispatches: u32,
}

/// What one frame took.
pub(super) struct FrameTimes {
    pub(super) passes: Vec<PassTime>,
    /// From its submission to its end.
    pub(super) wall_ms: f64,
}

impl FrameTimes {
    /// Of one half's passes together.
    pub(super) fn part_ms(&self, part: Part) -> f64 {
        let of_part = self.passes.iter().filter(|pass| pass.part == part);
        of_part.map(|pass| pass.ms).sum()
    }
}

fn part_of(draws: bool) -> Part {
    if draws { Part::Draw } else { Part::Step }
}

fn ms_since(begun: Instant) -> f64 {
    begun.elapsed().as_secs_f64() * 1e3
}

impl Lane {
    /// A run of a scene, told by its text, the text's name and the scene's, that has stepped once; and what
    /// to draw it with.
    pub(super) fn stepped_once(
        target: &Target,
        text: &str,
        (file, name): (&str, &str),
    ) -> Result<(Self, FrameInputs), BenchError> {
        let parsed = scene::parse(text, file, name);
        let scene = parsed.map_err(|e| BenchError::input(e.to_string(), "fewer particles"))?;
        let plan = Plan::new(&scene, 1)?;
        let mut lane = Self::start(target, &plan)?;
        let inputs = plan.inputs(0);
        lane.backend().step(&inputs)?;
        lane.statistics()?;
        Ok((lane, inputs))
    }

    /// An empty run.
    pub(super) fn start(target: &Target, plan: &Plan) -> Result<Self, BackendError> {
        let backend = match target {
            Target::Cpu => Bound::Cpu(Box::new(CpuBackend::new(plan, None)?)),
            Target::Gpu(device) => {
                let options = GpuOptions {
                    timed: true,
                    ..GpuOptions::default()
                };
                Bound::Gpu(Box::new(GpuBackend::new(device, plan, &options)?))
            }
        };
        let stages = STAGES.iter().map(|info| info.stage);
        Ok(Self {
            backend,
            stages: stages.filter(|stage| plan.has(*stage)).collect(),
        })
    }

    pub(super) fn backend(&mut self) -> &mut dyn Backend {
        match &mut self.backend {
            Bound::Cpu(cpu) => cpu.as_mut(),
            Bound::Gpu(gpu) => gpu.as_mut(),
        }
    }

    /// By which clock its passes are timed.
    pub(super) fn clock(&self) -> Clock {
        match &self.backend {
            Bound::Gpu(gpu) if gpu.is_timed() => Clock::GpuTimestamps,
            _ => Clock::Wall,
        }
    }

    /// Bytes that it has allocated on a device.
    pub(super) fn device_bytes(&self) -> Option<u64> {
        match &self.backend {
            Bound::Cpu(_) => None,
            Bound::Gpu(gpu) => Some(gpu.memory_bytes()),
        }
    }

    /// What has been stepped since the last call. Times that nobody wanted are forgotten.
    pub(super) fn statistics(&mut self) -> Result<Vec<FrameStats>, BackendError> {
        if let Bound::Gpu(gpu) = &mut self.backend {
            gpu.take_times()?;
        }
        self.backend().take_statistics()
    }

    /// Steps and draws a frame.
    pub(super) fn frame(&mut self, inputs: &FrameInputs) -> Result<FrameTimes, BackendError> {
        let due = self.stages.iter().filter(|stage| stage.is_due(inputs));
        let due: Vec<Stage> = due.copied().collect();
        match &mut self.backend {
            Bound::Cpu(cpu) => by_stages(cpu.as_mut(), &due, inputs),
            Bound::Gpu(gpu) if gpu.is_timed() => by_timestamps(gpu, inputs),
            Bound::Gpu(gpu) => by_kernels(gpu, &due, inputs),
        }
    }

    /// Draws alone, again: what that took without making it dark and turning light into bytes.
    pub(super) fn splat_ms(&mut self, inputs: &FrameInputs) -> Result<f64, BackendError> {
        self.stages_ms(&[Stage::Splat], inputs)
    }

    /// Draws, and tells what these stages took, of which no kernel is another's.
    pub(super) fn stages_ms(
        &mut self,
        wanted: &[Stage],
        inputs: &FrameInputs,
    ) -> Result<f64, BackendError> {
        let is_wanted = |name: &str| stages_of(name).any(|stage| wanted.contains(&stage));
        match &mut self.backend {
            Bound::Cpu(cpu) => {
                let begun = Instant::now();
                for stage in wanted {
                    cpu.run_stage(*stage, inputs)?;
                }
                Ok(ms_since(begun))
            }
            Bound::Gpu(gpu) if gpu.is_timed() => {
                gpu.draw(inputs)?;
                let times = gpu.take_times()?.into_iter().flatten();
                Ok(times
                    .filter(|(name, _)| is_wanted(name))
                    .map(|(_, ms)| ms)
                    .sum())
            }
            Bound::Gpu(gpu) => {
                let begun = Instant::now();
                for stage in wanted {
                    gpu.run_stage(*stage, inputs)?;
                }
                Ok(ms_since(begun))
            }
        }
    }

    /// What the frame of these statistics had to do, as far as only the run itself can tell.
    pub(super) fn load(&mut self, plan: &Plan, stats: &FrameStats) -> Result<Load, BackendError> {
        let low = self.backend().read("light_low")?;
        let high = self.backend().read("light_high")?;
        let lit = |(low, high): (&[u32], &[u32])| low.iter().chain(high).any(|word| *word != 0);
        let lit_pixels = low
            .chunks(3)
            .zip(high.chunks(3))
            .filter(|two| lit(*two))
            .count();
        let samples = self.backend().read("surface_faces")?;
        let is_seen = |pixel: &&[u32]| pixel.iter().any(|face| *face != 0);
        let surface_pixels = samples.chunks(4).filter(is_seen).count() as u64;
        let (large, pages) = match &mut self.backend {
            Bound::Cpu(_) => (0, 1),
            Bound::Gpu(gpu) => (gpu.large_particles()?, gpu.page_count().into()),
        };
        let counted = if plan.uses.covers {
            self.backend().read("cover_counts")?
        } else {
            Vec::new()
        };
        let count = |word: u32| u64::from(counted.get(word as usize).copied().unwrap_or(0));
        let families = counted.iter().skip(COVERS_OF_PARTICLES as usize);
        let covers = families.map(|count| u64::from(*count)).sum();
        Ok(Load {
            live: stats.live.into(),
            total: u64::from(stats.live) + u64::from(stats.died),
            born: stats.born.into(),
            pixels: u64::from(plan.width) * u64::from(plan.height),
            lit_pixels: lit_pixels as u64,
            large,
            systems: plan.system_count.into(),
            pages,
            boids: plan.boid_count.into(),
            flames: plan.flame_count.into(),
            dropped: stats.flames_live.into(),
            marks: count(COVERS_OF_MARKS),
            points: stats.points_live.into(),
            cells: plan.cell_count.into(),
            covers,
            boid_covers: count(COVERS_OF_BOIDS).saturating_sub(plan.trail_segments()),
            trail_segments: plan.trail_segments(),
            stroke_covers: count(COVERS_OF_STROKES),
            seen_covers: count(COVERS_SEEN),
            shade_cells: plan.shade_cells.pow(3).into(),
            faces: plan.surface_face_count.into(),
            surface_pixels,
            uses: plan.uses,
        })
    }

    /// Whether a pass of that name is a command of the interface, no kernel.
    pub(super) fn is_command(&self, pass: &str) -> bool {
        matches!(self.backend, Bound::Gpu(_)) && stages_of(pass).next().is_none()
    }

    /// What a pass of that name works on.
    pub(super) fn traffic(&self, pass: &str, load: &Load) -> Option<Traffic> {
        match &self.backend {
            Bound::Cpu(_) => {
                let info = STAGES.iter().find(|info| info.name == pass)?;
                stage_traffic(info.stage, load)
            }
            Bound::Gpu(_) => traffic(pass, load),
        }
    }
}

fn by_stages(
    cpu: &mut CpuBackend,
    stages: &[Stage],
    inputs: &FrameInputs,
) -> Result<FrameTimes, BackendError> {
    let frame = Instant::now();
    let passes = stages.iter().map(|stage| {
        let info = stage.info();
        let begun = Instant::now();
        cpu.run_stage(*stage, inputs)?;
        Ok(PassTime {
            name: info.name,
            part: part_of(info.draws),
            ms: ms_since(begun),
            dispatches: 1,
        })
    });
    let passes = passes.collect::<Result<_, BackendError>>()?;
    Ok(FrameTimes {
        passes,
        wall_ms: ms_since(frame),
    })
}

fn by_timestamps(gpu: &mut GpuBackend, inputs: &FrameInputs) -> Result<FrameTimes, BackendError> {
    let begun = Instant::now();
    gpu.step(inputs)?;
    gpu.draw(inputs)?;
    gpu.finish()?;
    let wall_ms = ms_since(begun);
    // One submission steps, the other draws.
    let mut passes: Vec<PassTime> = Vec::new();
    for (submission, kernels) in gpu.take_times()?.into_iter().enumerate() {
        let part = part_of(submission > 0);
        for (name, ms) in kernels {
            match passes.iter_mut().find(|pass| pass.name == name) {
                Some(pass) => {
                    pass.ms += ms;
                    pass.dispatches += 1;
                }
                None => passes.push(PassTime {
                    name,
                    part,
                    ms,
                    dispatches: 1,
                }),
            }
        }
    }
    Ok(FrameTimes { passes, wall_ms })
}

/// Where the device has no clock: every kernel is waited for; those that take turns, all with the
/// last of them.
fn by_kernels(
    gpu: &mut GpuBackend,
    stages: &[Stage],
    inputs: &FrameInputs,
) -> Result<FrameTimes, BackendError> {
    let frame = Instant::now();
    let all = STAGE_KERNELS.iter();
    let passes = all.filter(|of| stages.contains(&of.stage)).map(|of| {
        let begun = Instant::now();
        gpu.run_kernel(of, inputs)?;
        Ok(PassTime {
            name: of.kernel,
            part: part_of(of.stage.info().draws),
            ms: ms_since(begun),
            dispatches: 1,
        })
    });
    let passes = passes.collect::<Result<_, BackendError>>()?;
    Ok(FrameTimes {
        passes,
        wall_ms: ms_since(frame),
    })
}
