//! A folder of files that appears whole or not at all.
//!
//! It is filled under a hidden name beside its place and renamed when it is complete; dropping it
//! without that removes it.

use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::OutputError;
use super::atomic::AtomicFile;
use super::hidden::{hidden_prefix, token};
use super::made::MadeFolders;

/// Folders of one name that may stand beside each other.
const MOST_OF_A_NAME: u32 = 10_000;

/// A folder being filled. See the module's documentation.
pub(crate) struct AtomicFolder {
    hidden: PathBuf,
    parent: PathBuf,
    name: String,
    /// Those above it, gone if it does not come.
    _made: MadeFolders,
}

impl AtomicFolder {
    /// Starts a folder that shall stand in `parent` under `name`, which must be fit for a file name.
    /// Folders that are missing above it are created.
    pub(crate) fn create(parent: &Path, name: &str) -> Result<Self, OutputError> {
        let made = MadeFolders::make(parent)
            .map_err(|error| OutputError::io(parent, "create the folder", error))?;
        let prefix = hidden_prefix(token());
        for number in 0..MOST_OF_A_NAME {
            let hidden = parent.join(format!("{prefix}{name}-{number}"));
            match fs::create_dir(&hidden) {
                // Another of ours: take the next name.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(OutputError::io(parent, "create a folder here", error)),
                Ok(()) => {
                    return Ok(Self {
                        hidden,
                        parent: parent.to_owned(),
                        name: name.to_owned(),
                        _made: made,
                    });
                }
            }
        }
        Err(OutputError::io(
            parent,
            "create a folder here",
            ErrorKind::AlreadyExists.into(),
        ))
    }

    /// Writes the file `path` of the folder, `a/b.bin` in a folder of it.
    pub(crate) fn write(&self, path: &str, bytes: &[u8]) -> Result<(), OutputError> {
        write_whole(&self.hidden.join(path), bytes)
    }

    /// Puts the finished folder in its place; where one of its name stands there, `-2`, `-3`, … is
    /// put behind the name. The path that it has got.
    pub(crate) fn commit(self) -> Result<PathBuf, OutputError> {
        for number in 1..MOST_OF_A_NAME {
            let name = match number {
                1 => self.name.clone(),
                more => format!("{}-{more}", self.name),
            };
            let place = self.parent.join(name);
            // Renaming would replace an empty folder, and fails on a full one.
            if fs::symlink_metadata(&place).is_ok() {
                continue;
            }
            return match fs::rename(&self.hidden, &place) {
                Ok(()) => Ok(place),
                Err(error) => Err(OutputError::io(&place, "write", error)),
            };
        }
        Err(OutputError::io(
            &self.parent,
            "create a folder here",
            ErrorKind::AlreadyExists.into(),
        ))
    }
}

impl Drop for AtomicFolder {
    fn drop(&mut self) {
        // Gone when it has been put in its place; nothing better can be done when it will not go.
        let _ = fs::remove_dir_all(&self.hidden);
    }
}

/// Writes a file that appears whole or not at all.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let mut file = AtomicFile::create(path)?;
    file.write_all(bytes).map_err(|error| file.error(error))?;
    file.commit()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_appears_whole_under_a_free_name_or_not_at_all() {
        let parent = std::env::temp_dir().join(format!("motes-folder-{}", std::process::id()));
        let names = || -> Vec<_> {
            let mut names: Vec<_> = fs::read_dir(&parent)
                .expect("it is a folder")
                .map(|entry| {
                    entry
                        .expect("readable")
                        .file_name()
                        .into_string()
                        .expect("UTF-8")
                })
                .collect();
            names.sort();
            names
        };
        for expected in ["it", "it-2"] {
            let folder = AtomicFolder::create(&parent, "it").expect("writable");
            folder.write("a/b.bin", b"xy").expect("writable");
            assert!(
                !parent.join(expected).exists(),
                "it stands before it is complete"
            );
            let place = folder.commit().expect("writable");
            assert_eq!(place, parent.join(expected));
            assert_eq!(fs::read(place.join("a/b.bin")).expect("readable"), b"xy");
        }
        let given_up = AtomicFolder::create(&parent, "other").expect("writable");
        given_up.write("c.bin", b"z").expect("writable");
        drop(given_up);
        assert_eq!(names(), ["it", "it-2"]);
        fs::remove_dir_all(&parent).expect("removable");
    }
}
