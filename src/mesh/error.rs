//! Why a mesh was refused.

use super::{ENDINGS, MOST_BYTES};

/// What is wrong with a mesh file, where, and what would be right. It does not name the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshError {
    /// What is wrong, as a clause without a full stop.
    pub what: String,
    /// Line of the file, from 1; `None` where the format has no lines, or none is at fault.
    pub line: Option<usize>,
    /// Byte of that line, from 1; `None` if the whole line is meant.
    pub column: Option<usize>,
    /// Where it is in a file without lines: `byte 120`, or keys of glTF's JSON, `accessors[3]`.
    pub within: Option<String>,
    /// What would be right.
    pub help: String,
    /// Whether memory is out, so that the file may be right.
    pub(crate) is_out_of_memory: bool,
}

impl MeshError {
    /// Of the whole file.
    pub fn new(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            line: None,
            column: None,
            within: None,
            help: help.into(),
            is_out_of_memory: false,
        }
    }

    /// Of that line, unless it has one; 0 is none.
    pub(super) fn at(self, line: usize) -> Self {
        Self {
            line: self.line.or((line > 0).then_some(line)),
            ..self
        }
    }

    /// Of that byte of a line, both from 1.
    pub(super) fn at_column(self, line: usize, column: usize) -> Self {
        Self {
            line: Some(line),
            column: Some(column),
            ..self
        }
    }

    /// Of that part of the file, unless it has a place already.
    pub(super) fn within(self, place: impl FnOnce() -> String) -> Self {
        match (self.line, &self.within) {
            (None, None) => Self {
                within: Some(place()),
                ..self
            },
            _ => self,
        }
    }

    /// Of that byte of the file, from 0, unless it has a place already.
    pub(super) fn at_byte(self, byte: usize) -> Self {
        self.within(|| format!("byte {byte}"))
    }

    pub(crate) fn too_long() -> Self {
        let most = MOST_BYTES >> 20;
        Self::new(
            format!("the file is larger than {most} MiB"),
            "a mesh with fewer triangles, or in a binary format",
        )
    }

    /// No memory is left for `count` of these.
    pub(crate) fn no_memory(count: u64, of_what: &str) -> Self {
        let what = format!("there is no memory for {count} {of_what}");
        Self {
            is_out_of_memory: true,
            ..Self::new(what, "a smaller mesh, or a machine with more memory")
        }
    }

    /// Whether there is memory for so many, of that many bytes each, with all that is made on the way:
    /// what runs out of it later, in the midst of something, ends the program.
    pub(crate) fn room_for(count: usize, bytes_each: usize, of_what: &str) -> Result<(), Self> {
        let room = Vec::<u8>::new().try_reserve_exact(count.saturating_mul(bytes_each));
        room.map_err(|_| Self::no_memory(count as u64, of_what))
    }

    pub(super) fn unknown_ending() -> Self {
        let endings: Vec<String> = ENDINGS.iter().map(|it| format!(".{it}")).collect();
        Self::new(
            "the name has no ending of a mesh file",
            format!("a mesh file ends in {}", endings.join(", ")),
        )
    }
}

impl std::fmt::Display for MeshError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}")?;
            if let Some(column) = self.column {
                write!(f, ", column {column}")?;
            }
            f.write_str(": ")?;
        }
        if let Some(place) = &self.within {
            write!(f, "{place}: ")?;
        }
        write!(f, "{}; {}", self.what, self.help)
    }
}

impl std::error::Error for MeshError {}
