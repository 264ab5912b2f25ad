//! What the user wrote, checked: TOML → [`Scene`].
//!
//! A scene knows no plan and no backend. Every quantity here has passed its checks: finite, in
//! range, consistent. Lengths are in world units, times in frames, angles in degrees; the world
//! is right-handed with +y up.
//!
//! Each randomised parameter is a [`Spread`]: a mean and a *half-width* of a uniform interval
//! around it, which is what Reeves (1983, sections 2 and 2.1) calls mean and variance.

mod builtin;
mod check;
mod error;
mod expect;
mod parse;
mod read;
pub mod schema;
mod set;
mod tree;
mod values;

pub use builtin::{BUILTIN, BuiltinScene, load, load_with};
pub use error::SceneError;
pub use parse::parse;

/// A mean and a half-width: values are uniform in `[mean - var, mean + var]` (Reeves 1983, 2.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread<T> {
    /// Centre of the interval.
    pub mean: T,
    /// Half-width of the interval, not a statistical variance; at least 0.
    pub var: T,
}

/// A parameter with a spread at birth and a rate of change a frame (Reeves 1983, 2.2 and 2.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Changing<T> {
    /// Value at birth.
    pub initial: Spread<T>,
    /// Added once a frame; the same for all particles of a system.
    pub rate: T,
}

/// A whole scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name of the scene: the built-in name, or the file's stem. Used in default output paths.
    pub name: String,
    /// One line for people, at most 200 characters. Default: the name.
    pub title: String,
    /// A few sentences for people, at most 10,000 characters; may be empty.
    pub description: String,
    /// Frames that the scene lasts when nobody says otherwise, 1 ..= 1,000,000. Default 120.
    pub frames: u32,
    /// Frames a second, for animated files, 1 ..= 240. Default 24 (Reeves 1983, section 3).
    pub frame_rate: u32,
    /// Seed of every stochastic decision. Default 1; a file's is below 2^63, as TOML's numbers are.
    pub seed: u64,
    /// Most particles alive at once, 1 ..= 1,000,000,000; `None` means a bound computed from births and lifetimes.
    pub capacity: Option<u32>,
    /// Image size, background and shutter.
    pub image: Image,
    /// The viewer.
    pub camera: Camera,
    /// The particle systems, in the order of the file, at least one, at most 1,024; names unique.
    pub systems: Vec<System>,
}

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
}

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands, world space, each -1,000,000 ..= 1,000,000, as the two below.
    pub position: [f32; 3],
    /// What it looks at, world space; differs from `position`.
    pub target: [f32; 3],
    /// Which way is up in the picture, world space; not parallel to the view. Default +y.
    pub up: [f32; 3],
    /// Whole vertical angle of view, 1 ..= 170 degrees. Default 45.
    pub vertical_fov_degrees: f32,
    /// Nothing nearer than this along the view axis is drawn, 0.000001 ..= 1,000,000. Default 0.1.
    pub near: f32,
}

/// One particle system (Reeves 1983, section 2).
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// Unique name; its hash is part of every particle's identity. A letter or `_`, then letters,
    /// digits, `-` and `_`, at most 64 characters, so that it can stand in paths and file names.
    pub name: String,
    /// Origin, world space (2.2), each -1,000,000 ..= 1,000,000. Default 0.
    pub position: [f32; 3],
    /// Two angles of rotation: first about x, then about y (2.2). Local +z is the system's "up".
    /// Each -360 ..= 360. Default 0.
    pub rotation_degrees: [f32; 2],
    /// f0, the first frame with births, 0 ..= 1,000,000. Default 0.
    pub first_frame: u32,
    /// The frame at which births end (exclusive); `None` means never. Greater than
    /// `first_frame`, at most 1,000,000.
    pub end_frame: Option<u32>,
    /// How many are born (2.1).
    pub births: Births,
    /// How a fractional number of births becomes a whole one (RA1).
    pub birth_rounding: BirthRounding,
    /// Where particles are born, local space (2.2).
    pub generation_shape: GenerationShape,
    /// Half-angle of the cone about local +z that circle and rectangle births leave within, 0 ..= 180 degrees.
    /// Ignored by the sphere, whose particles leave outward. Default 0.
    pub ejection_angle_degrees: f32,
    /// Initial speed, world units a frame, mean -10,000 ..= 10,000 (2.2). Negative speeds go the
    /// other way.
    pub speed: Spread<f32>,
    /// Lifetime in frames, rounded to a whole number, at least 1; mean + var at most 65,000 (2.4).
    pub lifetime: Spread<f32>,
    /// Colour: light a fully covered pixel receives, each mean >= 0, at most 1,000 (2.2).
    pub color: Changing<[f32; 3]>,
    /// 0 opaque ..= 1 invisible; light is scaled by 1 - transparency (2.2, RA11). Default 0.
    pub transparency: Changing<f32>,
    /// Radius (half-width for rectangles), world units, mean 0.000001 ..= 10,000 (2.2). The var
    /// may be larger than the mean.
    pub size: Changing<f32>,
    /// Added to the velocity each frame, world space, units a frame squared, each
    /// -10,000 ..= 10,000 (2.3). Default 0.
    pub acceleration: [f32; 3],
    /// What a particle looks like (2.2).
    pub particle_shape: ParticleShape,
    /// How light spreads along a streak (RA8). Default conserved.
    pub streak_light: StreakLight,
    /// A particle whose intensity falls below this, 0 ..= 1,000, is killed; `None` means never (2.4, RA7).
    pub intensity_threshold: Option<f32>,
}

/// Births a frame (Reeves 1983, 2.1): a mean that changes linearly with the frame, and a half-width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Births {
    /// Whether the numbers are particles, or particles per pixel of the system's screen area.
    pub per: BirthUnit,
    /// InitialMeanParts (or its per-area twin) at the first frame, 0 ..= 16,000,000 a frame or
    /// 0 ..= 1,000 a pixel.
    pub initial_mean_parts: f32,
    /// DeltaMeanParts: added to the mean each frame after the first; at most as much, either way.
    /// Default 0.
    pub delta_mean_parts: f32,
    /// VarParts: half-width around the mean, constant; limits as the initial mean's. Default 0.
    pub var_parts: f32,
}

/// What [`Births`] counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BirthUnit {
    /// Particles a frame.
    Frame,
    /// Particles a frame for each pixel that the system's bounding sphere covers.
    ScreenArea,
}

/// How births are rounded (RA1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BirthRounding {
    /// floor(x + u), u uniform in [0, 1): keeps the mean. The default.
    Stochastic,
    /// floor(x + 1/2).
    Nearest,
}

/// Where particles are born, in the system's space (Reeves 1983, 2.2).
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

/// What a particle looks like on the screen (Reeves 1983, 2.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParticleShape {
    /// An antialiased disc.
    Sphere,
    /// An antialiased square that faces the viewer.
    Rectangle,
    /// A disc drawn along the motion while the shutter is open.
    Streak,
}

/// How a streak's light is spread (RA8).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StreakLight {
    /// The total is that of the particle at rest: long streaks are dimmer.
    Conserved,
    /// Every covered pixel gets the full colour.
    Constant,
}
