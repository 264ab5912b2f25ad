//! What can go wrong with an output file, and whose fault it is.

use std::error::Error;
use std::fmt;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// What helps where a disk is full.
pub(super) const NO_ROOM: &str = "make room, or choose another disk";

/// An output that could not be written: which file, what is wrong, and what would be right.
///
/// [`fmt::Display`] gives a line with the file and the problem and, where there is advice, more, indented lines.
#[derive(Debug)]
pub struct OutputError {
    path: PathBuf,
    problem: String,
    advice: String,
    is_users_fault: bool,
    source: Option<io::Error>,
}

impl OutputError {
    /// True where asking for something else would help (a name, a folder, a size): exit code 2.
    /// False where the machine refused (disk full, read-only, no permission, no ffmpeg): exit code 3.
    pub fn is_users_fault(&self) -> bool {
        self.is_users_fault
    }

    /// The file, folder or pattern that the error is about, as far as possible as the user wrote it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A request that cannot be met, with what would be right (may be empty).
    pub(super) fn usage(
        path: impl Into<PathBuf>,
        problem: impl Into<String>,
        advice: impl Into<String>,
    ) -> Self {
        Self {
            path: path.into(),
            problem: problem.into(),
            advice: advice.into(),
            is_users_fault: true,
            source: None,
        }
    }

    /// What the machine lacks or refuses, with what would help (may be empty).
    pub(super) fn machine(
        path: impl Into<PathBuf>,
        problem: impl Into<String>,
        advice: impl Into<String>,
    ) -> Self {
        Self {
            is_users_fault: false,
            ..Self::usage(path, problem, advice)
        }
    }

    /// An error of the file system while doing `attempt` ("create the folder", "write") with `path`.
    pub(crate) fn io(path: &Path, attempt: &str, error: io::Error) -> Self {
        let (is_users_fault, advice) = judge(error.kind());
        Self {
            path: path.to_owned(),
            problem: format!("cannot {attempt}: {error}"),
            advice: advice.to_owned(),
            is_users_fault,
            source: Some(error),
        }
    }
}

/// Whether another path would have helped, and the advice that goes with it.
fn judge(kind: ErrorKind) -> (bool, &'static str) {
    match kind {
        ErrorKind::NotADirectory | ErrorKind::AlreadyExists => (
            true,
            "a part of this path is a file; give a path whose folders are folders",
        ),
        ErrorKind::IsADirectory | ErrorKind::DirectoryNotEmpty => {
            (true, "this is a folder; give the name of a file")
        }
        ErrorKind::InvalidFilename | ErrorKind::InvalidInput => {
            (true, "give a name that this file system allows")
        }
        ErrorKind::NotFound => (true, "give a path in a folder that can exist"),
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            (false, "choose a folder that you may write to")
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            (false, NO_ROOM)
        }
        ErrorKind::OutOfMemory => (
            false,
            "there is no memory left for it: a smaller picture, or a folder of pictures, takes less",
        ),
        _ => (false, "choose another place to write to"),
    }
}

impl fmt::Display for OutputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.as_os_str().is_empty() {
            write!(f, "{}: ", self.path.display())?;
        }
        f.write_str(&self.problem)?;
        if !self.advice.is_empty() {
            write!(f, "\n  = help: {}", self.advice)?;
        }
        Ok(())
    }
}

impl Error for OutputError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.source
            .as_ref()
            .map(|error| error as &(dyn Error + 'static))
    }
}
