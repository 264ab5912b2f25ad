//! Every struct that Rust and WGSL share, once. `wgsl/lib/layout.wgsl` is the twin of this file,
//! and a test compares the two field by field (name, offset, size) through naga.

use bytemuck::{Pod, Zeroable};

/// Who a particle is and where it is: 32 bytes, in its system's space.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Particle {
    /// x, y, z as bits of `f32`; index within the births of its system and frame.
    pub position_and_index: [u32; 4],
    /// Velocity a frame as bits of `f32`; system slot (high 16 bits), birth frame modulo 65,536.
    pub velocity_and_birth: [u32; 4],
}

impl Particle {
    /// Position in its system's space, world units.
    #[inline]
    pub fn position(&self) -> [f32; 3] {
        let [x, y, z, _] = self.position_and_index;
        [x, y, z].map(f32::from_bits)
    }

    /// Velocity in its system's space, world units a frame.
    #[inline]
    pub fn velocity(&self) -> [f32; 3] {
        let [x, y, z, _] = self.velocity_and_birth;
        [x, y, z].map(f32::from_bits)
    }

    /// Index among the births of its system in its birth frame.
    #[inline]
    pub fn index(&self) -> u32 {
        self.position_and_index[3]
    }

    /// Slot of its system.
    #[inline]
    pub fn slot(&self) -> u32 {
        self.velocity_and_birth[3] >> 16
    }

    /// Frames since its birth, as of `frame`: 0 in the frame that it is born in.
    #[inline]
    pub fn age(&self, frame: u32) -> u32 {
        frame.wrapping_sub(self.velocity_and_birth[3]) & 0xffff
    }
}

/// The parameters of one system at one birth frame; they rule its particles for life, so that
/// turning one of these knobs never changes what is already born. What acts on the living, place
/// and acceleration, is in [`SystemFrame`].
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SystemRow {
    /// Extents of the generation shape (half-extents for the rectangle); w: cosine of the ejection angle.
    pub shape: [f32; 4],
    /// Speed mean and half-width, lifetime mean and half-width.
    pub speed_and_lifetime: [f32; 4],
    /// Size mean, half-width and rate; w: intensity threshold, negative when there is none.
    pub size_and_threshold: [f32; 4],
    /// Means of red, green, blue and transparency.
    pub color_mean: [f32; 4],
    /// Half-widths of red, green, blue and transparency.
    pub color_var: [f32; 4],
    /// Rates a frame of red, green, blue and transparency.
    pub color_rate: [f32; 4],
    /// Generation shape, particle shape, streak light (the constants below), and one unused word.
    pub kinds: [u32; 4],
}

/// [`SystemRow::kinds`]`[0]`: born in a ball.
pub const SHAPE_SPHERE: u32 = 0;
/// [`SystemRow::kinds`]`[0]`: born in a disc.
pub const SHAPE_CIRCLE: u32 = 1;
/// [`SystemRow::kinds`]`[0]`: born in a rectangle.
pub const SHAPE_RECTANGLE: u32 = 2;
/// [`SystemRow::kinds`]`[1]`: drawn as a disc.
pub const PARTICLE_SPHERE: u32 = 0;
/// [`SystemRow::kinds`]`[1]`: drawn as a square.
pub const PARTICLE_RECTANGLE: u32 = 1;
/// [`SystemRow::kinds`]`[1]`: drawn as a disc along its motion.
pub const PARTICLE_STREAK: u32 = 2;
/// [`SystemRow::kinds`]`[2]`: a streak's total light is that of the disc at rest.
pub const STREAK_CONSERVED: u32 = 0;
/// [`SystemRow::kinds`]`[2]`: a streak's covered pixels get the full colour.
pub const STREAK_CONSTANT: u32 = 1;

/// What the processor knows of one system in one frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SystemFrame {
    /// First row of the 3 × 4 transform to world space.
    pub world_from_system_x: [f32; 4],
    /// Second row.
    pub world_from_system_y: [f32; 4],
    /// Third row.
    pub world_from_system_z: [f32; 4],
    /// Added to velocities each frame, in the system's space; w unused.
    pub acceleration: [f32; 4],
    /// Mean births in this frame.
    pub mean_parts: f32,
    /// Half-width of the births around their mean.
    pub var_parts: f32,
    /// The system's key: hash of the seed and of its name.
    pub key: u32,
    /// 1: births are floor(x + u) with u uniform; 0: floor(x + 1/2).
    pub stochastic_rounding: u32,
}

/// What the processor knows of a whole frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Frame {
    /// First row of the 3 × 4 transform to view space: right.
    pub view_from_world_x: [f32; 4],
    /// Second row: up.
    pub view_from_world_y: [f32; 4],
    /// Third row: forward.
    pub view_from_world_z: [f32; 4],
    /// Colour behind everything; w unused.
    pub background: [f32; 4],
    /// Pixels per unit of x/z.
    pub focal_px: f32,
    /// Principal point, pixels from the left edge.
    pub center_x_px: f32,
    /// Principal point, pixels from the top edge.
    pub center_y_px: f32,
    /// Nearest drawn depth, world units.
    pub near: f32,
    /// Fraction of a frame that the shutter is open.
    pub shutter: f32,
    /// Frame number, from 0.
    pub frame: u32,
    /// Systems in use.
    pub system_count: u32,
    /// Rows kept for each system, less one; their number is a power of two.
    pub row_mask: u32,
    /// Most particles alive at once.
    pub capacity: u32,
    /// Particles in a page of the pools, a multiple of 2,048.
    pub page_len: u32,
    /// Pages in a pool.
    pub page_count: u32,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Unused.
    pub spare_a: u32,
    /// Unused.
    pub spare_b: u32,
    /// Unused.
    pub spare_c: u32,
}

/// How many; one record, kept on the device from frame to frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Counts {
    /// Alive after the last advance.
    pub live: u32,
    /// Births asked for in this frame.
    pub requested: u32,
    /// Births done.
    pub born: u32,
    /// Births left out for want of room.
    pub dropped: u32,
    /// Alive before plus born: what the cull looks at.
    pub total: u32,
    /// Deaths.
    pub died: u32,
    /// Unused.
    pub spare_a: u32,
    /// Unused.
    pub spare_b: u32,
}

/// One frame's line of the statistics: `requested = born + dropped`,
/// `live(f) = live(f - 1) + born - died`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct FrameStats {
    /// Frame number.
    pub frame: u32,
    /// Births asked for.
    pub requested: u32,
    /// Births done.
    pub born: u32,
    /// Deaths.
    pub died: u32,
    /// Alive after the frame's step.
    pub live: u32,
    /// Births left out for want of room.
    pub dropped: u32,
    /// Unused.
    pub spare_a: u32,
    /// Unused.
    pub spare_b: u32,
}

/// The arguments of one indirect dispatch.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Dispatch {
    /// Workgroups along x.
    pub x: u32,
    /// Workgroups along y.
    pub y: u32,
    /// Workgroups along z.
    pub z: u32,
}
