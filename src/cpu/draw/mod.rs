//! Stages of drawing.

pub mod cover;
pub mod resolve;
pub mod shapes;
pub mod splat;
