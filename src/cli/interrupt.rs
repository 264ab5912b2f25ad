//! Being asked to stop: Ctrl-C, or a signal to end.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

#[cfg(unix)]
use signal_hook::consts::SIGHUP;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::cli::CliError;

/// Signals that ask a process to end: from the keyboard, from another, from a closed terminal.
const SIGNALS: &[i32] = &[
    SIGINT,
    SIGTERM,
    #[cfg(unix)]
    SIGHUP,
];

/// Whether and how the process has been asked to stop. The first time it may finish what it is at,
/// the second time it ends at once.
pub(super) struct Interrupt {
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Listens from now on.
    pub(super) fn listen() -> Result<Self, CliError> {
        let signal = Arc::new(AtomicUsize::new(0));
        let asked = Arc::new(AtomicBool::new(false));
        for &one in SIGNALS {
            // In this order: the first signal finds `asked` false.
            flag::register_conditional_shutdown(one, 128 + one, asked.clone())
                .and_then(|_| flag::register(one, asked.clone()))
                .and_then(|_| flag::register_usize(one, signal.clone(), one as usize))
                .map_err(|e| CliError {
                    message: format!("error: signals cannot be listened to: {e}\n  = help: run it where a process may handle signals"),
                    code: 3,
                })?;
        }
        Ok(Self { signal })
    }

    /// The exit code that a shell gives a program that was stopped so: 130 for Ctrl-C, 143 for the
    /// signal to end. `None` if it was not asked.
    pub(super) fn exit_code(&self) -> Option<u8> {
        match self.signal.load(Ordering::Relaxed) {
            0 => None,
            signal => Some(128 + signal as u8),
        }
    }
}
