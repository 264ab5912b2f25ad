//! Every struct that Rust and WGSL share, once. `wgsl/lib/layout.wgsl` is the twin of this file,
//! and a test compares the two field by field (name, offset, size) through naga.

pub mod flame;
pub mod flock;
pub mod ground;
pub mod planet;
pub mod shade;
pub mod spread;
pub mod stroke;
pub mod surface;
pub mod tree;

use bytemuck::{Pod, Zeroable};

use crate::exact::shared_constants;

pub use flame::*;
pub use flock::*;
pub use ground::*;
pub use planet::*;
pub use shade::*;
pub use spread::*;
pub use stroke::*;
pub use surface::*;
pub use tree::*;

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
    /// Extents of the generation shape (half-extents where it is centred); w: inner radius of a
    /// ring, slope of a cone.
    pub shape: [f32; 4],
    /// Cosine of the ejection angle, the angle in turns; distance at which light is as the colour
    /// says, 0 when that is everywhere; half-width of the size's rate.
    pub ejection_and_light: [f32; 4],
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
    /// Half-widths of those rates.
    pub color_rate_var: [f32; 4],
    /// Generation shape, particle shape, what a stroke is like or, but for the lowest bit, which is how
    /// light is spread along a streak, the bits of the factor of what particles throw on surfaces; flags
    /// (the constants below).
    pub kinds: [u32; 4],
}

shared_constants! {
    /// [`SystemRow::kinds`]`[0]`: born in a ball.
    pub const SHAPE_SPHERE: u32 = 0;
    /// Born in a disc.
    pub const SHAPE_CIRCLE: u32 = 1;
    /// Born in a rectangle.
    pub const SHAPE_RECTANGLE: u32 = 2;
    /// Born between two circles.
    pub const SHAPE_RING: u32 = 3;
    /// Born in a box.
    pub const SHAPE_BOX: u32 = 4;
    /// Born in a cone with its apex at the origin.
    pub const SHAPE_CONE: u32 = 5;
    /// Born on a piece of the x axis.
    pub const SHAPE_LINE: u32 = 6;
    /// Born on a stored curve.
    pub const SHAPE_CURVE: u32 = 7;
    /// Born on the stored faces of a mesh.
    pub const SHAPE_MESH: u32 = 8;
    /// Of systems: on a ring that runs over a sphere.
    pub const SHAPE_RINGS: u32 = 9;
    /// [`SystemRow::kinds`]`[1]`: drawn as a disc.
    pub const PARTICLE_SPHERE: u32 = 0;
    /// Drawn as a square.
    pub const PARTICLE_RECTANGLE: u32 = 1;
    /// Drawn as a disc along its motion.
    pub const PARTICLE_STREAK: u32 = 2;
    /// Drawn as its whole trajectory.
    pub const PARTICLE_STROKE: u32 = 3;
    /// Lowest bit of [`SystemRow::kinds`]`[2]`: a streak's total light is that of the disc at rest.
    pub const STREAK_CONSERVED: u32 = 0;
    /// A streak's covered pixels get the full colour.
    pub const STREAK_CONSTANT: u32 = 1;
    /// Of a stroke: the most pieces that it is drawn of, in these bits.
    pub const STROKE_PIECES_MASK: u32 = 0xff;
    /// What its width loses to its end, in 4,095ths, above this bit.
    pub const STROKE_TAPER_SHIFT: u32 = 8;
    /// How dark its shadow is, in 4,095ths, above this bit.
    pub const STROKE_SHADOW_SHIFT: u32 = 20;
    /// Bits of those.
    pub const STROKE_SHARE_MASK: u32 = 0xfff;
    /// [`SystemRow::kinds`]`[3]`: the cone of ejection opens outward, not up.
    pub const ROW_OUTWARD: u32 = 1;
    /// It opens around the z axis.
    pub const ROW_AROUND: u32 = 2;
    /// Angles are uniform in it, not solid angles.
    pub const ROW_ANGLE_UNIFORM: u32 = 4;
    /// Intensity is luminance, not the brightest channel.
    pub const ROW_LUMINANCE: u32 = 8;
    /// Births are spread over the frame.
    pub const ROW_WITHIN_FRAME: u32 = 16;
    /// Particles cover what is behind them.
    pub const ROW_OVER: u32 = 32;
    /// They are shaded as spheres.
    pub const ROW_LIT_SPHERE: u32 = 64;
    /// They are parts of a cloud: lit as far as the light comes through the others.
    pub const ROW_LIT_CLOUD: u32 = 128;
    /// How soft their edge is stands above this bit, in 65,535ths.
    pub const ROW_SOFTNESS_SHIFT: u32 = 16;
    /// Word of `cover_counts`: records of something.
    pub const COVERS_SEEN: u32 = 0;
    /// Records of particles.
    pub const COVERS_OF_PARTICLES: u32 = 1;
    /// Records of boids.
    pub const COVERS_OF_BOIDS: u32 = 2;
    /// Records of places of dropped flames.
    pub const COVERS_OF_MARKS: u32 = 3;
    /// Records of fronts.
    pub const COVERS_OF_FRONTS: u32 = 4;
    /// Records of smoke.
    pub const COVERS_OF_SMOKE: u32 = 5;
    /// Records of strokes.
    pub const COVERS_OF_STROKES: u32 = 6;
    /// [`Cover::shape`]`[2]`: nothing is covered.
    pub const COVER_NONE: u32 = 0;
    /// A disc.
    pub const COVER_DISC: u32 = 1;
    /// A disc with an edge of its own width, smoothed.
    pub const COVER_SOFT_DISC: u32 = 2;
    /// A square along the axes.
    pub const COVER_SQUARE: u32 = 3;
    /// A segment of some width with round ends.
    pub const COVER_SEGMENT: u32 = 4;
    /// A triangle.
    pub const COVER_TRIANGLE: u32 = 5;
    /// A cone with a round base.
    pub const COVER_CONE: u32 = 6;
    /// A soft disc that is seen at a slant.
    pub const COVER_SLANTED: u32 = 7;
    /// A piece of a stroke.
    pub const COVER_STROKE: u32 = 8;
    /// [`Cover::lit`] of a piece of a stroke: nothing is cut off where it ends.
    pub const STROKE_UNCUT: f32 = 4.0;
    /// [`Cover::lit`]`[3]`: it is drawn where it is.
    pub const COVER_PLAIN: u32 = 0;
    /// It is drawn at the other side of the picture, mirrored.
    pub const COVER_MIRRORED: u32 = 1;
    /// It is drawn at both sides at once, which overlap.
    pub const COVER_TWIN: u32 = 2;
    /// [`SystemFrame::flags`]: births are floor(x + u) with u uniform, else floor(x + 1/2).
    pub const SYSTEM_STOCHASTIC: u32 = 1;
    /// Births are counted for each pixel of the screen area.
    pub const SYSTEM_PER_AREA: u32 = 2;
    /// Velocities are those halfway through a frame, so that particles are on parabolas.
    pub const SYSTEM_PARABOLIC: u32 = 4;
    /// What it bears are systems, not particles.
    pub const SYSTEM_BEARS_SYSTEMS: u32 = 8;
    /// Its particles stay where they are born, for what is seen of one is its whole trajectory.
    pub const SYSTEM_STILL: u32 = 16;
    /// [`Bound::kinds`]`[0]`: a plane.
    pub const BOUND_PLANE: u32 = 0;
    /// A sphere.
    pub const BOUND_SPHERE: u32 = 1;
    /// A box along the axes.
    pub const BOUND_BOX: u32 = 2;
    /// [`Wind::kinds`]`[0]`: the same everywhere.
    pub const WIND_UNIFORM: u32 = 0;
    /// Around an axis.
    pub const WIND_VORTEX: u32 = 1;
    /// Out of a point, or into it.
    pub const WIND_SOURCE: u32 = 2;
    /// Toward a point, from anywhere.
    pub const WIND_ATTRACTOR: u32 = 3;
    /// The gradient of a noise.
    pub const WIND_NOISE: u32 = 4;
    /// The product of two such gradients, which neither begins nor ends anywhere.
    pub const WIND_CURL: u32 = 5;
    /// [`Frame::flags`]: the view is orthographic.
    pub const FRAME_ORTHOGRAPHIC: u32 = 1;
    /// Late light counts more than early light.
    pub const FRAME_EYE: u32 = 2;
}

/// What the processor knows of one system in one frame. Transforms are rows of 3 × 4 matrices.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SystemFrame {
    /// From the space of its particles to world space: first row.
    pub world_from_system_x: [f32; 4],
    /// Second row.
    pub world_from_system_y: [f32; 4],
    /// Third row.
    pub world_from_system_z: [f32; 4],
    /// The same when the shutter closes: first row.
    pub closing_world_from_system_x: [f32; 4],
    /// Second row.
    pub closing_world_from_system_y: [f32; 4],
    /// Third row.
    pub closing_world_from_system_z: [f32; 4],
    /// From the space of the generation shape to that of its particles, a frame ago: first row.
    pub earlier_system_from_birth_x: [f32; 4],
    /// Second row.
    pub earlier_system_from_birth_y: [f32; 4],
    /// Third row.
    pub earlier_system_from_birth_z: [f32; 4],
    /// The same now: first row.
    pub system_from_birth_x: [f32; 4],
    /// Second row.
    pub system_from_birth_y: [f32; 4],
    /// Third row.
    pub system_from_birth_z: [f32; 4],
    /// Added to velocities each frame, in the system's space; the part of the velocity against the
    /// wind that drag takes each frame.
    pub acceleration: [f32; 4],
    /// Mean births in this frame, or for each pixel of the screen area.
    pub mean_parts: f32,
    /// Half-width of the births around their mean.
    pub var_parts: f32,
    /// The system's key: hash of the seed and of its name.
    pub key: u32,
    /// `SYSTEM_` constants.
    pub flags: u32,
    /// The sphere whose projection is the screen area: centre in world space, radius.
    pub bounding_sphere: [f32; 4],
    /// Where its bounds stand among all.
    pub first_bound: u32,
    /// How many they are.
    pub bound_count: u32,
    /// Births all at once in this frame, besides the others.
    pub burst_parts: f32,
    /// Their half-width.
    pub burst_var: f32,
}

/// Something that covers what is behind it, as it is seen: a family's `shapes` stage writes one for
/// each that it has (`wgsl/lib/shape.wgsl` makes them), in the order of their identities. Floats are
/// bits.
///
/// Families stand one after the other in `covers`: a family writes how many records it has into its
/// word of `cover_counts` (`COVERS_OF_` constants), begins behind those of the words before, and adds
/// how many of its records are of something to word 0. Of equal depth, what comes later is in front.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Cover {
    /// x and y in pixels of two points: a triangle's first two corners, the ends of a segment or of a piece
    /// of a stroke, the centre of
    /// a cone's base and its apex; a disc's or square's centre, then for shading the reciprocal of a
    /// disc's radius; of one seen at a slant, how much farther away it is a pixel to the right and down,
    /// in pixels.
    pub points: [u32; 4],
    /// A triangle's third corner. Of a disc or segment, how far it reaches from its centre or axis,
    /// pixels, and the reciprocal of its edge's width; of a square, half its width; of a cone, how far
    /// its base reaches, and how much its axis points to the viewer, -1 to 1; of a piece of a stroke, half
    /// its width at both ends. Then what it is (`COVER_` constants), and its depth along the view axis.
    pub shape: [u32; 4],
    /// Colour in red, green, blue, before exposure; alpha, 0 to 1.
    pub color: [u32; 4],
    /// What the light adds to the colour of a sphere where it falls straight; of a piece of a stroke, the
    /// directions that cut it off at both ends, as `wgsl/lib/cover.wgsl` has them; on which side of the
    /// picture it is drawn (`COVER_PLAIN` and what follows it).
    pub lit: [u32; 4],
}

/// What ends particles that come where they should not be, in world space (Reeves 1983, 2.4).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Bound {
    /// Plane: unit normal and distance along it. Sphere: centre and squared radius. Box: least corner.
    pub place: [f32; 4],
    /// Box: greatest corner.
    pub extent: [f32; 4],
    /// What it is (`BOUND_` constants); 1 if the outside kills, 0 if the inside does (of a plane,
    /// what the normal points from).
    pub kinds: [u32; 4],
}

/// One part of the wind, in world space and units a frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Wind {
    /// Kind (`WIND_` constants), octaves, key of the noise, and 1 if octaves count by their
    /// absolute value.
    pub kinds: [u32; 4],
    /// A place, and the radius of what is around it; of a curl, a weight for each axis.
    pub place: [f32; 4],
    /// A velocity or an axis, and a strength.
    pub aim: [f32; 4],
    /// Noise cells a world unit along each axis; the factor from an octave to the next.
    pub scale: [f32; 4],
    /// Where the noise has moved to, in cells; w unused.
    pub offset: [f32; 4],
}

/// What the processor knows of a whole frame. Transforms are rows of 3 × 4 matrices.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Frame {
    /// From world to view space: right.
    pub view_from_world_x: [f32; 4],
    /// Up.
    pub view_from_world_y: [f32; 4],
    /// Forward.
    pub view_from_world_z: [f32; 4],
    /// The same when the shutter closes: right.
    pub closing_view_from_world_x: [f32; 4],
    /// Up.
    pub closing_view_from_world_y: [f32; 4],
    /// Forward.
    pub closing_view_from_world_z: [f32; 4],
    /// Colour behind everything; w unused.
    pub background: [f32; 4],
    /// Where the light comes from, in view space (right, up, towards the viewer); w unused.
    pub light_from: [f32; 4],
    /// Its red, green, blue; w unused.
    pub light_color: [f32; 4],
    /// Red, green, blue of the light from everywhere; w unused.
    pub ambient_color: [f32; 4],
    /// The plane of the planet's outline: unit normal towards the eye, distance along it; what is
    /// beyond is behind the planet.
    pub planet_outline: [f32; 4],
    /// Pixels per unit of x/z, or of x if the view is orthographic.
    pub focal_px: f32,
    /// The same when the shutter closes.
    pub closing_focal_px: f32,
    /// Principal point, pixels from the left edge.
    pub center_x_px: f32,
    /// Principal point, pixels from the top edge.
    pub center_y_px: f32,
    /// Nearest drawn depth, world units.
    pub near: f32,
    /// Fraction of a frame that the shutter is open.
    pub shutter: f32,
    /// Factor of all light.
    pub exposure: f32,
    /// Frame number: from 0, or modulo 2^32 where a scene begins before.
    pub frame: u32,
    /// Slots of systems: those of the scene, then those that others bear.
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
    /// `FRAME_` constants.
    pub flags: u32,
    /// Parts of the wind.
    pub wind_count: u32,
    /// Planes that split the picture into layers.
    pub layer_plane_count: u32,
    /// The layer that is drawn, from 1; 0 for all.
    pub layer: u32,
    /// No particle dies of age before it has this many frames.
    pub least_lifetime: u32,
    /// Grid cells of all flocks.
    pub cell_count: u32,
    /// Systems of the scene itself: slots from here on are of systems that others bear.
    pub own_system_count: u32,
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
    /// Deaths for want of light.
    pub died_of_intensity: u32,
    /// Deaths out of bounds; the rest of `died` is of age.
    pub died_of_bounds: u32,
    /// Systems that others were to bear.
    pub systems_requested: u32,
    /// Systems that they bore; for the rest there was no slot.
    pub systems_born: u32,
    /// Systems whose lifetime was over.
    pub systems_died: u32,
    /// Systems born by others that live.
    pub systems_live: u32,
    /// Control points that were to be ignited or inserted.
    pub points_requested: u32,
    /// Those that were; for the rest there was no room.
    pub points_born: u32,
    /// Control points that came to rest.
    pub points_died: u32,
    /// Control points that move.
    pub points_live: u32,
    /// Flames that were to be dropped.
    pub flames_requested: u32,
    /// Those that were; for the rest there was no room.
    pub flames_born: u32,
    /// Dropped flames that have gone out.
    pub flames_died: u32,
    /// Dropped flames that have not.
    pub flames_live: u32,
    /// Marks that newer flames have taken the places of.
    pub marks_died: u32,
    /// Flames that have gone out and have their places yet.
    pub marks_live: u32,
}

impl FrameStats {
    /// What found no room: births, systems of systems, control points, flames.
    pub fn roomless(&self) -> [u32; 4] {
        [
            self.dropped,
            self.systems_requested.saturating_sub(self.systems_born),
            self.points_requested.saturating_sub(self.points_born),
            self.flames_requested.saturating_sub(self.flames_born),
        ]
    }
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
