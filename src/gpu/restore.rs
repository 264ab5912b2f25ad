//! A run's state put onto the device.

use super::{GpuBackend, StatisticsRing};
use crate::backend::{BackendError, Living};
use crate::layout::{Counts, DroppedFlame, SpreadCounts};
use crate::plan::{FrameInputs, Stage};

/// Words of a particle.
const PARTICLE_WORDS: usize = size_of::<crate::layout::Particle>() / 4;

impl GpuBackend {
    /// See [`crate::backend::Backend::restore`].
    pub(super) fn put(
        &mut self,
        living: &Living<'_>,
        recent: &[FrameInputs],
    ) -> Result<(), BackendError> {
        let particles = living.particles;
        for inputs in recent {
            self.upload(inputs)?;
            // What is written waits in staging memory for the next submission.
            self.gpu.queue.submit([]);
        }
        let page_words = self.memory.paging.page_len as usize * PARTICLE_WORDS;
        let pages = &self.memory.pools[self.current];
        for (page, words) in pages.iter().zip(particles.chunks(page_words)) {
            self.gpu.write(page, 0, bytemuck::cast_slice(words))?;
            self.gpu.queue.submit([]);
        }
        let boids = self.memory.named("boids")?;
        self.gpu
            .write(boids, 0, bytemuck::cast_slice(living.boids))?;
        self.gpu.queue.submit([]);
        let trails = self.memory.named("boid_trails")?;
        self.gpu
            .write(trails, 0, bytemuck::cast_slice(living.trails))?;
        self.gpu.queue.submit([]);
        if !living.front.is_empty() {
            let (counts, rest) = living.front.split_at(size_of::<SpreadCounts>() / 4);
            let (spans, rest) = rest.split_at(2 * self.ring_count as usize);
            let flames = self.dropped_places as usize * (size_of::<DroppedFlame>() / 4);
            let (flames, rest) = rest.split_at(flames);
            let (catches, points) = rest.split_at(4 * self.piece_count as usize);
            for (name, words) in [
                ("spread_counts", counts),
                ("ring_spans", spans),
                ("control_points", points),
                ("dropped_flames", flames),
                ("catches", catches),
            ] {
                let buffer = self.memory.named(name)?;
                self.gpu.write(buffer, 0, bytemuck::cast_slice(words))?;
                self.gpu.queue.submit([]);
            }
        }
        let live = (particles.len() / PARTICLE_WORDS) as u32;
        let counts = Counts {
            live,
            total: live,
            ..Counts::default()
        };
        let buffer = self.memory.named("counts")?;
        self.gpu.write(buffer, 0, bytemuck::bytes_of(&counts))?;
        self.gpu.queue.submit([]);
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        for name in ["nodes", "tree_counts"] {
            encoder.clear_buffer(self.memory.named(name)?, 0, None);
        }
        self.gpu.queue.submit([encoder.finish()]);
        self.newborns_present = false;
        self.points_moved = false;
        self.ring = StatisticsRing::default();
        // Flames have no past: they are what the last frame makes of them.
        if let Some(last) = recent.last() {
            self.submit(&[Stage::Kindle, Stage::Trace], last)?;
        }
        self.gpu.wait()
    }
}
