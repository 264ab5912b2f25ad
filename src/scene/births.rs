//! How many particles are born, and when (Reeves 1983, 2.1).

use super::Spread;

/// Births a frame (Reeves 1983, 2.1): a mean that changes with the frame, and a half-width.
/// Both are polynomials of the frames since the first.
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
    /// Times the squared number of frames. Default 0.
    pub quadratic_mean_parts: f32,
    /// Times the cubed number of frames. Default 0.
    pub cubic_mean_parts: f32,
    /// VarParts: half-width around the mean; limits as the initial mean's. Default 0.
    pub var_parts: f32,
    /// Added to the half-width each frame after the first. Default 0.
    pub delta_var_parts: f32,
    /// Times the squared number of frames. Default 0.
    pub quadratic_var_parts: f32,
    /// Times the cubed number of frames. Default 0.
    pub cubic_var_parts: f32,
    /// How far the mean strays at random, as a share of it, 0 ..= 1. Default 0.
    pub mean_parts_wander: f32,
    /// Over how many frames it does, 1 ..= 1,000,000. Default 24.
    pub mean_parts_wander_frames: f32,
}

impl Births {
    /// Nobody.
    pub(super) fn none(per: BirthUnit) -> Self {
        Self {
            per,
            initial_mean_parts: 0.0,
            delta_mean_parts: 0.0,
            quadratic_mean_parts: 0.0,
            cubic_mean_parts: 0.0,
            var_parts: 0.0,
            delta_var_parts: 0.0,
            quadratic_var_parts: 0.0,
            cubic_var_parts: 0.0,
            mean_parts_wander: 0.0,
            mean_parts_wander_frames: 24.0,
        }
    }
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

/// Births all at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Burst {
    /// When, from frame 0 or from the last trigger.
    pub frame: i32,
    /// How many, 0 ..= 16,000,000: a mean and a half-width.
    pub parts: Spread<f32>,
}

/// When in its frame a particle is born.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BirthMoment {
    /// At its start: it is seen one whole step from where it was born.
    FrameStart,
    /// At any moment of it, evenly: jets and moving systems leave no gaps.
    WithinFrame,
}
