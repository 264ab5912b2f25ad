//! What surfaces that flames light add to the shared structs (Perry 1994, 3.2.4).

use bytemuck::{Pod, Zeroable};

use crate::exact::shared_constants;

shared_constants! {
    /// Point lights of all flames, at most.
    pub const FLAME_LIGHTS: u32 = 64;
    /// Corners of cells along each side of the cube in which particles are gathered to point lights.
    pub const CLUSTERS_ACROSS: u32 = 8;
    /// All of them: point lights of particles, at most.
    pub const CLUSTER_LIGHTS: u32 = 512;
    /// [`FireFrame::lights`](super::FireFrame::lights) are of so many steps a whole weight; so are what
    /// particles give.
    pub const LIGHT_WEIGHT_STEPS: f32 = 1_073_741_824.0;
}

/// A plane behind everything, as one frame sees it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Ground {
    /// Its unit normal; how far the eye is above it.
    pub plane: [f32; 4],
    /// The eye, world space; w unused.
    pub eye: [f32; 4],
    /// The point that it is seen around, world space; inverse squared radius of what is seen, 0
    /// where there is no plane.
    pub middle: [f32; 4],
    /// The part of the light that it reflects; contrast.
    pub color: [f32; 4],
    /// Where the light comes from, world space; noise cells a world unit.
    pub light_from: [f32; 4],
    /// Its colour; w unused.
    pub light_color: [f32; 4],
    /// Light from everywhere; w unused.
    pub ambient: [f32; 4],
    /// What the places of lamps are counted from, world space; w unused.
    pub lamps_from: [f32; 4],
    /// Octaves of the noise, its key, lamps, lights of flames.
    pub kinds: [u32; 4],
    /// Pillars; the others unused.
    pub counts: [u32; 4],
}

/// An upright cylinder before the ground.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Pillar {
    /// The middle of its foot, world space; radius.
    pub place: [f32; 4],
    /// Height of its top, world space; translucence; inverse squared depth of that; inverse radius.
    pub extent: [f32; 4],
    /// The part of the light that it reflects; w unused.
    pub color: [f32; 4],
}

/// A point light that stands for flames, or for particles.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct FlameLight {
    /// Where it is, world space, as bits; the square of its extent, as bits.
    pub place: [u32; 4],
    /// What it makes of white a unit away, as bits; w unused.
    pub color: [u32; 4],
}
