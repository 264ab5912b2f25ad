//! The one place with `unsafe`: shader modules that wgpu does not look into.
#![allow(unsafe_code)]

use std::borrow::Cow;

use wgpu::{
    PassthroughShaderEntryPoint, ShaderModule, ShaderModuleDescriptor,
    ShaderModuleDescriptorPassthrough, ShaderRuntimeChecks, ShaderSource,
};

use super::shader::CompiledKernel;

/// A module from the kernel's SPIR-V, as it is: its float operations carry `NoContraction`, which
/// wgpu's own translation would not write.
pub(super) fn spirv_module(device: &wgpu::Device, kernel: &CompiledKernel) -> ShaderModule {
    let [x, y, z] = kernel.workgroup_size;
    let descriptor = ShaderModuleDescriptorPassthrough {
        label: Some(kernel.name.as_str()),
        entry_points: Cow::Owned(vec![PassthroughShaderEntryPoint {
            name: Cow::Borrowed(kernel.entry_point.as_str()),
            workgroup_size: (x, y, z),
        }]),
        spirv: Some(Cow::Borrowed(&kernel.spirv)),
        ..Default::default()
    };
    // SAFETY: the words were written by naga from a module that it has validated, with decorations
    // added; kernels bound their own indices, which a test runs with checks on.
    unsafe { device.create_shader_module_passthrough(descriptor) }
}

/// A module from the kernel's plain WGSL, for adapters that take no SPIR-V.
pub(super) fn wgsl_module(
    device: &wgpu::Device,
    kernel: &CompiledKernel,
    checked: bool,
) -> ShaderModule {
    let descriptor = ShaderModuleDescriptor {
        label: Some(kernel.name.as_str()),
        source: ShaderSource::Wgsl(Cow::Borrowed(&kernel.wgsl)),
    };
    let checks = if checked {
        ShaderRuntimeChecks::checked()
    } else {
        ShaderRuntimeChecks::unchecked()
    };
    // SAFETY: wgpu validates the text; only the checks at run time are left out, for kernels that
    // bound their own indices and loops.
    unsafe { device.create_shader_module_trusted(descriptor, checks) }
}
