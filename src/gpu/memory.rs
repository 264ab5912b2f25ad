//! The declared buffers of a plan on a device, and the two pools in pages.

use std::collections::HashMap;
use std::iter;

use super::device::GpuDevice;
use super::flame_tiling::FlameTiling;
use super::sort;
use super::tiling::Tiling;
use crate::backend::{BackendError, available_bytes};
use crate::layout::{Dispatch, Particle};
use crate::plan::{BUFFERS, BufferRole, Count, Plan, Stage};

/// A page holds a multiple of this many particles: whole words of bits, and whole runs of the scan.
const PAGE_GRAIN: u32 = 2048;

/// Drivers end an invocation's loops when they have turned 65,535 times in all, and one invocation
/// writes the dispatches of all pairs of pages, and looks up in each page where its first target ends.
const MOST_DISPATCHES: u32 = 50_000;

/// A page holds a multiple of this many flames: whole runs of an invocation's neighbours.
const FLAME_GRAIN: u32 = 32;

/// Flames a page at most.
const MOST_FLAMES: u64 = 1 << 16;

/// What is there of each flame in pages of so many; the flames themselves are in one.
const FLAME_PAGED: [&str; 5] = [
    "flame_steps",
    "flame_discs",
    "flame_skews",
    "strip_joints",
    "flame_bounds",
];

/// Bytes a particle.
const PARTICLE_BYTES: u64 = size_of::<Particle>() as u64;

/// How the pools are cut into pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Paging {
    /// Particles a page.
    pub(super) page_len: u32,
    /// Pages a pool.
    pub(super) page_count: u32,
}

impl Paging {
    /// Pages of at most `most_bytes`, no larger than the capacity needs.
    pub(super) fn new(capacity: u32, most_bytes: u64) -> Self {
        let fits = (most_bytes / PARTICLE_BYTES).min(1 << 23) as u32 / PAGE_GRAIN * PAGE_GRAIN;
        let needed = capacity.div_ceil(PAGE_GRAIN) * PAGE_GRAIN;
        let page_len = fits.max(PAGE_GRAIN).min(needed);
        Self {
            page_len,
            page_count: capacity.div_ceil(page_len),
        }
    }

    /// Dispatches that kernels write: two for the scan, three for each page, one for each pair of
    /// pages, and again one for each page (`wgsl/systems/offsets.wgsl`, `wgsl/scan/pages.wgsl` and
    /// `wgsl/draw/large_work.wgsl` have the same order).
    pub(super) fn dispatches(&self) -> u32 {
        self.large_dispatch(self.page_count)
    }

    /// The sort's runs, then its pairs, then three for each round of what covers, then that of large
    /// triangles, then that of flames.
    pub(super) fn spare_dispatch(&self, place: u32) -> u32 {
        self.large_dispatch(self.page_count) + place
    }

    pub(super) fn large_dispatch(&self, page: u32) -> u32 {
        self.pair_dispatch(self.page_count, 0) + page
    }

    pub(super) fn emit_dispatch(&self, page: u32) -> u32 {
        2 + page
    }

    pub(super) fn cull_dispatch(&self, page: u32) -> u32 {
        2 + self.page_count + page
    }

    pub(super) fn splat_dispatch(&self, page: u32) -> u32 {
        2 + 2 * self.page_count + page
    }

    pub(super) fn pair_dispatch(&self, source: u32, target: u32) -> u32 {
        2 + 3 * self.page_count + source * (source + 1) / 2 + target
    }
}

/// How what is there of each flame is cut into pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FlamePaging {
    /// Flames of all pages.
    flame_count: u32,
    /// Flames a page but the last, which may have fewer.
    page_len: u32,
}

impl FlamePaging {
    /// Pages of which no buffer has more than `most_bytes`. What may catch fire is looked for among
    /// all steps at once: then there is one page.
    fn new(plan: &Plan, most_bytes: u64) -> Self {
        let most = FLAME_PAGED.iter().map(|name| bytes_a_flame(name, plan));
        let fits = most_bytes / most.max().unwrap_or(0).max(1);
        let fits = fits.min(MOST_FLAMES) as u32;
        let page_len = match plan.ignitions.piece_count() {
            0 => (fits / FLAME_GRAIN * FLAME_GRAIN).max(FLAME_GRAIN),
            _ => u32::MAX,
        };
        Self {
            flame_count: plan.flame_count,
            page_len,
        }
    }

    /// The first flame of each page, and how many it has; a page of none where there are no flames.
    pub(super) fn pages(self) -> impl Iterator<Item = (u32, u32)> {
        let page_count = self.flame_count.div_ceil(self.page_len).max(1);
        (0..page_count).map(move |page| {
            let first = page * self.page_len;
            (first, self.page_len.min(self.flame_count - first))
        })
    }
}

/// Bytes of such a buffer for each flame.
fn bytes_a_flame(name: &str, plan: &Plan) -> u64 {
    let declared = crate::plan::buffer(name);
    let bytes = declared.and_then(|declared| {
        let records = u64::from(declared.records(plan)?);
        Some(records * u64::from(declared.stride))
    });
    bytes.unwrap_or(0) / u64::from(plan.flame_count.max(1))
}

/// All buffers of a run.
#[derive(Debug)]
pub(super) struct Memory {
    pub(super) paging: Paging,
    pub(super) flame_paging: FlamePaging,
    pub(super) tiling: Tiling,
    pub(super) flame_tiling: FlameTiling,
    pub(super) pools: [Vec<wgpu::Buffer>; 2],
    /// For each page, the particles that are no small discs: two counts, their copies, indices.
    pub(super) large: Vec<wgpu::Buffer>,
    /// Those of [`FLAME_PAGED`], page by page.
    flames: HashMap<&'static str, Vec<wgpu::Buffer>>,
    named: HashMap<&'static str, wgpu::Buffer>,
    /// Whether light is there before the splat: that of particles behind the planet.
    has_planet: bool,
    /// Bytes allocated in all.
    pub(super) bytes: u64,
}

impl Memory {
    /// Allocates everything, zeroed.
    pub(super) fn new(
        gpu: &GpuDevice,
        plan: &Plan,
        most_page_bytes: u64,
        wide: bool,
        tiling: Tiling,
    ) -> Result<Self, BackendError> {
        let limits = gpu.device.limits();
        let most_binding = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size);
        let paging = Paging::new(plan.capacity, most_page_bytes.min(most_binding));
        let flame_paging = FlamePaging::new(plan, most_page_bytes.min(most_binding));
        let flame_tiling = FlameTiling::new(tiling, [plan.width, plan.height], flame_paging);
        if paging.dispatches() > MOST_DISPATCHES {
            return Err(BackendError::Unsupported(format!(
                "{} particles in pages of {} are too many pages",
                plan.capacity, paging.page_len
            )));
        }
        let page_bytes = u64::from(paging.page_len) * PARTICLE_BYTES;
        let pages = paging.page_count as usize;
        let pooled = iter::repeat_n(("particles", page_bytes), 2 * pages);
        let large_bytes = (u64::from(paging.page_len) + 4) * 4;
        let large = iter::repeat_n(("large_particles", large_bytes), pages);
        let of_flames = FLAME_PAGED.iter().flat_map(|name| {
            let each = bytes_a_flame(name, plan);
            let pages = flame_paging.pages();
            pages.map(move |(_, count)| (*name, u64::from(count) * each))
        });
        let single = BUFFERS.iter().filter(|declared| {
            declared.name != "large_particles"
                && !FLAME_PAGED.contains(&declared.name)
                && !matches!(declared.count, Count::ParticlesOver(1))
                && (wide || declared.name != "light_packed")
        });
        let named = single.map(|declared| {
            let own = || match declared.name {
                "ranked_covers" | "ranked_bounds" if plan.uses.covers => tiling.slice,
                "tile_bits" if plan.uses.covers => tiling.tiles() * (tiling.slice / 32),
                "tile_summaries" if plan.uses.covers => tiling.tiles() * (tiling.slice / 1024),
                "flame_tiles" if plan.flame_count > 0 => flame_tiling.words(),
                "digit_counts" => sort::counts(plan.cover_capacity()),
                "dispatches" => paging.dispatches() + 4 + 3 * tiling.rounds,
                _ => 0,
            };
            // Kernels load the first record of some before they know whether there is any.
            let records = declared.records(plan).unwrap_or_else(own).max(1);
            (
                declared.name,
                u64::from(records) * u64::from(declared.stride),
            )
        });
        // Digests look at whole vectors of four words.
        let sizes: Vec<(&'static str, u64)> = pooled
            .chain(large)
            .chain(of_flames)
            .chain(named)
            .map(|(name, size)| (name, size.next_multiple_of(16).max(16)))
            .collect();
        if let Some((name, size)) = sizes.iter().find(|(_, size)| *size > most_binding) {
            return Err(BackendError::Unsupported(format!(
                "`{name}` takes {size} bytes, and the device binds at most {most_binding}"
            )));
        }
        let bytes = sizes.iter().map(|(_, size)| size).sum();
        check_available(gpu, bytes)?;
        let mut buffers = allocate(gpu, &sizes, bytes)?.into_iter();
        let mut next = |count| buffers.by_ref().take(count).collect::<Vec<_>>();
        let flame_pages = flame_paging.pages().count();
        debug_assert_eq!(size_of::<Dispatch>(), 12);
        Ok(Self {
            paging,
            flame_paging,
            tiling,
            flame_tiling,
            pools: [next(pages), next(pages)],
            large: next(pages),
            flames: FLAME_PAGED.map(|name| (name, next(flame_pages))).into(),
            named: sizes[3 * pages + FLAME_PAGED.len() * flame_pages..]
                .iter()
                .map(|(name, _)| *name)
                .zip(buffers)
                .collect(),
            has_planet: plan.uses.planet,
            bytes,
        })
    }

    /// Every buffer, those of the pools included.
    pub(super) fn all(&self) -> impl Iterator<Item = &wgpu::Buffer> {
        self.pools
            .iter()
            .flatten()
            .chain(&self.large)
            .chain(self.flames.values().flatten())
            .chain(self.named.values())
    }

    /// The pages of what is there of each flame, if that is what the name is of.
    pub(super) fn flame_pages(&self, name: &str) -> Option<&[wgpu::Buffer]> {
        self.flames.get(name).map(Vec::as_slice)
    }

    /// The buffer of that name; the pools and the pages of flames are not among them.
    pub(super) fn named(&self, name: &str) -> Result<&wgpu::Buffer, BackendError> {
        self.named
            .get(name)
            .ok_or_else(|| BackendError::Internal(format!("no buffer `{name}`")))
    }

    /// Whether it is the first stage that adds light: what is behind a planet is splatted before it.
    pub(super) fn clears_light(&self, stage: Stage) -> bool {
        let first = if self.has_planet {
            Stage::Planet
        } else {
            Stage::Splat
        };
        stage == first
    }

    /// Clears what a stage adds to: it is dark before the splat, and nothing covers before the shapes.
    pub(super) fn begin(&self, stage: Stage, encoder: &mut wgpu::CommandEncoder) {
        let names: &[&str] = match stage {
            Stage::Lights => &["flame_sums"],
            Stage::Clusters => &["cluster_span", "cluster_sums"],
            Stage::Surface => &["large_faces", "surface_nearness", "surface_faces"],
            Stage::Shade => &["shade_sums"],
            Stage::Shapes => &["cover_counts"],
            Stage::Block => &["crowd"],
            Stage::Catch => &["catches"],
            _ if self.clears_light(stage) => &["light_low", "light_high", "light_packed"],
            _ => &[],
        };
        for buffer in names.iter().filter_map(|name| self.named.get(name)) {
            encoder.clear_buffer(buffer, 0, None);
        }
    }
}

/// The buffers of these names and sizes, which sum to `bytes`, zeroed.
fn allocate(
    gpu: &GpuDevice,
    sizes: &[(&'static str, u64)],
    bytes: u64,
) -> Result<Vec<wgpu::Buffer>, BackendError> {
    let allocated = gpu.watched(|| {
        let buffer = |(name, size): &(&'static str, u64)| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(name),
                size: *size,
                usage: usage_of(name),
                mapped_at_creation: false,
            })
        };
        Ok(sizes.iter().map(buffer).collect())
    });
    allocated.map_err(|failure| match failure {
        BackendError::OutOfMemory(_) => BackendError::OutOfMemory(format!(
            "the run needs {} MiB on {}",
            bytes >> 20,
            gpu.description.name
        )),
        other => other,
    })
}

/// A software adapter's memory is the system's, which gives it only when it is written to, and ends
/// the process when there is none.
pub(super) fn check_available(gpu: &GpuDevice, bytes: u64) -> Result<(), BackendError> {
    if gpu.description.kind != "software" {
        return Ok(());
    }
    match available_bytes() {
        Some(available) if bytes > available => Err(BackendError::OutOfMemory(format!(
            "the run needs {} MiB on {}, and {} MiB are available",
            bytes >> 20,
            gpu.description.name,
            available >> 20
        ))),
        _ => Ok(()),
    }
}

fn usage_of(name: &str) -> wgpu::BufferUsages {
    use wgpu::BufferUsages as Usage;
    let role = crate::plan::buffer(name).map(|declared| declared.role);
    let kind = match (name, role) {
        ("frame", _) => Usage::UNIFORM | Usage::COPY_DST,
        (
            "spread_counts" | "winds" | "lamps" | "counts" | "tree_counts" | "surface_light"
            | "stroke_light" | "shade_box",
            _,
        ) => Usage::UNIFORM | Usage::STORAGE | Usage::COPY_DST,
        // Vertices, for callers who draw particles themselves.
        ("particles", _) => Usage::STORAGE | Usage::VERTEX | Usage::COPY_DST,
        ("dispatches", _) => Usage::STORAGE | Usage::INDIRECT | Usage::COPY_DST,
        (_, Some(BufferRole::Input)) => Usage::STORAGE | Usage::COPY_DST,
        _ => Usage::STORAGE | Usage::COPY_DST,
    };
    kind | Usage::COPY_SRC
}
