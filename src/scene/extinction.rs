//! Where particles may not be (Reeves 1983, 2.4).

/// Where particles may not be (Reeves 1983, 2.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extinction {
    /// Farther than this along a direction from the system's origin, both in the system's space.
    Distance {
        /// Not zero; its length does not matter.
        direction: [f32; 3],
        /// World units.
        distance: f32,
    },
    /// Behind a plane of the world.
    Plane {
        /// A point of it.
        point: [f32; 3],
        /// Where it faces; not zero.
        normal: [f32; 3],
    },
    /// Inside or outside a sphere of the world.
    Sphere {
        /// Its centre.
        center: [f32; 3],
        /// 0 ..= 1,000,000.
        radius: f32,
        /// Which side kills.
        kills: Side,
    },
    /// Inside or outside a box along the world's axes.
    Box {
        /// The corner with the least coordinates.
        min: [f32; 3],
        /// The corner with the greatest.
        max: [f32; 3],
        /// Which side kills.
        kills: Side,
    },
}

/// A side of something closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// What it holds.
    Inside,
    /// Everything else.
    Outside,
}
