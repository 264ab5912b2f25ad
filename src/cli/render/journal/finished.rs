//! What the whole lines of a journal say: the frames that a stopped run had finished.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

/// What a stopped run had finished.
#[derive(Default)]
pub(in crate::cli::render) struct Finished {
    /// By frame.
    frames: BTreeMap<u32, Done>,
    /// Tokens of the processes that worked on it, which their hidden files are named by.
    pub(super) tokens: Vec<u64>,
}

/// What is known of a finished frame.
struct Done {
    /// Length and digest of each of its files, in order.
    files: String,
    /// Its rows of statistics; none where none were asked for.
    rows: Vec<String>,
}

/// A number that tells texts apart: FNV-1a, the same in every version of the program.
pub(in crate::cli::render) fn digest_of(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// Lengths and digests of the files, as a line of the journal has them; `None` where one cannot be
/// read.
pub(super) fn files_as_they_are(files: &[PathBuf]) -> Option<String> {
    let of = |path: &PathBuf| {
        let bytes = fs::read(path).ok()?;
        Some(format!("{}:{:016x}", bytes.len(), digest_of(&bytes)))
    };
    let all: Option<Vec<String>> = files.iter().map(of).collect();
    Some(all?.join(" "))
}

impl Finished {
    /// What the whole lines of a journal say.
    pub(super) fn of(text: &str) -> Self {
        let mut finished = Self::default();
        for line in text.lines() {
            let mut parts = line.split('\t');
            let words = parts.next().and_then(|first| first.split_once(' '));
            match words {
                Some(("frame", about)) => {
                    let (number, files) = about.split_once(' ').unwrap_or((about, ""));
                    if let Ok(frame) = number.parse() {
                        let done = Done {
                            files: files.to_owned(),
                            rows: parts.map(str::to_owned).collect(),
                        };
                        finished.frames.insert(frame, done);
                    }
                }
                Some(("token", token)) => {
                    finished.tokens.extend(u64::from_str_radix(token, 16).ok());
                }
                _ => {}
            }
        }
        finished
    }

    /// Whether there is a run to go on with.
    pub(in crate::cli::render) fn is_resumed(&self) -> bool {
        !self.tokens.is_empty()
    }

    /// How many frames are finished.
    pub(in crate::cli::render) fn count(&self) -> usize {
        self.frames.len()
    }

    /// Whether a frame was finished, whatever has become of it.
    pub(in crate::cli::render) fn has(&self, frame: u32) -> bool {
        self.frames.contains_key(&frame)
    }

    /// The rows of a finished frame whose files are as they were; `None` for any other.
    pub(in crate::cli::render) fn rows(&self, frame: u32, files: &[PathBuf]) -> Option<&[String]> {
        let done = self.frames.get(&frame)?;
        (files_as_they_are(files)? == done.files).then_some(&done.rows)
    }
}
