//! Folders made for something to come, gone again if it does not come.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Attempts while others, who have just found them empty, remove folders that are wanted.
const ATTEMPTS: u32 = 16;

/// Folders that were missing and have been made. Dropped, it removes those that are empty.
#[derive(Debug)]
pub(crate) struct MadeFolders {
    /// The innermost first.
    folders: Vec<PathBuf>,
}

impl MadeFolders {
    /// Makes a folder with all that are missing above it.
    pub(crate) fn make(folder: &Path) -> io::Result<Self> {
        let is_missing = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
        let missing = folder.ancestors().take_while(is_missing);
        let made = Self {
            folders: missing.map(Path::to_owned).collect(),
        };
        for _ in 1..ATTEMPTS {
            match fs::create_dir_all(folder) {
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                done => return done.map(|()| made),
            }
        }
        fs::create_dir_all(folder).map(|()| made)
    }
}

impl Drop for MadeFolders {
    fn drop(&mut self) {
        for folder in &self.folders {
            match fs::remove_dir(folder) {
                Err(error) if error.kind() != ErrorKind::NotFound => return,
                _ => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_empty_folders_of_its_own_are_removed() {
        let here = std::env::temp_dir().join(format!("motes-made-{}", std::process::id()));
        fs::create_dir_all(&here).expect("writable");
        let deep = here.join("a/b/c");
        let made = MadeFolders::make(&deep).expect("writable");
        assert!(deep.is_dir());
        drop(made);
        assert!(here.is_dir() && !here.join("a").exists());

        fs::create_dir(here.join("a")).expect("writable");
        let made = MadeFolders::make(&deep).expect("writable");
        fs::write(here.join("a/b/other"), "").expect("writable");
        drop(made);
        assert!(here.join("a/b/other").exists() && !deep.exists());

        fs::remove_dir_all(&here).expect("removable");
    }
}
