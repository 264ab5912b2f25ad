//! A file that appears whole or not at all.
//!
//! Bytes go to a hidden file (`hidden.rs`) in the same folder (so that renaming stays on one file system);
//! [`AtomicFile::commit`] renames it to its place, and dropping it without that removes it. A killed process leaves at
//! most the hidden file, which the next run to the same place removes.

use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::made::MadeFolders;
use super::special::{end_of_links, is_special, parent_folder, special};
use super::{OutputError, hidden};

/// Bytes kept back before they are written to the file.
const BUFFER_BYTES: usize = 1 << 16;

/// A file being written. See the module's documentation.
pub(crate) struct AtomicFile {
    /// None only while the value is being taken apart.
    writer: Option<BufWriter<File>>,
    /// As the user wrote it, for messages.
    asked_path: PathBuf,
    /// The hidden file and the place it goes to; None where the path is no plain file (`special.rs`), and is written directly.
    renaming: Option<Renaming>,
}

struct Renaming {
    temporary_path: PathBuf,
    final_path: PathBuf,
    /// Those of the file that is replaced.
    permissions: Option<Permissions>,
    /// Gone if the file does not come.
    _made: MadeFolders,
}

impl AtomicFile {
    /// Starts a file that shall stand at `path`; folders that are missing above it are created.
    ///
    /// A symbolic link is followed, to where there is nothing yet, too, and what is no plain file (`/dev/stdout`) is
    /// written as it is: renaming would replace it. A file that is replaced hands on its permissions, where that can be.
    pub(crate) fn create(path: &Path) -> Result<Self, OutputError> {
        let asked_path = path.to_owned();
        if let Some(special) = special(path) {
            let opened = special.open(path);
            let file = opened.map_err(|error| OutputError::io(path, "open", error))?;
            return Ok(Self {
                writer: Some(BufWriter::with_capacity(BUFFER_BYTES, file)),
                asked_path,
                renaming: None,
            });
        }
        let mut permissions = None;
        let final_path = match fs::metadata(path) {
            Ok(metadata) if metadata.is_dir() => {
                return Err(OutputError::io(
                    path,
                    "write",
                    ErrorKind::IsADirectory.into(),
                ));
            }
            Ok(metadata) => {
                permissions = Some(metadata.permissions());
                fs::canonicalize(path).map_err(|error| OutputError::io(path, "write", error))?
            }
            // Not there yet, or out of reach: creating the hidden file will tell.
            Err(_) => end_of_links(path)?,
        };
        let folder = parent_folder(&final_path);
        let made = MadeFolders::make(folder).map_err(|error| {
            let attempt = format!("create the folder {}", folder.display());
            OutputError::io(path, &attempt, error)
        })?;
        let name = final_path.file_name().unwrap_or_default();
        let (temporary_path, file) = hidden::create(folder, name).map_err(|error| {
            let attempt = format!("create a file in {}", folder.display());
            OutputError::io(path, &attempt, error)
        })?;
        Ok(Self {
            writer: Some(BufWriter::with_capacity(BUFFER_BYTES, file)),
            asked_path,
            renaming: Some(Renaming {
                temporary_path,
                final_path,
                permissions,
                _made: made,
            }),
        })
    }

    /// As [`AtomicFile::create`], for what is written once in a run; removes what killed ones have left of it.
    pub(crate) fn begin(path: &Path) -> Result<Self, OutputError> {
        let file = Self::create(path)?;
        if let Some(Renaming { final_path, .. }) = &file.renaming {
            let name = final_path.file_name().unwrap_or_default();
            hidden::sweep(parent_folder(final_path), name);
        }
        Ok(file)
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
        // Held until it is renamed, or it would pass for left behind; but some systems rename no open file.
        let held = cfg!(unix).then_some(writer);
        if let Some(renaming) = &self.renaming {
            if let Some(permissions) = renaming.permissions.clone() {
                // Some file systems have none; the file is as good without.
                let _ = fs::set_permissions(&renaming.temporary_path, permissions);
            }
            fs::rename(&renaming.temporary_path, &renaming.final_path)
                .map_err(|error| self.error(error))?;
            hidden::forget(&renaming.temporary_path);
        }
        drop(held);
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
            hidden::forget(&renaming.temporary_path);
        }
    }
}

/// Finds out before a long run, rather than after it, whether a file can be written.
pub(crate) fn probe(path: &Path) -> Result<(), OutputError> {
    // Who reads a pipe would take this for its end.
    if is_special(path) {
        return Ok(());
    }
    AtomicFile::begin(path).map(drop)
}
