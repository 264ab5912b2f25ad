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

    /// Particles that the last drawing left to the kernel for those that cover many pixels.
    ///
    /// # Errors
    /// The device fails.
    pub fn large_particles(&mut self) -> Result<u64, BackendError> {
        self.watched(|run| {
            let pages = run.memory.large.iter();
            // The count is kept in word 1.
            let counts = pages.map(|page| readback::words(&run.gpu, page, 8).map(|two| two[1]));
            counts.map(|count| count.map(u64::from)).sum()
        })
    }
}
