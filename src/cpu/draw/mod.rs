//! Stages of drawing.

pub mod boid_shapes;
pub mod boid_trails;
pub mod cover;
pub mod flame_discs;
pub mod front_lines;
pub mod glow;
pub mod ground;
pub mod marks;
pub mod planet;
pub mod resolve;
pub mod shade;
pub mod shapes;
pub mod smoke;
pub mod splat;
pub mod strip_joints;
pub mod strips;
pub mod strokes;
pub mod surface;
pub mod surface_raster;
