//! What kernels need of a device, and whether a caller's has it.

use super::dispatch::DISPATCH_WIDTH;
use crate::layout::{Frame, Particle};

/// Most bytes of immediates of a kernel.
const IMMEDIATE_BYTES: u32 = 24;

/// Most storage buffers of a kernel.
const STORAGE_BUFFERS: u32 = 8;

/// Most uniform buffers of a kernel.
const UNIFORM_BUFFERS: u32 = 3;

/// Most storage buffers of a kernel on a device with 64-bit integers.
const WIDE_STORAGE_BUFFERS: u32 = 9;

/// What makes kernels quicker where an adapter has both: 64-bit integers, and their atomic addition.
const WIDE: wgpu::Features =
    wgpu::Features::SHADER_INT64.union(wgpu::Features::SHADER_INT64_ATOMIC_ALL_OPS);

/// Most invocations of a workgroup, all along x.
const WORKGROUP_SIZE: u32 = 256;

/// Bytes of the smallest page of a pool. Large scenes need more: a run that finds too little says
/// which buffer.
const LEAST_BINDING: u64 = 2048 * size_of::<Particle>() as u64;

/// Whether SPIR-V can be handed to drivers of that interface.
pub(super) fn takes_spirv(backend: wgpu::Backend) -> bool {
    backend == wgpu::Backend::Vulkan
}

/// What a device must have to run kernels on this adapter; also what makes its bits exact
/// ([`wgpu::Features::PASSTHROUGH_SHADERS`]), where the adapter has it. None of them is one that
/// wgpu calls experimental, so no `unsafe` token is needed.
pub fn required_features(adapter: &wgpu::Adapter) -> wgpu::Features {
    let mut features = wgpu::Features::IMMEDIATES;
    if takes_spirv(adapter.get_info().backend) {
        features |= adapter.features() & wgpu::Features::PASSTHROUGH_SHADERS;
        if adapter.features().contains(WIDE) {
            features |= WIDE;
        }
    }
    features
}

/// Whether kernels may use 64-bit integers on this device.
pub(super) fn is_wide(device: &wgpu::Device) -> bool {
    device.features().contains(WIDE)
        && device.limits().max_storage_buffers_per_shader_stage >= WIDE_STORAGE_BUFFERS
}

/// wgpu's default limits, as far as the adapter has them, with those that kernels need in their
/// place and buffers as large as the adapter's: the particles alive at once are bounded by them.
/// Other limits may be raised at will.
pub fn required_limits(adapter: &wgpu::Adapter) -> wgpu::Limits {
    let most = adapter.limits();
    let mut limits = wgpu::Limits::default().or_worse_values_from(&most);
    limits.max_immediate_size = IMMEDIATE_BYTES
        .next_power_of_two()
        .min(most.max_immediate_size);
    if adapter.features().contains(WIDE) {
        let storage = &mut limits.max_storage_buffers_per_shader_stage;
        *storage = WIDE_STORAGE_BUFFERS.min(most.max_storage_buffers_per_shader_stage);
    }
    limits.max_buffer_size = most.max_buffer_size;
    limits.max_storage_buffer_binding_size = most.max_storage_buffer_binding_size;
    limits
}

/// A descriptor of a device that runs kernels. Features and limits may be added to it; a
/// [`wgpu::Features::TIMESTAMP_QUERY`] lets [`super::GpuOptions::timed`] work.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("motes"),
        required_features: required_features(adapter),
        required_limits: required_limits(adapter),
        ..Default::default()
    }
}

/// Why a caller's device cannot run kernels.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnfitDevice {
    /// It was opened without these features.
    Features(wgpu::Features),
    /// It was opened with a limit that is too low.
    Limit {
        /// Name of the limit in [`wgpu::Limits`].
        name: &'static str,
        /// The least that will do: bytes, or a number.
        needed: u64,
        /// What the device has.
        got: u64,
    },
    /// It has been destroyed, or its driver has given it up.
    Lost,
}

impl std::fmt::Display for UnfitDevice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Features(missing) => write!(
                f,
                "error: the device was opened without {missing:?}\n  = help: open it with \
                 `motes::gpu::required_features`, if its adapter has them"
            ),
            Self::Limit { name, needed, got } => write!(
                f,
                "error: the device was opened with `{name}` of {got}, and {needed} are needed\n  = \
                 help: open it with `motes::gpu::required_limits`"
            ),
            Self::Lost => write!(f, "error: the device is lost\n  = help: open another one"),
        }
    }
}

impl std::error::Error for UnfitDevice {}

/// Whether the device was opened with all that kernels need.
pub(super) fn check_needs(device: &wgpu::Device) -> Result<(), UnfitDevice> {
    let missing = wgpu::Features::IMMEDIATES - device.features();
    if !missing.is_empty() {
        return Err(UnfitDevice::Features(missing));
    }
    let has = device.limits();
    let small = |needed: u32, name, got: u32| (name, u64::from(needed), u64::from(got));
    let limits = [
        small(1, "max_bind_groups", has.max_bind_groups),
        small(
            STORAGE_BUFFERS,
            "max_storage_buffers_per_shader_stage",
            has.max_storage_buffers_per_shader_stage,
        ),
        small(
            UNIFORM_BUFFERS,
            "max_uniform_buffers_per_shader_stage",
            has.max_uniform_buffers_per_shader_stage,
        ),
        small(
            WORKGROUP_SIZE,
            "max_compute_invocations_per_workgroup",
            has.max_compute_invocations_per_workgroup,
        ),
        small(
            WORKGROUP_SIZE,
            "max_compute_workgroup_size_x",
            has.max_compute_workgroup_size_x,
        ),
        small(
            DISPATCH_WIDTH,
            "max_compute_workgroups_per_dimension",
            has.max_compute_workgroups_per_dimension,
        ),
        small(
            IMMEDIATE_BYTES,
            "max_immediate_size",
            has.max_immediate_size,
        ),
        (
            "max_uniform_buffer_binding_size",
            size_of::<Frame>() as u64,
            has.max_uniform_buffer_binding_size,
        ),
        (
            "max_storage_buffer_binding_size",
            LEAST_BINDING,
            has.max_storage_buffer_binding_size,
        ),
        ("max_buffer_size", LEAST_BINDING, has.max_buffer_size),
    ];
    match limits.into_iter().find(|(_, needed, got)| got < needed) {
        Some((name, needed, got)) => Err(UnfitDevice::Limit { name, needed, got }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::{Access, CompileOptions, compile, sources::KERNELS};

    #[test]
    fn the_needs_are_those_of_the_kernels() {
        for (wide, most) in [(false, STORAGE_BUFFERS), (true, WIDE_STORAGE_BUFFERS)] {
            check_kernels(wide, most);
        }
    }

    fn check_kernels(wide: bool, most: u32) {
        let (mut immediates, mut storage, mut uniforms) = (0, 0, 0);
        for source in KERNELS {
            let options = CompileOptions {
                workgroup_size: WORKGROUP_SIZE,
                wide,
                ..CompileOptions::default()
            };
            let kernel = compile(source.name, &options).expect("every kernel compiles");
            let count = |is: fn(Access) -> bool| {
                kernel.bindings.iter().filter(|b| is(b.access)).count() as u32
            };
            immediates = immediates.max(kernel.immediate_size);
            storage = storage.max(count(|access| access != Access::Uniform));
            uniforms = uniforms.max(count(|access| access == Access::Uniform));
        }
        let needs = (IMMEDIATE_BYTES, most, UNIFORM_BUFFERS);
        assert_eq!((immediates, storage, uniforms), needs);
    }
}
