//! A device to run on: one of our own, or a caller's.

use std::sync::{Arc, Mutex};

use super::adapter::{AdapterDescription, describe};
use super::needs::{UnfitDevice, check_needs, is_wide, takes_spirv};
use super::watch;
use crate::backend::BackendError;

/// A device that is open. Copies of it are the same device.
#[derive(Clone, Debug)]
pub struct GpuDevice {
    /// The adapter it stands on, as far as the device was given it.
    pub description: AdapterDescription,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    /// Four bytes to write to, to see whether the device is lost.
    pub(super) probe: wgpu::Buffer,
    /// What the callbacks of a device of our own have heard.
    pub(super) failure: Arc<Mutex<Option<BackendError>>>,
}

impl PartialEq for GpuDevice {
    fn eq(&self, other: &Self) -> bool {
        self.device == other.device
    }
}

impl Eq for GpuDevice {}

impl GpuDevice {
    /// The caller's own device, opened with [`super::device_descriptor`] or with what
    /// [`super::required_features`] and [`super::required_limits`] name, and the queue that was
    /// opened with it. (wgpu does not tell whose a queue is: one of another device would panic.)
    ///
    /// The device remains the caller's: its callbacks are left as they are, and what our calls do
    /// wrong comes back as [`BackendError`] and does not reach them. Work is submitted to the
    /// queue in the order of the calls, so that what the caller submits afterwards sees its
    /// results. Waiting for results polls the device, which may run callbacks of the caller's.
    ///
    /// Where the device has [`wgpu::Features::PASSTHROUGH_SHADERS`] on Vulkan, its bits are exact;
    /// elsewhere kernels run as plain WGSL ([`GpuDevice::is_exact`]). Dispatches are fastest when
    /// the instance is without [`wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL`]: kernels clamp
    /// their arguments themselves.
    ///
    /// ```no_run
    /// use motes::gpu::{self, GpuDevice};
    ///
    /// # fn open(adapter: wgpu::Adapter) -> Result<GpuDevice, Box<dyn std::error::Error>> {
    /// let request = adapter.request_device(&gpu::device_descriptor(&adapter));
    /// let (device, queue) = pollster::block_on(request)?;
    /// let ours = GpuDevice::from_wgpu(&device, &queue)?;
    /// # Ok(ours)
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`UnfitDevice`]: what the device lacks, or that it is lost.
    pub fn from_wgpu(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Self, UnfitDevice> {
        check_needs(device)?;
        let description = describe(&device.adapter_info(), device.features(), &device.limits());
        if watch::is_gone(device) {
            return Err(UnfitDevice::Lost);
        }
        Ok(Self::new(description, device.clone(), queue.clone()))
    }

    /// Of a device that fits.
    fn new(description: AdapterDescription, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let probe = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("motes: probe"),
            size: 4,
            usage: wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self {
            description,
            device,
            queue,
            probe,
            failure: Arc::default(),
        }
    }

    /// Of a device that nobody else knows: what happens to it outside of our calls is kept.
    pub(super) fn of_our_own(
        description: AdapterDescription,
        device: wgpu::Device,
        queue: wgpu::Queue,
    ) -> Self {
        let ours = Self::new(description, device, queue);
        let (on_error, on_loss) = (ours.failure.clone(), ours.failure.clone());
        ours.device.on_uncaptured_error(Arc::new(move |error| {
            keep_first(&on_error, watch::named(&error));
        }));
        ours.device
            .set_device_lost_callback(move |reason, message| {
                if reason != wgpu::DeviceLostReason::Destroyed {
                    keep_first(&on_loss, BackendError::DeviceLost(message));
                }
            });
        ours
    }

    /// Whether its bits are those of every exact device: whether it takes SPIR-V as it is.
    pub fn is_exact(&self) -> bool {
        self.description.exact
    }

    /// Whether kernels may use 64-bit integers and their atomic addition.
    pub fn is_wide(&self) -> bool {
        self.is_exact() && is_wide(&self.device)
    }

    /// Whether its driver is known to end the loops of an invocation when they have turned 65,535 times in all,
    /// so that what takes more is worth a second kernel. Others, if they do, are found out where it counts.
    pub(super) fn ends_loops(&self) -> bool {
        self.description.name.starts_with("llvmpipe")
    }

    /// The device, to make textures and pipelines of the caller's own with.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The queue that work goes to.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }
}

/// Whether a device of this adapter and these features takes SPIR-V as it is.
pub(super) fn is_exact(info: &wgpu::AdapterInfo, features: wgpu::Features) -> bool {
    takes_spirv(info.backend) && features.contains(wgpu::Features::PASSTHROUGH_SHADERS)
}

fn keep_first(slot: &Mutex<Option<BackendError>>, failure: BackendError) {
    if let Ok(mut slot) = slot.lock() {
        slot.get_or_insert(failure);
    }
}
