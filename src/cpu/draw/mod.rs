//! Stages of drawing.

pub mod boid_shapes;
pub mod cover;
pub mod planet;
pub mod resolve;
pub mod shapes;
pub mod splat;
