//! How far what is drawn reaches in the picture, and whether it is in there at all (Reeves 1983, 2.5).
//! Twin of `wgsl/lib/reach.wgsl`, line by line.

use crate::cpu::projection::Projected;
use crate::exact::{
    at_least_zero, clamp_unit, f32_of_i32, less, max_exact, min_exact, shared_constants,
    square_root,
};
use crate::layout::Frame;

shared_constants! {
    /// Half a turn over its radius.
    pub(crate) const PI: f32 = std::f32::consts::PI;
    /// Radii are at most this many pixels: four times the largest picture.
    pub(crate) const MOST_RADIUS_PX: f32 = 16_384.0;
    /// What moves less than the root of this while the shutter is open is at rest, square pixels.
    pub(crate) const LEAST_WAY_SQUARED: f32 = 0.0001;
}

/// Whether any of it may fall into the picture.
#[inline]
pub(crate) fn is_visible(view: &Frame, start: Projected, end: Projected, radius_px: f32) -> bool {
    let reach = radius_px + 2.0;
    let width = f32_of_i32(view.width as i32);
    let height = f32_of_i32(view.height as i32);
    !(less(start.depth, view.near)
        || less(end.depth, view.near)
        || less(max_exact(start.x, end.x) + reach, 0.0)
        || less(max_exact(start.y, end.y) + reach, 0.0)
        || less(width, min_exact(start.x, end.x) - reach)
        || less(height, min_exact(start.y, end.y) - reach))
}

/// Whether it is seen to move while the shutter is open.
#[inline]
pub(crate) fn moves(start: Projected, end: Projected) -> bool {
    let dx = end.x - start.x;
    let dy = end.y - start.y;
    less(LEAST_WAY_SQUARED, dx * dx + dy * dy)
}

/// The radius whose edge, one pixel wide, gives the area of a disc of `radius_px`.
#[inline]
pub(crate) fn edged_radius(radius_px: f32) -> f32 {
    max_exact(
        square_root(at_least_zero(radius_px * radius_px - 0.083_333_336)),
        0.5,
    )
}

/// The centre of a pixel, along one axis.
#[inline]
pub(crate) fn center_of(pixel: i32) -> f32 {
    f32_of_i32(pixel) + 0.5
}

/// How much of the pixel around `center` lies within [low, high], along one axis.
#[inline]
pub(crate) fn overlap(center: f32, low: f32, high: f32) -> f32 {
    let left = center - 0.5;
    clamp_unit(min_exact(left + 1.0, high) - max_exact(left, low))
}
