//! Kernels one by one, to ask a driver what it does: alone, on buffers of the caller's making, or in
//! a run, with a look at the buffers between one and the next.

use super::GpuBackend;
use super::commands::{KernelUse, stages_of, turning_with};
use super::device::GpuDevice;
use super::dispatch::dispatch_for;
use super::kernel::Kernel;
use super::readback;
use super::readback::StatisticsRing;
use super::shader::{Access, CompiledKernel};
use crate::backend::BackendError;
use crate::plan::FrameInputs;

/// In which form a driver gets a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KernelForm {
    /// [`CompiledKernel::spirv`], word by word.
    Spirv,
    /// [`CompiledKernel::wgsl`], which wgpu translates; nothing keeps the driver from contracting.
    Wgsl,
}

fn is_output(access: Access) -> bool {
    access == Access::ReadWrite
}

impl GpuDevice {
    /// Runs `kernel` once and returns what it left in its one read-write buffer, which starts
    /// zeroed and holds `output_words`. Its other bindings get `inputs`, in order. At least
    /// `invocations` of it run: the kernel bounds its own index.
    ///
    /// # Errors
    /// The kernel's bindings do not fit `inputs`, it takes immediates, or the device fails.
    pub fn run_kernel(
        &self,
        kernel: &CompiledKernel,
        form: KernelForm,
        inputs: &[&[u32]],
        output_words: usize,
        invocations: u32,
    ) -> Result<Vec<u32>, BackendError> {
        let outputs = kernel
            .bindings
            .iter()
            .filter(|b| is_output(b.access))
            .count();
        if outputs != 1 || kernel.bindings.len() != inputs.len() + 1 || kernel.immediate_size != 0 {
            return Err(BackendError::Unsupported(format!(
                "kernel `{}` with {} bindings, {outputs} of them read-write, and {} bytes of \
                 immediates cannot be run on {} inputs and one output",
                kernel.name,
                kernel.bindings.len(),
                kernel.immediate_size,
                inputs.len()
            )));
        }
        self.watched(|| self.run_once(kernel, form, inputs, output_words, invocations))
    }

    /// As [`GpuDevice::run_kernel`], of a kernel whose bindings fit.
    fn run_once(
        &self,
        kernel: &CompiledKernel,
        form: KernelForm,
        inputs: &[&[u32]],
        output_words: usize,
        invocations: u32,
    ) -> Result<Vec<u32>, BackendError> {
        let compiled = Kernel::unchecked_bindings(self, kernel, form, true);
        let zeros = vec![0; output_words];
        let mut inputs = inputs.iter();
        let mut output = None;
        let mut buffers = Vec::new();
        for binding in &kernel.bindings {
            let words: &[u32] = if is_output(binding.access) {
                &zeros
            } else {
                inputs.next().copied().unwrap_or_default()
            };
            let buffer = self.filled(&binding.name, binding.access, words);
            if is_output(binding.access) {
                output = Some(buffer.clone());
            }
            buffers.push(buffer);
        }
        let entries: Vec<_> = kernel
            .bindings
            .iter()
            .zip(&buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding: binding.binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&kernel.name),
            layout: &compiled.layout,
            entries: &entries,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&compiled.pipeline);
            pass.set_bind_group(0, &group, &[]);
            let (x, y) = dispatch_for(invocations, kernel.workgroup_size[0]);
            pass.dispatch_workgroups(x, y, 1);
        }
        self.queue.submit([encoder.finish()]);
        match output {
            Some(output) => readback::words(self, &output, output_words as u64 * 4),
            None => Ok(Vec::new()),
        }
    }

    fn filled(&self, name: &str, access: Access, words: &[u32]) -> wgpu::Buffer {
        use wgpu::BufferUsages as Usage;
        let kind = if access == Access::Uniform {
            Usage::UNIFORM
        } else {
            Usage::STORAGE
        };
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(name),
            size: (words.len() as u64 * 4).next_multiple_of(16).max(16),
            usage: kind | Usage::COPY_DST | Usage::COPY_SRC,
            mapped_at_creation: false,
        });
        self.queue
            .write_buffer(&buffer, 0, bytemuck::cast_slice(words));
        buffer
    }
}

impl GpuBackend {
    /// Runs one kernel's dispatches in one stage of one frame and waits for them. All of
    /// [`STAGE_KERNELS`](super::STAGE_KERNELS) one after the other make the frame that stepping and drawing make; of those
    /// that take turns, all run with the last.
    ///
    /// # Errors
    /// The device fails.
    pub fn run_kernel(
        &mut self,
        kernel: &KernelUse,
        inputs: &FrameInputs,
    ) -> Result<(), BackendError> {
        self.stepped(|run| {
            let together = turning_with(kernel);
            let is_last = together.last().is_some_and(|last| *last == kernel);
            let wanted = |other: &KernelUse| is_last && together.contains(&other);
            run.submit_kernels(&[kernel.stage], wanted, inputs)?;
            run.gpu.wait()
        })
    }

    /// Puts words at the beginning of a buffer, which holds at least as many: a stage can then be run on
    /// what no scene leads to. The pools are not among the buffers.
    ///
    /// # Errors
    /// There is no such buffer, or the device fails.
    pub fn write(&mut self, buffer: &str, words: &[u32]) -> Result<(), BackendError> {
        self.stepped(|run| {
            let place = run.memory.named(buffer)?;
            run.gpu.write(place, 0, bytemuck::cast_slice(words))
        })
    }

    /// The plan's run from its beginning, with every buffer zero, and with `changed`, which must
    /// bind the same, in place of the kernel of its name.
    ///
    /// # Errors
    /// The driver refuses the kernel, or the device fails.
    pub fn restart(
        &mut self,
        changed: &CompiledKernel,
        form: KernelForm,
        checked: bool,
    ) -> Result<(), BackendError> {
        let kernel = Kernel::new(&self.gpu, changed, form, checked)?;
        match self.kernels.get_mut(changed.name.as_str()) {
            Some(place) => *place = kernel,
            // The plan does without it.
            None if stages_of(&changed.name).next().is_some() => {}
            None => {
                let found = format!("a run has no kernel `{}`", changed.name);
                return Err(BackendError::Unsupported(found));
            }
        }
        self.failure = None;
        self.stepped(|run| {
            let mut encoder = run.gpu.device.create_command_encoder(&Default::default());
            for buffer in run.memory.all() {
                encoder.clear_buffer(buffer, 0, None);
            }
            run.gpu.queue.submit([encoder.finish()]);
            run.upload_stored()?;
            run.current = 0;
            run.newborns_present = false;
            run.ring = StatisticsRing::default();
            run.in_flight.clear();
            run.gpu.wait()
        })
    }
}
