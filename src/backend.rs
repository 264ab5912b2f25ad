//! What the two backends have in common, as the rest of the program sees them.

mod record;

use std::any::Any;

use crate::layout::FrameStats;
use crate::plan::{FrameInputs, Population, STAGES, Stage};

pub use record::{BindingRecord, BufferRecord, DispatchRecord, Groups, KernelRecord, StageRecord};

/// Why a backend could not go on. All of these are the machine's fault, not the scene's.
///
/// After an error of a step the run's state is unknown: the run is over, and a new one makes the
/// same bits. After [`BackendError::DeviceLost`] the device is over, too. Whatever else fails,
/// drawing or reading, leaves the run as it was.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BackendError {
    /// There was no room for a buffer; what and how many bytes.
    OutOfMemory(String),
    /// The driver gave up, or the device's owner destroyed it.
    DeviceLost(String),
    /// The adapter cannot run the plan.
    Unsupported(String),
    /// The driver or wgpu refused a call: a defect of ours or theirs.
    Internal(String),
    /// A kernel that stands in for one of the program's is not right: where, and why.
    Kernel(String),
}

impl std::fmt::Display for BackendError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::OutOfMemory(what) => write!(
                f,
                "error: out of memory: {what}\n  = help: take a smaller capacity or image, or \
                 another adapter"
            ),
            Self::DeviceLost(what) => write!(
                f,
                "error: the device was lost: {what}\n  = help: try again, or `--adapter cpu`"
            ),
            Self::Unsupported(what) => write!(
                f,
                "error: the adapter cannot run this: {what}\n  = help: `motes adapters` lists \
                 others; `--adapter cpu` always works"
            ),
            Self::Internal(what) => write!(
                f,
                "error: the graphics driver refused a call: {what}\n  = help: `--adapter cpu` \
                 does not need the driver; `motes check` may name the stage"
            ),
            Self::Kernel(what) => write!(f, "error: {}", what.trim_start_matches("error: ")),
        }
    }
}

impl std::error::Error for BackendError {}

/// Bytes of memory that the system can still give, where it says so. Asking for more does not fail
/// at once on most systems: it ends the process later, without a word.
pub(crate) fn available_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kib * 1024)
}

/// `len` zeros, or an error where there is no room for them: running out of memory later would end
/// the process without a word.
pub(crate) fn try_zeroed<T: bytemuck::Zeroable + Clone>(
    len: usize,
    what: &str,
) -> Result<Vec<T>, BackendError> {
    let bytes = (len * size_of::<T>()) as u64;
    let failed = || BackendError::OutOfMemory(format!("{what} take {} MiB", bytes >> 20));
    if available_bytes().is_some_and(|available| bytes > available) {
        return Err(failed());
    }
    let mut zeros = Vec::new();
    zeros.try_reserve_exact(len).map_err(|_| failed())?;
    zeros.resize(len, T::zeroed());
    Ok(zeros)
}

/// A copy of the words, or an error where there is no room for it.
pub(crate) fn try_copied(words: &[u32], what: &str) -> Result<Vec<u32>, BackendError> {
    let mut copy = Vec::new();
    copy.try_reserve_exact(words.len()).map_err(|_| {
        let mib = size_of_val(words) >> 20;
        BackendError::OutOfMemory(format!("a copy of {what} takes {mib} MiB"))
    })?;
    copy.extend_from_slice(words);
    Ok(copy)
}

/// Everybody who lives, as words in storage order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Living<'a> {
    /// Words of [`crate::layout::Particle`].
    pub particles: &'a [u32],
    /// Words of [`crate::layout::Boid`].
    pub boids: &'a [u32],
    /// Words of the places of boids' trails, as the buffer `boid_trails` has them.
    pub trails: &'a [u32],
    /// Of fires that spread: words of [`crate::layout::SpreadCounts`], two for each ring, words of
    /// [`crate::layout::DroppedFlame`] for all that there may be, words of
    /// [`crate::layout::SpreadPoint`]; empty where none does.
    pub front: &'a [u32],
}

/// A plan under way on some processor. Pools start empty. It may move to another thread.
pub trait Backend: Any + Send {
    /// Name of the adapter, for people.
    fn adapter_name(&self) -> String;

    /// Whether its bits are those that every exact backend makes.
    fn is_exact(&self) -> bool;

    /// Runs one stage, and finishes it before it returns where the backend works in the background.
    ///
    /// # Errors
    /// [`BackendError`] when the machine fails.
    fn run_stage(&mut self, stage: Stage, inputs: &FrameInputs) -> Result<(), BackendError>;

    /// Runs all stages of the simulation, in order. May return before they are done.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn step(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        for info in STAGES.iter().filter(|info| !info.draws) {
            self.run_stage(info.stage, inputs)?;
        }
        Ok(())
    }

    /// Runs all stages of drawing, in order, on the state after the last step.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn draw(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        for info in STAGES.iter().filter(|info| info.draws) {
            self.run_stage(info.stage, inputs)?;
        }
        Ok(())
    }

    /// The live records of a state buffer, as words. `particles` has those present: the living
    /// and, between emit and advance, the newborn and the dying.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn read(&mut self, buffer: &str) -> Result<Vec<u32>, BackendError>;

    /// The statistics of all frames stepped since the last call, in order.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn take_statistics(&mut self) -> Result<Vec<FrameStats>, BackendError>;

    /// Puts the living in place of those there are, as after the last of the frames `recent`: those
    /// whose parameter rows the living may have. Statistics that have not been taken are lost. There
    /// are at most as many particles as the plan has room for, and all are of its systems; there
    /// are as many boids as the plan has.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn restore(&mut self, living: &Living<'_>, recent: &[FrameInputs]) -> Result<(), BackendError>;

    /// The stage as it would run now, with everything that it reads; `None` on a backend that has
    /// no kernels. Everything before it in the frame must have run.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn record_stage(
        &mut self,
        stage: Stage,
        inputs: &FrameInputs,
    ) -> Result<Option<StageRecord>, BackendError> {
        let _ = (stage, inputs);
        Ok(None)
    }

    /// Digest of all that lives, made on the backend itself: the sum of its populations', by halves.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn state_digest(&mut self) -> Result<u64, BackendError> {
        let mut halves = [0u32; 2];
        for population in Population::ALL {
            let digest = self.population_digest(population)?;
            halves[0] = halves[0].wrapping_add(digest as u32);
            halves[1] = halves[1].wrapping_add((digest >> 32) as u32);
        }
        Ok(u64::from(halves[0]) | (u64::from(halves[1]) << 32))
    }

    /// Digest of one population, made on the backend itself; 0 where it has nobody.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn population_digest(&mut self, population: Population) -> Result<u64, BackendError>;

    /// Digest of the image, made on the backend itself.
    ///
    /// # Errors
    /// As [`Backend::run_stage`].
    fn image_digest(&mut self) -> Result<u64, BackendError>;
}
