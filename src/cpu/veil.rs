//! What surfaces leave of what is behind them: by four samples a pixel, each with how near it is.
//! Twin of `wgsl/lib/veil.wgsl`; see there.

use crate::exact::{bits_of, f32_of_u32, min_exact, reciprocal};
use crate::layout::Frame;

/// How near the front of something round is, of which the radius is seen in pixels.
#[inline]
pub fn front_of(frame: &Frame, depth: f32, radius_px: f32) -> u32 {
    let share = min_exact(radius_px * reciprocal(frame.focal_px), 0.5);
    bits_of(reciprocal(depth - depth * share))
}

/// How many samples of a pixel have no surface before that.
#[inline]
pub fn open_samples(nearness: [u32; 4], front: u32) -> u32 {
    nearness.iter().map(|near| u32::from(*near < front)).sum()
}

/// The share of a pixel that has no surface before that.
#[inline]
pub fn open_share(nearness: [u32; 4], front: u32) -> f32 {
    f32_of_u32(open_samples(nearness, front)) * 0.25
}
