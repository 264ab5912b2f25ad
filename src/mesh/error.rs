//! Why a mesh was refused.

use super::{ENDINGS, MOST_BYTES};

/// What is wrong with a mesh file, where, and what would be right. It does not name the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshError {
    /// What is wrong, as a clause without a full stop.
    pub what: String,
    /// Line of the file, from 1; `None` where the format has no lines, or none is at fault.
    pub line: Option<usize>,
    /// What would be right.
    pub help: String,
}

impl MeshError {
    /// Of the whole file.
    pub(crate) fn new(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            line: None,
            help: help.into(),
        }
    }

    /// Of that line; 0 is none.
    pub(super) fn at(self, line: usize) -> Self {
        Self {
            line: (line > 0).then_some(line),
            ..self
        }
    }

    pub(crate) fn too_long() -> Self {
        let most = MOST_BYTES >> 20;
        Self::new(
            format!("the file is larger than {most} MiB"),
            "a mesh with fewer triangles, or in a binary format",
        )
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
            write!(f, "line {line}: ")?;
        }
        write!(f, "{}; {}", self.what, self.help)
    }
}

impl std::error::Error for MeshError {}
