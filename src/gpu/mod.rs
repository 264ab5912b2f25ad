//! A [`Plan`] on wgpu.
//!
//! [`shader`] turns WGSL into kernels, pure and without a device; `kernel` puts one on a device and
//! finds its buffers by name; `memory` holds the buffers; `commands` expands the plan's stages into
//! dispatches and `run` submits them; `readback` brings statistics and state home. `device` is a
//! device of our own or a caller's, `needs` what a caller's must have, and `watch` catches what goes
//! wrong on either. All `unsafe` is in `raw`.

mod adapter;
mod commands;
mod device;
pub mod dispatch;
mod flame_tiling;
mod kernel;
mod measured;
mod memory;
mod needs;
mod options;
mod picture;
mod probe;
mod raster;
mod raw;
mod readback;
mod record;
mod restore;
mod run;
pub mod shader;
pub mod sort;
mod strip_shares;
mod tiling;
mod timing;
mod traffic;
mod watch;
mod yardstick;
mod yardstick_memory;
mod yardstick_sort;

use std::collections::{HashMap, VecDeque};
use std::sync::Arc;

use crate::backend::{Backend, BackendError, Living, StageRecord};
use crate::layout::FrameStats;
use crate::plan::{
    FrameInputs, MeshTables, Plan, Population, STAGES, SolidTables, SpreadTables, Stage,
    SurfaceTables,
};
use commands::Command;
use kernel::Kernel;
use memory::Memory;
use options::switches_off;
use readback::StatisticsRing;
use shader::sources::{KernelTexts, WIDE_KERNELS};
use tiling::Tiling;
use timing::Timer;

#[cfg(feature = "view")]
pub(crate) use adapter::named;
pub use adapter::{AdapterDescription, adapters, open};
pub use commands::{KernelUse, STAGE_KERNELS, stages_of};
pub use device::GpuDevice;
pub use flame_tiling::CONSTANTS as FLAME_TILE_CONSTANTS;
pub use kernel::check_binding;
pub use needs::{UnfitDevice, device_descriptor, required_features, required_limits};
pub use options::{GpuOptions, Mutation};
pub use picture::{ParticleBuffers, TextureError};
pub use probe::KernelForm;
pub use raster::{RasterShape, RasterTarget};
pub use timing::KernelTimes;
pub use traffic::{Load, Traffic, sort_bytes, stage_traffic, traffic};
pub use watch::is_waiting;
pub use yardstick::{Timed, Yardstick};
pub use yardstick_memory::{TABLE_WORDS, YardstickMemory};
pub use yardstick_sort::SortYardstick;

/// The state of a run on a device.
pub struct GpuBackend {
    gpu: GpuDevice,
    exact: bool,
    memory: Memory,
    kernels: HashMap<&'static str, Kernel>,
    /// Dispatches by the pool that holds the particles, and by stage.
    commands: [HashMap<Stage, Vec<Command>>; 2],
    workgroup_size: u32,
    system_count: u32,
    node_count: u32,
    row_count: u32,
    curve_points: Vec<[f32; 4]>,
    meshes: Arc<MeshTables>,
    solids: Arc<SolidTables>,
    boid_count: u32,
    boid_trail_count: u32,
    flame_count: u32,
    point_capacity: u32,
    dropped_places: u32,
    ring_count: u32,
    piece_count: u32,
    spreads: Arc<SpreadTables>,
    surfaces: Arc<SurfaceTables>,
    cell_count: u32,
    width: u32,
    height: u32,
    /// Whether boids may look at more others than some drivers let loops turn.
    has_crowds: bool,
    has_covers: bool,
    has_planet: bool,
    has_ground: bool,
    has_clusters: bool,
    has_skews: bool,
    has_strips: bool,
    has_surfaces: bool,
    shade_cells: u32,
    /// Which pool holds the particles.
    current: usize,
    /// Whether newborns stand behind the living: between emit and advance.
    newborns_present: bool,
    /// Whether control points have moved, and none has been inserted since.
    points_moved: bool,
    ring: StatisticsRing,
    in_flight: VecDeque<wgpu::SubmissionIndex>,
    timer: Option<Timer>,
    /// Why its state cannot be trusted any more.
    failure: Option<BackendError>,
}

impl GpuBackend {
    /// An empty run of `plan` on the device.
    ///
    /// # Errors
    /// The plan does not fit the adapter, memory runs out, or the driver refuses a kernel.
    pub fn new(gpu: &GpuDevice, plan: &Plan, options: &GpuOptions) -> Result<Self, BackendError> {
        gpu.watched(|| Self::build(gpu, plan, options, (None, None)))
    }

    /// As [`GpuBackend::new`], with other kernels than the program's.
    ///
    /// # Errors
    /// As [`GpuBackend::new`], or one of them is not right.
    pub fn with_kernels(
        gpu: &GpuDevice,
        plan: &Plan,
        options: &GpuOptions,
        texts: &KernelTexts,
    ) -> Result<Self, BackendError> {
        gpu.watched(|| Self::build(gpu, plan, options, (Some(texts), None)))
    }

    /// As [`GpuBackend::new`], with a defect put in on purpose.
    ///
    /// # Errors
    /// As [`GpuBackend::new`].
    pub fn mutated(
        gpu: &GpuDevice,
        plan: &Plan,
        options: &GpuOptions,
        mutation: Mutation,
    ) -> Result<Self, BackendError> {
        gpu.watched(|| Self::build(gpu, plan, options, (None, Some(mutation))))
    }

    fn build(
        gpu: &GpuDevice,
        plan: &Plan,
        options: &GpuOptions,
        (texts, mutation): (Option<&KernelTexts>, Option<Mutation>),
    ) -> Result<Self, BackendError> {
        if let Some(lost) = gpu.loss() {
            return Err(lost);
        }
        let workgroup_size = if options.workgroup_size == 0 {
            256
        } else {
            options.workgroup_size
        };
        if !(8..=256).contains(&workgroup_size) || !workgroup_size.is_multiple_of(8) {
            return Err(BackendError::Unsupported(format!(
                "workgroups of {workgroup_size}: they are 8 to 256, a multiple of 8"
            )));
        }
        let most_page_bytes = if options.page_bytes == 0 {
            u64::MAX
        } else {
            options.page_bytes
        };
        if !options.tile_px.is_multiple_of(4) || options.tile_px > 256 {
            return Err(BackendError::Unsupported(format!(
                "tiles of {} pixels: they are 4 to 256, a multiple of 4",
                options.tile_px
            )));
        }
        if !options.cover_slice.is_multiple_of(1024) || options.cover_slice > 32_768 {
            return Err(BackendError::Unsupported(format!(
                "{} records at a time: they are 1,024 to 32,768, a multiple of 1,024",
                options.cover_slice
            )));
        }
        let mut kernels = HashMap::new();
        let exact = gpu.description.exact && !options.plain;
        let form = if exact {
            KernelForm::Spirv
        } else {
            KernelForm::Wgsl
        };
        let wide = gpu.is_wide() && !options.plain && !options.narrow;
        let tiling = Tiling::new(plan, options);
        let memory = Memory::new(gpu, plan, most_page_bytes, wide, tiling)?;
        let is_run =
            |name| (wide || !WIDE_KERNELS.contains(&name)) && commands::is_used(name, plan, gpu);
        let all = shader::sources::KERNELS.iter();
        for source in all.filter(|source| is_run(source.name)) {
            let mutate = mutation
                .filter(|mutation| mutation.kernel == source.name)
                .map(|mutation| mutation.change);
            let off = switches_off(plan, gpu, source.name, wide);
            let compiled = shader::compile(
                source.name,
                &shader::CompileOptions {
                    workgroup_size,
                    checked: options.checked,
                    off: &off,
                    wide,
                    texts,
                    mutate,
                },
            )
            .map_err(|e| match texts {
                Some(_) => BackendError::Kernel(e.to_string()),
                None => BackendError::Internal(e.to_string()),
            })?;
            kernels.insert(
                source.name,
                Kernel::new(gpu, &compiled, form, options.checked)?,
            );
        }
        let mut backend = Self {
            gpu: gpu.clone(),
            exact,
            memory,
            kernels,
            commands: Default::default(),
            workgroup_size,
            system_count: plan.system_count,
            node_count: plan.system_count - plan.own_system_count,
            row_count: plan.row_count,
            curve_points: plan.curve_points.clone(),
            meshes: Arc::clone(&plan.meshes),
            solids: Arc::clone(&plan.solids),
            boid_count: plan.boid_count,
            boid_trail_count: plan.boid_trail_count,
            flame_count: plan.flame_count,
            point_capacity: plan.point_capacity,
            dropped_places: plan.dropped_places,
            ring_count: plan.ring_count,
            piece_count: plan.ignitions.piece_count(),
            spreads: Arc::clone(&plan.spreads),
            surfaces: Arc::clone(&plan.surfaces),
            cell_count: plan.cell_count,
            width: plan.width,
            height: plan.height,
            has_crowds: plan.uses.crowds,
            has_covers: plan.uses.covers,
            has_planet: plan.uses.planet,
            has_ground: plan.uses.ground,
            has_clusters: plan.gathers_clusters(),
            has_skews: plan.uses.skews,
            has_strips: plan.uses.strips,
            has_surfaces: plan.uses.surfaces,
            shade_cells: plan.shade_cells,
            current: 0,
            newborns_present: false,
            points_moved: false,
            ring: StatisticsRing::default(),
            in_flight: VecDeque::new(),
            timer: None,
            failure: None,
        };
        for current in [0, 1] {
            for info in STAGES {
                let list = backend.expand(info.stage, current, plan, workgroup_size)?;
                backend.commands[current].insert(info.stage, list);
            }
        }
        backend.upload_stored()?;
        if options.timed {
            backend.timer = Timer::new(gpu);
        }
        Ok(backend)
    }

    /// Does work that leaves the state as it is, and says what of it went wrong.
    fn watched<T>(
        &mut self,
        work: impl FnOnce(&mut Self) -> Result<T, BackendError>,
    ) -> Result<T, BackendError> {
        if let Some(failure) = &self.failure {
            return Err(failure.clone());
        }
        let gpu = self.gpu.clone();
        let done = gpu.watched(|| work(self));
        if let Err(lost @ BackendError::DeviceLost(_)) = &done {
            self.failure = Some(lost.clone());
        }
        done
    }

    /// Does work that changes the state. When it fails, nobody knows how far it came: the run is
    /// over, and says why whenever it is asked for anything.
    fn stepped<T>(
        &mut self,
        work: impl FnOnce(&mut Self) -> Result<T, BackendError>,
    ) -> Result<T, BackendError> {
        let done = self.watched(work);
        if let Err(failure) = &done {
            self.failure = Some(failure.clone());
        }
        done
    }

    /// Bytes allocated on the device.
    pub fn memory_bytes(&self) -> u64 {
        self.memory.bytes
    }

    /// Time of each kernel in each frame since the last call; empty unless timed.
    ///
    /// # Errors
    /// The device fails.
    pub fn take_times(&mut self) -> Result<Vec<KernelTimes>, BackendError> {
        self.watched(|run| match &mut run.timer {
            Some(timer) => timer.take(),
            None => Ok(Vec::new()),
        })
    }

    /// Waits until the device has done all that it was given.
    ///
    /// # Errors
    /// The device fails.
    pub fn wait(&mut self) -> Result<(), BackendError> {
        self.watched(|run| run.gpu.wait())
    }
}

impl Backend for GpuBackend {
    fn adapter_name(&self) -> String {
        self.gpu.description.name.clone()
    }

    fn is_exact(&self) -> bool {
        self.exact
    }

    fn run_stage(&mut self, stage: Stage, inputs: &FrameInputs) -> Result<(), BackendError> {
        self.stepped(|run| {
            run.submit(&[stage], inputs)?;
            run.gpu.wait()
        })
    }

    fn step(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        self.stepped(|run| run.submit(&stages(false), inputs))
    }

    fn draw(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        self.watched(|run| run.submit(&stages(true), inputs))
    }

    fn read(&mut self, buffer: &str) -> Result<Vec<u32>, BackendError> {
        self.watched(|run| {
            run.check_overlooked()?;
            run.read_buffer(buffer)
        })
    }

    fn take_statistics(&mut self) -> Result<Vec<FrameStats>, BackendError> {
        self.watched(|run| {
            run.check_overlooked()?;
            run.ring.take(&run.gpu, &run.memory)
        })
    }

    fn restore(&mut self, living: &Living<'_>, recent: &[FrameInputs]) -> Result<(), BackendError> {
        self.stepped(|run| run.put(living, recent))
    }

    fn record_stage(
        &mut self,
        stage: Stage,
        inputs: &FrameInputs,
    ) -> Result<Option<StageRecord>, BackendError> {
        self.watched(|run| run.record(stage, inputs).map(Some))
    }

    fn population_digest(&mut self, population: Population) -> Result<u64, BackendError> {
        self.watched(|run| {
            let commands = run.population_commands(population, run.current)?;
            run.check_overlooked()?;
            run.digest_of(&commands, 0)
        })
    }

    fn image_digest(&mut self) -> Result<u64, BackendError> {
        self.watched(|run| {
            let commands = run.image_digest_commands()?;
            run.check_overlooked()?;
            run.digest_of(&commands, 0)
        })
    }
}

/// The stages of drawing, or those of the simulation, in order.
fn stages(draws: bool) -> Vec<Stage> {
    let chosen = STAGES.iter().filter(|info| info.draws == draws);
    chosen.map(|info| info.stage).collect()
}
