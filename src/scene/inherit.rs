//! How much systems differ that have one parent (Reeves 1983, 2.6 and section 3).

use super::{Changing, Spread};

/// Half-widths of the ranges that each system of a kind chooses its values in, around those of its
/// kind. Of a spread, `mean` is for means and `var` for half-widths. All 0: they are alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inherit {
    /// For mean births, 0 ..= 16,000,000, in their unit.
    pub mean_parts: f32,
    /// For half-widths of births, 0 ..= 16,000,000, in their unit.
    pub var_parts: f32,
    /// For the extents of the generation shape, a share of them, 0 ..= 1.
    pub generation_scale: f32,
    /// For ejection angles, 0 ..= 180 degrees.
    pub ejection_angle_degrees: f32,
    /// For speeds, world units a frame.
    pub speed: Spread<f32>,
    /// For lifetimes, frames.
    pub lifetime: Spread<f32>,
    /// For colours and their rates.
    pub color: Changing<[f32; 3]>,
    /// For transparencies and their rates.
    pub transparency: Changing<f32>,
    /// For sizes and their rates, world units.
    pub size: Changing<f32>,
}

impl Default for Inherit {
    fn default() -> Self {
        let none = Spread {
            mean: 0.0,
            var: 0.0,
        };
        let still = Changing {
            initial: none,
            rate: 0.0,
            rate_var: 0.0,
        };
        let black = [0.0; 3];
        Self {
            mean_parts: 0.0,
            var_parts: 0.0,
            generation_scale: 0.0,
            ejection_angle_degrees: 0.0,
            speed: none,
            lifetime: none,
            color: Changing {
                initial: Spread {
                    mean: black,
                    var: black,
                },
                rate: black,
                rate_var: black,
            },
            transparency: still,
            size: still,
        }
    }
}
