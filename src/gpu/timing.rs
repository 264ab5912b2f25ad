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
    /// Whether copies and clears can be timed, too.
    between_passes: bool,
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
            between_passes: gpu
                .device
                .features()
                .contains(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS),
            frames: Vec::new(),
            used: 0,
        })
    }

    /// Whether copies and clears can be timed, too.
    pub(super) fn times_between_passes(&self) -> bool {
        self.between_passes
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
    /// Where to write the next two timestamps, which are those of `name`; `None` when there is no
    /// room left for them.
    pub(super) fn stamps(&mut self, name: &'static str) -> Option<(&wgpu::QuerySet, u32)> {
        let timer = &mut *self.timer;
        let first = timer.used;
        if first + 2 > MOST_STAMPS {
            return None;
        }
        timer.used += 2;
        if let Some(frame) = timer.frames.last_mut() {
            frame.push(name);
        }
        Some((&timer.queries, first))
    }

    /// A pass for `kernel`, timed while there is room for its timestamps.
    pub(super) fn pass(&mut self, kernel: &'static str) -> wgpu::ComputePassDescriptor<'_> {
        let Some((query_set, first)) = self.stamps(kernel) else {
            return wgpu::ComputePassDescriptor::default();
        };
        wgpu::ComputePassDescriptor {
            label: Some(kernel),
            timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(first),
                end_of_pass_write_index: Some(first + 1),
            }),
        }
    }

    /// Does what is no pass, copies and clears; timed where the device can.
    pub(super) fn between_passes<T>(
        &mut self,
        name: &'static str,
        encoder: &mut wgpu::CommandEncoder,
        work: impl FnOnce(&mut wgpu::CommandEncoder) -> T,
    ) -> T {
        let stamps = if self.timer.between_passes {
            self.stamps(name)
        } else {
            None
        };
        match stamps {
            Some((queries, first)) => {
                encoder.write_timestamp(queries, first);
                let done = work(encoder);
                encoder.write_timestamp(queries, first + 1);
                done
            }
            None => work(encoder),
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
