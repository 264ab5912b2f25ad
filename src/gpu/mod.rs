//! A [`Plan`] on wgpu.
//!
//! [`shader`] turns WGSL into kernels, pure and without a device; `kernel` puts one on a device and
//! finds its buffers by name; `memory` holds the buffers; `commands` expands the plan's stages into
//! dispatches; `readback` brings statistics and state home. All `unsafe` is in `raw`.

mod adapter;
mod commands;
pub mod dispatch;
mod kernel;
mod memory;
mod probe;
mod raw;
mod readback;
mod record;
pub mod shader;
mod timing;
mod yardstick;

use std::collections::{HashMap, VecDeque};

use crate::backend::{Backend, BackendError, StageRecord};
use crate::layout::{Counts, Frame, FrameStats};
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
    [
        ("THRESHOLDS", plan.uses.thresholds),
        ("STREAKS", plan.uses.streaks),
        ("RECTANGLES", plan.uses.rectangles),
    ]
    .into_iter()
    .filter_map(|(switch, used)| (!used).then_some(switch))
    .collect()
}

/// Frames that may be under way on the device at once.
const FRAMES_IN_FLIGHT: usize = 3;

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
        let workgroup_size = if options.workgroup_size == 0 { 256 } else { options.workgroup_size };
        let most_page_bytes = if options.page_bytes == 0 { u64::MAX } else { options.page_bytes };
        let memory = Memory::new(gpu, plan, most_page_bytes)?;
        let mut kernels = HashMap::new();
        let off = switches_off(plan);
        let exact = gpu.description.exact && !options.plain;
        let form = if exact { KernelForm::Spirv } else { KernelForm::Wgsl };
        for source in shader::sources::KERNELS {
            let mutate = options
                .mutation
                .as_ref()
                .filter(|mutation| mutation.kernel == source.name)
                .map(|mutation| mutation.change);
            let compiled = shader::compile(
                source.name,
                &shader::CompileOptions { workgroup_size, checked: options.checked, off: &off, mutate },
            )
            .map_err(|e| BackendError::Internal(e.to_string()))?;
            kernels.insert(source.name, Kernel::new(gpu, &compiled, form, options.checked)?);
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

    fn upload(&self, inputs: &FrameInputs) -> Result<(), BackendError> {
        let queue = &self.gpu.queue;
        let frame = Frame {
            page_len: self.memory.paging.page_len,
            page_count: self.memory.paging.page_count,
            ..inputs.frame
        };
        queue.write_buffer(self.memory.named("frame")?, 0, bytemuck::bytes_of(&frame));
        queue.write_buffer(
            self.memory.named("system_frames")?,
            0,
            bytemuck::cast_slice(&inputs.systems),
        );
        let rows = self.memory.named("rows")?;
        for (slot, row) in inputs.rows.iter().enumerate() {
            let at = slot as u32 * self.row_count + frame.frame % self.row_count;
            queue.write_buffer(rows, u64::from(at) * size_of_val(row) as u64, bytemuck::bytes_of(row));
        }
        Ok(())
    }

    /// Submits the stages' dispatches in order.
    fn submit(&mut self, stages: &[Stage], inputs: &FrameInputs) -> Result<(), BackendError> {
        self.submit_kernels(stages, |_| true, inputs)
    }

    /// Submits those of the stages' dispatches whose kernel is `wanted`; a stage is over with its
    /// last kernel.
    fn submit_kernels(
        &mut self,
        stages: &[Stage],
        wanted: impl Fn(&str) -> bool,
        inputs: &FrameInputs,
    ) -> Result<(), BackendError> {
        self.upload(inputs)?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut timed = self.timer.as_mut().map(Timer::frame);
        for &stage in stages {
            if stage == Stage::Splat {
                self.memory.clear_light(&mut encoder)?;
            }
            let dispatches = self.memory.named("dispatches")?;
            let all = &self.commands[self.current][&stage];
            let commands = all.iter().filter(|command| wanted(command.kernel));
            match &mut timed {
                None => {
                    let mut pass = encoder.begin_compute_pass(&Default::default());
                    for command in commands {
                        command.encode(&mut pass, &self.kernels, dispatches);
                    }
                }
                Some(timed) => {
                    for command in commands {
                        let mut pass = encoder.begin_compute_pass(&timed.pass(command.kernel));
                        command.encode(&mut pass, &self.kernels, dispatches);
                    }
                }
            }
            if all.last().is_some_and(|last| !wanted(last.kernel)) {
                continue;
            }
            match stage {
                Stage::Emit => self.newborns_present = true,
                Stage::Advance => {
                    self.newborns_present = false;
                    self.current = 1 - self.current;
                    self.ring.stepped(&self.gpu, &self.memory, &mut encoder, inputs.frame.frame)?;
                }
                _ => {}
            }
        }
        if let Some(timed) = timed {
            timed.resolve(&mut encoder);
        }
        let submission = self.gpu.queue.submit([encoder.finish()]);
        self.ring.submitted();
        self.in_flight.push_back(submission);
        if self.in_flight.len() > FRAMES_IN_FLIGHT {
            let oldest = self.in_flight.pop_front();
            self.gpu
                .device
                .poll(wgpu::PollType::Wait { submission_index: oldest, timeout: None })
                .map_err(|e| BackendError::DeviceLost(e.to_string()))?;
        }
        self.gpu.check()
    }

    fn counts(&self) -> Result<Counts, BackendError> {
        let words = readback::words(&self.gpu, self.memory.named("counts")?, size_of::<Counts>() as u64)?;
        Ok(bytemuck::pod_read_unaligned(bytemuck::cast_slice(&words)))
    }

    fn digest_of(&mut self, commands: &[Command], at: usize) -> Result<u64, BackendError> {
        let digest = self.memory.named("digest")?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(digest, 0, None);
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            let dispatches = self.memory.named("dispatches")?;
            for command in commands {
                command.encode(&mut pass, &self.kernels, dispatches);
            }
        }
        self.gpu.queue.submit([encoder.finish()]);
        let words = readback::words(&self.gpu, digest, 16)?;
        Ok(u64::from(words[at]) | (u64::from(words[at + 1]) << 32))
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
        self.submit(&[Stage::Births, Stage::Emit, Stage::Cull, Stage::Advance], inputs)
    }

    fn draw(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        self.submit(&[Stage::Splat, Stage::Resolve], inputs)
    }

    fn read(&mut self, buffer: &str) -> Result<Vec<u32>, BackendError> {
        let counts = self.counts()?;
        if buffer == "particles" {
            let mut left = u64::from(if self.newborns_present { counts.total } else { counts.live }) * 32;
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
            "image" => u64::from(self.pixels),
            "light_low" | "light_high" => u64::from(self.pixels) * 3,
            _ => whole.size() / 4,
        };
        readback::words(&self.gpu, whole, records * 4)
    }

    fn take_statistics(&mut self) -> Result<Vec<FrameStats>, BackendError> {
        self.ring.take(&self.gpu, &self.memory)
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
