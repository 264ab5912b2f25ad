//! The declared buffers of a plan on a device, and the two pools in pages.

use std::collections::HashMap;

use super::adapter::GpuDevice;
use crate::backend::{BackendError, available_bytes};
use crate::layout::{Dispatch, Particle};
use crate::plan::{BUFFERS, BufferRole, Count, Plan};

/// A page holds a multiple of this many particles: whole words of bits, and whole runs of the scan.
const PAGE_GRAIN: u32 = 2048;

/// Drivers end an invocation's loops when they have turned 65,535 times in all, and one invocation
/// writes the dispatches of all pairs of pages.
const MOST_DISPATCHES: u32 = 60_000;

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

/// All buffers of a run.
#[derive(Debug)]
pub(super) struct Memory {
    pub(super) paging: Paging,
    pub(super) pools: [Vec<wgpu::Buffer>; 2],
    /// For each page, the particles that cover many pixels: a count, its copy, indices.
    pub(super) large: Vec<wgpu::Buffer>,
    named: HashMap<&'static str, wgpu::Buffer>,
    /// Bytes allocated in all.
    pub(super) bytes: u64,
}

impl Memory {
    /// Allocates everything, zeroed.
    pub(super) fn new(
        gpu: &GpuDevice,
        plan: &Plan,
        most_page_bytes: u64,
    ) -> Result<Self, BackendError> {
        if gpu.description.kind == "software" {
            check_available(plan)?;
        }
        let limits = gpu.device.limits();
        let most_binding = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size);
        let paging = Paging::new(plan.capacity, most_page_bytes.min(most_binding));
        if paging.dispatches() > MOST_DISPATCHES {
            return Err(BackendError::Unsupported(format!(
                "{} particles in pages of {} are too many pages",
                plan.capacity, paging.page_len
            )));
        }
        let mut bytes = 0;
        let mut allocate = |name: &str, size: u64| -> Result<wgpu::Buffer, BackendError> {
            if size > most_binding {
                return Err(BackendError::Unsupported(format!(
                    "`{name}` takes {size} bytes, and the adapter binds at most {most_binding}"
                )));
            }
            // Digests look at whole vectors of four words.
            let size = size.next_multiple_of(16).max(16);
            bytes += size;
            Ok(gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(name),
                size,
                usage: usage_of(name),
                mapped_at_creation: false,
            }))
        };
        let page_bytes = u64::from(paging.page_len) * PARTICLE_BYTES;
        let mut pools = [Vec::new(), Vec::new()];
        for pool in &mut pools {
            for _ in 0..paging.page_count {
                pool.push(allocate("particles", page_bytes)?);
            }
        }
        let large = (0..paging.page_count)
            .map(|_| allocate("large_particles", (u64::from(paging.page_len) + 2) * 4))
            .collect::<Result<_, _>>()?;
        let mut named = HashMap::new();
        for declared in BUFFERS {
            let in_pages = matches!(declared.count, Count::ParticlesOver(1));
            if in_pages || declared.name == "large_particles" {
                continue;
            }
            let records = declared
                .records(plan)
                .unwrap_or_else(|| paging.dispatches());
            let size = u64::from(records) * u64::from(declared.stride);
            named.insert(declared.name, allocate(declared.name, size)?);
        }
        debug_assert_eq!(size_of::<Dispatch>(), 12);
        gpu.check().map_err(|failure| match failure {
            BackendError::OutOfMemory(_) => BackendError::OutOfMemory(format!(
                "the run needs {} MiB on {}",
                bytes >> 20,
                gpu.description.name
            )),
            other => other,
        })?;
        Ok(Self {
            paging,
            pools,
            large,
            named,
            bytes,
        })
    }

    /// Every buffer, those of the pools included.
    pub(super) fn all(&self) -> impl Iterator<Item = &wgpu::Buffer> {
        self.pools
            .iter()
            .flatten()
            .chain(&self.large)
            .chain(self.named.values())
    }

    /// The buffer of that name; the pools are not among them.
    pub(super) fn named(&self, name: &str) -> Result<&wgpu::Buffer, BackendError> {
        self.named
            .get(name)
            .ok_or_else(|| BackendError::Internal(format!("no buffer `{name}`")))
    }

    /// Makes it dark, as every splat begins.
    pub(super) fn clear_light(
        &self,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), BackendError> {
        encoder.clear_buffer(self.named("light_low")?, 0, None);
        encoder.clear_buffer(self.named("light_high")?, 0, None);
        Ok(())
    }
}

/// A software adapter's memory is the system's.
fn check_available(plan: &Plan) -> Result<(), BackendError> {
    let needed = 2 * u64::from(plan.capacity) * PARTICLE_BYTES;
    match available_bytes() {
        Some(available) if needed > available => Err(BackendError::OutOfMemory(format!(
            "two pools of {} particles take {} MiB, and {} MiB are available",
            plan.capacity,
            needed >> 20,
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
        ("dispatches", _) => Usage::STORAGE | Usage::INDIRECT | Usage::COPY_DST,
        (_, Some(BufferRole::Input)) => Usage::STORAGE | Usage::COPY_DST,
        _ => Usage::STORAGE | Usage::COPY_DST,
    };
    kind | Usage::COPY_SRC
}
