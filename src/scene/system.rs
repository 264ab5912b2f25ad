//! A particle system (Reeves 1983, section 2).

use super::{
    BirthMoment, BirthRounding, Births, Burst, Changing, EjectionAxis, EjectionSpread, Extinction,
    GenerationShape, Inherit, Spread,
};

/// One particle system (Reeves 1983, section 2).
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// Unique name; its hash is part of every particle's identity. A letter or `_`, then letters,
    /// digits, `-` and `_`, at most 64 characters, so that it can stand in paths and file names.
    pub name: String,
    /// Name of the system that bears systems of this kind (2.6); this one then stands for all of
    /// them, and its place is in the space that each is born in. `None`: it is one of its own.
    pub parent: Option<String>,
    /// Which way is up for those of its kind. Default the parent's.
    pub child_up: ChildUp,
    /// How much those of its kind differ. Default not at all.
    pub inherit: Inherit,
    /// Origin, world space (2.2), each -1,000,000 ..= 1,000,000. Default 0.
    pub position: [f32; 3],
    /// Two angles of rotation: first about x, then about y (2.2). Local +z is the system's "up".
    /// Each -36,000 ..= 36,000. Default 0.
    pub rotation_degrees: [f32; 2],
    /// f0, the first frame with births, -65,000 ..= 1,000,000: a system that begins before frame 0
    /// is under way when the scene begins. Default 0.
    pub first_frame: i32,
    /// The frame at which births end (exclusive); `None` means never. Greater than
    /// `first_frame`, at most 1,000,000.
    pub end_frame: Option<i32>,
    /// Frames at which the system begins anew, at most 256, ascending: all frames of its births
    /// then count from the last one. Empty: it begins once, and they count from frame 0.
    pub trigger_frames: Vec<i32>,
    /// Births all at once, besides the others, at most 64.
    pub bursts: Vec<Burst>,
    /// When in its frame a particle is born. Default at the frame's start (2.3).
    pub birth_moment: BirthMoment,
    /// Whose motion the living follow. Default the system's.
    pub particle_space: ParticleSpace,
    /// How many are born (2.1).
    pub births: Births,
    /// How a fractional number of births becomes a whole one (RA1).
    pub birth_rounding: BirthRounding,
    /// Where particles are born, local space (2.2).
    pub generation_shape: GenerationShape,
    /// The axis of the cone that particles leave within. Default outward for sphere and cone, along
    /// the curve for an attractor, else up.
    pub ejection_axis: EjectionAxis,
    /// Half-angle of that cone, 0 ..= 180 degrees. Default 0.
    pub ejection_angle_degrees: f32,
    /// What is uniform in the cone (RA5). Default solid angle.
    pub ejection_spread: EjectionSpread,
    /// Initial speed, world units a frame, mean -10,000 ..= 10,000 (2.2). Negative speeds go the
    /// other way.
    pub speed: Spread<f32>,
    /// Lifetime in frames, rounded to a whole number, at least 1; mean + var at most 65,000 (2.4).
    /// `None`: age kills nobody, and a run has at most 65,000 frames.
    pub lifetime: Option<Spread<f32>>,
    /// Colour: light a fully covered pixel receives, each mean >= 0, at most 1,000 (2.2).
    pub color: Changing<[f32; 3]>,
    /// 0 opaque ..= 1 invisible; light is scaled by 1 - transparency (2.2, RA11). Default 0.
    pub transparency: Changing<f32>,
    /// Radius (half-width for rectangles), world units, mean 0.000001 ..= 10,000 (2.2). The var
    /// may be larger than the mean.
    pub size: Changing<f32>,
    /// Added to the velocity each frame, units a frame squared, each -10,000 ..= 10,000 (2.3).
    /// Default 0.
    pub acceleration: [f32; 3],
    /// Whose directions that has. Default the world's.
    pub acceleration_space: ParticleSpace,
    /// The part of its velocity against the wind that a particle loses each frame, 0 ..= 1.
    /// Default 0: it feels neither air nor wind.
    pub drag: f32,
    /// How position and velocity go on together (RA6). Default Euler.
    pub integration: Integration,
    /// What a particle looks like (2.2).
    pub particle_shape: ParticleShape,
    /// How they and what is behind them share a pixel; the same for a whole run. Default add.
    pub blend: Blend,
    /// Whether those that cover reflect the scene's light. Default flat.
    pub shading: Shading,
    /// How much of a covering disc's radius its edge takes, 0 sharp ..= 1 from the centre on.
    /// Default 0.
    pub edge_softness: f32,
    /// How light spreads along a streak (RA8). Default conserved.
    pub streak_light: StreakLight,
    /// How much narrower a stroke is at its end, 0 ..= 1. Default 1: to nothing.
    pub stroke_taper: f32,
    /// Straight pieces that a stroke is drawn of, at most, 1 ..= 64. Default 16.
    pub stroke_pieces: u32,
    /// How dark shadows of strokes are on the ground, 0 ..= 1. Default 0.
    pub stroke_shadow: f32,
    /// A particle whose intensity falls below this, 0 ..= 1,000, is killed; `None` means never (2.4, RA7).
    pub intensity_threshold: Option<f32>,
    /// What intensity is (RA7). Default the brightest channel.
    pub intensity: Intensity,
    /// Where particles may not be, at most 16 (2.4).
    pub extinctions: Vec<Extinction>,
    /// Distance at which a particle's light is as its colour says, falling with the square of the
    /// distance, 0.000001 ..= 1,000,000; `None`: light does not depend on it (2.5, further work).
    pub light_distance: Option<f32>,
    /// Factor of the light that its particles throw on the planet, the ground and surfaces,
    /// 0 ..= 1,000,000; 1 is what they send to the picture (section 3, what is missing). Default 0.
    pub light: f32,
}

/// Which way is up for a system that another one has borne.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChildUp {
    /// As its parent's.
    Parent,
    /// Away from the parent's generation shape.
    Outward,
}

/// How particles and what is behind them share a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blend {
    /// They add their light to it (Reeves 1983, 2.5).
    Add,
    /// They cover it, as far as they are opaque.
    Over,
}

/// Whether covering particles reflect the scene's light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// They have their own colour all over.
    Flat,
    /// Each is a ball that reflects light in its colour (Reeves 1983, 5).
    LitSphere,
    /// Each is a part of a cloud: it reflects the light that comes to it through the others.
    LitCloud,
}

/// Whose motion the living follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParticleSpace {
    /// The system's: they move and turn with it.
    System,
    /// The world's: they stay behind.
    World,
}

/// How position and velocity go on together (RA6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integration {
    /// position += velocity, then velocity += acceleration: the order of the text.
    Euler,
    /// The same with velocities halfway through each frame: particles are on the parabola of their
    /// acceleration, p0 + n v0 + a n^2 / 2.
    Parabola,
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
    /// Its whole trajectory, drawn at once (4.3). It covers, has a lifetime and no drag, and stays where it
    /// is for the whole run.
    Stroke,
}

/// How a streak's light is spread (RA8).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StreakLight {
    /// The total is that of the particle at rest: long streaks are dimmer.
    Conserved,
    /// Every covered pixel gets the full colour.
    Constant,
}

/// What a particle's intensity is (RA7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Intensity {
    /// (1 - transparency) times the brightest channel.
    Brightest,
    /// (1 - transparency) times the luminance.
    Luminance,
}
