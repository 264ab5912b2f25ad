//! The picture and its viewer.

/// The picture that frames are drawn into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image {
    /// Pixels across, 1 ..= 4,096. Default 1280.
    pub width: u32,
    /// Pixels down, 1 ..= 4,096; `width * height` is at most 8,847,360. Default 720.
    pub height: u32,
    /// Display-referred colour behind everything, each 0 ..= 1. Default black.
    pub background: [f32; 3],
    /// Fraction of a frame that the shutter is open, 0 ..= 1. Default 0.5 (Reeves 1983, section 3).
    pub shutter: f32,
    /// How light counts while the shutter is open. Default even.
    pub shutter_weighting: ShutterWeighting,
    /// Factor of the light of all particles, 0 ..= 1,000. Default 1.
    pub exposure: f32,
}

/// The light that covering particles may reflect: one from far away, and one from everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it comes from, world space, not zero. Default (0.4, 0.8, 0.5).
    pub direction: [f32; 3],
    /// Its red, green, blue, each 0 ..= 1,000. Default 1.
    pub color: [f32; 3],
    /// Red, green, blue of the light from everywhere, each 0 ..= 1,000. Default 0.2.
    pub ambient: [f32; 3],
    /// The middle of the box in which clouds throw shadows on themselves, world space. Default the origin.
    pub shadow_center: [f32; 3],
    /// Half how wide it is, world units, 0.001 ..= 1,000,000; `None`: they throw none.
    pub shadow_radius: Option<f32>,
    /// Cells along each of its sides, 4 ..= 96. Default 32.
    pub shadow_cells: u32,
}

/// How light counts while the shutter is open (Reeves 1983, section 3, further work).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShutterWeighting {
    /// All of it alike, as in a camera.
    Camera,
    /// The later, the more, as in an eye that forgets.
    Eye,
}

/// What is behind this plane and behind no plane before it is a layer of the picture; what is
/// behind none is the last (Reeves 1983, 2.5).
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Unique name, a part of file names, as that of a [`System`](super::System).
    pub name: String,
    /// A point of the plane, world space.
    pub point: [f32; 3],
    /// Where the plane faces, world space, not zero: the layer is on the other side.
    pub normal: [f32; 3],
}

/// A ball with a surface, which hides what is behind it (Reeves 1983, section 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planet {
    /// Its centre, world space. Default the origin.
    pub center: [f32; 3],
    /// Its radius, world units, 0.001 ..= 1,000,000.
    pub radius: f32,
    /// The part of the light that it reflects, each 0 ..= 1. Default 0.3.
    pub color: [f32; 3],
    /// How rough its ground looks, as a slope, 0 ..= 10. Default 0.
    pub relief: f32,
    /// How far its colour strays, as a share, 0 ..= 1. Default 0.
    pub contrast: f32,
    /// Noise cells a world unit, 0 ..= 10,000. Default 1.
    pub scale: f32,
    /// Patterns on top of each other, 1 ..= 8. Default 5.
    pub octaves: u32,
}

/// A plane behind everything (Perry 1994, 3.2.4: flames light surfaces).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// A point of it, world space. Default the origin.
    pub position: [f32; 3],
    /// Where it faces, world space, not zero. Default y.
    pub normal: [f32; 3],
    /// How far from the point it fades away, world units, 0.001 ..= 1,000,000.
    pub radius: f32,
    /// The part of the light that it reflects, each 0 ..= 1. Default 0.3.
    pub color: [f32; 3],
    /// How far its colour strays, as a share, 0 ..= 1. Default 0.
    pub contrast: f32,
    /// Noise cells a world unit, 0 ..= 10,000. Default 1.
    pub scale: f32,
    /// Patterns on top of each other, 1 ..= 8. Default 4.
    pub octaves: u32,
}

/// An upright cylinder before the ground, such as a candle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pillar {
    /// The middle of its foot, world space. Default the origin.
    pub position: [f32; 3],
    /// World units, 0.001 ..= 10,000.
    pub radius: f32,
    /// World units along y, 0.001 ..= 10,000.
    pub height: f32,
    /// The part of the light that it reflects, each 0 ..= 1. Default 0.3.
    pub color: [f32; 3],
    /// The share of the light of flames that it lets through, 0 ..= 100. Default 0.
    pub translucence: f32,
    /// How far that comes, world units, 0.001 ..= 10,000. Default 0.3.
    pub depth: f32,
}

/// A light near the planet and the ground (Reeves 1983, section 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Where it is, world space.
    pub position: [f32; 3],
    /// What it makes of white that it falls on straight, at its distance, each 0 ..= 1,000,000.
    pub color: [f32; 3],
    /// Where light is as the colour says, world units, 0.001 ..= 1,000,000; it falls with the squared
    /// distance. Default 1.
    pub distance: f32,
}

/// How the camera sees depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// What is farther is smaller.
    Perspective,
    /// Sizes do not depend on distance.
    Orthographic,
}

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands, world space, each -1,000,000 ..= 1,000,000, as the two below.
    pub position: [f32; 3],
    /// What it looks at, world space; differs from `position`.
    pub target: [f32; 3],
    /// Which way is up in the picture, world space; not parallel to the view. Default +y.
    pub up: [f32; 3],
    /// Perspective, the default, or orthographic.
    pub projection: Projection,
    /// Whole vertical angle of view, 1 ..= 170 degrees, in perspective. Default 45.
    pub vertical_fov_degrees: f32,
    /// World units from the picture's bottom to its top, 0.000001 ..= 1,000,000, if orthographic.
    /// Default 4.
    pub view_height: f32,
    /// Nothing nearer than this along the view axis is drawn, 0.000001 ..= 1,000,000. Default 0.1.
    pub near: f32,
}
