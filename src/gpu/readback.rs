//! What comes home from the device: state on request, statistics through a ring without stalling.

use std::sync::mpsc;
use std::time::Duration;

use super::GpuBackend;
use super::device::GpuDevice;
use super::memory::Memory;
use crate::backend::BackendError;
use crate::layout::{
    Boid, Cover, DroppedFlame, FLAME_STEPS, Flame, FlameDisc, FrameStats, Node, SpreadCounts,
    SpreadPoint, SystemFrame,
};

/// Lines in the device's ring; `wgsl/scan/survivors.wgsl` has the same.
pub(super) const STATISTICS_LEN: u32 = 256;

/// A half of the ring is fetched while the other fills.
const HALF: u32 = STATISTICS_LEN / 2;

/// Bytes a line.
const LINE: u64 = size_of::<FrameStats>() as u64;

/// Words a boid.
const BOID_WORDS: u64 = size_of::<Boid>() as u64 / 4;

/// Words a flame.
const FLAME_WORDS: u64 = size_of::<Flame>() as u64 / 4;

/// Words a dropped flame.
const DROPPED_WORDS: u64 = size_of::<DroppedFlame>() as u64 / 4;

/// Words a control point.
const POINT_WORDS: u64 = size_of::<SpreadPoint>() as u64 / 4;

/// Words a particle of a flame as it is seen.
const DISC_WORDS: u64 = size_of::<FlameDisc>() as u64 / 4;

/// How long after the device is done its word of it may take.
const CALL_BACK: Duration = Duration::from_secs(60);

/// The first `bytes` (a multiple of 4) of a buffer, after all submitted work.
pub(super) fn words(
    gpu: &GpuDevice,
    buffer: &wgpu::Buffer,
    bytes: u64,
) -> Result<Vec<u32>, BackendError> {
    if bytes == 0 {
        return Ok(Vec::new());
    }
    let staging = staging(gpu, bytes);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, bytes);
    gpu.queue.submit([encoder.finish()]);
    let mapped = Mapping::begin(staging);
    gpu.wait()?;
    mapped.words()
}

impl GpuBackend {
    /// The live records of a state buffer, as words.
    pub(super) fn read_buffer(&self, buffer: &str) -> Result<Vec<u32>, BackendError> {
        let counts = self.counts()?;
        if buffer == "particles" {
            let mut left = u64::from(if self.newborns_present {
                counts.total
            } else {
                counts.live
            }) * 32;
            let mut present = Vec::new();
            for page in &self.memory.pools[self.current] {
                let here = left.min(page.size());
                present.extend(words(&self.gpu, page, here)?);
                left -= here;
            }
            return Ok(present);
        }
        if buffer.starts_with("light_") {
            self.unpack_light()?;
        }
        if buffer == "borne_systems" {
            let stride = size_of::<SystemFrame>() / 4;
            let all = self.memory.named("system_frames")?;
            let bytes = u64::from(self.system_count) * size_of::<SystemFrame>() as u64;
            let mut systems = words(&self.gpu, all, bytes)?;
            let own = (self.system_count - self.node_count) as usize * stride;
            return Ok(systems.split_off(own));
        }
        if let Some(pages) = self.memory.flame_pages(buffer) {
            let mut words_left = self.flame_words(buffer);
            let mut present = Vec::new();
            for page in pages {
                let here = (words_left * 4).min(page.size());
                present.extend(words(&self.gpu, page, here)?);
                words_left -= here / 4;
            }
            return Ok(present);
        }
        let whole = self.memory.named(buffer)?;
        let pixels = u64::from(self.width) * u64::from(self.height);
        let records = match buffer {
            "alive_bits" => u64::from(counts.total.div_ceil(32)),
            "birth_counts" => u64::from(self.system_count),
            "birth_offsets" => u64::from(self.system_count) + 1,
            "boids" | "sorted_boids" => u64::from(self.boid_count) * BOID_WORDS,
            "boid_trails" => u64::from(self.boid_trail_count) * 4,
            "flames" => u64::from(self.flame_count) * FLAME_WORDS,
            "control_points" => u64::from(self.spread_counts()?.total) * POINT_WORDS,
            // Those that were there before the frame's insertions, as of the last.
            "moved_points" => u64::from(self.moved_count()?) * POINT_WORDS,
            "catches" => u64::from(self.piece_count) * 4,
            "ring_spans" => u64::from(self.ring_count) * 2,
            "dropped_flames" => u64::from(self.dropped_places) * DROPPED_WORDS,
            "spread_counts" => size_of::<SpreadCounts>() as u64 / 4,
            "boid_cells" => u64::from(self.boid_count),
            "cell_starts" => u64::from(self.cell_count) + 1,
            "deaths" => 2,
            "nodes" => u64::from(self.node_count) * (size_of::<Node>() / 4) as u64,
            "tree_counts" => 8,
            "image" => pixels,
            "covers" => self.cover_records()? * (size_of::<Cover>() / 4) as u64,
            "cover_counts" => 8,
            "cover_rg" | "cover_bt" if self.has_covers => pixels * 2,
            "cover_rg" | "cover_bt" => 0,
            "planet_pixels" if self.has_planet => pixels * 4,
            "ground_pixels" if self.has_ground => pixels * 4,
            "surface_nearness" | "surface_faces" | "surface_pixels" if self.has_surfaces => {
                pixels * 4
            }
            "cover_front" if self.has_surfaces && self.has_covers => pixels,
            "planet_pixels" | "ground_pixels" | "surface_nearness" | "surface_faces"
            | "surface_pixels" | "cover_front" => 0,
            "shade_sums" | "shade_light" => u64::from(self.shade_cells).pow(3),
            "cluster_span" | "cluster_sums" | "cluster_lights" if !self.has_clusters => 0,
            "light_low" | "light_high" => pixels * 3,
            _ => whole.size() / 4,
        };
        words(&self.gpu, whole, records * 4)
    }
}

impl GpuBackend {
    /// Words of what is there of each flame.
    fn flame_words(&self, buffer: &str) -> u64 {
        let steps = u64::from(FLAME_STEPS);
        let each = match buffer {
            "flame_bounds" => 4,
            "flame_steps" => steps * 4,
            "flame_discs" => steps * DISC_WORDS,
            "flame_skews" if self.has_skews => steps * 4,
            "strip_joints" if self.has_strips => steps * 8,
            _ => 0,
        };
        u64::from(self.flame_count) * each
    }

    /// How many control points have moved in the last frame.
    fn moved_count(&self) -> Result<u32, BackendError> {
        let counts = self.spread_counts()?;
        Ok(if self.points_moved {
            counts.total
        } else {
            counts.before
        })
    }

    /// How many records of what covers there are.
    fn cover_records(&self) -> Result<u64, BackendError> {
        let counts = words(&self.gpu, self.memory.named("cover_counts")?, 32)?;
        let [_, of_families @ ..] = counts.as_slice() else {
            return Ok(0);
        };
        Ok(of_families.iter().map(|count| u64::from(*count)).sum())
    }
}

fn staging(gpu: &GpuDevice, bytes: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("staging"),
        size: bytes,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// A staging buffer on its way to being readable.
#[derive(Debug)]
struct Mapping {
    buffer: wgpu::Buffer,
    done: mpsc::Receiver<Result<(), wgpu::BufferAsyncError>>,
}

impl Mapping {
    fn begin(buffer: wgpu::Buffer) -> Self {
        let (send, done) = mpsc::channel();
        buffer
            .slice(..)
            .map_async(wgpu::MapMode::Read, move |result| {
                // Nobody listens any more when the run has been given up: nothing is lost.
                let _ = send.send(result);
            });
        Self { buffer, done }
    }

    /// The words; the device must have been waited for.
    fn words(self) -> Result<Vec<u32>, BackendError> {
        let failed = |what: String| BackendError::DeviceLost(format!("readback failed: {what}"));
        // Another thread that waits for the same device may have taken it on itself to call back.
        self.done
            .recv_timeout(CALL_BACK)
            .map_err(|e| failed(e.to_string()))?
            .map_err(|e| failed(e.to_string()))?;
        let view = self
            .buffer
            .slice(..)
            .get_mapped_range()
            .map_err(|e| failed(e.to_string()))?;
        Ok(bytemuck::pod_collect_to_vec(&view[..]))
    }
}

/// Fetches the device's ring of statistics, half by half.
#[derive(Debug, Default)]
pub(super) struct StatisticsRing {
    /// First frame that has not been fetched, and one past the last that has been stepped.
    first: Option<u32>,
    end: u32,
    /// Copied in the encoder at hand, not yet submitted.
    copied: Vec<wgpu::Buffer>,
    mappings: Vec<Mapping>,
}

impl StatisticsRing {
    /// Notes that `frame` is stepped by the encoder at hand, and fetches a half that is full.
    pub(super) fn stepped(
        &mut self,
        gpu: &GpuDevice,
        memory: &Memory,
        encoder: &mut wgpu::CommandEncoder,
        frame: u32,
    ) -> Result<(), BackendError> {
        self.first.get_or_insert(frame);
        self.end = frame.wrapping_add(1);
        if self.end.is_multiple_of(HALF) {
            self.fetch(gpu, memory, encoder)?;
        }
        Ok(())
    }

    fn fetch(
        &mut self,
        gpu: &GpuDevice,
        memory: &Memory,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), BackendError> {
        let Some(first) = self.first.take() else {
            return Ok(());
        };
        // Frames since the last fetch lie within one half, so they do not wrap.
        let bytes = u64::from(self.end.wrapping_sub(first)) * LINE;
        let target = staging(gpu, bytes);
        let from = u64::from(first % STATISTICS_LEN) * LINE;
        encoder.copy_buffer_to_buffer(memory.named("statistics")?, from, &target, 0, bytes);
        self.copied.push(target);
        Ok(())
    }

    /// Notes that the encoder has been submitted.
    pub(super) fn submitted(&mut self) {
        self.mappings
            .extend(self.copied.drain(..).map(Mapping::begin));
    }

    /// All lines since the last call; waits for the device.
    pub(super) fn take(
        &mut self,
        gpu: &GpuDevice,
        memory: &Memory,
    ) -> Result<Vec<FrameStats>, BackendError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.fetch(gpu, memory, &mut encoder)?;
        gpu.queue.submit([encoder.finish()]);
        self.submitted();
        gpu.wait()?;
        let mut lines = Vec::new();
        for mapping in self.mappings.drain(..) {
            let words = mapping.words()?;
            lines.extend(bytemuck::pod_collect_to_vec::<u32, FrameStats>(&words));
        }
        Ok(lines)
    }
}
