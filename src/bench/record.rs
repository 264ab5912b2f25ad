//! The record: what one call of `motes bench` found out about one adapter.
//!
//! Keys are added without notice and never change their meaning within one [`SCHEMA`]; readers pass
//! over keys that they do not know. `schema.json` beside this file is the record's JSON Schema.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::spread::{Clock, Spread};

/// The record's version. It goes up when a key changes its meaning or goes away.
pub const SCHEMA: u32 = 1;

/// What was measured on one adapter, and with what.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Version of the record: [`SCHEMA`].
    pub schema: u32,
    /// Version of Motes that measured.
    #[serde(default)]
    pub motes: String,
    /// Commit that it was built from, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// When it began, seconds since 1970 (UTC).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub began_unix_secs: Option<u64>,
    /// The driver's name for the adapter, or `cpu`.
    pub adapter: String,
    /// The driver.
    pub driver: String,
    /// The driver's version, where `driver` does not say it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub driver_version: Option<String>,
    /// Graphics interface (`vulkan`, `metal`, `dx12`), or `cpu`.
    pub backend: String,
    /// Whether the adapter's bits are those of every exact adapter.
    pub exact: bool,
    /// Operating system and processor family, e.g. `linux x86_64`.
    #[serde(default)]
    pub os: String,
    /// The processor's name.
    #[serde(default)]
    pub cpu: String,
    /// Threads of the processor that the program could use; 0 where that is unknown.
    #[serde(default)]
    pub cpu_threads: u32,
    /// How kernels were run, e.g. `workgroup_size` = `256`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub options: BTreeMap<String, String>,
    /// Rate of the fastest copy by a kernel of what fits in no cache, 10^9 bytes a second, read and
    /// written bytes together.
    pub copy_kernel_gb_per_s: Option<f64>,
    /// Rate of the interface's own copy, 10^9 bytes a second, read and written bytes together.
    pub copy_buffer_gb_per_s: Option<f64>,
    /// What a dispatch costs that does nothing, as a pass of its own; `None` for the processor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dispatch_ms: Option<Spread>,
    /// Kernels alone.
    #[serde(default)]
    pub micro: Vec<Measure>,
    /// Scenes, each at one count.
    #[serde(default)]
    pub runs: Vec<Run>,
    /// What a reader should know before believing the numbers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

/// One scene at one count of particles.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The scene's name.
    pub scene: String,
    /// Particles asked for; where none were, those that live.
    pub particles: u64,
    /// Particles that lived while it was measured (median over frames).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub live: Option<u64>,
    /// Births that did not fit while it was measured.
    #[serde(default)]
    pub dropped: u64,
    /// How many of their own flock the boids saw, all together, in the last frame: those within its
    /// `perception_radius`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neighbour_reads: Option<u64>,
    /// Pixels across and down.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image_px: Option<[u32; 2]>,
    /// Frames measured.
    pub frames: u32,
    /// Frames run before, unmeasured.
    #[serde(default)]
    pub warm_up_frames: u32,
    /// A step and a drawing, as the passes' clock has it.
    pub frame_ms: Spread,
    /// The step alone.
    pub step_ms: Spread,
    /// The drawing alone.
    pub draw_ms: Spread,
    /// From the submission of a frame to its end, by the machine's clock.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_ms: Option<Spread>,
    /// Processor time of the whole process during the measured frames, seconds over all threads.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_seconds: Option<f64>,
    /// Most memory that the process held, bytes.
    pub peak_memory_bytes: u64,
    /// Memory that the backend allocated on the device, bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu_memory_bytes: Option<u64>,
    /// Rate of the fastest copy by a kernel, measured beside the frames, of what fits in no cache;
    /// shares of passes that move as much are of this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub copy_kernel_gb_per_s: Option<f64>,
    /// The same of 8 MiB, the price of the dispatch not counted, if that is faster: shares of passes
    /// that move no more are of this, of those between, of what lies between.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub copy_in_cache_gb_per_s: Option<f64>,
    /// Rate of the interface's own copy, measured beside the frames; shares of commands of the
    /// interface are of this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub copy_buffer_gb_per_s: Option<f64>,
    /// The copies behind `copy_kernel_gb_per_s`, 256 MiB each, in the order taken: they show what the
    /// machine did meanwhile, whatever the build.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub copy_ms: Option<Spread>,
    /// What a dispatch costs that does nothing, measured beside the frames.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dispatch_ms: Option<Spread>,
    /// What each pass took, in the order of the frame.
    pub passes: Vec<Measure>,
    /// What a reader should know before believing the numbers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

/// To which half of a frame a pass belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// State goes on by a frame.
    Step,
    /// State becomes a picture.
    Draw,
}

/// A pass of a frame, or a kernel alone.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measure {
    /// What ran; no two in one list have the same.
    pub name: String,
    /// To which half of the frame it belongs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Part>,
    /// More about it, e.g. which form of the kernel was fastest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// Milliseconds a frame, or a run of the kernel.
    pub ms: Spread,
    /// Things it worked on in that time: particles, pixels, words.
    pub items: u64,
    /// Bytes that it must move at least; 0 where memory is not what it is about.
    pub bytes: u64,
    /// Rate of those bytes at the median time, 10^9 bytes a second.
    pub gb_per_s: Option<f64>,
    /// Milliseconds that the adapter's own copy of as many bytes takes, the price of its dispatch not
    /// counted: the pass cannot be faster.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor_ms: Option<f64>,
    /// `floor_ms` over the median time.
    pub share_of_copy: Option<f64>,
    /// Dispatches of a frame, or copies, that were timed one by one and are told together; 1 where
    /// nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dispatches: Option<u32>,
}

impl Measure {
    /// What is told of these samples. `bytes` are those it must move at least in one sample;
    /// `copy_gb_per_s` is the rate of the fastest copy by a kernel.
    pub fn new(
        name: impl Into<String>,
        samples_ms: Vec<f64>,
        clock: Clock,
        items: u64,
        bytes: u64,
        copy_gb_per_s: Option<f64>,
    ) -> Self {
        let ms = Spread::new(samples_ms, clock);
        let gb_per_s = gb_per_s(bytes, ms.median);
        let measure = Self {
            name: name.into(),
            ms,
            items,
            bytes,
            gb_per_s,
            ..Self::default()
        };
        let copy = copy_gb_per_s.filter(|copy| *copy > 0.0 && bytes > 0);
        measure.held_against(copy.map(|copy| bytes as f64 / (copy * 1e6)))
    }

    /// The same, held against a copy of as many bytes that takes so long, milliseconds.
    #[must_use]
    pub fn held_against(self, floor_ms: Option<f64>) -> Self {
        let ms = self.ms.median;
        Self {
            floor_ms,
            share_of_copy: floor_ms.filter(|_| ms > 0.0).map(|floor| floor / ms),
            ..self
        }
    }

    /// Items a second at the median time; `None` where that is too short for the clock.
    pub fn items_per_s(&self) -> Option<f64> {
        (self.ms.median > 0.0 && self.items > 0)
            .then(|| self.items as f64 / (self.ms.median * 1e-3))
    }
}

/// 10^9 bytes a second; `None` for no bytes or no time.
pub(super) fn gb_per_s(bytes: u64, ms: f64) -> Option<f64> {
    (bytes > 0 && ms > 0.0).then(|| bytes as f64 / (ms * 1e6))
}

impl Run {
    /// Milliseconds that the adapter's own copies of the passes' bytes take: what a frame cannot be
    /// shorter than. `None` where that is unknown.
    pub fn floor_ms(&self, record: &Record) -> Option<f64> {
        let floors = || self.passes.iter().filter_map(|pass| pass.floor_ms);
        if floors().next().is_some() {
            return Some(floors().sum());
        }
        let bytes: u64 = self.passes.iter().map(|pass| pass.bytes).sum();
        let copy = self.copy_kernel_gb_per_s.or(record.copy_kernel_gb_per_s);
        let copy = copy.filter(|copy| *copy > 0.0)?;
        (bytes > 0).then(|| bytes as f64 / (copy * 1e6))
    }

    /// Milliseconds that the frame's dispatches cost if they did nothing, and how many those are. `None`
    /// where nobody measured it.
    pub fn dispatches_ms(&self) -> Option<(f64, u32)> {
        let price = self.dispatch_ms.as_ref()?.median;
        let dispatches = self.passes.iter().map(|pass| pass.dispatches.unwrap_or(1));
        let dispatches = dispatches.sum();
        Some((price * f64::from(dispatches), dispatches))
    }

    /// Neighbours that boids see a second of the steps alone; `None` where there are none, or a step took no
    /// time.
    pub fn neighbour_reads_per_s(&self) -> Option<f64> {
        let reads = self.neighbour_reads? as f64;
        (self.step_ms.median > 0.0).then(|| reads / self.step_ms.median * 1e3)
    }

    /// Live particles a second; `None` where the frame took no time.
    pub fn particles_per_s(&self) -> Option<f64> {
        let ms = self.frame_ms.median;
        let live = self.live.unwrap_or(self.particles) as f64;
        (ms > 0.0).then(|| live / (ms * 1e-3))
    }

    /// Its share of the frame, medians of both; `None` where the frame took no time.
    pub fn share_of_frame(&self, ms: &Spread) -> Option<f64> {
        let frame = self.frame_ms.median;
        (frame > 0.0).then(|| ms.median / frame)
    }
}
