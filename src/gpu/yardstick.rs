//! What an adapter's memory can do at best: the measure that stages are held against.

use super::device::GpuDevice;
use super::dispatch::dispatch_for;
use super::kernel::Kernel;
use super::probe::KernelForm;
use super::shader::{self, CompileOptions};
use super::timing::Timer;
use crate::backend::BackendError;
use crate::layout::Particle;

impl GpuDevice {
    /// Milliseconds of each of `repeats` runs of a yardstick over `records` particles (32 bytes
    /// read, 32 written), on the device's clock; empty where it has none. At most one binding's
    /// worth of records. `bench/copy` does nothing else; the others work on what they read.
    ///
    /// # Errors
    /// No yardstick has that name, out of memory, or the device fails.
    pub fn yardstick_times(
        &self,
        yardstick: &'static str,
        records: u32,
        workgroup_size: u32,
        repeats: u32,
    ) -> Result<Vec<f64>, BackendError> {
        self.watched(|| self.measured(yardstick, records, workgroup_size, repeats))
    }

    fn measured(
        &self,
        yardstick: &'static str,
        records: u32,
        workgroup_size: u32,
        repeats: u32,
    ) -> Result<Vec<f64>, BackendError> {
        let Some(mut timer) = Timer::new(self) else {
            return Ok(Vec::new());
        };
        let compiled = shader::compile(
            yardstick,
            &CompileOptions {
                workgroup_size,
                ..CompileOptions::default()
            },
        )
        .map_err(|e| BackendError::Internal(e.to_string()))?;
        let form = if self.description.exact {
            KernelForm::Spirv
        } else {
            KernelForm::Wgsl
        };
        let kernel = Kernel::unchecked_bindings(self, &compiled, form, false);
        let buffers = ["source", "destination"].map(|label| {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::from(records) * size_of::<Particle>() as u64,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        // Random words: a copy of zeros can be quicker than one of data.
        let words: Vec<u32> = (0..records * 8)
            .map(|at| at.wrapping_mul(0x9e37_79b9))
            .collect();
        self.queue
            .write_buffer(&buffers[0], 0, bytemuck::cast_slice(&words));
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(yardstick),
            layout: &kernel.layout,
            entries: &[0, 1].map(|at| wgpu::BindGroupEntry {
                binding: at,
                resource: buffers[at as usize].as_entire_binding(),
            }),
        });
        for _ in 0..repeats {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            let mut timed = timer.frame();
            {
                let mut pass = encoder.begin_compute_pass(&timed.pass(yardstick));
                pass.set_pipeline(&kernel.pipeline);
                pass.set_bind_group(0, &group, &[]);
                pass.set_immediates(0, bytemuck::bytes_of(&records));
                let (x, y) = dispatch_for(records, workgroup_size);
                pass.dispatch_workgroups(x, y, 1);
            }
            timed.resolve(&mut encoder);
            self.queue.submit([encoder.finish()]);
            self.wait()?;
        }
        let times = timer.take(self)?;
        Ok(times.into_iter().flatten().map(|(_, ms)| ms).collect())
    }
}
