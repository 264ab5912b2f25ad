//! What goes wrong with our own calls on a device, told apart from what goes wrong with its owner's.
//!
//! wgpu tells of errors through callbacks that belong to whoever opened the device, or through
//! scopes of the calling thread. Scopes nest: ours catch what our calls do wrong between their
//! beginning and end, and nothing else. Of a lost device neither of them tells: calls on it are
//! quietly left undone, so that it has to be asked.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::device::GpuDevice;
use crate::backend::BackendError;

thread_local! {
    /// Whether this thread waits for a device.
    static WAITING: Cell<bool> = const { Cell::new(false) };
}

/// Whether this thread is waiting for a device: a panic now is the driver's loss of it, which is
/// caught and comes back as [`BackendError::DeviceLost`]. For panic hooks.
pub fn is_waiting() -> bool {
    WAITING.get()
}

/// Open scopes for every kind of error, popped in reverse order also when dropped.
struct Scopes(Option<[wgpu::ErrorScopeGuard; 3]>);

impl Scopes {
    fn open(device: &wgpu::Device) -> Self {
        use wgpu::ErrorFilter::{Internal, OutOfMemory, Validation};
        Self(Some(
            [Validation, Internal, OutOfMemory].map(|filter| device.push_error_scope(filter)),
        ))
    }

    /// What they have caught: want of memory first, for the rest often follows from it.
    fn caught(mut self) -> Option<wgpu::Error> {
        let [validation, internal, memory] = self.0.take()?;
        let memory = pollster::block_on(memory.pop());
        let internal = pollster::block_on(internal.pop());
        let validation = pollster::block_on(validation.pop());
        memory.or(internal).or(validation)
    }
}

impl Drop for Scopes {
    fn drop(&mut self) {
        // An array would drop its first scope first.
        if let Some([validation, internal, memory]) = self.0.take() {
            drop(memory);
            drop(internal);
            drop(validation);
        }
    }
}

/// Our name for an error of wgpu's.
pub(super) fn named(error: &wgpu::Error) -> BackendError {
    match error {
        wgpu::Error::OutOfMemory { .. } => {
            BackendError::OutOfMemory("the adapter's memory is used up".into())
        }
        other => BackendError::Internal(other.to_string()),
    }
}

/// Whether the device gives out no memory: that of a lost device cannot be looked at.
pub(super) fn is_gone(device: &wgpu::Device) -> bool {
    let scopes = Scopes::open(device);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("motes: probe"),
        size: 4,
        usage: wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: true,
    });
    let gone = buffer.slice(..).get_mapped_range().is_err();
    drop(scopes);
    gone
}

impl GpuDevice {
    /// Does the work, which calls wgpu on this thread, and says what of it went wrong.
    pub(super) fn watched<T>(
        &self,
        work: impl FnOnce() -> Result<T, BackendError>,
    ) -> Result<T, BackendError> {
        let scopes = Scopes::open(&self.device);
        let done = work();
        let caught = scopes.caught();
        if caught.is_none() && done.is_ok() {
            self.check()?;
            return done;
        }
        // Everything fails on a lost device; that it is lost is the reason.
        if let Some(lost) = self.loss() {
            return Err(lost);
        }
        match caught {
            Some(error) => Err(named(&error)),
            None => done,
        }
    }

    /// That the device is lost, if it is.
    pub(super) fn loss(&self) -> Option<BackendError> {
        let scopes = Scopes::open(&self.device);
        let size = wgpu::BufferSize::MIN.saturating_add(3);
        let refused = self.queue.write_buffer_with(&self.probe, 0, size).is_none();
        let quietly = refused && scopes.caught().is_none();
        quietly.then(|| match self.check() {
            Err(lost @ BackendError::DeviceLost(_)) => lost,
            _ => BackendError::DeviceLost(format!(
                "{}: the driver gave it up, or its owner destroyed it",
                self.description.name
            )),
        })
    }

    /// Writes to a buffer, as [`wgpu::Queue::write_buffer`] does, which does not tell whether the
    /// device is lost.
    pub(super) fn write(
        &self,
        buffer: &wgpu::Buffer,
        offset: u64,
        bytes: &[u8],
    ) -> Result<(), BackendError> {
        let Some(size) = wgpu::BufferSize::new(bytes.len() as u64) else {
            return Ok(());
        };
        match self.queue.write_buffer_with(buffer, offset, size) {
            Some(mut view) => {
                view.copy_from_slice(bytes);
                Ok(())
            }
            None => Err(BackendError::DeviceLost(format!(
                "{} took no bytes",
                self.description.name
            ))),
        }
    }

    /// What the callbacks of a device of our own have heard; nothing on a caller's.
    pub(super) fn check(&self) -> Result<(), BackendError> {
        match self.failure.lock() {
            Ok(slot) => slot.clone().map_or(Ok(()), Err),
            Err(_) => Err(BackendError::Internal("an error handler failed".into())),
        }
    }

    /// Waits until all submitted work is done.
    pub(super) fn wait(&self) -> Result<(), BackendError> {
        self.wait_for(None)
    }

    /// Waits until the submission, or all submitted work, is done.
    pub(super) fn wait_for(
        &self,
        submission_index: Option<wgpu::SubmissionIndex>,
    ) -> Result<(), BackendError> {
        let lost = |why: String| BackendError::DeviceLost(why);
        let kind = wgpu::PollType::Wait {
            submission_index,
            timeout: None,
        };
        // wgpu panics here when the driver loses the device while it is waited for. It holds
        // nothing by then, and only answers that the device is lost from then on.
        WAITING.set(true);
        let polled = catch_unwind(AssertUnwindSafe(|| self.device.poll(kind)));
        WAITING.set(false);
        polled
            .map_err(|_| lost(format!("{} gave up", self.description.name)))?
            .map_err(|e| lost(e.to_string()))?;
        self.check()
    }
}
