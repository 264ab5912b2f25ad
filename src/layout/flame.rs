//! What flames add to the shared structs.

use bytemuck::{Pod, Zeroable};

use crate::exact::shared_constants;

shared_constants! {
    /// Steps of a flame's trajectory: ages 0 to 24 (Perry 1994, 3.2.2).
    pub const FLAME_STEPS: u32 = 25;
    /// [`FireFrame::kinds`]`[0]`: no flames but those listed.
    pub const ROOTS_LISTED: u32 = 0;
    /// Evenly on a piece of the x axis.
    pub const ROOTS_LINE: u32 = 1;
    /// Evenly on a circle around the y axis.
    pub const ROOTS_CIRCLE: u32 = 2;
    /// Anywhere in a disc around the y axis.
    pub const ROOTS_DISC: u32 = 3;
    /// Anywhere on the stored faces of a mesh.
    pub const ROOTS_MESH: u32 = 4;
    /// [`FireFrame::kinds`]`[3]`: velocities are brought to length 1.
    pub const FIRE_NORMALISED: u32 = 1;
    /// [`FireFrame::kinds`]`[3]`: a strip is drawn along each flame, not its particles.
    pub const FIRE_STRIP: u32 = 2;
    /// [`ListedFlame::kinds`]`[1]`: it has a first frame of its own.
    pub const LISTED_FIRST_FRAME: u32 = 1;
}

/// A flame's root: 64 bytes, in world space. Its place among all flames is the fire's first and its
/// index.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Flame {
    /// x, y, z as bits of `f32`; slot of its fire.
    pub root_and_fire: [u32; 4],
    /// The unit vector that it leaves along, as bits; the frame that it is kindled in.
    pub normal_and_birth: [u32; 4],
    /// How far its root has moved in this frame, as bits; index within its fire.
    pub motion_and_index: [u32; 4],
    /// Height and width, world units, and brightness, as bits; 1 if it burns in this frame.
    pub look: [u32; 4],
}

impl Flame {
    /// World position of its root.
    #[inline]
    pub fn root(&self) -> [f32; 3] {
        let [x, y, z, _] = self.root_and_fire;
        [x, y, z].map(f32::from_bits)
    }

    /// The unit vector that it leaves along, world space.
    #[inline]
    pub fn normal(&self) -> [f32; 3] {
        let [x, y, z, _] = self.normal_and_birth;
        [x, y, z].map(f32::from_bits)
    }

    /// How far its root has moved in this frame, world units.
    #[inline]
    pub fn motion(&self) -> [f32; 3] {
        let [x, y, z, _] = self.motion_and_index;
        [x, y, z].map(f32::from_bits)
    }

    /// Slot of its fire.
    #[inline]
    pub fn fire(&self) -> u32 {
        self.root_and_fire[3]
    }

    /// Index within its fire.
    #[inline]
    pub fn index(&self) -> u32 {
        self.motion_and_index[3]
    }

    /// The frame that it is kindled in.
    #[inline]
    pub fn birth_frame(&self) -> i32 {
        self.normal_and_birth[3].cast_signed()
    }

    /// Whether it burns.
    #[inline]
    pub fn burns(&self) -> bool {
        self.look[3] == 1
    }
}

/// What the processor knows of one fire in one frame. Transforms are rows of 3 × 4 matrices.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct FireFrame {
    /// From the fire's space to world space: first row.
    pub world_from_fire_x: [f32; 4],
    /// Second row.
    pub world_from_fire_y: [f32; 4],
    /// Third row.
    pub world_from_fire_z: [f32; 4],
    /// The same a frame ago: first row.
    pub earlier_world_from_fire_x: [f32; 4],
    /// Second row.
    pub earlier_world_from_fire_y: [f32; 4],
    /// Third row.
    pub earlier_world_from_fire_z: [f32; 4],
    /// Extent of the roots: length, radius or scale; the inverse of their number; the others unused.
    pub roots: [f32; 4],
    /// Means and half-widths of height and width, world units.
    pub extents: [f32; 4],
    /// The unit vector against gravity; k_g.
    pub rise: [f32; 4],
    /// Where the noise has moved to, in cells; k_p.
    pub noise: [f32; 4],
    /// C times the number of steps; factor of the scene's wind; speed at first; length of a unit
    /// step as a share of the height.
    pub motion: [f32; 4],
    /// Brightness; C_noise times the number of steps; cells of that noise a world unit; w unused.
    pub look: [f32; 4],
    /// Opacity of the inner layer as a factor; the inverse of its radius; the others unused.
    pub inner: [f32; 4],
    /// Octaves of details; how far they stray as a share of the width; their opacity as a factor; w
    /// unused.
    pub details: [f32; 4],
    /// Of the matrix that each particle is multiplied by after it faces the viewer: the column that x is
    /// multiplied by, half-widths.
    pub matrix_x: [f32; 4],
    /// That of y.
    pub matrix_y: [f32; 4],
    /// Where it puts the centre; z, towards the viewer, is 0 in a particle, and has no column.
    pub matrix_center: [f32; 4],
    /// Of strips: half the noise cells across, cells a step along, contrast; how far noise changes
    /// the matrix.
    pub strip: [f32; 4],
    /// Colour with which char begins to glow; its opacity, 0 if none is left.
    pub char_look: [f32; 4],
    /// How wide it is, world units; how soft, 0 to 1; the inverse of the frames that it glows, and of those
    /// in which it appears.
    pub char_shape: [f32; 4],
    /// Colour of smoke; how much it hides at most, 0 if there is none.
    pub smoke_look: [f32; 4],
    /// How wide it is at first, world units; how many times as wide in the end, less 1; the inverse of the
    /// frames until it has vanished; how far it goes in a frame where the wind is 1, world units.
    pub smoke_shape: [f32; 4],
    /// What a weight of 1 throws on a white surface a world unit away; the square of a light's
    /// extent.
    pub light: [f32; 4],
    /// The inverse of the greatest weight of a flame; how far lights may be from the roots that they
    /// are counted from, and half the inverse of that; the inverse of the number of ages that make
    /// the place of a light.
    pub light_scale: [f32; 4],
    /// Kind of roots (`ROOTS_` constants), the fire's key, that of the noise, flags
    /// (`FIRE_` constants).
    pub kinds: [u32; 4],
    /// First flame and how many; first listed flame and how many.
    pub members: [u32; 4],
    /// First face of the mesh and how many; 1 if the places that its point lights' are counted from are
    /// told, 0 if they are those of flames; unused.
    pub faces: [u32; 4],
    /// The first frame; frames of kindling; frames that a flame burns, 0 for ever; frames of growth.
    pub times: [u32; 4],
    /// First point light and how many; first and last age that its place is made of.
    pub lights: [u32; 4],
}

/// A flame that is told by itself. Of its extents, those below 0 are the fire's.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ListedFlame {
    /// Root in the fire's space; height.
    pub position: [f32; 4],
    /// Unit vector that it leaves along, in the fire's space; width.
    pub normal: [f32; 4],
    /// Brightness; the others unused.
    pub look: [f32; 4],
    /// First frame; `LISTED_` constants; the others unused.
    pub kinds: [u32; 4],
}

/// What a fire's particles look like at one age.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct AgeLook {
    /// Red, green, blue and opacity of the centre.
    pub center: [f32; 4],
    /// The same of the rim.
    pub rim: [f32; 4],
    /// Scales of the half-width and of the half-height; the others unused.
    pub scale: [f32; 4],
}

/// One particle of a flame as it is seen: a radial polygon. Floats are bits.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct FlameDisc {
    /// Centre, pixels; reciprocals of its half-width and half-height in pixels.
    pub place: [u32; 4],
    /// Red, green, blue and opacity of the centre.
    pub center: [u32; 4],
    /// The same of the rim.
    pub rim: [u32; 4],
}

/// Where a strip along a flame bends: 32 bytes. Floats are bits.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct StripJoint {
    /// Place in pixels, the unit vector along the flame.
    pub place: [u32; 4],
    /// Half-width in pixels, factor of the opacity, 1 if it is seen, depth.
    pub extent: [u32; 4],
}
