//! A stage with its kernels and all that they bind, read back for a report to a driver's writers.

use std::collections::BTreeMap;

use super::GpuBackend;
use super::commands::{Command, Size};
use super::readback;
use super::shader::Access;
use crate::backend::{
    BackendError, BindingRecord, BufferRecord, DispatchRecord, Groups, KernelRecord, StageRecord,
};
use crate::plan::{FrameInputs, Stage};

impl GpuBackend {
    /// The stage as it would run now on `inputs`: everything before it in the frame has run.
    pub(super) fn record(
        &self,
        stage: Stage,
        inputs: &FrameInputs,
    ) -> Result<StageRecord, BackendError> {
        self.upload(inputs)?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.memory.begin(stage, &mut encoder);
        self.gpu.queue.submit([encoder.finish()]);
        let commands = &self.commands[self.current][&stage];
        let mut kernels: Vec<KernelRecord> = Vec::new();
        let mut buffers: BTreeMap<String, &wgpu::Buffer> = BTreeMap::new();
        let mut dispatches = Vec::new();
        for command in commands {
            let compiled = &self.kernels[command.kernel].compiled;
            if !kernels.iter().any(|kernel| kernel.name == compiled.name) {
                kernels.push(KernelRecord {
                    name: compiled.name.clone(),
                    entry_point: compiled.entry_point.clone(),
                    workgroup_size: compiled.workgroup_size,
                    spirv: compiled.spirv.clone(),
                    wgsl: compiled.wgsl.clone(),
                });
            }
            let mut bindings = Vec::new();
            for binding in &compiled.bindings {
                let (name, buffer) = self.bound(command, &binding.name)?;
                buffers.insert(name.clone(), buffer);
                bindings.push(BindingRecord {
                    binding: binding.binding,
                    variable: binding.name.clone(),
                    buffer: name,
                    access: match binding.access {
                        Access::Uniform => "uniform",
                        Access::Read => "read",
                        Access::ReadWrite => "read_write",
                    },
                });
            }
            dispatches.push(DispatchRecord {
                kernel: compiled.name.clone(),
                groups: match command.size {
                    Size::Direct(x, y) => Groups::Direct([x, y, 1]),
                    Size::Indirect(at) => Groups::Listed(at),
                },
                immediates: command.immediates.clone(),
                bindings,
            });
        }
        buffers.insert("dispatches".to_owned(), self.memory.named("dispatches")?);
        let buffers = buffers
            .into_iter()
            .map(|(name, buffer)| {
                let words = readback::words(&self.gpu, buffer, buffer.size())?;
                Ok(BufferRecord { name, words })
            })
            .collect::<Result<_, BackendError>>()?;
        Ok(StageRecord {
            adapter: self.gpu.description.name.clone(),
            driver: self.gpu.description.driver.clone(),
            kernels,
            dispatches,
            buffers,
        })
    }

    /// The buffer that a dispatch binds to a variable, and its name in records.
    fn bound(
        &self,
        command: &Command,
        variable: &str,
    ) -> Result<(String, &wgpu::Buffer), BackendError> {
        let (pages, page) = match variable {
            "particles" => (&*self.memory.pools[self.current], command.pages[0]),
            "survivors" => (&*self.memory.pools[1 - self.current], command.pages[1]),
            "large_particles" => (&*self.memory.large, command.pages[0]),
            "sort_pairs" if command.swaps => return self.bound_by_name("sorted_pairs"),
            "sorted_pairs" if command.swaps => return self.bound_by_name("sort_pairs"),
            name => match self.memory.flame_pages(name) {
                Some(pages) => (pages, command.pages[0]),
                None => return self.bound_by_name(name),
            },
        };
        let buffer = pages
            .get(page)
            .ok_or_else(|| BackendError::Internal(format!("no page {page} of `{variable}`")))?;
        Ok((format!("{variable}-{page}"), buffer))
    }

    fn bound_by_name(&self, name: &str) -> Result<(String, &wgpu::Buffer), BackendError> {
        Ok((name.to_owned(), self.memory.named(name)?))
    }
}
