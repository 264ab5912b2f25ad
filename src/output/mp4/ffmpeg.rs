//! The program `ffmpeg` while it takes bytes: started, fed, ended, and asked what went wrong.
//!
//! Nobody waits for ever: what it says is taken by a thread all the while, so that it never waits for us to read, and
//! one that takes no more bytes is given a moment to end by itself.

use std::ffi::OsString;
use std::io::{self, ErrorKind, Read, Write};
use std::process::{Child, ChildStderr, ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Bytes kept of what it said last.
const KEPT_BYTES: usize = 4096;

/// Lines of these that are told.
const TOLD_LINES: usize = 4;

/// For one that takes no more bytes to end, and for its last words to come.
const GRACE: Duration = Duration::from_secs(2);

/// Why there is no film.
pub(super) enum Failure {
    /// There is no such program.
    Missing,
    /// There is one, and it does not run.
    NotStarted(io::Error),
    /// It lacks this encoder.
    NoEncoder(&'static str),
    /// It ended badly.
    Failed {
        how: String,
        last_lines: Vec<String>,
    },
}

/// A running ffmpeg. Dropping it kills it.
pub(super) struct Ffmpeg {
    child: Child,
    /// None when all bytes have been given.
    stdin: Option<ChildStdin>,
    words: Words,
}

impl Ffmpeg {
    /// Fails unless there is an ffmpeg with that encoder.
    pub(super) fn require(encoder: &'static str) -> Result<(), Failure> {
        let listed = Command::new("ffmpeg")
            .args(["-hide_banner", "-loglevel", "error", "-encoders"])
            .stdin(Stdio::null())
            .output()
            .map_err(not_started)?;
        if !listed.status.success() {
            return Err(Failure::Failed {
                how: listed.status.to_string(),
                last_lines: last_lines(&listed.stderr),
            });
        }
        // ` V....D libx264   libx264 H.264 / AVC …`
        let list = String::from_utf8_lossy(&listed.stdout);
        let mut names = list
            .lines()
            .filter_map(|line| line.split_whitespace().nth(1));
        if names.any(|name| name == encoder) {
            Ok(())
        } else {
            Err(Failure::NoEncoder(encoder))
        }
    }

    /// Starts it; it shall read from its standard input.
    pub(super) fn start(arguments: Vec<OsString>) -> Result<Self, Failure> {
        let mut command = Command::new("ffmpeg");
        command
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        // An interruption from the terminal is for us, who then end it.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn().map_err(not_started)?;
        Ok(Self {
            stdin: child.stdin.take(),
            words: Words::of(child.stderr.take()),
            child,
        })
    }

    /// Gives it bytes, and waits until it has taken them.
    pub(super) fn write(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let Some(stdin) = &mut self.stdin else {
            return Err(self.failure("its input is closed".to_owned()));
        };
        match stdin.write_all(bytes) {
            Ok(()) => Ok(()),
            Err(error) => {
                self.stdin = None;
                let how = match self.wait_for(GRACE) {
                    Some(status) => status.to_string(),
                    None => format!("it takes no more frames: {error}"),
                };
                Err(self.failure(how))
            }
        }
    }

    /// Lets it end, however long that takes.
    pub(super) fn finish(&mut self) -> Result<(), Failure> {
        // The end of its input.
        self.stdin = None;
        match self.child.wait() {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => Err(self.failure(status.to_string())),
            Err(error) => Err(self.failure(error.to_string())),
        }
    }

    /// What it said last.
    pub(super) fn last_lines(&self) -> Vec<String> {
        self.words.last_lines()
    }

    fn failure(&mut self, how: String) -> Failure {
        self.kill();
        Failure::Failed {
            how,
            last_lines: self.words.last_lines(),
        }
    }

    fn wait_for(&mut self, time: Duration) -> Option<ExitStatus> {
        let end = Instant::now() + time;
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Ok(None) if Instant::now() < end => {
                    std::thread::sleep(Duration::from_millis(10));
                }
                _ => return None,
            }
        }
    }

    fn kill(&mut self) {
        self.stdin = None;
        // Both are no errors where it has ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Ffmpeg {
    fn drop(&mut self) {
        self.kill();
    }
}

fn not_started(error: io::Error) -> Failure {
    match error.kind() {
        ErrorKind::NotFound => Failure::Missing,
        _ => Failure::NotStarted(error),
    }
}

/// What it says on standard error, taken by a thread as it comes.
struct Words {
    kept: Arc<Mutex<Vec<u8>>>,
    /// Closed when there is nothing more to come.
    ended: Receiver<()>,
}

impl Words {
    fn of(stderr: Option<ChildStderr>) -> Self {
        let kept = Arc::new(Mutex::new(Vec::new()));
        let (end, ended) = channel();
        if let Some(mut stderr) = stderr {
            let kept = Arc::clone(&kept);
            std::thread::spawn(move || {
                let _end = end;
                let mut bytes = [0; KEPT_BYTES];
                while let Ok(count @ 1..) = stderr.read(&mut bytes) {
                    let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
                    kept.extend_from_slice(&bytes[..count]);
                    let excess = kept.len().saturating_sub(KEPT_BYTES);
                    kept.drain(..excess);
                }
            });
        }
        Self { kept, ended }
    }

    /// The last of it, when it has ended: a moment at most, for a child of its own may hold on to it.
    fn last_lines(&self) -> Vec<String> {
        let _ = self.ended.recv_timeout(GRACE);
        last_lines(&self.kept.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

fn last_lines(bytes: &[u8]) -> Vec<String> {
    let text = String::from_utf8_lossy(bytes);
    let lines = text.lines().map(str::trim_end).filter(|l| !l.is_empty());
    let lines: Vec<_> = lines.map(str::to_owned).collect();
    lines[lines.len().saturating_sub(TOLD_LINES)..].to_vec()
}
