//! Why nothing was measured.

use std::fmt;

use crate::backend::BackendError;
use crate::plan::PlanError;

/// Why nothing was measured.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BenchError {
    /// The scene cannot be planned, or not at that count: the input's fault.
    Plan(PlanError),
    /// The machine's fault.
    Backend(BackendError),
    /// The watch asked to stop.
    Stopped,
}

impl BenchError {
    /// Whether other input would help.
    pub fn is_users_fault(&self) -> bool {
        matches!(self, Self::Plan(_))
    }

    pub(super) fn input(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Plan(PlanError {
            message: message.into(),
            help: help.into(),
            key: None,
        })
    }
}

impl fmt::Display for BenchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Plan(error) => error.fmt(f),
            Self::Backend(error) => error.fmt(f),
            Self::Stopped => write!(f, "error: the measurement was stopped"),
        }
    }
}

impl std::error::Error for BenchError {}

impl From<BackendError> for BenchError {
    fn from(error: BackendError) -> Self {
        Self::Backend(error)
    }
}

impl From<PlanError> for BenchError {
    fn from(error: PlanError) -> Self {
        Self::Plan(error)
    }
}
