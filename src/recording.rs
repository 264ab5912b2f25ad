//! Parameter changes while a scene runs, and checkpoints.
//!
//! Every stochastic decision is a hash of who a particle is, so a run is told completely by its
//! scene, its seed and the changes made on the way: that is all a checkpoint holds
//! (Reeves 1983, section 3, saved a table of random numbers instead of 750,000 particles).

use std::fmt::Write;

use crate::plan::{self, Turn};
use crate::scene::{Draft, Loader, Scene, SceneError, Set, shortened};

/// The last frame that a scene can have.
const MOST_FRAME: u32 = 1_000_000;

/// Changes of a recording at most: the whole scene is checked after each.
const MOST_CHANGES: usize = 100_000;

/// One change: from `frame` on, `set` holds, as `--set` has it: `path.to.key=value`.
///
/// Changes are equal that say the same, whatever lines they stand on.
#[derive(Clone, Debug)]
pub struct Change {
    /// First frame that it holds for.
    pub frame: u32,
    /// `path.to.key=value`.
    pub set: String,
    /// Line of the text that it was read from, from 1; 0 if it was not read.
    pub line: usize,
}

impl PartialEq for Change {
    fn eq(&self, other: &Self) -> bool {
        (self.frame, &self.set) == (other.frame, &other.set)
    }
}

impl Eq for Change {}

impl Change {
    /// Path of the key that it sets.
    pub fn key(&self) -> &str {
        self.set.split('=').next().unwrap_or_default().trim()
    }
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

/// A change that its scene refuses, and what the scene says to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RefusedChange {
    /// The change; its line is that of the recording's text.
    pub change: Change,
    /// A few lines, as of an error of the scene or its plan.
    pub message: String,
}

impl std::fmt::Display for RefusedChange {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for RefusedChange {}

impl Recording {
    /// Reads lines of `FRAME path.to.key=value`; empty lines and lines that begin with `#` say
    /// nothing. `file` is for messages.
    ///
    /// # Errors
    /// A line of another form, frames out of order, or more than 100,000 changes; with file and line.
    pub fn parse(text: &str, file: &str) -> Result<Self, RecordingError> {
        Self::parse_from(1, text, file)
    }

    /// As [`Recording::parse`], of a part of the file that begins at line `first_line`.
    fn parse_from(first_line: usize, text: &str, file: &str) -> Result<Self, RecordingError> {
        let mut changes: Vec<Change> = Vec::new();
        for (number, line) in (first_line..).zip(text.lines()) {
            // Some editors begin a text with a byte order mark.
            let line = line.trim_start_matches('\u{feff}').trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let wrong = |what: &str| RecordingError {
                message: format!("{file}:{number}: {what}: `{}`", shortened(line)),
            };
            let (frame, set) = line
                .split_once(char::is_whitespace)
                .ok_or_else(|| wrong("no change"))?;
            let frame = frame.parse().map_err(|_| wrong("no frame number"))?;
            if frame > MOST_FRAME {
                return Err(wrong("a frame after 1,000,000"));
            }
            if changes.last().is_some_and(|last| last.frame > frame) {
                return Err(wrong("a frame before the last line's"));
            }
            if !set.contains('=') {
                return Err(wrong("no `=`"));
            }
            if changes.len() == MOST_CHANGES {
                return Err(wrong("more than 100,000 changes"));
            }
            changes.push(Change {
                frame,
                set: set.trim().to_owned(),
                line: number,
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
    /// The first change that the scene refuses, or that alters what holds for a whole run.
    pub fn turns(&self, scene: &str, sets: &[String]) -> Result<Vec<Turn>, RefusedChange> {
        self.turns_with(Loader::default(), scene, sets)
    }

    /// As [`Recording::turns`], with scenes loaded so.
    ///
    /// # Errors
    /// As [`Recording::turns`].
    pub fn turns_with(
        &self,
        loader: Loader,
        scene: &str,
        sets: &[String],
    ) -> Result<Vec<Turn>, RefusedChange> {
        let sets: Vec<Set> = sets.iter().map(|set| Set::argument(set)).collect();
        let Some(first) = self.changes.first() else {
            return Ok(Vec::new());
        };
        let mut draft = loader.draft(scene, &sets).map_err(|error| RefusedChange {
            change: first.clone(),
            message: error.to_string(),
        })?;
        self.turns_on(&mut draft, ("", "changes"))
    }

    /// As [`Recording::turns`], of changes to a scene that is loaded and right; `text` is that of the
    /// file, which errors point into.
    pub(crate) fn turns_on(
        &self,
        draft: &mut Draft,
        (text, file): (&str, &str),
    ) -> Result<Vec<Turn>, RefusedChange> {
        let mut turns: Vec<Turn> = Vec::new();
        let Some(first) = self.changes.first() else {
            return Ok(turns);
        };
        let refused = |change: &Change, message: String| RefusedChange {
            change: change.clone(),
            message,
        };
        let place = |change: &Change| match change.line {
            0 => format!("{file}, frame {}", change.frame),
            line => format!("{file}:{line}"),
        };
        let of_scene = |change: &Change, error: SceneError| {
            let place = format!("error: {}: the scene refuses this change", place(change));
            let why = error.to_string();
            refused(
                change,
                match error.file() {
                    // It points at the change itself.
                    Some(named) if named == file => why,
                    _ => format!("{place}\n{}", why.trim_start_matches("error: ")),
                },
            )
        };
        let lines: Vec<&str> = text.lines().collect();
        let unchanged = draft.scene().map_err(|error| of_scene(first, error))?;
        for change in &self.changes {
            let set = change.set.trim();
            let written = format!("{} {set}", change.frame);
            let line = change.line.checked_sub(1).and_then(|at| lines.get(at));
            let line = line.map(|line| line.trim_start_matches('\u{feff}').trim_end());
            let line = line.filter(|line| line.ends_with(set)).unwrap_or(&written);
            let start = line.len() - set.len();
            draft
                .set(&Set::line(file, change.line, line, start))
                .map_err(|error| of_scene(change, error))?;
            let turn = Turn {
                frame: change.frame,
                scene: draft.scene().map_err(|error| of_scene(change, error))?,
            };
            if let Some(key) = without_effect(&unchanged, &turn.scene) {
                let place = place(change);
                let message = format!(
                    "error: {place}: `{key}` changes nothing in a run that is under way\n  = help: \
                     set it in the scene, or with --set"
                );
                return Err(refused(change, message));
            }
            let before = turns.iter().rev().find(|known| known.frame < turn.frame);
            let before = before.map_or(&unchanged, |known| &known.scene);
            let checked = plan::check_turn(&unchanged, &turn)
                .and_then(|()| plan::check_ignitions(before, (turn.frame, &turn.scene)));
            checked.map_err(|error| {
                let place = place(change);
                refused(
                    change,
                    format!(
                        "error: {place}: {}\n  = help: {}",
                        error.message, error.help
                    ),
                )
            })?;
            match turns.last_mut() {
                Some(last) if last.frame == turn.frame => *last = turn,
                _ => turns.push(turn),
            }
        }
        Ok(turns)
    }
}

/// A key that no frame is made of, and that is not as it was.
pub(crate) fn without_effect(unchanged: &Scene, turned: &Scene) -> Option<&'static str> {
    let keys = [
        ("title", unchanged.title != turned.title),
        ("description", unchanged.description != turned.description),
        ("frames", unchanged.frames != turned.frames),
        ("frame_rate", unchanged.frame_rate != turned.frame_rate),
        (
            "steady_particles",
            unchanged.steady_particles != turned.steady_particles,
        ),
    ];
    let changed = keys.into_iter().find(|(_, is_changed)| *is_changed);
    changed.map(|(key, _)| key)
}

impl Checkpoint {
    /// The lines `scene NAME`, `seed N` and `frame N`, then a line a change, as
    /// [`Recording::to_text`] has them.
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
                    message: format!("{file}:{at}: a checkpoint has `{name}…` here, not `{line}`"),
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
            recording: Recording::parse_from(4, lines.next().unwrap_or_default(), file)?,
        })
    }
}
