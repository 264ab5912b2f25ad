//! A file that appears whole or not at all.
//!
//! Bytes go to a hidden file `.motes-TOKEN-…` in the same folder (so that renaming stays on one file system);
//! [`AtomicFile::commit`] renames it to its place, and dropping it without that removes it. A killed process leaves at
//! most the hidden file, whose token ([`token`]) tells whose it was.

use std::fs::{self, File, OpenOptions, Permissions};
use std::hash::{BuildHasher as _, RandomState};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::SystemTime;

use super::OutputError;

/// Bytes kept back before they are written to the file.
const BUFFER_BYTES: usize = 1 << 16;

/// Links in a row that are followed.
const MOST_LINKS: usize = 40;

/// A file being written. See the module's documentation.
pub(crate) struct AtomicFile {
    /// None only while the value is being taken apart.
    writer: Option<BufWriter<File>>,
    /// As the user wrote it, for messages.
    asked_path: PathBuf,
    /// The hidden file and the place it goes to; None where the path is a device or a pipe, which is written directly.
    renaming: Option<Renaming>,
}

struct Renaming {
    temporary_path: PathBuf,
    final_path: PathBuf,
    /// Those of the file that is replaced.
    permissions: Option<Permissions>,
}

impl AtomicFile {
    /// Starts a file that shall stand at `path`; folders that are missing above it are created.
    ///
    /// A symbolic link is followed, to where there is nothing yet, too, and a device or pipe (`/dev/stdout`) is written as
    /// it is: renaming would replace it. A file that is replaced hands on its permissions, where that can be.
    pub(crate) fn create(path: &Path) -> Result<Self, OutputError> {
        let asked_path = path.to_owned();
        let mut permissions = None;
        let final_path = match fs::metadata(path) {
            Ok(metadata) if metadata.is_dir() => {
                return Err(OutputError::io(
                    path,
                    "write",
                    ErrorKind::IsADirectory.into(),
                ));
            }
            Ok(metadata) if metadata.is_file() => {
                permissions = Some(metadata.permissions());
                fs::canonicalize(path).map_err(|error| OutputError::io(path, "write", error))?
            }
            Ok(_) => {
                let device = OpenOptions::new()
                    .write(true)
                    .open(path)
                    .map_err(|error| OutputError::io(path, "open", error))?;
                return Ok(Self {
                    writer: Some(BufWriter::with_capacity(BUFFER_BYTES, device)),
                    asked_path,
                    renaming: None,
                });
            }
            // Not there yet, or out of reach: creating the hidden file will tell.
            Err(_) => end_of_links(path)?,
        };
        let folder = parent_folder(&final_path);
        create_folder(folder)?;
        let (temporary_path, file) = create_hidden(folder)
            .map_err(|error| OutputError::io(path, "create a file here", error))?;
        Ok(Self {
            writer: Some(BufWriter::with_capacity(BUFFER_BYTES, file)),
            asked_path,
            renaming: Some(Renaming {
                temporary_path,
                final_path,
                permissions,
            }),
        })
    }

    /// The path as it was asked for, for messages.
    pub(super) fn path(&self) -> &Path {
        &self.asked_path
    }

    /// The hidden file, for another program to fill; None for a device or a pipe.
    pub(super) fn hidden_path(&self) -> Option<&Path> {
        let renaming = self.renaming.as_ref()?;
        Some(&renaming.temporary_path)
    }

    /// An error of writing this file, in the user's words.
    pub(crate) fn error(&self, error: io::Error) -> OutputError {
        OutputError::io(&self.asked_path, "write", error)
    }

    /// Puts the finished file in its place, over an older one of that name.
    pub(crate) fn commit(mut self) -> Result<(), OutputError> {
        let mut writer = self.writer.take().expect("taken only here and in drop");
        writer.flush().map_err(|error| self.error(error))?;
        // Closed before it is renamed: some systems do not rename an open file.
        drop(writer);
        if let Some(renaming) = &self.renaming {
            if let Some(permissions) = renaming.permissions.clone() {
                // Some file systems have none; the file is as good without.
                let _ = fs::set_permissions(&renaming.temporary_path, permissions);
            }
            fs::rename(&renaming.temporary_path, &renaming.final_path)
                .map_err(|error| self.error(error))?;
        }
        // In place: there is nothing left for drop to remove.
        self.renaming = None;
        Ok(())
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.writer {
            Some(writer) => writer.write(bytes),
            None => Err(ErrorKind::BrokenPipe.into()),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let Some(writer) = self.writer.take() {
            // What is still in the buffer is not wanted any more.
            drop(writer.into_parts());
        }
        if let Some(renaming) = &self.renaming {
            // Nothing better can be done about a hidden file that will not go.
            let _ = fs::remove_file(&renaming.temporary_path);
        }
    }
}

/// Finds out before a long run, rather than after it, whether a file can be written.
pub(crate) fn probe(path: &Path) -> Result<(), OutputError> {
    // Who reads a pipe would take this for its end.
    let is_special = fs::metadata(path).is_ok_and(|it| !it.is_file() && !it.is_dir());
    if is_special {
        return Ok(());
    }
    AtomicFile::create(path).map(drop)
}

/// Creates a folder with all that are missing above it; no error where it exists.
pub(crate) fn create_folder(folder: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(folder).map_err(|error| OutputError::io(folder, "create the folder", error))
}

/// The place that links lead to from here, where there need not be anything; `path` itself if it is no link.
fn end_of_links(path: &Path) -> Result<PathBuf, OutputError> {
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

fn parent_folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// A number that this process has drawn by lot, and puts into the names of its hidden files. Numbers of processes would
/// not do: they are given again, and machines that share a folder each have their own.
pub(crate) fn token() -> u64 {
    static TOKEN: OnceLock<u64> = OnceLock::new();
    *TOKEN.get_or_init(|| RandomState::new().hash_one((SystemTime::now(), std::process::id())))
}

/// How the names of all hidden files begin that a process with this token makes.
pub(crate) fn hidden_prefix(token: u64) -> String {
    format!(".motes-{token:016x}-")
}

fn create_hidden(folder: &Path) -> io::Result<(PathBuf, File)> {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let prefix = hidden_prefix(token());
    loop {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!("{prefix}{number}"));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            // Whoever has made it: take the next name.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            result => return result.map(|file| (path, file)),
        }
    }
}
