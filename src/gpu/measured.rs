//! What a benchmark asks of a run besides its state.

use super::{GpuBackend, readback};
use crate::backend::BackendError;

impl GpuBackend {
    /// Waits until everything that was submitted is done.
    ///
    /// # Errors
    /// The device fails.
    pub fn finish(&mut self) -> Result<(), BackendError> {
        self.watched(|run| run.gpu.wait())
    }

    /// Whether kernels are timed by the device's own clock.
    pub fn is_timed(&self) -> bool {
        self.timer.is_some()
    }

    /// Pages of a pool.
    pub fn page_count(&self) -> u32 {
        self.memory.paging.page_count
    }

    /// Particles that the last drawing left to the kernel for all but small discs.
    ///
    /// # Errors
    /// The device fails.
    pub fn large_particles(&mut self) -> Result<u64, BackendError> {
        self.watched(|run| {
            let pages = run.memory.large.iter();
            // Of few pixels and of many, the counts are kept in words 2 and 3.
            let heads = pages.map(|page| readback::words(&run.gpu, page, 16));
            heads
                .map(|head| head.map(|of| u64::from(of[2]) + u64::from(of[3])))
                .sum()
        })
    }
}
