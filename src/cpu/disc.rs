//! A small disc at rest: the pixels that it covers, and how much of each (Reeves 1983, 2.5).
//! Twin of `wgsl/lib/disc.wgsl`, which tells the pixels in bits.

use glam::{IVec2, Vec2};

use crate::cpu::reach::{PI, center_of, edged_radius};
use crate::exact::{clamp_unit, reciprocal, shared_constants, square_root, to_i32};

shared_constants! {
    /// A small disc reaches no further than this, and covers pixels of a square of so many at a
    /// side.
    pub(crate) const SMALL_REACH_PX: f32 = 2.47;
    const SMALL_SIDE: u32 = 5;
}

/// How far a disc reaches at rest: to the outermost covered pixel centre.
#[inline]
pub(crate) fn reach_of(radius_px: f32) -> f32 {
    edged_radius(radius_px) + 0.5
}

/// How much of the pixel around `place` a disc covers, 0 to 1.
#[inline]
fn weight_at(center: Vec2, reach: f32, place: Vec2) -> f32 {
    let dx = place.x - center.x;
    let dy = place.y - center.y;
    clamp_unit(reach - square_root(dx * dx + dy * dy))
}

/// Gives `pixel` the pixels of a disc of `radius_px`, in the picture or not, column by column, and
/// how much light each gets: their sum is the disc's area.
pub(crate) fn small_disc(center: Vec2, radius_px: f32, mut pixel: impl FnMut(IVec2, f32)) {
    let reach = reach_of(radius_px);
    let range = |middle: f32| {
        let first = to_i32(middle - reach + 0.5);
        let last = to_i32(middle + reach - 0.5);
        first..first + (last - first + 1).min(SMALL_SIDE as i32)
    };
    let (columns, lines) = (range(center.x), range(center.y));
    let pixels = columns.flat_map(|x| lines.clone().map(move |y| IVec2::new(x, y)));
    let mut weights = [0.0; (SMALL_SIDE * SMALL_SIDE) as usize];
    let mut sum = 0.0;
    for (at, weight) in pixels.clone().zip(&mut weights) {
        *weight = weight_at(center, reach, Vec2::new(center_of(at.x), center_of(at.y)));
        sum += *weight;
    }
    let gain = PI * radius_px * radius_px * reciprocal(sum);
    for (at, weight) in pixels.zip(weights) {
        pixel(at, weight * gain);
    }
}
