//! Flocks (Reynolds 1987, as the flocking article has them).

use std::sync::Arc;

use super::Side;
use crate::mesh::{Mesh, Surface};

/// A flock: boids that are all there from the first frame on and never die.
///
/// Predators and attractors are flocks, too: what one flock makes of another is a [`Relation`].
#[derive(Clone, Debug, PartialEq)]
pub struct Flock {
    /// Unique name among flocks; its hash is part of every boid's identity. As that of a
    /// [`System`](super::System).
    pub name: String,
    /// How many boids, 1 ..= 1,000,000; all flocks together have no more.
    pub count: u32,
    /// Whether boids live in a plane or in space. Default a plane.
    pub dimensions: Dimensions,
    /// Where they are at first: uniform in this box.
    pub region: Corners,
    /// Speed at first, in a random direction, 0 ..= 10,000 world units a frame. Default 1.
    pub start_speed: f32,
    /// Velocities are limited to it after the move, so that a displacement may be longer by one
    /// frame's acceleration; 0.000001 ..= 10,000 world units a frame. Default 2.
    pub max_speed: f32,
    /// What forces are divided by, 0.000001 ..= 1,000,000; steering is an acceleration. Default 1.
    pub mass: f32,
    /// A constant force, mass times world units a frame squared, each -10,000 ..= 10,000. Default 0.
    pub force: [f32; 3],
    /// How far a boid sees, unless a relation says otherwise, 0.000001 ..= 1,000,000 world units.
    /// Default 60.
    pub perception_radius: f32,
    /// What happens at the ends of the world. Default nothing.
    pub edges: Edges,
    /// What the flock makes of others and of itself, at most 16.
    pub relations: Vec<Relation>,
    /// Where it wants to go. Default nowhere.
    pub goal: Option<Goal>,
    /// What it turns away from and never enters, at most 16; of those that overlap, the last counts.
    /// Its meshes have at most 10,000 faces together.
    pub obstacles: Vec<Obstacle>,
    /// Part of its velocity against the wind that a boid loses each frame, 0 ..= 1. Default 0.
    pub drag: f32,
    /// What a boid looks like. Default a triangle.
    pub shape: BoidShape,
    /// Base of the triangle or diameter of the disc or of the cone's base, 0.000001 ..= 10,000 world units; of a point,
    /// pixels. Default 3.
    pub size: f32,
    /// Display-referred colour, each 0 ..= 1. Default white.
    pub color: [f32; 3],
    /// How much of what is behind it a boid hides, 0 ..= 1. Default 1; 0 is not drawn.
    pub opacity: f32,
    /// How many frames long the trail is that a boid draws behind it, 0 ..= 64; it fades and narrows.
    /// The same for a whole run. Default 0.
    pub trail_frames: u32,
    /// Whether each boid is drawn a second time, mirrored at the picture's upright middle line: the
    /// picture of such a flock is its own mirror image, to the bit. Default no.
    pub mirrored: bool,
}

impl Flock {
    /// Faces of all meshes among its obstacles.
    pub(crate) fn solid_faces(&self) -> u32 {
        let of = |obstacle: &Obstacle| match &obstacle.shape {
            ObstacleShape::Mesh { surface, .. } => surface.faces().len() as u32,
            _ => 0,
        };
        self.obstacles.iter().map(of).sum()
    }
}

/// A box along the axes, world units, each -1,000,000 ..= 1,000,000.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners {
    /// The corner with the least coordinates.
    pub min: [f32; 3],
    /// The corner with the greatest.
    pub max: [f32; 3],
}

/// Where boids live.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimensions {
    /// In the plane of z = 0; of the flock's vectors, z does not count.
    Two,
    /// In space.
    Three,
}

/// What a boid looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoidShape {
    /// A triangle that points where it flies; its pivot is a corner of the base.
    Triangle,
    /// A disc.
    Disc,
    /// A disc whose diameter is in pixels.
    Point,
    /// A cone that points where it flies, lit as spheres are; its base is round, and it is two and a
    /// half times as long as that is wide.
    Cone,
}

/// What happens where the world ends; `Corners` say where that is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edges {
    /// It does not end.
    None,
    /// Whoever is beyond an edge is put on the opposite one.
    Wrap(Corners),
    /// Velocities are reversed at an edge; `inward` turns them inward instead, so that nobody who
    /// is beyond sticks there.
    Repel {
        /// The edges.
        corners: Corners,
        /// Whether signs are set by side.
        inward: bool,
    },
    /// Velocities are multiplied by `factor` at an edge.
    Constrain {
        /// The edges.
        corners: Corners,
        /// -100 ..= 100. Default -4.
        factor: f32,
    },
    /// Opposite edges are the same: positions count modulo the box, and boids see across.
    Torus(Corners),
}

/// What a flock makes of another one, or of itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relation {
    /// Index of the other flock in the scene.
    pub other: usize,
    /// Whom of it a boid perceives: those nearer than this, 0.000001 ..= 1,000,000 world units;
    /// `None`: the flock's own perception radius.
    pub radius: Option<f32>,
    /// How wide it sees around where it flies, 1 ..= 360 degrees; who does not move sees all around.
    /// Default 360.
    pub view_angle_degrees: f32,
    /// How many of those it perceives, the nearest, 1 ..= 16; of those that are as far, the first of
    /// their flock. `None`: all.
    pub nearest: Option<u32>,
    /// What it does about them.
    pub kind: RelationKind,
}

/// What a boid does about those it perceives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RelationKind {
    /// It flocks with them, by the three rules.
    Flock {
        /// Away from them.
        separation: Rule,
        /// Whether separation counts near ones more, by the inverse of the distance.
        inverse_distance: bool,
        /// Where they go.
        alignment: Rule,
        /// To their middle.
        cohesion: Rule,
    },
    /// It flees from each of them, with at most this acceleration for each, 0.000001 ..= 10,000
    /// world units a frame squared. Default 1.
    Avoid {
        /// The limit.
        limit: f32,
    },
    /// Each of them pulls it, with at most this force, 0.000001 ..= 10,000. Default 0.4.
    Approach {
        /// The limit.
        limit: f32,
    },
}

/// A steering rule: the way it wants, at `speed`, less the velocity, at most `limit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Factor of the whole, -100 ..= 100; 0 switches the rule off. Default 1.
    pub weight: f32,
    /// World units a frame, 0 ..= 10,000. Default 4 (cohesion 4.5).
    pub speed: f32,
    /// World units a frame squared, 0.000001 ..= 10,000. Default 0.2 (separation 0.3).
    pub limit: f32,
}

/// A place that boids steer to: the way there at `speed`, less the velocity, at most `limit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// World units; on a torus they take the nearest way.
    pub position: [f32; 3],
    /// Factor of the whole, -100 ..= 100; below 0 they flee. Default 1.
    pub weight: f32,
    /// World units a frame, 0 ..= 10,000. Default 4.
    pub speed: f32,
    /// World units a frame squared, 0.000001 ..= 10,000. Default 0.1.
    pub limit: f32,
    /// Within it they slow down, so as to arrive, 0 ..= 1,000,000 world units. Default 0.
    pub slowing_radius: f32,
}

/// What boids turn away from and never enter; not across edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// What it is. For boids of a plane, its depth does not count.
    pub shape: ObstacleShape,
    /// How far from its surface they begin to turn away, 0.001 ..= 1,000,000 world units. Default 20.
    pub margin: f32,
    /// Most that they accelerate for it, at its surface, 0.000001 ..= 10,000 world units a frame
    /// squared. Default 0.5.
    pub limit: f32,
}

/// Shapes of obstacles.
#[derive(Clone, Debug, PartialEq)]
pub enum ObstacleShape {
    /// A ball.
    Sphere {
        /// Its centre.
        center: [f32; 3],
        /// 0.001 ..= 1,000,000 world units.
        radius: f32,
        /// Where boids may be.
        stay: Side,
    },
    /// A plane.
    Plane {
        /// A point of it.
        point: [f32; 3],
        /// Where it faces, and boids may be; not zero.
        normal: [f32; 3],
    },
    /// A box along the axes.
    Box {
        /// Its corners.
        corners: Corners,
        /// Where boids may be.
        stay: Side,
    },
    /// What a mesh encloses; of flocks in space only.
    Mesh {
        /// The mesh.
        mesh: Arc<Mesh>,
        /// The same, with its faces joined; it has no border.
        surface: Arc<Surface>,
        /// Where its origin is.
        position: [f32; 3],
        /// World units a unit of the mesh, 0.000001 ..= 10,000.
        scale: f32,
        /// Where boids may be.
        stay: Side,
    },
}
