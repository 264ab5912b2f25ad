//! A [`Plan`] on wgpu.
//!
//! [`shader`] turns WGSL into kernels, pure and without a device; `kernel` puts one on a device and
//! finds its buffers by name; `memory` holds the buffers; `commands` expands the plan's stages into
//! dispatches and `run` submits them; `readback` brings statistics and state home. All `unsafe` is in `raw`.

mod adapter;
mod commands;
pub mod dispatch;
mod kernel;
mod memory;
mod probe;
mod raw;
mod readback;
mod record;
mod restore;
mod run;
pub mod shader;
mod timing;
mod yardstick;

use std::collections::{HashMap, VecDeque};

use crate::backend::{Backend, BackendError, StageRecord};
use crate::layout::FrameStats;
use crate::plan::{FrameInputs, Plan, STAGES, Stage};
use commands::Command;
use kernel::Kernel;
use memory::Memory;
use readback::StatisticsRing;
use timing::Timer;

pub use adapter::{AdapterDescription, GpuDevice, adapters, open};
pub use commands::{KernelUse, STAGE_KERNELS};
pub use kernel::check_binding;
pub use probe::KernelForm;
pub use timing::KernelTimes;

/// A change that a test makes to one kernel's module.
pub struct Mutation<'a> {
    /// The kernel, e.g. `particles/advance`.
    pub kernel: &'a str,
    /// The change, after the lint.
    pub change: &'a dyn Fn(&mut naga::Module),
}

/// How to run on a device. None of these but `plain` changes a bit of the result.
#[derive(Default)]
pub struct GpuOptions<'a> {
    /// Invocations a workgroup, 8 ..= 256, a multiple of 8; 0 for the default of 256.
    pub workgroup_size: u32,
    /// Most bytes a page of the pools; 0 for as much as the adapter binds.
    pub page_bytes: u64,
    /// Whether kernels check their own indices and bound their loops.
    pub checked: bool,
    /// Whether the adapter gets plain WGSL though it would take SPIR-V: what adapters that take
    /// none get. This alone may change bits.
    pub plain: bool,
    /// Whether kernels are timed, each in a pass of its own.
    pub timed: bool,
    /// A defect put in on purpose.
    pub mutation: Option<Mutation<'a>>,
}

/// Switches of what the plan does not use.
fn switches_off(plan: &Plan) -> Vec<&'static str> {
    let switches = plan.uses.switches().into_iter();
    switches
        .filter_map(|(switch, used)| (!used).then_some(switch))
        .collect()
}

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
    row_count: u32,
    curve_points: Vec<[f32; 4]>,
    pixels: u32,
    /// Which pool holds the particles.
    current: usize,
    /// Whether newborns stand behind the living: between emit and advance.
    newborns_present: bool,
    ring: StatisticsRing,
    in_flight: VecDeque<wgpu::SubmissionIndex>,
    timer: Option<Timer>,
}

impl GpuBackend {
    /// An empty run of `plan` on the device.
    ///
    /// # Errors
    /// The plan does not fit the adapter, memory runs out, or the driver refuses a kernel.
    pub fn new(gpu: &GpuDevice, plan: &Plan, options: &GpuOptions) -> Result<Self, BackendError> {
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
        let memory = Memory::new(gpu, plan, most_page_bytes)?;
        let mut kernels = HashMap::new();
        let off = switches_off(plan);
        let exact = gpu.description.exact && !options.plain;
        let form = if exact {
            KernelForm::Spirv
        } else {
            KernelForm::Wgsl
        };
        for source in shader::sources::KERNELS {
            let mutate = options
                .mutation
                .as_ref()
                .filter(|mutation| mutation.kernel == source.name)
                .map(|mutation| mutation.change);
            let compiled = shader::compile(
                source.name,
                &shader::CompileOptions {
                    workgroup_size,
                    checked: options.checked,
                    off: &off,
                    mutate,
                },
            )
            .map_err(|e| BackendError::Internal(e.to_string()))?;
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
            row_count: plan.row_count,
            curve_points: plan.curve_points.clone(),
            pixels: plan.width * plan.height,
            current: 0,
            newborns_present: false,
            ring: StatisticsRing::default(),
            in_flight: VecDeque::new(),
            timer: None,
        };
        for current in [0, 1] {
            for info in STAGES {
                let list = backend.expand(info.stage, current, plan, workgroup_size)?;
                backend.commands[current].insert(info.stage, list);
            }
        }
        if options.timed {
            backend.timer = Timer::new(gpu);
        }
        backend.gpu.check()?;
        Ok(backend)
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
        match &mut self.timer {
            Some(timer) => timer.take(&self.gpu),
            None => Ok(Vec::new()),
        }
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
        self.submit(&[stage], inputs)?;
        self.gpu.wait()
    }

    fn step(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        self.submit(
            &[Stage::Births, Stage::Emit, Stage::Cull, Stage::Advance],
            inputs,
        )
    }

    fn draw(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        self.submit(&[Stage::Splat, Stage::Resolve], inputs)
    }

    fn read(&mut self, buffer: &str) -> Result<Vec<u32>, BackendError> {
        let counts = self.counts()?;
        if buffer == "particles" {
            let mut left = u64::from(if self.newborns_present {
                counts.total
            } else {
                counts.live
            }) * 32;
            let mut words = Vec::new();
            for page in &self.memory.pools[self.current] {
                let here = left.min(page.size());
                words.extend(readback::words(&self.gpu, page, here)?);
                left -= here;
            }
            return Ok(words);
        }
        let whole = self.memory.named(buffer)?;
        let records = match buffer {
            "alive_bits" => u64::from(counts.total.div_ceil(32)),
            "birth_counts" => u64::from(self.system_count),
            "birth_offsets" => u64::from(self.system_count) + 1,
            "deaths" => 2,
            "image" => u64::from(self.pixels),
            "light_low" | "light_high" => u64::from(self.pixels) * 3,
            _ => whole.size() / 4,
        };
        readback::words(&self.gpu, whole, records * 4)
    }

    fn take_statistics(&mut self) -> Result<Vec<FrameStats>, BackendError> {
        self.ring.take(&self.gpu, &self.memory)
    }

    fn restore(&mut self, particles: &[u32], recent: &[FrameInputs]) -> Result<(), BackendError> {
        self.put(particles, recent)
    }

    fn record_stage(
        &mut self,
        stage: Stage,
        inputs: &FrameInputs,
    ) -> Result<Option<StageRecord>, BackendError> {
        self.record(stage, inputs).map(Some)
    }

    fn state_digest(&mut self) -> Result<u64, BackendError> {
        let commands = self.particle_digest(self.current)?;
        self.digest_of(&commands, 0)
    }

    fn image_digest(&mut self) -> Result<u64, BackendError> {
        let commands = self.image_digest_commands()?;
        self.digest_of(&commands, 0)
    }
}
