//! Being asked to stop: Ctrl-C, or a signal to end.

use std::io::IsTerminal as _;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Weak};
use std::time::{Duration, Instant};

#[cfg(unix)]
use signal_hook::consts::{SIGHUP, SIGXFSZ};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::{flag, low_level};

use crate::cli::{CliError, note};
use crate::output::remove_own;

/// Signals that ask a process to end: from the keyboard, from another, from a closed terminal.
const SIGNALS: &[i32] = &[
    SIGINT,
    SIGTERM,
    #[cfg(unix)]
    SIGHUP,
];

/// Time between two looks whether a signal has come that the user has not been told of.
const LOOKED_EVERY: Duration = Duration::from_millis(20);

/// Signals that come within this time are one: `timeout` and shells tell a process and its group.
const ONE_ASKING: Duration = Duration::from_millis(500);

/// Whether and how the process has been asked to stop. The first time it may finish what it is at,
/// the second time it ends at once.
pub(super) struct Interrupt {
    asked: Arc<Asked>,
}

/// What has been asked.
#[derive(Default)]
struct Asked {
    /// The signal that came last; 0 for none.
    signal: Arc<AtomicUsize>,
    /// Whether one has come that nobody has looked at yet.
    has_come: Arc<AtomicBool>,
    is_told: AtomicBool,
}

impl Interrupt {
    /// Listens from now on, to those signals that the process was not begun to ignore.
    pub(super) fn listen() -> Result<Self, CliError> {
        let failed = |e: std::io::Error| {
            CliError::machine(
                format!("signals cannot be listened to: {e}"),
                "run it where a process may handle signals",
            )
        };
        let asked = Arc::new(Asked::default());
        let watched = Arc::downgrade(&asked);
        // A handler of signals may neither write nor remove files. What it cannot do, this does.
        std::thread::Builder::new()
            .spawn(move || watch(&watched))
            .map_err(failed)?;
        let ignored = ignored();
        for &one in SIGNALS.iter().filter(|one| !ignored.contains(one)) {
            flag::register_usize(one, asked.signal.clone(), one as usize)
                .and_then(|_| flag::register(one, asked.has_come.clone()))
                .map_err(failed)?;
        }
        Ok(Self { asked })
    }

    /// The exit code that a shell gives a program that was stopped so: 130 for Ctrl-C, 143 for the
    /// signal to end. `None` if it was not asked.
    pub(super) fn exit_code(&self) -> Option<u8> {
        self.asked.signal().map(|signal| 128 + signal as u8)
    }
}

/// Looks for signals until nobody asks for them any more; at one that comes again, the process ends.
fn watch(watched: &Weak<Asked>) {
    let mut first = None;
    while let Some(asked) = watched.upgrade() {
        if asked.has_come.swap(false, Ordering::Relaxed) {
            let since = *first.get_or_insert_with(Instant::now);
            if since.elapsed() > ONE_ASKING {
                remove_own();
                low_level::exit(128 + asked.signal.load(Ordering::Relaxed) as i32);
            }
        }
        asked.signal();
        drop(asked);
        std::thread::sleep(LOOKED_EVERY);
    }
}

/// Signals that whoever began the process wants it to ignore, as `nohup` does.
fn ignored() -> Vec<i32> {
    // Told by Linux alone.
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .unwrap_or(0);
    let is_ignored = |signal: &i32| mask >> (signal - 1) & 1 == 1;
    SIGNALS.iter().copied().filter(is_ignored).collect()
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
