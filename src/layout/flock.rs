//! What flocks add to the shared structs.

use bytemuck::{Pod, Zeroable};

use crate::exact::shared_constants;

/// A boid: 32 bytes, in world space. Its place among all boids is the flock's first and its index.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Boid {
    /// x, y, z as bits of `f32`; slot of its flock.
    pub position_and_flock: [u32; 4],
    /// Velocity a frame as bits of `f32`; index within its flock.
    pub velocity_and_index: [u32; 4],
}

impl Boid {
    /// World position.
    #[inline]
    pub fn position(&self) -> [f32; 3] {
        let [x, y, z, _] = self.position_and_flock;
        [x, y, z].map(f32::from_bits)
    }

    /// Velocity, world units a frame.
    #[inline]
    pub fn velocity(&self) -> [f32; 3] {
        let [x, y, z, _] = self.velocity_and_index;
        [x, y, z].map(f32::from_bits)
    }

    /// Slot of its flock.
    #[inline]
    pub fn flock(&self) -> u32 {
        self.position_and_flock[3]
    }

    /// Index within its flock.
    #[inline]
    pub fn index(&self) -> u32 {
        self.velocity_and_index[3]
    }
}

shared_constants! {
    /// [`FlockFrame::members`]`[3]`: the world has no ends.
    pub const EDGES_NONE: u32 = 0;
    /// Who is beyond an edge is put on the opposite one.
    pub const EDGES_WRAP: u32 = 1;
    /// Velocities are multiplied at an edge.
    pub const EDGES_BOUNCE: u32 = 2;
    /// They are turned inward.
    pub const EDGES_INWARD: u32 = 3;
    /// Opposite edges are the same.
    pub const EDGES_TORUS: u32 = 4;
    /// [`Relation::kinds`]`[0]`: flock with them.
    pub const RELATION_FLOCK: u32 = 0;
    /// Flee from each of them.
    pub const RELATION_AVOID: u32 = 1;
    /// Be pulled by each of them.
    pub const RELATION_APPROACH: u32 = 2;
    /// Parts of the wind, at most.
    pub const MOST_WINDS: u32 = 16;
    /// Lamps, at most.
    pub const MOST_LAMPS: u32 = 16;
    /// [`Relation::kinds`]`[3]` at most.
    pub const MOST_NEAREST: u32 = 16;
    /// [`Obstacle::kinds`]`[0]`: a ball.
    pub const OBSTACLE_SPHERE: u32 = 0;
    /// A plane.
    pub const OBSTACLE_PLANE: u32 = 1;
    /// A box along the axes.
    pub const OBSTACLE_BOX: u32 = 2;
    /// What a mesh encloses.
    pub const OBSTACLE_MESH: u32 = 3;
    /// Rows of `solid_faces` a face: a corner and the edges to the next and the last one, in the
    /// ball around the mesh as if that were of radius 1; normals of the face, of its edges and of its corners.
    pub const ROWS_A_SOLID_FACE: u32 = 10;
    /// Steps of a sum over neighbours in its unit, which no term exceeds: 2^29.
    pub const SUM_STEPS: f32 = 536_870_912.0;
    /// [`FlockFrame::ties`]`[3]`: a triangle along the heading.
    pub const BOID_TRIANGLE: u32 = 0;
    /// A disc.
    pub const BOID_DISC: u32 = 1;
    /// A disc whose size is in pixels.
    pub const BOID_POINT: u32 = 2;
    /// A cone with a round base, along the heading.
    pub const BOID_CONE: u32 = 3;
}

/// What the processor knows of one flock in one frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct FlockFrame {
    /// Least corner of where boids are at first; their speed.
    pub region_min: [f32; 4],
    /// Its extents; the greatest speed after a move.
    pub region_extent: [f32; 4],
    /// Of the constant force; the inverse of the mass.
    pub acceleration: [f32; 4],
    /// The edges' least corner; the factor of velocities there.
    pub edges_min: [f32; 4],
    /// The edges' greatest corner; how far a boid sees, for statistics only.
    pub edges_max: [f32; 4],
    /// Extents of the torus, 0 along axes that have no wrap; w unused.
    pub torus: [f32; 4],
    /// Their inverses; w unused.
    pub torus_inverse: [f32; 4],
    /// Least corner of the grid; steps of the fixed-point sums of its boids' velocities, a power of
    /// two.
    pub grid_min: [f32; 4],
    /// Grid cells a world unit; w: size of a boid.
    pub cells_per_unit: [f32; 4],
    /// World units a grid cell, 0 where gaps to rows are not to be relied on; w unused.
    pub cell_extent: [f32; 4],
    /// Red, green, blue and opacity.
    pub color: [f32; 4],
    /// The goal; the inverse of the radius where boids slow down, 0 for none.
    pub goal: [f32; 4],
    /// Its weight, speed and limit, which is 0 where there is no goal; the drag.
    pub goal_rule: [f32; 4],
    /// Grid cells along x, y and z; the first one among those of all flocks.
    pub grid: [u32; 4],
    /// First boid and how many; the flock's key; what its edges are (`EDGES_` constants).
    pub members: [u32; 4],
    /// First relation and how many; 1 if headings are in space, not in a plane; what boids look
    /// like (`BOID_` constants).
    pub ties: [u32; 4],
    /// First place of its boids' trails; the length of the ring that each has, less 1, a power of two
    /// less 1; how many segments are drawn; the first record of what covers of these, among those of
    /// boids.
    pub trail: [u32; 4],
    /// How much fainter each segment is than the one before; how wide the first would be, in sizes; the
    /// square of what is no way but a jump; w unused.
    pub trail_look: [f32; 4],
    /// First record of what covers, among those of boids; records a boid: 0, 1, or 2 where it is
    /// drawn mirrored, too; first obstacle and how many.
    pub drawn: [u32; 4],
}

/// What one flock makes of another.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Relation {
    /// Kind (`RELATION_` constants), slot of the other flock, 1 if separation counts near ones
    /// more, how many are seen at most, the nearest, or 0 for all.
    pub kinds: [u32; 4],
    /// Squared radius, radius, steps of the fixed-point sums of offsets, of those of pushes.
    pub reach: [f32; 4],
    /// Weight, speed and limit; w: the limit of a push.
    pub separation: [f32; 4],
    /// Weight, speed and limit; w: the unit of pushes.
    pub alignment: [f32; 4],
    /// Weight, speed and limit; w: the radius, widened for rounding.
    pub cohesion: [f32; 4],
    /// cos |cos| of half the angle of view, below -1 for all around; the others unused.
    pub sight: [f32; 4],
}

/// What boids of a flock turn away from, and never enter.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Obstacle {
    /// Kind (`OBSTACLE_` constants); 1 if boids stay inside; of a mesh, its first stored face and how
    /// many.
    pub kinds: [u32; 4],
    /// Of a ball its centre and radius, of a mesh those of the ball around it, of a plane its unit
    /// normal and the distance along it, of a box its centre.
    pub place: [f32; 4],
    /// Half the extents of a box; of a mesh, the inverse of the ball's radius in x.
    pub extent: [f32; 4],
    /// The inverse of the margin where boids turn away, most that they accelerate; the others unused.
    pub push: [f32; 4],
}
