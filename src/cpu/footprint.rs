//! The pixels that a streak, a square or a larger disc covers, and how much of each, antialiased
//! (Reeves 1983, 2.5 and 3). Twin of `wgsl/lib/footprint.wgsl`; see there for how light is kept. Here
//! several pixels are weighed together, so that the processor takes several in one instruction.

use std::ops::Range;

use crate::cpu::lanes::{LANES, Lanes, lanes};
use crate::cpu::projection::Projected;
use crate::cpu::reach::{LEAST_WAY_SQUARED, PI, center_of, edged_radius, overlap};
use crate::exact::{
    clamp_unit, inverse_square_root, less, max_exact, min_exact, reciprocal, shared_constants,
    square_root, to_i32,
};
use crate::layout::{FRAME_EYE, Frame};

shared_constants! {
    /// Footprints of at most this many pixels are summed one by one.
    const FEW_CELLS: u32 = 2048;
    /// A disc of at least this radius needs no gain; below half of it, all of it.
    pub(crate) const LARGE_RADIUS_PX: f32 = 4.0;
    /// Pixels count by their centres, so rows of what is no farther away than this are narrower by
    /// nearly half a pixel on either side; a rest is left for rounding.
    const NEAR_PX: f32 = 16_384.0;
    const CENTER_TRIM_PX: f32 = 0.375;
    /// Pixel coordinates are kept within these, and ranges of them below 2^15.
    const FARTHEST_PX: i32 = 16_777_216;
    const LONGEST_PX: i32 = 32_768;
    /// Invocations that share a footprint of many pixels, and where their list starts: here, a
    /// particle is drawn in one go.
    const SHARES: u32 = 256;
    const LIST_START: u32 = 4;
}

/// A disc swept along a segment, or a square; `major` is the axis on which the segment is longer.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Footprint {
    pub(crate) square: bool,
    pub(crate) steep: bool,
    start_major: f32,
    start_minor: f32,
    along_major: f32,
    along_minor: f32,
    inverse_length_squared: f32,
    pub(crate) reach: f32,
    minor_reach: f32,
    slope: f32,
    pub(crate) gain: f32,
    early: f32,
    late: f32,
    pub(crate) first: i32,
    pub(crate) last: i32,
    pub(crate) minor_size: i32,
}

/// Pixels of a footprint that are weighed together.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cells {
    pub(crate) major: Lanes<i32>,
    pub(crate) minor: Lanes<i32>,
    /// Lanes from here on hold no pixel of their own.
    pub(crate) count: usize,
}

#[inline]
fn span(first: i32, last: i32) -> u32 {
    (last - first).clamp(0, LONGEST_PX) as u32
}

impl Footprint {
    /// How much of a pixel the disc or streak covers, 0 to 1.
    #[inline]
    pub(crate) fn weight_at(&self, major: i32, minor: i32) -> f32 {
        let dx = center_of(major) - self.start_major;
        let dy = center_of(minor) - self.start_minor;
        let along = (dx * self.along_major + dy * self.along_minor) * self.inverse_length_squared;
        let t = clamp_unit(along);
        let ex = dx - t * self.along_major;
        let ey = dy - t * self.along_minor;
        let distance = square_root(ex * ex + ey * ey);
        clamp_unit(self.reach - distance) * (self.early + t * self.late)
    }

    /// How much of a pixel the square covers, 0 to 1.
    #[inline]
    pub(crate) fn square_weight_at(&self, major: i32, minor: i32) -> f32 {
        overlap(
            center_of(major),
            self.start_major - self.reach,
            self.start_major + self.reach,
        ) * overlap(
            center_of(minor),
            self.start_minor - self.reach,
            self.start_minor + self.reach,
        )
    }

    /// First and one past the last pixel along the minor axis that may be covered.
    #[inline]
    pub(crate) fn minor_range(&self, major: i32) -> (i32, i32) {
        let middle = self.start_minor + (center_of(major) - self.start_major) * self.slope;
        (
            to_i32(middle - self.minor_reach),
            to_i32(middle + self.minor_reach) + 1,
        )
    }

    /// No weight is above it, gain and all.
    pub(crate) fn most_weight(&self) -> f32 {
        self.gain * (self.early + self.late)
    }

    /// How much of each pixel the square covers, or the disc or streak before its gain.
    #[inline(always)]
    pub(crate) fn weights_at(&self, cells: &Cells) -> Lanes<f32> {
        if self.square {
            lanes(|lane| self.square_weight_at(cells.major[lane], cells.minor[lane]))
        } else {
            self.swept_weights_at(cells)
        }
    }

    /// Alone, this becomes instructions for several lanes; as part of more, it does not.
    #[inline(never)]
    fn swept_weights_at(&self, cells: &Cells) -> Lanes<f32> {
        lanes(|lane| self.weight_at(cells.major[lane], cells.minor[lane]))
    }

    /// Goes through the pixels that may be covered, of those rows across the major axis and of those
    /// places along the minor one, row by row, several at a time.
    #[inline(always)]
    pub(crate) fn each_cells(
        &self,
        majors: Range<i32>,
        minors: Range<i32>,
        mut take: impl FnMut(&Cells),
    ) {
        let mut cells = Cells::default();
        for major in majors {
            let (low, high) = self.minor_range(major);
            for minor in low.max(minors.start)..high.min(minors.end) {
                cells.major[cells.count] = major;
                cells.minor[cells.count] = minor;
                cells.count += 1;
                if cells.count == LANES {
                    take(&cells);
                    cells.count = 0;
                }
            }
        }
        if cells.count > 0 {
            take(&cells);
        }
    }

    /// First and one past the last row of pixels that may be covered.
    pub(crate) fn rows(&self) -> [i32; 2] {
        if self.steep || self.first >= self.last {
            return [self.first, self.last];
        }
        // Where the range lies grows or falls with the column, rounded or not.
        let (low, high) = self.minor_range(self.first);
        let (low_at_end, high_at_end) = self.minor_range(self.last - 1);
        [low.min(low_at_end), high.max(high_at_end)]
    }

    /// What makes the sum of the weights the area of the disc at rest, or with `swept` the area
    /// that it sweeps.
    fn gain_of(
        &self,
        radius_px: f32,
        first: i32,
        last: i32,
        cells: u32,
        moves: bool,
        swept: bool,
    ) -> f32 {
        if !moves && !less(radius_px, LARGE_RADIUS_PX) {
            return 1.0;
        }
        let length_squared =
            self.along_major * self.along_major + self.along_minor * self.along_minor;
        let edge = self.reach - 0.5;
        let area = if swept {
            PI * edge * edge + 2.0 * edge * square_root(length_squared)
        } else {
            PI * radius_px * radius_px
        };
        let mut sum = 2.0 * edge * square_root(length_squared) + PI * (edge * edge + 0.083_333_336);
        if cells <= FEW_CELLS {
            sum = 0.0;
            self.each_cells(first..last, i32::MIN..i32::MAX, |cells| {
                for weight in &self.swept_weights_at(cells)[..cells.count] {
                    sum += weight;
                }
            });
        }
        let gain = area * reciprocal(sum);
        let half = 0.5 * LARGE_RADIUS_PX;
        let share = clamp_unit((radius_px - half) * 0.5);
        if moves {
            gain
        } else {
            gain + share * (1.0 - gain)
        }
    }

    /// The footprint of a disc that moves from `start` to `end`; of a square if it is to be one.
    pub(crate) fn new(
        view: &Frame,
        start: Projected,
        end: Projected,
        radius_px: f32,
        square: bool,
        conserved: bool,
    ) -> Self {
        let dx = end.x - start.x;
        let dy = end.y - start.y;
        let length_squared = dx * dx + dy * dy;
        let moves = less(LEAST_WAY_SQUARED, length_squared);
        let steep = square || less(dx.abs(), dy.abs());
        let when_moving = |x: f32| if moves { x } else { 0.0 };
        let along_major = when_moving(if steep { dy } else { dx });
        let along_minor = when_moving(if steep { dx } else { dy });
        let inverse_length = inverse_square_root(length_squared);
        let slope = along_minor * reciprocal(along_major);
        let swept = !conserved && moves;
        let edge = if swept {
            max_exact(radius_px, 0.5)
        } else {
            edged_radius(radius_px)
        };
        let reach = if square { radius_px } else { edge + 0.5 };
        let minor_reach = reach * square_root(1.0 + slope * slope);
        let farthest = max_exact(
            max_exact(start.x.abs(), start.y.abs()),
            max_exact(end.x.abs(), end.y.abs()),
        );
        let is_near = !square && less(farthest, NEAR_PX);
        let mut shape = Self {
            square,
            steep,
            start_major: if steep { start.y } else { start.x },
            start_minor: if steep { start.x } else { start.y },
            along_major,
            along_minor,
            inverse_length_squared: when_moving(inverse_length * inverse_length),
            reach,
            minor_reach: if is_near {
                minor_reach - CENTER_TRIM_PX
            } else {
                minor_reach
            },
            slope,
            gain: 1.0,
            early: 1.0,
            late: 0.0,
            first: 0,
            last: 0,
            minor_size: 0,
        };
        let length = length_squared * inverse_length;
        let lateness = clamp_unit(0.25 * length * reciprocal(reach));
        if moves && view.flags & FRAME_EYE != 0 {
            shape.early = 1.0 - lateness;
            shape.late = 2.0 * lateness;
        }
        let end_major = shape.start_major + along_major;
        let first = to_i32(min_exact(shape.start_major, end_major) - reach)
            .clamp(-FARTHEST_PX, FARTHEST_PX);
        let last = (to_i32(max_exact(shape.start_major, end_major) + reach) + 1)
            .clamp(-FARTHEST_PX, FARTHEST_PX);
        let (width, height) = (view.width as i32, view.height as i32);
        let across = to_i32(2.0 * minor_reach) as u32 + 2;
        shape.first = first.max(0);
        shape.last = last.min(if steep { height } else { width });
        shape.minor_size = if steep { width } else { height };
        if !square {
            let cells = span(first, last) * across;
            shape.gain = shape.gain_of(radius_px, first, last, cells, moves, swept);
        }
        shape
    }
}
