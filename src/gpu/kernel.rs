//! A compiled kernel on a device, and the buffers it asks for by name.

use super::device::GpuDevice;
use super::probe::KernelForm;
use super::raw;
use super::shader::{Access, Binding, CompiledKernel};
use crate::backend::BackendError;
use crate::plan::{Buffer, buffer};

/// A pipeline with what it binds.
#[derive(Debug)]
pub(super) struct Kernel {
    /// What was handed to the driver, kept for reports about it.
    pub(super) compiled: CompiledKernel,
    pub(super) pipeline: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

/// Names that kernels give to views of other buffers, as vectors of words.
const VIEWS: &[&str] = &["words"];

/// Whether what WGSL binds is what Rust declares under that name.
///
/// # Errors
/// The file, the line and the difference.
pub fn check_binding(binding: &Binding) -> Result<(), String> {
    let place = format!("{}:{}", binding.file, binding.line);
    if VIEWS.contains(&binding.name.as_str()) {
        return Ok(());
    }
    let Some(declared) = buffer(&binding.name) else {
        return Err(format!(
            "{place}: no buffer is declared under the name `{}`",
            binding.name
        ));
    };
    let Buffer {
        name,
        record,
        stride,
        ..
    } = declared;
    let shape = &binding.shape;
    let type_name = shape
        .type_name
        .strip_prefix("atomic<")
        .and_then(|inner| inner.strip_suffix('>'))
        .unwrap_or(&shape.type_name);
    // Words may be looked at four at a time: buffers hold whole fours. Two may be one of 64 bits.
    let in_other_words = matches!(
        (*record, type_name),
        ("u32", "vec4<u32>") | ("u64" | "Particle" | "Boid", "vec4<u64>") | ("vec2<u32>", "u64")
    ) && shape.runtime_array;
    if !in_other_words && (type_name != *record || shape.stride != *stride) {
        return Err(format!(
            "{place}: `{name}` holds {record} of {stride} bytes, not {type_name} of {} bytes",
            shape.stride
        ));
    }
    Ok(())
}

impl Kernel {
    /// The kernel, once its bindings are found to be what Rust declares.
    pub(super) fn new(
        gpu: &GpuDevice,
        compiled: &CompiledKernel,
        form: KernelForm,
        checked: bool,
    ) -> Result<Self, BackendError> {
        for binding in &compiled.bindings {
            check_binding(binding).map_err(BackendError::Internal)?;
        }
        gpu.watched(|| Ok(Self::unchecked_bindings(gpu, compiled, form, checked)))
    }

    /// The kernel, whatever its bindings are called and hold; the caller watches.
    pub(super) fn unchecked_bindings(
        gpu: &GpuDevice,
        compiled: &CompiledKernel,
        form: KernelForm,
        checked: bool,
    ) -> Self {
        let device = &gpu.device;
        let entries: Vec<_> = compiled.bindings.iter().map(layout_entry).collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(&compiled.name),
            entries: &entries,
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&compiled.name),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: compiled.immediate_size,
        });
        let module = match form {
            KernelForm::Spirv => raw::spirv_module(device, compiled),
            KernelForm::Wgsl => raw::wgsl_module(device, compiled, checked),
        };
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&compiled.name),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(&compiled.entry_point),
            compilation_options: wgpu::PipelineCompilationOptions {
                zero_initialize_workgroup_memory: false,
                ..Default::default()
            },
            cache: None,
        });
        Self {
            compiled: compiled.clone(),
            pipeline,
            layout,
        }
    }
}

fn layout_entry(binding: &Binding) -> wgpu::BindGroupLayoutEntry {
    let ty = match binding.access {
        Access::Uniform => wgpu::BufferBindingType::Uniform,
        Access::Read => wgpu::BufferBindingType::Storage { read_only: true },
        Access::ReadWrite => wgpu::BufferBindingType::Storage { read_only: false },
    };
    wgpu::BindGroupLayoutEntry {
        binding: binding.binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}
