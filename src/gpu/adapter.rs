//! Which adapters there are, which one is meant, and a device of our own on it.

use super::device::{GpuDevice, is_exact};
use super::needs::required_features;
use crate::backend::BackendError;

/// An adapter, for people and for `motes adapters --json`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterDescription {
    /// The driver's name for it.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Graphics interface: `vulkan`, `metal`, `dx12`.
    pub backend: String,
    /// `hardware` or `software`.
    pub kind: &'static str,
    /// Whether it takes SPIR-V as it is, so that its bits are those of every exact adapter.
    pub exact: bool,
    /// Largest storage buffer binding, bytes: the largest page of a pool.
    pub most_binding_bytes: u64,
}

fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    // WGPU_VALIDATION=1 turns the driver's own validation layer on.
    descriptor.flags = wgpu::InstanceFlags::empty().with_env();
    // Kernels clamp the arguments of indirect dispatches themselves.
    descriptor
        .flags
        .remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
    wgpu::Instance::new(descriptor)
}

pub(super) fn describe(
    info: &wgpu::AdapterInfo,
    features: wgpu::Features,
    limits: &wgpu::Limits,
) -> AdapterDescription {
    let driver = format!("{} {}", info.driver, info.driver_info);
    AdapterDescription {
        name: info.name.clone(),
        driver: driver.trim().to_owned(),
        backend: info.backend.to_str().to_owned(),
        kind: if info.device_type == wgpu::DeviceType::Cpu {
            "software"
        } else {
            "hardware"
        },
        exact: is_exact(info, features),
        most_binding_bytes: limits.max_storage_buffer_binding_size,
    }
}

fn describe_adapter(adapter: &wgpu::Adapter) -> AdapterDescription {
    describe(&adapter.get_info(), adapter.features(), &adapter.limits())
}

/// Adapters that can run kernels: hardware first, then software.
fn usable(instance: &wgpu::Instance) -> Vec<wgpu::Adapter> {
    let mut adapters: Vec<_> =
        pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY))
            .into_iter()
            .filter(|adapter| adapter.features().contains(wgpu::Features::IMMEDIATES))
            .collect();
    adapters.sort_by_key(|adapter| match adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        // Of software adapters, Mesa's is the quicker one.
        wgpu::DeviceType::Cpu if adapter.get_info().name.starts_with("llvmpipe") => 4,
        wgpu::DeviceType::Cpu => 5,
    });
    adapters
}

/// All adapters that can run kernels, best first.
pub fn adapters() -> Vec<AdapterDescription> {
    usable(&instance()).iter().map(describe_adapter).collect()
}

/// Opens the first adapter whose name or driver contains `name`, whatever the case; the first of
/// all for the empty name. `None` when there is no such adapter.
///
/// # Errors
/// The driver refuses to open the device.
pub fn open(name: &str) -> Result<Option<GpuDevice>, BackendError> {
    let found = named(&instance(), name).next();
    found.map(|adapter| open_adapter(&adapter)).transpose()
}

/// Adapters that can run kernels whose name or driver contains `name`, whatever the case, best first.
pub(crate) fn named(instance: &wgpu::Instance, name: &str) -> impl Iterator<Item = wgpu::Adapter> {
    // The driver is called lavapipe, and names its adapter after the older half of it.
    let wanted = name.to_lowercase().replace("lavapipe", "llvmpipe");
    usable(instance).into_iter().filter(move |adapter| {
        let info = adapter.get_info();
        format!("{} {}", info.name, info.driver)
            .to_lowercase()
            .contains(&wanted)
    })
}

fn open_adapter(adapter: &wgpu::Adapter) -> Result<GpuDevice, BackendError> {
    let description = describe_adapter(adapter);
    let clocks = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
    // For the benchmark's raster of quads into 32-bit floats.
    let blended = wgpu::Features::FLOAT32_BLENDABLE;
    let stamps = adapter.features() & (clocks | blended);
    let request = adapter.request_device(&wgpu::DeviceDescriptor {
        label: Some("motes"),
        required_features: required_features(adapter) | stamps,
        required_limits: adapter.limits(),
        ..Default::default()
    });
    let (device, queue) = pollster::block_on(request)
        .map_err(|e| BackendError::DeviceLost(format!("{}: {e}", description.name)))?;
    Ok(GpuDevice::of_our_own(description, device, queue))
}
