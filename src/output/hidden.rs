//! Hidden files: what is being written, until it is renamed to its place.
//!
//! A name is `.motes-TOKEN-NUMBER-TARGET`: whose it is ([`token`]), the how manieth, and what it shall be, as a hash of
//! that file's name. Who writes one holds its lock, so that one whose process was killed is known by its being free.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::hash::{BuildHasher as _, RandomState};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError, TryLockError as Busy};
use std::time::{Duration, SystemTime};

/// How the names of all hidden files begin.
const PREFIX: &str = ".motes-";

/// What [`remove_own`] waits for a file to be created, at most.
const PATIENCE: Duration = Duration::from_millis(500);

/// Those of this process that stand on the disk.
static OWN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// A number that this process has drawn by lot, and puts into the names of its hidden files. Numbers of processes would
/// not do: they are given again, and machines that share a folder each have their own.
pub(crate) fn token() -> u64 {
    static TOKEN: OnceLock<u64> = OnceLock::new();
    *TOKEN.get_or_init(|| RandomState::new().hash_one((SystemTime::now(), std::process::id())))
}

/// How the names of all hidden files begin that a process with this token makes.
pub(crate) fn hidden_prefix(token: u64) -> String {
    format!("{PREFIX}{token:016x}-")
}

/// How the names of all hidden files end that shall be files of this name.
fn suffix(name: &OsStr) -> String {
    // FNV-1a, the same in every version of the program.
    let bytes = name.as_encoded_bytes().iter();
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("-{hash:016x}")
}

fn own() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    OWN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A new hidden file in the folder, for a file `name` there; locked, where there are locks.
pub(super) fn create(folder: &Path, name: &OsStr) -> io::Result<(PathBuf, File)> {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let (prefix, suffix) = (hidden_prefix(token()), suffix(name));
    loop {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!("{prefix}{number}{suffix}"));
        let mut own = own();
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            // Who sweeps may have taken it for left behind before it was locked.
            Ok(file) if may_be_swept(&file, &path) => {}
            Ok(file) => {
                own.insert(path.clone());
                return Ok((path, file));
            }
            // Whoever has made it: take the next name.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

/// Locks it; whether that came too late.
fn may_be_swept(file: &File, path: &Path) -> bool {
    // Elsewhere locks keep out who shall write it, too.
    if !cfg!(unix) {
        return false;
    }
    match file.try_lock() {
        Ok(()) => !path.exists(),
        Err(TryLockError::WouldBlock) => true,
        // Some file systems know no locks, and nobody sweeps there.
        Err(TryLockError::Error(_)) => false,
    }
}

/// It has been renamed, or is not wanted any more.
pub(super) fn forget(path: &Path) {
    own().remove(path);
}

/// Removes what killed processes have left of a file `name` in the folder.
pub(super) fn sweep(folder: &Path, name: &OsStr) {
    if !cfg!(unix) {
        return;
    }
    let suffix = suffix(name);
    // A folder that cannot be read has nothing that could be removed.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let found = entry.file_name();
        let is_of_it = |it: &str| it.starts_with(PREFIX) && it.ends_with(&suffix);
        if !found.to_str().is_some_and(is_of_it) {
            continue;
        }
        let path = entry.path();
        let is_file = entry.file_type().is_ok_and(|it| it.is_file());
        // Locked until it is gone, or who has just made it would go on to write it.
        if let Some(file) = is_file.then(|| File::open(&path).ok()).flatten()
            && file.try_lock().is_ok()
        {
            // It is hidden and of no use; that it stays harms nothing.
            let _ = fs::remove_file(&path);
        }
    }
}

/// Removes all hidden files of this process, which must end right after: no more can be made.
pub(crate) fn remove_own() {
    let end = std::time::Instant::now() + PATIENCE;
    let own = loop {
        match OWN.try_lock() {
            Ok(own) => break own,
            Err(Busy::Poisoned(own)) => break own.into_inner(),
            Err(Busy::WouldBlock) if std::time::Instant::now() < end => {
                std::thread::sleep(Duration::from_millis(1));
            }
            Err(Busy::WouldBlock) => return,
        }
    };
    for path in own.iter() {
        let _ = fs::remove_file(path);
    }
    std::mem::forget(own);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_holds_any_more_is_swept_and_nothing_else() {
        let folder = std::env::temp_dir().join(format!("motes-hidden-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("writable");
        let (gif, png) = (OsStr::new("a.gif"), OsStr::new("a.png"));
        let (left, file) = create(&folder, gif).expect("writable");
        drop(file);
        let (other, file) = create(&folder, png).expect("writable");
        drop(file);
        let (held, file) = create(&folder, gif).expect("writable");
        sweep(&folder, gif);
        let are_there = [&left, &other, &held].map(|path| path.exists());
        assert_eq!(are_there, [!cfg!(unix), true, true]);
        drop(file);
        for path in [left, other, held] {
            forget(&path);
        }
        fs::remove_dir_all(&folder).expect("removable");
    }
}
