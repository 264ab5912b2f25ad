//! What a run has finished, kept so that a stopped one can go on.
//!
//! A hidden folder beside the output holds `journal`, a line for each finished frame, written when
//! all files of the frame stand in their places; for animations, the frames themselves; and `state`,
//! a snapshot, from time to time. It goes when the run is complete. A line that a killed process has
//! not ended is not believed.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Write as _};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::cli::CliError;
use crate::output::{
    OutputError, OutputTarget, Rgba8Image, create_folder, read_png, write_png, write_whole,
};
use crate::simulation::Snapshot;

/// The first line of a journal.
const FIRST_LINE: &str = "motes journal 1";

/// A journal being kept.
pub(super) struct Journal {
    folder: PathBuf,
    file: File,
    /// Whether a frame is finished, so that there is something to go on from.
    has_frames: bool,
}

/// What a stopped run had finished.
#[derive(Default)]
pub(super) struct Finished {
    /// Rows of statistics by finished frame; none where none were asked for.
    pub(super) frames: BTreeMap<u32, Vec<String>>,
    /// Processes that worked on it.
    processes: Vec<u32>,
}

/// The folder of the journal of such a run; `None` where the output is a device or a pipe.
pub(super) fn place(target: &OutputTarget, frames: &Range<u32>) -> Option<PathBuf> {
    let (folder, name) = target.folder_and_name();
    let path = folder.join(&name);
    let is_special = fs::metadata(path).is_ok_and(|it| !it.is_file() && !it.is_dir());
    let Range { start, end } = frames;
    (!is_special).then(|| folder.join(format!(".{name}.{start}-{end}.resume")))
}

/// A number that tells runs apart by all that decides their files.
pub(super) fn identity(text: &str) -> u64 {
    // FNV-1a: the same in every version of the program and on every machine.
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

impl Journal {
    /// Begins a journal, in place of any that there is.
    pub(super) fn begin(folder: &Path, identity: u64) -> Result<Self, CliError> {
        if folder.exists() {
            fs::remove_dir_all(folder)
                .map_err(|e| OutputError::io(folder, "remove what an older run left", e))?;
        }
        if let Some(parent) = folder.parent().filter(|it| !it.as_os_str().is_empty()) {
            create_folder(parent)?;
        }
        let path = folder.join("journal");
        let head = format!("{FIRST_LINE}\nrender {identity:016x}\n");
        write_whole(&path, head.as_bytes())?;
        Self::go_on(folder)
    }

    /// Opens the journal that a stopped run has left; `None` where there is none.
    pub(super) fn resume(
        folder: &Path,
        identity: u64,
    ) -> Result<Option<(Self, Finished)>, CliError> {
        let path = folder.join("journal");
        let mut text = match fs::read_to_string(&path) {
            Ok(text) => text,
            // What stands in the way is told when the outputs are opened.
            Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
                return Ok(None);
            }
            Err(e) => return Err(OutputError::io(&path, "read", e).into()),
        };
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        text.truncate(whole);
        let mut lines = text.lines();
        let head = (lines.next(), lines.next());
        let expected = format!("render {identity:016x}");
        if head != (Some(FIRST_LINE), Some(expected.as_str())) {
            return Err(CliError::usage(
                format!(
                    "{} is of another run: its scene, size, seed, changes or outputs were not these",
                    folder.display()
                ),
                "repeat the command as it was, or leave out --resume to begin anew",
            ));
        }
        let mut finished = Finished::default();
        for line in lines {
            let mut parts = line.split('\t');
            match parts.next().and_then(|first| first.split_once(' ')) {
                Some(("frame", number)) => {
                    let rows = parts.map(str::to_owned).collect();
                    finished
                        .frames
                        .extend(number.parse().ok().map(|frame: u32| (frame, rows)));
                }
                Some(("process", number)) => finished.processes.extend(number.parse::<u32>().ok()),
                _ => {}
            }
        }
        // What a killed process has begun is cut off, or the next line would be joined to it.
        write_whole(&path, text.as_bytes())?;
        let mut journal = Self::go_on(folder)?;
        journal.has_frames = !finished.frames.is_empty();
        Ok(Some((journal, finished)))
    }

    fn go_on(folder: &Path) -> Result<Self, CliError> {
        let path = folder.join("journal");
        let file = OpenOptions::new()
            .append(true)
            .open(&path)
            .map_err(|e| OutputError::io(&path, "open", e))?;
        let mut journal = Self {
            folder: folder.to_owned(),
            file,
            has_frames: false,
        };
        journal.line(&format!("process {}", std::process::id()))?;
        Ok(journal)
    }

    fn line(&mut self, line: &str) -> Result<(), CliError> {
        let path = self.folder.join("journal");
        self.file
            .write_all(format!("{line}\n").as_bytes())
            .map_err(|e| OutputError::io(&path, "write", e).into())
    }

    /// Notes that all files of a frame stand in their places.
    pub(super) fn frame_done(&mut self, frame: u32, rows: &[String]) -> Result<(), CliError> {
        let line = rows.iter().fold(format!("frame {frame}"), |mut line, row| {
            // Writing to a text cannot fail.
            let _ = write!(line, "\t{row}");
            line
        });
        self.has_frames = true;
        self.line(&line)
    }

    /// Whether there is anything to go on from.
    pub(super) fn has_frames(&self) -> bool {
        self.has_frames
    }

    fn kept_frame(&self, frame: u32) -> PathBuf {
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
    pub(super) fn keep_state(&self, snapshot: &Snapshot, dropped: u64) -> Result<(), CliError> {
        let bytes = [&dropped.to_le_bytes()[..], &snapshot.to_bytes()].concat();
        Ok(write_whole(&self.folder.join("state"), &bytes)?)
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
        self.has_frames = false;
    }
}

impl Drop for Journal {
    fn drop(&mut self) {
        if !self.has_frames {
            // It is hidden, and a later run that finds it begins anew: that it stays harms nothing.
            let _ = fs::remove_dir_all(&self.folder);
        }
    }
}

impl Finished {
    /// Removes what the killed processes of this run had begun to write in these folders.
    pub(super) fn sweep<'a>(&self, folders: impl Iterator<Item = &'a Path>) {
        // Numbers of processes are given again.
        let is_over = |process: &&u32| {
            **process != std::process::id()
                && !Path::new("/proc").join(process.to_string()).exists()
        };
        let over: Vec<_> = self.processes.iter().filter(is_over).collect();
        for folder in folders {
            let folder = match folder.as_os_str().is_empty() {
                true => Path::new("."),
                false => folder,
            };
            // A folder that cannot be read has nothing that could be removed.
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                let name = entry.file_name();
                let is_theirs = |process: &&u32| {
                    let begun = format!(".motes-{process}-");
                    name.to_str().is_some_and(|name| name.starts_with(&begun))
                };
                if over.iter().any(is_theirs) {
                    // It is hidden and of no use; that it stays harms nothing.
                    let _ = fs::remove_file(entry.path());
                }
            }
        }
    }
}
