//! How long each kernel takes, by the device's own clock.

use super::device::GpuDevice;
use super::readback;
use crate::backend::BackendError;

/// Timestamps that one set of queries holds: the interface's limit, and even, so that no pass has its
/// two in different sets.
const STAMPS_A_SET: u32 = wgpu::QUERY_SET_MAX_QUERIES;

/// Sets that a run can fill before its times are taken: half a million passes. More is a mistake of
/// whoever does not take them, and is told when they are taken.
const MOST_SETS: usize = 256;

/// Milliseconds that the kernels of one submission took, in order.
pub type KernelTimes = Vec<(&'static str, f64)>;

/// Collects timestamps of compute passes. Sets of queries are added as passes come.
#[derive(Debug)]
pub(super) struct Timer {
    gpu: GpuDevice,
    sets: Vec<StampSet>,
    period_ns: f64,
    /// Whether copies and clears can be timed, too.
    between_passes: bool,
    frames: Vec<Vec<&'static str>>,
    used: u32,
    /// Passes that found no room.
    lost: u32,
}

#[derive(Debug)]
struct StampSet {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
}

/// Timestamps of the submission at hand.
#[derive(Debug)]
pub(super) struct TimedFrame<'a> {
    timer: &'a mut Timer,
    /// The first timestamp of this submission.
    first: u32,
}

impl StampSet {
    fn new(gpu: &GpuDevice) -> Self {
        Self {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("kernel times"),
                ty: wgpu::QueryType::Timestamp,
                count: STAMPS_A_SET,
            }),
            resolved: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("kernel times"),
                size: u64::from(STAMPS_A_SET) * 8,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
        }
    }
}

impl Timer {
    /// `None` where the adapter has no timestamps.
    pub(super) fn new(gpu: &GpuDevice) -> Option<Self> {
        let features = gpu.device.features();
        if !features.contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        Some(Self {
            gpu: gpu.clone(),
            sets: vec![StampSet::new(gpu)],
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
            between_passes: features.contains(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS),
            frames: Vec::new(),
            used: 0,
            lost: 0,
        })
    }

    /// Whether copies and clears can be timed, too.
    pub(super) fn times_between_passes(&self) -> bool {
        self.between_passes
    }

    /// Begins a submission.
    pub(super) fn frame(&mut self) -> TimedFrame<'_> {
        self.frames.push(Vec::new());
        let first = self.used;
        TimedFrame { timer: self, first }
    }

    /// The times of all submissions since the last call.
    ///
    /// # Errors
    /// The device fails, or so much was submitted since the last call that there was no room.
    pub(super) fn take(&mut self) -> Result<Vec<KernelTimes>, BackendError> {
        let (frames, lost) = (std::mem::take(&mut self.frames), self.lost);
        let used = std::mem::take(&mut self.used);
        self.lost = 0;
        if lost > 0 {
            return Err(BackendError::Unsupported(format!(
                "{lost} passes were not timed: {} have been, and nobody took their times",
                used / 2
            )));
        }
        let mut words = Vec::new();
        for (at, set) in self.sets.iter().enumerate() {
            let of_set = used.saturating_sub(at as u32 * STAMPS_A_SET);
            let bytes = u64::from(of_set.min(STAMPS_A_SET)) * 8;
            if bytes > 0 {
                words.extend(readback::words(&self.gpu, &set.resolved, bytes)?);
            }
        }
        let stamps: Vec<u64> = words
            .chunks_exact(2)
            .map(|pair| u64::from(pair[0]) | (u64::from(pair[1]) << 32))
            .collect();
        let mut spans = stamps
            .chunks_exact(2)
            .map(|span| span[1].saturating_sub(span[0]) as f64 * self.period_ns * 1e-6);
        Ok(frames
            .into_iter()
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
    /// room left for them, which [`Timer::take`] tells.
    pub(super) fn stamps(&mut self, name: &'static str) -> Option<(&wgpu::QuerySet, u32)> {
        let timer = &mut *self.timer;
        let set = (timer.used / STAMPS_A_SET) as usize;
        if set == timer.sets.len() {
            if set == MOST_SETS {
                timer.lost += 1;
                return None;
            }
            timer.sets.push(StampSet::new(&timer.gpu));
        }
        let first = timer.used % STAMPS_A_SET;
        timer.used += 2;
        if let Some(frame) = timer.frames.last_mut() {
            frame.push(name);
        }
        Some((&timer.sets[set].queries, first))
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
        for (at, set) in (0u32..).zip(&self.timer.sets) {
            let start = at * STAMPS_A_SET;
            let of_set = used.saturating_sub(start).min(STAMPS_A_SET);
            // Those of earlier submissions lie there already.
            if of_set > 0 && start + of_set > self.first {
                encoder.resolve_query_set(&set.queries, 0..of_set, &set.resolved, 0);
            }
        }
    }
}
