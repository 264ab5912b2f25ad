//! What a run has finished, kept so that a stopped one can go on.
//!
//! A hidden folder beside the output holds `journal`, with a line for each finished frame, written
//! when all files of the frame stand in their places; for animations, the frames themselves; and
//! `state`, a snapshot, from time to time. It goes when the run is complete. A line that a killed
//! process has not ended is not believed, nor one whose files have changed since. The journal is
//! locked by whoever works on the run, and has the token of each that did: by it the hidden files
//! are known that a killed one has left.

mod finished;

use std::fmt::Write as _;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write as _};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::cli::CliError;
use crate::output::made::MadeFolders;
use crate::output::{
    AtomicFile, OutputError, OutputTarget, Rgba8Image, hidden_prefix, is_special, read_png, token,
    write_png,
};
use crate::simulation::Snapshot;
use finished::files_as_they_are;
pub(super) use finished::{Finished, digest_of};

/// The first line of a journal.
const FIRST_LINE: &str = "motes journal 2";

/// What a journal is called in its folder.
const NAME: &str = "journal";

/// Letters of an output's name that its journal is called by; of longer ones, the first few.
const MOST_LETTERS: usize = 48;
const SHOWN_LETTERS: usize = 24;

/// A journal being kept.
pub(super) struct Journal {
    folder: PathBuf,
    file: File,
    /// Whether this run began it and has put nothing into it that is worth keeping.
    is_empty: bool,
    /// What processes before this one may have left.
    leftovers: Leftovers,
    /// The folder of the outputs with those above it, if this run has made them: gone if nothing comes.
    _made: MadeFolders,
}

/// Hidden files that killed processes of a run had begun to write.
struct Leftovers {
    prefixes: Vec<String>,
    folders: Vec<PathBuf>,
}

/// The folder of the journal of such a run; `None` where the output is a device or a pipe.
pub(super) fn place(target: &OutputTarget, frames: &Range<u32>) -> Option<PathBuf> {
    let (folder, name) = target.folder_and_name();
    let path = folder.join(&name);
    let Range { start, end } = frames;
    // Names that are as long as they may be leave no room for more.
    let name = match name.chars().nth(MOST_LETTERS) {
        None => name,
        Some(_) => {
            let begin: String = name.chars().take(SHOWN_LETTERS).collect();
            format!("{begin}-{:016x}", digest_of(name.as_bytes()))
        }
    };
    (!is_special(&path)).then(|| folder.join(format!(".{name}.{start}-{end}.resume")))
}

impl Journal {
    /// Opens and locks the journal in the folder, which is made if it is not there; what it says.
    fn open(folder: &Path) -> Result<(File, String, MadeFolders), CliError> {
        let path = folder.join(NAME);
        let failed = |attempt: &str, error| OutputError::io(&path, attempt, error);
        let made = MadeFolders::make(folder)
            .map_err(|e| OutputError::io(folder, "keep a journal in the folder", e))?;
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .map_err(|e| failed("open", e))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(CliError::usage(
                    format!("another process is at work on this ({})", folder.display()),
                    "wait for it or stop it, or render to another place",
                ));
            }
            // Some file systems know no locks: then the user sees to it.
            Err(TryLockError::Error(_)) => {}
        }
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(|e| failed("read", e))?;
        Ok((file, String::from_utf8_lossy(&text).into_owned(), made))
    }

    /// Begins a journal, in place of any that there is.
    pub(super) fn begin(
        folder: &Path,
        identity: u64,
        outputs: &[PathBuf],
    ) -> Result<Self, CliError> {
        let (file, text, made) = Self::open(folder)?;
        let mut journal = Self {
            folder: folder.to_owned(),
            file,
            is_empty: true,
            leftovers: Leftovers::of(&Finished::of(&text), outputs, folder),
            _made: made,
        };
        journal.leftovers.sweep();
        journal.cut_off(0)?;
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            if entry.file_name() != NAME {
                // What stays is written over, or of no use.
                let _ = fs::remove_file(entry.path());
            }
        }
        journal.line(&format!("{FIRST_LINE}\nrender {identity:016x}"))?;
        journal.line(&format!("token {:016x}", token()))?;
        Ok(journal)
    }

    /// Removes the journal that a stopped run has left, if nobody is at work on it.
    pub(super) fn forget(folder: &Path) {
        let file = File::open(folder.join(NAME));
        if file.is_ok_and(|file| file.try_lock().is_ok()) {
            // It is hidden: that it stays harms nothing.
            let _ = fs::remove_dir_all(folder);
        }
    }

    /// Opens the journal that a stopped run has left; `None` where there is none.
    pub(super) fn resume(
        folder: &Path,
        identity: u64,
        outputs: &[PathBuf],
    ) -> Result<Option<(Self, Finished)>, CliError> {
        if !folder.join(NAME).is_file() {
            return Ok(None);
        }
        let (file, text, made) = Self::open(folder)?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let mut lines = text[..whole].lines();
        let head = (lines.next(), lines.next());
        if !matches!(head, (Some(_), Some(_))) {
            // Its beginning was not even written.
            drop(file);
            return Ok(None);
        }
        let expected = format!("render {identity:016x}");
        if head != (Some(FIRST_LINE), Some(expected.as_str())) {
            return Err(CliError::usage(
                format!(
                    "{} is of another run: its scene, size, seed, changes or outputs were not \
                     these, or it was made by another version",
                    folder.display()
                ),
                "repeat the command as it was, or leave out --resume to begin anew",
            ));
        }
        let finished = Finished::of(&text[..whole]);
        let mut journal = Self {
            folder: folder.to_owned(),
            file,
            is_empty: false,
            leftovers: Leftovers::of(&finished, outputs, folder),
            _made: made,
        };
        journal.leftovers.sweep();
        // What a killed process has begun is cut off, or the next line would be joined to it.
        journal.cut_off(whole as u64)?;
        journal.line(&format!("token {:016x}", token()))?;
        Ok(Some((journal, finished)))
    }

    fn cut_off(&mut self, len: u64) -> Result<(), CliError> {
        let cut = self.file.set_len(len);
        cut.and_then(|()| self.file.seek(SeekFrom::Start(len)))
            .map_err(|e| OutputError::io(&self.folder.join(NAME), "write", e))?;
        Ok(())
    }

    fn line(&mut self, line: &str) -> Result<(), CliError> {
        self.file
            .write_all(format!("{line}\n").as_bytes())
            .map_err(|e| OutputError::io(&self.folder.join(NAME), "write", e).into())
    }

    /// Notes that all files of a frame stand in their places.
    pub(super) fn frame_done(
        &mut self,
        frame: u32,
        files: &[PathBuf],
        rows: &[String],
    ) -> Result<(), CliError> {
        // One that cannot be read back is made again.
        let files = files_as_they_are(files).unwrap_or_else(|| "unread".into());
        let mut line = format!("frame {frame} {files}");
        for row in rows {
            // Writing to a text cannot fail.
            let _ = write!(line, "\t{row}");
        }
        self.is_empty = false;
        self.line(&line)
    }

    /// Whether there is anything to go on from.
    pub(super) fn is_empty(&self) -> bool {
        self.is_empty
    }

    /// Where a frame of an animation is kept.
    pub(super) fn kept_frame(&self, frame: u32) -> PathBuf {
        self.folder.join(format!("frame-{frame:04}.png"))
    }

    /// Keeps a frame of an animation.
    pub(super) fn keep_frame(&self, frame: u32, image: &Rgba8Image) -> Result<(), CliError> {
        Ok(write_png(&self.kept_frame(frame), image)?)
    }

    /// A frame that was kept; `None` where it is not there, or damaged.
    pub(super) fn kept(&self, frame: u32) -> Option<Rgba8Image> {
        read_png(&self.kept_frame(frame)).ok()
    }

    /// Keeps the state, and how many births have been dropped up to it.
    pub(super) fn keep_state(&mut self, snapshot: &Snapshot, dropped: u64) -> Result<(), CliError> {
        let mut file = AtomicFile::create(&self.folder.join("state"))?;
        file.write_all(&dropped.to_le_bytes())
            .and_then(|()| snapshot.write_to(&mut file))
            .map_err(|error| file.error(error))?;
        file.commit()?;
        self.is_empty = false;
        Ok(())
    }

    /// The state that was kept last; `None` where there is none, or it is damaged.
    pub(super) fn state(&self) -> Option<(Snapshot, u64)> {
        let bytes = fs::read(self.folder.join("state")).ok()?;
        let (dropped, snapshot) = bytes.split_first_chunk()?;
        let snapshot = Snapshot::from_bytes(snapshot).ok()?;
        Some((snapshot, u64::from_le_bytes(*dropped)))
    }

    /// The run is complete: nothing is left to go on from.
    pub(super) fn remove(mut self) {
        self.is_empty = true;
        // What a killed process had started may have begun a file after it was swept.
        self.leftovers.sweep();
    }
}

impl Drop for Journal {
    fn drop(&mut self) {
        if self.is_empty {
            // It is hidden, and a later run that finds it begins anew: that it stays harms nothing.
            let _ = fs::remove_dir_all(&self.folder);
        }
    }
}

impl Leftovers {
    /// Those of the processes that worked on the run before, all over now: who works on it holds the
    /// journal's lock.
    fn of(finished: &Finished, outputs: &[PathBuf], journal: &Path) -> Self {
        let tokens = finished.tokens.iter().copied();
        let folders = outputs.iter().map(PathBuf::as_path).chain([journal]);
        Self {
            prefixes: tokens.map(hidden_prefix).collect(),
            folders: folders.map(Path::to_owned).collect(),
        }
    }

    fn sweep(&self) {
        if self.prefixes.is_empty() {
            return;
        }
        for folder in &self.folders {
            let folder = match folder.as_os_str().is_empty() {
                true => Path::new("."),
                false => folder,
            };
            // A folder that cannot be read has nothing that could be removed.
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                let name = entry.file_name();
                let is_theirs = |prefix: &String| {
                    name.to_str()
                        .is_some_and(|name| name.starts_with(prefix.as_str()))
                };
                if self.prefixes.iter().any(is_theirs) {
                    // It is hidden and of no use; that it stays harms nothing.
                    let _ = fs::remove_file(entry.path());
                }
            }
        }
    }
}
