//! What is no plain file: devices, pipes, and what the process has open already.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use super::OutputError;

/// Links in a row that are followed.
const MOST_LINKS: usize = 40;

/// A place to write to as it is: renaming would replace it.
pub(super) enum Special {
    /// One of what a process has open: `/dev/stdout`, `/dev/fd/3`, `/proc/self/fd/3`. It may well be
    /// a file that others write to, too.
    Descriptor(PathBuf),
    /// A device or a pipe.
    Device,
}

/// What is at that place, unless it is a plain file, a folder, or nothing.
pub(super) fn special(path: &Path) -> Option<Special> {
    if let Some(descriptor) = descriptor(path) {
        return Some(Special::Descriptor(descriptor));
    }
    let metadata = fs::metadata(path).ok()?;
    (!metadata.is_file() && !metadata.is_dir()).then_some(Special::Device)
}

/// Whether a file there would not be renamed to its place but written into.
pub(crate) fn is_special(path: &Path) -> bool {
    special(path).is_some()
}

impl Special {
    /// Opens it for writing: at its end, where it has one.
    pub(super) fn open(&self, path: &Path) -> io::Result<File> {
        match self {
            Self::Descriptor(descriptor) => match own_stream(descriptor) {
                Some(stream) => stream,
                None => OpenOptions::new().append(true).open(descriptor),
            },
            Self::Device => OpenOptions::new().write(true).open(path),
        }
    }
}

/// The stream of this process itself, which knows where in its file it stands; opened anew, it would
/// not, and who writes to it next would write over what we wrote.
#[cfg(unix)]
fn own_stream(descriptor: &Path) -> Option<io::Result<File>> {
    use std::os::fd::AsFd as _;
    let folder = descriptor.parent()?;
    let of_process = Path::new("/proc").join(std::process::id().to_string());
    let is_own = folder == Path::new("/dev/fd") || folder.starts_with(of_process);
    let owned = match descriptor.file_name()?.to_str()? {
        "1" if is_own => io::stdout().as_fd().try_clone_to_owned(),
        "2" if is_own => io::stderr().as_fd().try_clone_to_owned(),
        _ => return None,
    };
    Some(owned.map(File::from))
}

#[cfg(not(unix))]
fn own_stream(_: &Path) -> Option<io::Result<File>> {
    None
}

/// The place among what a process has open that the path leads to, if it does.
fn descriptor(path: &Path) -> Option<PathBuf> {
    let mut at = path.to_owned();
    for _ in 0..MOST_LINKS {
        let folder = fs::canonicalize(parent_folder(&at)).ok()?;
        at = folder.join(at.file_name()?);
        let is_of_process = folder.starts_with("/proc") && folder.ends_with("fd");
        if is_of_process || folder == Path::new("/dev/fd") {
            return Some(at);
        }
        at = folder.join(fs::read_link(&at).ok()?);
    }
    None
}

/// The place that links lead to from here, where there need not be anything; `path` itself if it is no link.
pub(super) fn end_of_links(path: &Path) -> Result<PathBuf, OutputError> {
    let mut end = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&end) {
            Ok(target) => end = parent_folder(&end).join(target),
            Err(_) => return Ok(end),
        }
    }
    Err(OutputError::usage(
        path,
        "links lead from here in a circle, or too far",
        "give the name of a file",
    ))
}

pub(super) fn parent_folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}
