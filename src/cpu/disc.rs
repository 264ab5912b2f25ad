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

/// Room for its pixels in groups of four.
const WHOLE_GROUPS: usize = (SMALL_SIDE * SMALL_SIDE).next_multiple_of(4) as usize;

/// How far a disc reaches at rest: to the outermost covered pixel centre.
#[inline]
pub(crate) fn reach_of(radius_px: f32) -> f32 {
    edged_radius(radius_px) + 0.5
}

/// Squared ways along one axis from `middle` to the centres of the pixels from `first` on.
#[inline]
fn squares(first: i32, middle: f32) -> [f32; SMALL_SIDE as usize] {
    std::array::from_fn(|at| {
        let away = center_of(first + at as i32) - middle;
        away * away
    })
}

/// The pixels of a small disc, in the picture or not, and how much light each gets: their sum is the
/// disc's area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SmallDisc {
    /// The pixel of the least x and y.
    pub(crate) first: IVec2,
    /// How many stand side by side.
    pub(crate) columns: usize,
    /// How many stand one below the other.
    pub(crate) lines: usize,
    /// Column by column, before the gain.
    weights: [f32; WHOLE_GROUPS],
    gain: f32,
}

impl SmallDisc {
    /// The disc of `radius_px` around `center`.
    #[inline]
    pub(crate) fn new(center: Vec2, radius_px: f32) -> Self {
        let reach = reach_of(radius_px);
        let range = |middle: f32| {
            let first = to_i32(middle - reach + 0.5);
            let last = to_i32(middle + reach - 0.5);
            (
                first,
                (last - first + 1).clamp(0, SMALL_SIDE as i32) as usize,
            )
        };
        let ((first_x, columns), (first_y, lines)) = (range(center.x), range(center.y));
        let (across, down) = (squares(first_x, center.x), squares(first_y, center.y));
        let mut weights = [0.0; WHOLE_GROUPS];
        let mut count = 0;
        for dx_squared in &across[..columns] {
            for dy_squared in &down[..lines] {
                weights[count] = dx_squared + dy_squared;
                count += 1;
            }
        }
        // In whole groups, what is past the last pixel among them: vectors of the processor.
        for weight in &mut weights[..count.next_multiple_of(4)] {
            *weight = clamp_unit(reach - square_root(*weight));
        }
        let mut sum = 0.0;
        for weight in &weights[..count] {
            sum += weight;
        }
        Self {
            first: IVec2::new(first_x, first_y),
            columns,
            lines,
            weights,
            gain: PI * radius_px * radius_px * reciprocal(sum),
        }
    }

    /// What the pixel in that column and line gets.
    #[inline]
    pub(crate) fn weight(&self, column: usize, line: usize) -> f32 {
        self.weights[column * self.lines + line] * self.gain
    }
}
