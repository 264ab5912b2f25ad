//! Flocks (Reynolds 1987, as the flocking article has them).

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
    /// What a boid looks like. Default a triangle.
    pub shape: BoidShape,
    /// Base of the triangle or diameter of the disc, 0.000001 ..= 10,000 world units; of a point,
    /// pixels. Default 3.
    pub size: f32,
    /// Display-referred colour, each 0 ..= 1. Default white.
    pub color: [f32; 3],
    /// How much of what is behind it a boid hides, 0 ..= 1. Default 1; 0 is not drawn.
    pub opacity: f32,
    /// Whether each boid is drawn a second time, mirrored, at -x. Default no.
    pub mirrored: bool,
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
