//! What can go wrong with a window, or with the script that stands in for one.

use super::session::Told;
use crate::output::OutputError;

/// Why there is no window.
#[derive(Debug)]
pub enum WindowError {
    /// The scene, or what was done to it, is at fault.
    Scene(Told),
    /// A picture or a scene that was asked for cannot be written.
    Output(OutputError),
    /// There is no display, no adapter that shows on it, or it fails.
    Machine(Told),
}

impl std::fmt::Display for WindowError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Scene(told) | Self::Machine(told) => f.write_str(told),
            Self::Output(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for WindowError {}
