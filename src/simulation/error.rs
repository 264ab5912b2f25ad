//! Why a simulation could not begin or go on.

use super::SnapshotError;
use crate::backend::BackendError;
use crate::gpu::TextureError;
use crate::plan::PlanError;

/// Why a simulation could not begin or go on.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SimulationError {
    /// The scene asks for what cannot be planned.
    Plan(PlanError),
    /// There is no adapter of that name.
    NoAdapter {
        /// What was asked for.
        wanted: String,
        /// What there is.
        available: Vec<String>,
    },
    /// A texture cannot take the picture.
    Texture(TextureError),
    /// The machine failed.
    Backend(BackendError),
    /// A snapshot cannot be gone on from.
    Snapshot(SnapshotError),
}

impl SimulationError {
    /// Whether the input is at fault and not the machine.
    pub fn is_users_fault(&self) -> bool {
        !matches!(self, Self::Backend(_))
    }
}

impl std::fmt::Display for SimulationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Plan(e) => e.fmt(f),
            Self::Texture(e) => e.fmt(f),
            Self::Backend(e) => e.fmt(f),
            Self::Snapshot(e) => write!(f, "error: {e}\n  = help: begin without it"),
            Self::NoAdapter { wanted, available } => write!(
                f,
                "error: no adapter's name or driver contains `{wanted}`\n  = help: adapters here: {}",
                available.join(", ")
            ),
        }
    }
}

impl std::error::Error for SimulationError {}

impl From<BackendError> for SimulationError {
    fn from(error: BackendError) -> Self {
        Self::Backend(error)
    }
}

impl From<PlanError> for SimulationError {
    fn from(error: PlanError) -> Self {
        Self::Plan(error)
    }
}

impl From<TextureError> for SimulationError {
    fn from(error: TextureError) -> Self {
        Self::Texture(error)
    }
}
