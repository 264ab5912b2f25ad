//! Meshes that are seen.

use std::sync::Arc;

use super::Grain;
use crate::mesh::Mesh;

/// A mesh that is lit, and hides what is behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct LitSurface {
    /// The triangles; both sides of each are seen.
    pub mesh: Arc<Mesh>,
    /// Where the mesh's origin is, world space. Default the origin.
    pub position: [f32; 3],
    /// Turns about x, then about y, degrees. Default 0.
    pub rotation_degrees: [f32; 2],
    /// World units a unit of the mesh's coordinates, 0 ..= 1,000. Default 1.
    pub scale: f32,
    /// The part of the light that it reflects, each 0 ..= 1. Default 0.3.
    pub color: [f32; 3],
    /// What makes it darker here and there, if anything does, in the mesh's coordinates times `scale`.
    pub grain: Option<Grain>,
    /// Triangles that meet at less than this angle look as one curved surface, 0 ..= 180 degrees.
    /// Default 40.
    pub crease_degrees: f32,
}
