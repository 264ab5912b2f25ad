//! Stages of drawing.

pub mod resolve;
pub mod splat;
