//! Stages of drawing.

pub mod boid_shapes;
pub mod cover;
pub mod resolve;
pub mod shapes;
pub mod splat;
