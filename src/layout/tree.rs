//! What systems that bear systems add to the shared structs (Reeves 1983, 2.6).

use bytemuck::{Pod, Zeroable};

use crate::exact::shared_constants;

/// Where a system is, at three times. Transforms are rows of 3 × 4 matrices to world space.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Pose {
    /// Now: first row.
    pub now_x: [f32; 4],
    /// Second row.
    pub now_y: [f32; 4],
    /// Third row.
    pub now_z: [f32; 4],
    /// A frame ago: first row.
    pub earlier_x: [f32; 4],
    /// Second row.
    pub earlier_y: [f32; 4],
    /// Third row.
    pub earlier_z: [f32; 4],
    /// When the shutter closes: first row.
    pub closing_x: [f32; 4],
    /// Second row.
    pub closing_y: [f32; 4],
    /// Third row.
    pub closing_z: [f32; 4],
}

/// What the processor knows of systems that one of the scene's stands for: all that are born by its
/// parent. Of a system without a parent, what its own births are.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Brood {
    /// Slot of the scene's system that bears such systems, or `NO_SLOT`; steps from the root of the
    /// tree; `BROOD_` constants; slot of the system that stands for those that these bear, or
    /// `NO_SLOT`.
    pub ties: [u32; 4],
    /// First frame with births, and the first without again (`NO_SLOT`: never), both from its own
    /// birth; frames that its slot is needed after the last of them; frames from one ring to the next.
    pub spans: [u32; 4],
    /// Mean births: coefficients of a polynomial of the frames since the first.
    pub mean_parts: [f32; 4],
    /// Their half-width, likewise.
    pub var_parts: [f32; 4],
    /// Births all at once: mean, half-width, the frame from its own birth; w unused.
    pub burst: [f32; 4],
    /// Half-widths of what differs from one to the next: constant coefficients of the mean and of
    /// the half-width of births, and the factor of the generation shape; w unused.
    pub spread: [f32; 4],
    /// The sphere around the generation shape in the system's own space: centre, radius.
    pub bounding_sphere: [f32; 4],
    /// Added to velocities each frame; w: drag.
    pub acceleration: [f32; 4],
    /// Rings: radius of the sphere, world units a frame, systems a world unit; w: 1 / (2 pi radius).
    pub rings: [f32; 4],
}

/// A system that another one has borne. Floats are bits.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Node {
    /// Its key; the frame of its birth; slot of the scene's system that it is like; slot of its
    /// parent.
    pub who: [u32; 4],
    /// `NODE_` constant; frames that it bears; the frame in which its slot is free again; its index
    /// among its parent's births of the frame.
    pub spans: [u32; 4],
    /// Velocity a frame in the space of its parent's offspring; w unused.
    pub velocity: [u32; 4],
    /// Added to it each frame; w unused.
    pub acceleration: [u32; 4],
    /// Where it was born, in that space: first row of a 3 × 4 matrix.
    pub place_x: [u32; 4],
    /// Second row.
    pub place_y: [u32; 4],
    /// Third row.
    pub place_z: [u32; 4],
}

shared_constants! {
    /// No slot.
    pub const NO_SLOT: u32 = 0xffff_ffff;
    /// [`Node::spans`]`[0]`: nobody is there.
    pub const NODE_FREE: u32 = 0;
    /// It bears.
    pub const NODE_LIVES: u32 = 1;
    /// It bears no more, and what it has borne may still live.
    pub const NODE_LINGERS: u32 = 2;
    /// [`Brood::ties`]`[2]`: their up is where they would leave to as particles.
    pub const BROOD_OUTWARD: u32 = 1;
    /// What they bear stays behind in the world.
    pub const BROOD_WORLD_SPACE: u32 = 2;
    /// Their acceleration turns with them.
    pub const BROOD_OWN_ACCELERATION: u32 = 4;
    /// A mean that has shrunk to nothing makes no births.
    pub const BROOD_SHRINKS: u32 = 8;
    /// Births all at once.
    pub const BROOD_BURSTS: u32 = 16;
}
