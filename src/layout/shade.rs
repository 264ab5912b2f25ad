//! What shadows that clouds throw on themselves add to the shared structs (Reeves 1983, 5).

use bytemuck::{Pod, Zeroable};

/// A box of cells along the light, as many each way.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShadeBox {
    /// From world space to cells across the light: a row of three, and an offset.
    pub across: [f32; 4],
    /// The same, across that.
    pub aside: [f32; 4],
    /// The same along the light, from where it comes.
    pub along: [f32; 4],
    /// The inverse of a cell's cross-section; the others unused.
    pub look: [f32; 4],
    /// Cells each way; the others unused.
    pub kinds: [u32; 4],
}
