//! How long each kernel takes, by the device's own clock.

use super::device::GpuDevice;
use super::readback;
use crate::backend::BackendError;

/// Timestamps a run can hold before they are taken.
const MOST_STAMPS: u32 = 4096;

/// Milliseconds that the kernels of one submission took, in order.
pub type KernelTimes = Vec<(&'static str, f64)>;

/// Collects timestamps of compute passes.
#[derive(Debug)]
pub(super) struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    period_ns: f64,
    frames: Vec<Vec<&'static str>>,
    used: u32,
}

/// Timestamps of the submission at hand.
#[derive(Debug)]
pub(super) struct TimedFrame<'a> {
    timer: &'a mut Timer,
}

impl Timer {
    /// `None` where the adapter has no timestamps.
    pub(super) fn new(gpu: &GpuDevice) -> Option<Self> {
        if !gpu
            .device
            .features()
            .contains(wgpu::Features::TIMESTAMP_QUERY)
        {
            return None;
        }
        Some(Self {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("kernel times"),
                ty: wgpu::QueryType::Timestamp,
                count: MOST_STAMPS,
            }),
            resolved: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("kernel times"),
                size: u64::from(MOST_STAMPS) * 8,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
            frames: Vec::new(),
            used: 0,
        })
    }

    /// Begins a submission.
    pub(super) fn frame(&mut self) -> TimedFrame<'_> {
        self.frames.push(Vec::new());
        TimedFrame { timer: self }
    }

    /// The times of all submissions since the last call.
    pub(super) fn take(&mut self, gpu: &GpuDevice) -> Result<Vec<KernelTimes>, BackendError> {
        let words = readback::words(gpu, &self.resolved, u64::from(self.used) * 8)?;
        let stamps: Vec<u64> = words
            .chunks_exact(2)
            .map(|pair| u64::from(pair[0]) | (u64::from(pair[1]) << 32))
            .collect();
        let mut spans = stamps
            .chunks_exact(2)
            .map(|span| span[1].saturating_sub(span[0]) as f64 * self.period_ns * 1e-6);
        self.used = 0;
        Ok(self
            .frames
            .drain(..)
            .map(|kernels| {
                kernels
                    .into_iter()
                    .map_while(|kernel| Some((kernel, spans.next()?)))
                    .collect()
            })
            .collect())
    }
}

impl TimedFrame<'_> {
    /// A pass for `kernel`, timed while there is room for its timestamps.
    pub(super) fn pass(&mut self, kernel: &'static str) -> wgpu::ComputePassDescriptor<'_> {
        let timer = &mut *self.timer;
        let first = timer.used;
        if first + 2 > MOST_STAMPS {
            return wgpu::ComputePassDescriptor::default();
        }
        timer.used += 2;
        if let Some(frame) = timer.frames.last_mut() {
            frame.push(kernel);
        }
        wgpu::ComputePassDescriptor {
            label: Some(kernel),
            timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
                query_set: &timer.queries,
                beginning_of_pass_write_index: Some(first),
                end_of_pass_write_index: Some(first + 1),
            }),
        }
    }

    /// Makes the submission's timestamps readable.
    pub(super) fn resolve(self, encoder: &mut wgpu::CommandEncoder) {
        let used = self.timer.used;
        if used > 0 {
            encoder.resolve_query_set(&self.timer.queries, 0..used, &self.timer.resolved, 0);
        }
    }
}
