//! What fires that spread add to the shared structs.

use bytemuck::{Pod, Zeroable};

use crate::exact::shared_constants;

shared_constants! {
    /// [`SpreadPoint::course`]`[3]`: it moves.
    pub const POINT_MOVES: u32 = 0;
    /// It has come to a border and stays there.
    pub const POINT_ENDED: u32 = 1;
    /// It has met what has burnt and stays there.
    pub const POINT_BLOCKED: u32 = 2;
    /// It has crossed more edges in one step than are looked at, and stays there.
    pub const POINT_LOST: u32 = 3;
    /// No half-edge, no ring's place.
    pub const NO_EDGE: u32 = 0xffff_ffff;
    /// [`SpreadFrame::kinds`]`[1]`: headings are the front's normals.
    pub const SPREAD_NORMAL: u32 = 1;
    /// Points are inserted in the middle, not on an arc.
    pub const SPREAD_MIDPOINT: u32 = 2;
    /// Equation 3.4 to the letter, which does not move where it is flat.
    pub const SPREAD_LITERAL: u32 = 4;
    /// Edges do not matter.
    pub const SPREAD_FLAT: u32 = 8;
    /// Points are stopped where it has burnt.
    pub const SPREAD_BLOCKS: u32 = 16;
    /// What a point has come beyond d_d counts for the next flame, and it may drop several at once.
    pub const SPREAD_CARRIES: u32 = 32;
    /// Nothing burns: it runs downhill.
    pub const SPREAD_SPILL: u32 = 64;
    /// Nothing burns: it is soaked up, ever more slowly.
    pub const SPREAD_STAIN: u32 = 128;
    /// Kinds of grain: none, slabs across a direction, rings around it.
    pub const GRAIN_NONE: u32 = 0;
    /// Slabs.
    pub const GRAIN_STRIPES: u32 = 1;
    /// Rings.
    pub const GRAIN_RINGS: u32 = 2;
    /// Bit of `gap_flags`: a point is inserted after this one.
    pub const GAP_INSERTS: u32 = 1;
    /// The point moves.
    pub const GAP_MOVES: u32 = 2;
    /// The point came to rest in this frame.
    pub const GAP_CAME_TO_REST: u32 = 4;
    /// How far up the number of flames is that it drops.
    pub const GAP_DROPS_SHIFT: u32 = 8;
}

/// A control point of a front: 64 bytes. Points of a ring stand one after the other, counterclockwise,
/// what burns to their left; after the last comes the first.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct SpreadPoint {
    /// x and y in the frame of its face, as bits; the face among all stored; its ring.
    pub place: [u32; 4],
    /// Unit heading in the face's frame, as bits; its key; its state (`POINT_` constants).
    pub course: [u32; 4],
    /// How far it has come since it dropped a flame, and in all, world units, as bits; the frame in
    /// which it began; unused.
    pub path: [u32; 4],
    /// Where it is in its fire's space, as bits; slot of its spread.
    pub position: [u32; 4],
}

impl SpreadPoint {
    /// Where it is in its fire's space.
    #[inline]
    pub fn position(&self) -> [f32; 3] {
        let [x, y, z, _] = self.position;
        [x, y, z].map(f32::from_bits)
    }

    /// Its ring: the number of its ignition.
    #[inline]
    pub fn ring(&self) -> u32 {
        self.place[3]
    }

    /// Whether it moves.
    #[inline]
    pub fn moves(&self) -> bool {
        self.course[3] == POINT_MOVES
    }
}

/// What walks over faces: 48 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Walker {
    /// x and y in the frame of its face, as bits; the face; its state (`POINT_` constants).
    pub place: [u32; 4],
    /// The unit vector that it walks along, and a vector that turns with it, as bits.
    pub way: [u32; 4],
    /// How far it has to go yet, and had in all, as bits. Of a front, its way at first, as bits; of a
    /// gap, the index of the point after that which it began at.
    pub left: [u32; 4],
}

/// A stored face that fires spread over, in its fire's space: rows of the 3 × 4 transform from its
/// frame, whose z is the outward normal.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpreadFace {
    /// First row.
    pub fire_from_face_x: [f32; 4],
    /// Second row.
    pub fire_from_face_y: [f32; 4],
    /// Third row.
    pub fire_from_face_z: [f32; 4],
    /// First edge in `spread_features` that is near, and how many; the mesh's face; unused.
    pub features: [u32; 4],
    /// What q_o and q_c are multiplied by, as bits; frames that flames burn which are dropped here, 0 if as
    /// long as the fire's; unused.
    pub material: [u32; 4],
}

/// A half-edge of a stored face; half-edge 3 f + i begins at corner i of face f.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpreadEdge {
    /// Inward unit normal in the face's frame, and what it times a place of the edge is, negated;
    /// the edge's length.
    pub line: [f32; 4],
    /// Its first corner in the face's frame; cosine and sine of a quarter of all angles around it.
    pub corner: [f32; 4],
    /// From this face's frame to that beyond: cosine and sine of the rotation, then the shift.
    pub turn: [f32; 4],
    /// The half-edge beyond, or `NO_EDGE`; 1 if its first corner is at no border; the others unused.
    pub ties: [u32; 4],
}

/// An edge near a face, in the face's frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpreadFeature {
    /// Where it begins; from there to its end.
    pub line: [f32; 4],
    /// The angle between the normals on both sides, radians, above 0 where convex; the inverse of its
    /// squared length; the others unused.
    pub bend: [f32; 4],
}

/// What the processor knows of one spread in one frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpreadFrame {
    /// q_o and q_c; what both times the angle of exposed air are multiplied by; the inverse of d_t.
    pub rates: [f32; 4],
    /// d_s and d_d; the inverse of a cell's size; how far apart points are looked at for meetings.
    pub distances: [f32; 4],
    /// Slot of its fire; `SPREAD_` constants; kind of grain (`GRAIN_` constants) and its noise's key.
    pub kinds: [u32; 4],
    /// Colour and opacity of the front's line.
    pub line_look: [f32; 4],
    /// How wide it is, world units, 0 if there is none; the others unused.
    pub line_shape: [f32; 4],
    /// Unit direction of the grain, the fire's space; its periods a world unit.
    pub grain: [f32; 4],
    /// What it takes away of the speed at most, as a share; how far noise shifts it, periods; cells of
    /// that noise a world unit; unused.
    pub grain_shape: [f32; 4],
}

/// A ring that is to begin.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Ignition {
    /// Its middle in the frame of its face; a share of a turn a point; unused.
    pub place: [f32; 4],
    /// The face; how many points; slot of the spread; its key.
    pub kinds: [u32; 4],
    /// How many points those have that begin in the same frame and stand before it; its ring; the
    /// others unused.
    pub order: [u32; 4],
}

/// A piece of a surface that flames may light, in one frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpreadPiece {
    /// From its fire's space to world space: first row.
    pub world_from_fire_x: [f32; 4],
    /// Second row.
    pub world_from_fire_y: [f32; 4],
    /// Third row.
    pub world_from_fire_z: [f32; 4],
    /// Centre and radius of a ball around it, in the fire's space.
    pub ball: [f32; 4],
    /// Its first face and how many, 0 where it burns without flames' doing; slot of the spread; its ring.
    pub faces: [u32; 4],
    /// How many points that has; its key; a share of a turn a point, as bits; unused.
    pub ring: [u32; 4],
}

/// How many points; one record, kept on the device from frame to frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct SpreadCounts {
    /// Points there are, at rest or not.
    pub total: u32,
    /// Those of them that move.
    pub live: u32,
    /// Points that were to be inserted or ignited in this frame.
    pub requested: u32,
    /// Those that were.
    pub born: u32,
    /// Points that came to rest in this frame.
    pub died: u32,
    /// Points before insertions.
    pub before: u32,
    /// Insertions that there was room for.
    pub inserted: u32,
    /// Points at the end of insertions, where rings begin that are new.
    pub ignited_from: u32,
    /// Flames dropped up to now, which are numbered from 0.
    pub flames_total: u32,
    /// The first of them that may burn yet: all before it have gone out.
    pub flames_first: u32,
    /// Flames that were to be dropped in this frame.
    pub flames_requested: u32,
    /// Those that were.
    pub flames_born: u32,
    /// Dropped flames that have gone out in this frame.
    pub flames_died: u32,
    /// Those that burn.
    pub flames_live: u32,
    /// The first flame that has its place yet: all before it have lost theirs to newer ones.
    pub marks_first: u32,
    /// How many have lost theirs in this frame.
    pub marks_died: u32,
}

impl SpreadCounts {
    /// Dropped flames that have gone out and have their places yet.
    pub fn marks(&self) -> u32 {
        self.flames_total - self.marks_first - self.flames_live
    }
}

/// A flame that a control point has dropped, in its fire's space: 48 bytes. Flame k is in place k modulo
/// how many there may be.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct DroppedFlame {
    /// x, y, z as bits; slot of its fire.
    pub root_and_fire: [u32; 4],
    /// Outward unit normal of its face, as bits; the frame that it is dropped in.
    pub normal_and_birth: [u32; 4],
    /// Its key; its number; how many frames it burns, 0 for ever; unused.
    pub identity: [u32; 4],
}
