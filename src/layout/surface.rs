//! What surfaces of triangles add to the shared structs.

use bytemuck::{Pod, Zeroable};

/// A mesh somewhere, as one frame sees it. The transform is rows of a 3 × 4 matrix.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SurfaceFrame {
    /// From the mesh's coordinates to world space: first row.
    pub world_from_mesh_x: [f32; 4],
    /// Second row.
    pub world_from_mesh_y: [f32; 4],
    /// Third row.
    pub world_from_mesh_z: [f32; 4],
    /// The part of the light that it reflects; w unused.
    pub color: [f32; 4],
    /// First triangle among those stored, how many, and the first's number among those of all
    /// surfaces; w unused.
    pub faces: [u32; 4],
    /// Unit direction of the grain, the mesh's space; its periods a unit of the mesh.
    pub grain: [f32; 4],
    /// What it takes away of the colour at most, as a share; how far noise shifts it, periods; cells of
    /// that noise a unit of the mesh; unused.
    pub grain_shape: [f32; 4],
    /// Kind of grain (`GRAIN_` constants) and its noise's key; the others unused.
    pub grain_kind: [u32; 4],
}

/// What falls on surfaces, and what hides them.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SurfaceLight {
    /// The eye, world space; w unused.
    pub eye: [f32; 4],
    /// Where the light comes from, world space; w unused.
    pub light_from: [f32; 4],
    /// Its colour; w unused.
    pub light_color: [f32; 4],
    /// Light from everywhere; w unused.
    pub ambient: [f32; 4],
    /// What the places of lamps are counted from, world space; w unused.
    pub lamps_from: [f32; 4],
    /// From the eye to a planet's centre; squared distance of the centre less squared radius.
    pub planet: [f32; 4],
    /// [`Ground::plane`](super::Ground::plane).
    pub plane: [f32; 4],
    /// [`Ground::middle`](super::Ground::middle).
    pub middle: [f32; 4],
    /// Lamps, lights of flames, pillars, planets.
    pub kinds: [u32; 4],
    /// Surfaces; the others unused.
    pub counts: [u32; 4],
}
