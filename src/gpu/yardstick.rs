//! Kernels alone, on buffers of their own: what an adapter can do at best, which stages are held
//! against. `src/bench/` decides what is measured and how often; here it is put on the device.

use std::time::Instant;

use super::device::GpuDevice;
use super::dispatch::dispatch_for;
use super::kernel::Kernel;
use super::probe::KernelForm;
use super::raster::Raster;
use super::shader::{self, CompileOptions};
use super::timing::Timer;
use super::yardstick_memory::{Page, YardstickMemory};
use crate::backend::BackendError;

/// How long one run took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timed {
    /// Milliseconds.
    pub ms: f64,
    /// Whether by the device's own clock; else by that of the processor, from the submission until
    /// the device is done.
    pub by_device: bool,
}

/// Work that can be run again and again, each run timed.
#[derive(Debug)]
pub struct Yardstick {
    name: &'static str,
    gpu: GpuDevice,
    /// Copied before each run, untimed where the device has a clock.
    before: Vec<(wgpu::Buffer, wgpu::Buffer)>,
    work: Work,
    /// Passes of a run, one after another in one submission.
    passes: u32,
    timer: Option<Timer>,
}

#[derive(Debug)]
pub(super) enum Work {
    Dispatches(Vec<Ready>),
    /// From, to, bytes.
    Copies(Vec<(wgpu::Buffer, wgpu::Buffer, u64)>),
    Raster(Raster),
}

/// A dispatch, ready to encode.
#[derive(Debug)]
pub(super) struct Ready {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    immediates: Vec<u32>,
    groups: (u32, u32),
}

/// A kernel, with its invocations for so many particles.
type Step = (&'static str, fn(u32) -> u32);

/// The kernels of the prefix sum over the survivors.
const SCAN: &[Step] = &[
    ("scan/count_bits", |particles| particles.div_ceil(2048)),
    ("scan/sum_runs", |particles| particles.div_ceil(131_072)),
    ("scan/survivors", |_| 1),
    ("scan/spread_runs", |particles| particles.div_ceil(131_072)),
    ("scan/spread_bits", |particles| particles.div_ceil(2048)),
];

impl Yardstick {
    /// Runs `kernel` over all records, page by page: an invocation takes `1 / invocations_per_record`
    /// of a record, or a run of `records_per_invocation`. It binds what `memory` has, by name.
    ///
    /// # Errors
    /// No kernel has that name, it binds something else, or the device fails.
    pub fn kernel(
        memory: &YardstickMemory,
        name: &'static str,
        kernel: &'static str,
        workgroup_size: u32,
        invocations: impl Fn(u32) -> u32,
    ) -> Result<Self, BackendError> {
        let gpu = &memory.gpu;
        gpu.watched(|| {
            let compiled = compiled(gpu, kernel, workgroup_size)?;
            let dispatches = memory.pages.iter().map(|page| {
                let work = (invocations(page.records), workgroup_size);
                let named = |name: &str| memory.named(name, Some(page));
                ready(gpu, &compiled, &named, &[page.records], work)
            });
            let work = Work::Dispatches(dispatches.collect::<Result<_, _>>()?);
            Ok(Self::new(gpu, name, work))
        })
    }

    /// The prefix sum over as many survivors as `memory` has records: all of its kernels.
    ///
    /// # Errors
    /// The device fails.
    pub fn scan(memory: &YardstickMemory, workgroup_size: u32) -> Result<Self, BackendError> {
        let gpu = &memory.gpu;
        gpu.watched(|| {
            let dispatches = SCAN.iter().map(|(kernel, invocations)| {
                let compiled = compiled(gpu, kernel, workgroup_size)?;
                let size = compiled.compiled.workgroup_size[0];
                let work = (invocations(memory.records), size);
                let named = |name: &str| memory.named(name, None);
                ready(gpu, &compiled, &named, &[], work)
            });
            let work = Work::Dispatches(dispatches.collect::<Result<_, _>>()?);
            Ok(Self::new(gpu, "scan", work))
        })
    }

    /// The interface's own copy of all records.
    ///
    /// # Errors
    /// The device fails.
    pub fn copy_buffer(memory: &YardstickMemory) -> Result<Self, BackendError> {
        let copy = |page: &Page| {
            let (from, to) = (page.source.clone(), page.destination.clone());
            let bytes = from.size();
            (from, to, bytes)
        };
        let work = Work::Copies(memory.pages.iter().map(copy).collect());
        memory
            .gpu
            .watched(|| Ok(Self::new(&memory.gpu, "copy_buffer", work)))
    }

    /// The same so many times in a run, 1 ..= 1,000, pass after pass; a run's time is that of one.
    #[must_use]
    pub fn repeated(self, passes: u32) -> Self {
        Self {
            passes: passes.clamp(1, 1000),
            ..self
        }
    }

    /// A pass of the device's own rasteriser.
    pub(super) fn raster(gpu: &GpuDevice, name: &'static str, raster: Raster) -> Self {
        Self::new(gpu, name, Work::Raster(raster))
    }

    /// The same, with copies from the first to the second of each before every run.
    pub(super) fn after(self, before: Vec<(wgpu::Buffer, wgpu::Buffer)>) -> Self {
        Self { before, ..self }
    }

    pub(super) fn new(gpu: &GpuDevice, name: &'static str, work: Work) -> Self {
        let timer = Timer::new(gpu)
            .filter(|timer| !matches!(work, Work::Copies(_)) || timer.times_between_passes());
        Self {
            name,
            gpu: gpu.clone(),
            before: Vec::new(),
            work,
            passes: 1,
            timer,
        }
    }

    /// Runs it once and waits for it.
    ///
    /// # Errors
    /// The device fails.
    pub fn run(&mut self) -> Result<Timed, BackendError> {
        let gpu = self.gpu.clone();
        gpu.watched(|| self.timed())
    }

    fn timed(&mut self) -> Result<Timed, BackendError> {
        let begun = Instant::now();
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        for (from, to) in &self.before {
            encoder.copy_buffer_to_buffer(from, 0, to, 0, from.size());
        }
        let mut timed = self.timer.as_mut().map(Timer::frame);
        for _ in 0..self.passes {
            match &self.work {
                Work::Dispatches(dispatches) => {
                    let descriptor = match &mut timed {
                        Some(timed) => timed.pass(self.name),
                        None => wgpu::ComputePassDescriptor::default(),
                    };
                    let mut pass = encoder.begin_compute_pass(&descriptor);
                    for ready in dispatches {
                        pass.set_pipeline(&ready.pipeline);
                        pass.set_bind_group(0, &ready.group, &[]);
                        if !ready.immediates.is_empty() {
                            pass.set_immediates(0, bytemuck::cast_slice(&ready.immediates));
                        }
                        pass.dispatch_workgroups(ready.groups.0, ready.groups.1, 1);
                    }
                }
                Work::Copies(copies) => {
                    let copy = |encoder: &mut wgpu::CommandEncoder| {
                        for (from, to, bytes) in copies {
                            encoder.copy_buffer_to_buffer(from, 0, to, 0, *bytes);
                        }
                    };
                    match &mut timed {
                        Some(timed) => timed.between_passes(self.name, &mut encoder, copy),
                        None => copy(&mut encoder),
                    }
                }
                Work::Raster(raster) => {
                    let stamps = timed.as_mut().and_then(|timed| timed.stamps(self.name));
                    raster.encode(&mut encoder, stamps);
                }
            }
        }
        if let Some(timed) = timed {
            timed.resolve(&mut encoder);
        }
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait()?;
        let wall_ms = begun.elapsed().as_secs_f64() * 1e3;
        let times = match &mut self.timer {
            Some(timer) => timer.take()?,
            None => Vec::new(),
        };
        let by_device: Vec<f64> = times.iter().flatten().map(|(_, ms)| *ms).collect();
        let all_ms = match by_device.is_empty() {
            true => wall_ms,
            false => by_device.iter().sum(),
        };
        Ok(Timed {
            ms: all_ms / f64::from(self.passes),
            by_device: !by_device.is_empty(),
        })
    }
}

pub(super) fn compiled(
    gpu: &GpuDevice,
    kernel: &str,
    workgroup_size: u32,
) -> Result<Kernel, BackendError> {
    let options = CompileOptions {
        workgroup_size,
        wide: gpu.is_wide(),
        ..CompileOptions::default()
    };
    let compiled =
        shader::compile(kernel, &options).map_err(|e| BackendError::Internal(e.to_string()))?;
    let form = if gpu.description.exact {
        KernelForm::Spirv
    } else {
        KernelForm::Wgsl
    };
    Ok(Kernel::unchecked_bindings(gpu, &compiled, form, false))
}

/// The dispatch of a kernel whose bindings are found by their names.
pub(super) fn ready<'a>(
    gpu: &GpuDevice,
    kernel: &Kernel,
    named: &dyn Fn(&str) -> Option<&'a wgpu::Buffer>,
    immediates: &[u32],
    (invocations, workgroup_size): (u32, u32),
) -> Result<Ready, BackendError> {
    let name = &kernel.compiled.name;
    let entries = kernel.compiled.bindings.iter().map(|binding| {
        let buffer = named(&binding.name).ok_or_else(|| {
            BackendError::Unsupported(format!("no buffer `{}` for `{name}` alone", binding.name))
        })?;
        Ok(wgpu::BindGroupEntry {
            binding: binding.binding,
            resource: buffer.as_entire_binding(),
        })
    });
    let entries: Vec<_> = entries.collect::<Result<_, BackendError>>()?;
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(name),
        layout: &kernel.layout,
        entries: &entries,
    });
    let words = kernel.compiled.immediate_size as usize / 4;
    Ok(Ready {
        pipeline: kernel.pipeline.clone(),
        group,
        immediates: immediates.iter().copied().take(words).collect(),
        groups: dispatch_for(invocations, workgroup_size),
    })
}
