//! Which adapters there are, which one is meant, and a device on it.

use std::sync::{Arc, Mutex};

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

/// A device that is open, with what has gone wrong on it so far.
#[derive(Clone, Debug)]
pub struct GpuDevice {
    /// The adapter it stands on.
    pub description: AdapterDescription,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    failure: Arc<Mutex<Option<BackendError>>>,
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

fn describe(adapter: &wgpu::Adapter) -> AdapterDescription {
    let info = adapter.get_info();
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
        exact: takes_spirv(adapter),
        most_binding_bytes: adapter.limits().max_storage_buffer_binding_size,
    }
}

fn takes_spirv(adapter: &wgpu::Adapter) -> bool {
    adapter.get_info().backend == wgpu::Backend::Vulkan
        && adapter
            .features()
            .contains(wgpu::Features::PASSTHROUGH_SHADERS)
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
    usable(&instance()).iter().map(describe).collect()
}

/// Opens the first adapter whose name or driver contains `name`, whatever the case; the first of
/// all for the empty name. `None` when there is no such adapter.
///
/// # Errors
/// The driver refuses to open the device.
pub fn open(name: &str) -> Result<Option<GpuDevice>, BackendError> {
    // The driver is called lavapipe, and names its adapter after the older half of it.
    let wanted = name.to_lowercase().replace("lavapipe", "llvmpipe");
    let found = usable(&instance()).into_iter().find(|adapter| {
        let info = adapter.get_info();
        format!("{} {}", info.name, info.driver)
            .to_lowercase()
            .contains(&wanted)
    });
    found.map(|adapter| open_adapter(&adapter)).transpose()
}

fn open_adapter(adapter: &wgpu::Adapter) -> Result<GpuDevice, BackendError> {
    let description = describe(adapter);
    let mut features = wgpu::Features::IMMEDIATES;
    features |= adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
    if description.exact {
        features |= wgpu::Features::PASSTHROUGH_SHADERS;
    }
    let request = adapter.request_device(&wgpu::DeviceDescriptor {
        label: Some("motes"),
        required_features: features,
        required_limits: adapter.limits(),
        experimental_features: super::raw::experimental_features(),
        ..Default::default()
    });
    let (device, queue) = pollster::block_on(request)
        .map_err(|e| BackendError::DeviceLost(format!("{}: {e}", description.name)))?;
    let failure = Arc::new(Mutex::new(None));
    let (on_error, on_loss) = (failure.clone(), failure.clone());
    device.on_uncaptured_error(Arc::new(move |error| {
        let failed = match &error {
            wgpu::Error::OutOfMemory { .. } => {
                BackendError::OutOfMemory("the adapter's memory is used up".into())
            }
            other => BackendError::Internal(other.to_string()),
        };
        keep_first(&on_error, failed);
    }));
    device.set_device_lost_callback(move |reason, message| {
        if reason != wgpu::DeviceLostReason::Destroyed {
            keep_first(&on_loss, BackendError::DeviceLost(message));
        }
    });
    Ok(GpuDevice {
        description,
        device,
        queue,
        failure,
    })
}

fn keep_first(slot: &Mutex<Option<BackendError>>, failure: BackendError) {
    if let Ok(mut slot) = slot.lock() {
        slot.get_or_insert(failure);
    }
}

impl GpuDevice {
    /// What has gone wrong since the device was opened, if anything has.
    pub(super) fn check(&self) -> Result<(), BackendError> {
        match self.failure.lock() {
            Ok(slot) => slot.clone().map_or(Ok(()), Err),
            Err(_) => Err(BackendError::Internal("an error handler failed".into())),
        }
    }

    /// Waits until all submitted work is done.
    pub(super) fn wait(&self) -> Result<(), BackendError> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|e| BackendError::DeviceLost(e.to_string()))?;
        self.check()
    }
}
