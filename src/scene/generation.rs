//! Where particles are born and where they leave to (Reeves 1983, 2.2).

use std::sync::Arc;

use crate::mesh::Mesh;

/// Where particles are born, in the system's space (Reeves 1983, 2.2).
#[derive(Clone, Debug, PartialEq)]
pub enum GenerationShape {
    /// Uniform in a ball; particles leave outward from the origin.
    Sphere {
        /// Radius, 0 ..= 1,000,000.
        radius: f32,
    },
    /// Uniform in a disc in the local x-y plane.
    Circle {
        /// Radius, 0 ..= 1,000,000.
        radius: f32,
    },
    /// Uniform in a rectangle in the local x-y plane, centred.
    Rectangle {
        /// Extent along x, 0 ..= 1,000,000.
        length: f32,
        /// Extent along y, 0 ..= 1,000,000.
        width: f32,
    },
    /// Uniform between two circles in the local x-y plane.
    Ring {
        /// Of the inner circle, at most the outer's.
        inner_radius: f32,
        /// Of the outer circle, 0 ..= 1,000,000.
        outer_radius: f32,
    },
    /// Uniform in a box, centred.
    Box {
        /// Extent along x, 0 ..= 1,000,000.
        length: f32,
        /// Extent along y, 0 ..= 1,000,000.
        width: f32,
        /// Extent along z, 0 ..= 1,000,000.
        height: f32,
    },
    /// Uniform in a cone with its apex at the origin that opens along +z.
    Cone {
        /// Along z, 0 ..= 1,000,000.
        height: f32,
        /// From the axis to its side, 0 ..= 89 degrees.
        angle_degrees: f32,
    },
    /// Uniform on a piece of the local x axis, centred.
    Line {
        /// Extent along x, 0 ..= 1,000,000.
        length: f32,
    },
    /// On the trajectory of a chaotic system (2.2, further work), centred.
    Attractor {
        /// Which.
        attractor: Attractor,
        /// From its centre to its farthest point, 0 ..= 1,000,000.
        radius: f32,
    },
    /// Of systems: on rings that run over a sphere, from the local origin on.
    Rings {
        /// Of the sphere, 0.001 ..= 1,000,000.
        radius: f32,
        /// World units a frame along the sphere, 0.000001 ..= 10,000.
        wall_speed: f32,
        /// Frames from one ring to the next, 1 ..= 65,000. Default 1.
        ring_frames: u32,
        /// Systems a world unit of circumference, 0 ..= 10,000.
        density: f32,
    },
    /// Uniform on the faces of a mesh; particles leave along the normal of theirs.
    Mesh {
        /// The faces.
        mesh: Arc<Mesh>,
        /// World units a unit of the mesh's coordinates, 0 ..= 1,000.
        scale: f32,
    },
}

/// Chaotic systems with a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attractor {
    /// Lorenz (1963): the butterfly.
    Lorenz,
    /// Roessler (1976): the folded band.
    Rossler,
    /// Halvorsen's: three arms around a diagonal.
    Halvorsen,
}

/// The axis of the cone that particles leave within.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EjectionAxis {
    /// Local +z.
    Up,
    /// From the origin; along the curve for an attractor, along the face's normal for a mesh.
    Outward,
    /// Around local +z; across the curve for an attractor.
    Around,
}

/// What is uniform in the cone of ejection (RA5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EjectionSpread {
    /// Solid angle: the same number for each part of the sphere.
    SolidAngle,
    /// The angle from the axis: more of them near it.
    Angle,
}
