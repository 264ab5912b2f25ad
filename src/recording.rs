//! Parameter changes while a scene runs, and checkpoints.
//!
//! Every stochastic decision is a hash of who a particle is, so a run is told completely by its
//! scene, its seed and the changes made on the way: that is all a checkpoint holds
//! (Reeves 1983, section 3, saved a table of random numbers instead of 750,000 particles).

use std::fmt::Write;

use crate::plan::Turn;
use crate::scene::{self, SceneError};

/// One change: from `frame` on, `set` holds, as `--set` has it: `path.to.key=value`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// First frame that it holds for.
    pub frame: u32,
    /// `path.to.key=value`.
    pub set: String,
}

/// Changes in the order of their frames.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Recording {
    /// The changes.
    pub changes: Vec<Change>,
}

/// Where a run stands: enough to go on with the same bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checkpoint {
    /// Name or path of the scene.
    pub scene: String,
    /// Its seed.
    pub seed: u64,
    /// The last frame stepped.
    pub frame: u32,
    /// What was changed on the way.
    pub recording: Recording,
}

/// What is wrong with the text of a recording or a checkpoint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordingError {
    /// What, and where.
    pub message: String,
}

impl std::fmt::Display for RecordingError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "error: {}\n  = help: a line is `FRAME path.to.key=value`, frames in order; `#` begins a comment",
            self.message
        )
    }
}

impl std::error::Error for RecordingError {}

impl Recording {
    /// Reads lines of `FRAME path.to.key=value`; empty lines and lines that begin with `#` say
    /// nothing. `file` is for messages.
    ///
    /// # Errors
    /// A line of another form, or frames out of order; with file and line.
    pub fn parse(text: &str, file: &str) -> Result<Self, RecordingError> {
        let mut changes: Vec<Change> = Vec::new();
        for (at, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let wrong = |what: &str| RecordingError {
                message: format!("{file}:{}: {what}: `{line}`", at + 1),
            };
            let (frame, set) = line
                .split_once(char::is_whitespace)
                .ok_or_else(|| wrong("no change"))?;
            let frame = frame.parse().map_err(|_| wrong("no frame number"))?;
            if changes.last().is_some_and(|last| last.frame > frame) {
                return Err(wrong("a frame before the last line's"));
            }
            if !set.contains('=') {
                return Err(wrong("no `=`"));
            }
            changes.push(Change {
                frame,
                set: set.trim().to_owned(),
            });
        }
        Ok(Self { changes })
    }

    /// The text that [`Recording::parse`] reads.
    pub fn to_text(&self) -> String {
        self.changes.iter().fold(String::new(), |mut text, change| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{} {}", change.frame, change.set);
            text
        })
    }

    /// The scene from each change on, on top of `sets`.
    ///
    /// # Errors
    /// A change that the scene refuses.
    pub fn turns(&self, scene: &str, sets: &[String]) -> Result<Vec<Turn>, SceneError> {
        let mut sets = sets.to_vec();
        let mut turns: Vec<Turn> = Vec::new();
        for change in &self.changes {
            sets.push(change.set.clone());
            let turn = Turn {
                frame: change.frame,
                scene: scene::load_with(scene, &sets)?,
            };
            match turns.last_mut() {
                Some(last) if last.frame == turn.frame => *last = turn,
                _ => turns.push(turn),
            }
        }
        Ok(turns)
    }
}

impl Checkpoint {
    /// A few lines of text: scene, seed and frame as comments' neighbours, then the changes.
    pub fn to_text(&self) -> String {
        format!(
            "scene {}\nseed {}\nframe {}\n{}",
            self.scene,
            self.seed,
            self.frame,
            self.recording.to_text()
        )
    }

    /// Reads what [`Checkpoint::to_text`] wrote. `file` is for messages.
    ///
    /// # Errors
    /// A missing or malformed line; with file and line.
    pub fn parse(text: &str, file: &str) -> Result<Self, RecordingError> {
        let mut lines = text.splitn(4, '\n');
        let mut field = |at: usize, name: &str| {
            let line = lines.next().unwrap_or_default();
            line.strip_prefix(name)
                .map(str::trim)
                .map(str::to_owned)
                .ok_or_else(|| RecordingError {
                    message: format!("{file}:{at}: a checkpoint has `{name} …` here, not `{line}`"),
                })
        };
        let (scene, seed, frame) = (field(1, "scene ")?, field(2, "seed ")?, field(3, "frame ")?);
        let number = |at: usize, text: &str| RecordingError {
            message: format!("{file}:{at}: `{text}` is not a whole number"),
        };
        Ok(Self {
            seed: seed.parse().map_err(|_| number(2, &seed))?,
            frame: frame.parse().map_err(|_| number(3, &frame))?,
            scene,
            recording: Recording::parse(lines.next().unwrap_or_default(), file)?,
        })
    }
}
