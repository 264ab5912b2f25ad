//! What strokes add to the shared structs (Reeves 1983, 4.3).

use bytemuck::{Pod, Zeroable};

/// What falls on strokes, and what their shadows fall on.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct StrokeLight {
    /// What the places of lamps are counted from, world space; w unused.
    pub lamps_from: [f32; 4],
    /// The ground's unit normal, and its distance along that from the world's origin.
    pub ground: [f32; 4],
    /// The way that the shadow of a place goes for each unit that it is above the ground, world space,
    /// against its sign; w unused.
    pub shade_from: [f32; 4],
    /// What the ground sends back where no light comes straight; w unused.
    pub shade_color: [f32; 4],
    /// [`Ground::middle`](super::Ground::middle).
    pub middle: [f32; 4],
    /// Lamps; 1 if shadows fall on a ground; 1 if there is a ground; w unused.
    pub kinds: [u32; 4],
}
