//! Being asked to stop: Ctrl-C, or a signal to end.

use std::io::IsTerminal as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

#[cfg(unix)]
use signal_hook::consts::{SIGHUP, SIGXFSZ};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::cli::{CliError, note};

/// Signals that ask a process to end: from the keyboard, from another, from a closed terminal.
const SIGNALS: &[i32] = &[
    SIGINT,
    SIGTERM,
    #[cfg(unix)]
    SIGHUP,
];

/// Time between two looks whether a signal has come that the user has not been told of.
const LOOKED_EVERY: Duration = Duration::from_millis(20);

/// Whether and how the process has been asked to stop. The first time it may finish what it is at,
/// the second time it ends at once.
pub(super) struct Interrupt {
    asked: Arc<Asked>,
}

/// What has been asked.
struct Asked {
    /// The signal that came last; 0 for none.
    signal: Arc<AtomicUsize>,
    is_told: AtomicBool,
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
        let asked = Arc::new(Asked {
            signal,
            is_told: AtomicBool::new(false),
        });
        let watched = Arc::downgrade(&asked);
        // A handler of signals may not write. What it cannot tell, the next look at the code does.
        let _ = std::thread::Builder::new().spawn(move || {
            while let Some(asked) = watched.upgrade()
                && asked.signal().is_none()
            {
                drop(asked);
                std::thread::sleep(LOOKED_EVERY);
            }
        });
        Ok(Self { asked })
    }

    /// The exit code that a shell gives a program that was stopped so: 130 for Ctrl-C, 143 for the
    /// signal to end. `None` if it was not asked.
    pub(super) fn exit_code(&self) -> Option<u8> {
        self.asked.signal().map(|signal| 128 + signal as u8)
    }
}

impl Asked {
    /// The first signal, if one has come, of which the user is told once.
    fn signal(&self) -> Option<usize> {
        let signal = self.signal.load(Ordering::Relaxed);
        if signal == 0 {
            return None;
        }
        if !self.is_told.swap(true, Ordering::Relaxed) {
            // From behind a bar of progress.
            let begin = if std::io::stderr().is_terminal() {
                "\n"
            } else {
                ""
            };
            note!("{begin}motes: stopping after this frame; again to stop at once");
        }
        Some(signal)
    }
}

/// Has a file that may not grow any more (`ulimit -f`) be an error of writing it, as a full disk is:
/// the signal would end the process and leave what it had begun.
pub(super) fn outlive_limits() {
    #[cfg(unix)]
    {
        // Without it, all is as if nothing had been done.
        let _ = flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    }
}
