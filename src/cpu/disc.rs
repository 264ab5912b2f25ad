//! Small discs at rest: the pixels that they cover, and how much of each (Reeves 1983, 2.5).
//! Twin of `wgsl/lib/disc.wgsl`, which tells the pixels in bits; here several discs are weighed together, so that
//! the processor takes several in one instruction.

use crate::cpu::lanes::{LANES, Lanes, lanes};
use crate::cpu::reach::{PI, center_of, edged_radius};
use crate::exact::{
    at_least_zero, clamp_unit, floor_exact, reciprocal, shared_constants, square_root,
};

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

/// [`to_i32`](crate::exact::to_i32) of places in the picture and near it: vectors have no conversion that
/// clamps as the language's does. What is farther away, or not a number, becomes the end of that range.
#[inline(always)]
fn to_near_i32(x: f32) -> i32 {
    const FARTHEST: f32 = 65_536.0;
    // Beside it, floats are 1 apart.
    const MIDDLE: f32 = 12_582_912.0;
    let raised = if x > -FARTHEST { x } else { -FARTHEST };
    let near = if raised < FARTHEST { raised } else { FARTHEST };
    (floor_exact(near) + MIDDLE).to_bits() as i32 - MIDDLE.to_bits() as i32
}

/// How many sizes there are of small discs.
pub(crate) const SMALL_SIZES: usize = (SMALL_SIDE * SMALL_SIDE) as usize;

/// A small disc's size among them, by its columns and lines.
#[inline(always)]
pub(crate) fn size_of(columns: i32, lines: i32) -> u32 {
    let place = |count: i32| count.max(1) as u32 - 1;
    place(columns) * SMALL_SIDE + place(lines)
}

/// Pixels of discs along one axis: the first of each, and how many.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ranges {
    pub(crate) first: Lanes<i32>,
    pub(crate) count: Lanes<i32>,
}

impl Ranges {
    /// Those of discs that reach so far from `middle`.
    #[inline(always)]
    pub(crate) fn new(middle: &Lanes<f32>, reach: &Lanes<f32>) -> Self {
        let first = lanes(|lane| to_near_i32(middle[lane] - reach[lane] + 0.5));
        let last = lanes(|lane| to_near_i32(middle[lane] + reach[lane] - 0.5));
        Self {
            first,
            count: lanes(|lane| (last[lane] - first[lane] + 1).clamp(0, SMALL_SIDE as i32)),
        }
    }

    fn most(&self) -> usize {
        self.count.iter().fold(0, |most, count| most.max(*count)) as usize
    }

    /// Squared ways from `middle` to the centres of the pixels of that place in their ranges.
    #[inline(always)]
    fn squares(&self, place: usize, middle: &Lanes<f32>) -> Lanes<f32> {
        lanes(|lane| {
            let away = center_of(self.first[lane] + place as i32) - middle[lane];
            away * away
        })
    }
}

/// Discs, at rest and small: one that is not there has the radius 0 and no reach.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Discs {
    pub(crate) x: Lanes<f32>,
    pub(crate) y: Lanes<f32>,
    pub(crate) radius_px: Lanes<f32>,
    pub(crate) reach: Lanes<f32>,
}

/// The pixels of small discs, in the picture or not, and how much light each gets: their sum is the
/// disc's area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weighed {
    pub(crate) columns: Ranges,
    pub(crate) lines: Ranges,
    /// The most columns and lines of any.
    pub(crate) most: [usize; 2],
    /// By column and line, before the gain; 0 where a disc has none.
    weights: [[Lanes<f32>; SMALL_SIDE as usize]; SMALL_SIDE as usize],
    /// No weight is above it.
    pub(crate) gain: Lanes<f32>,
}

impl Weighed {
    /// Weighs the pixels of `discs`.
    #[inline]
    pub(crate) fn new(discs: &Discs) -> Self {
        let columns = Ranges::new(&discs.x, &discs.reach);
        let lines = Ranges::new(&discs.y, &discs.reach);
        let most = [columns.most(), lines.most()];
        let mut weights = [[[0.0; LANES]; SMALL_SIDE as usize]; SMALL_SIDE as usize];
        let mut down = [[0.0; LANES]; SMALL_SIDE as usize];
        for (line, down) in down[..most[1]].iter_mut().enumerate() {
            *down = lines.squares(line, &discs.y);
        }
        let mut sum = [0.0; LANES];
        for (column, weights) in weights[..most[0]].iter_mut().enumerate() {
            let across = columns.squares(column, &discs.x);
            for (line, weights) in weights[..most[1]].iter_mut().enumerate() {
                let down = &down[line];
                *weights = lanes(|lane| {
                    let distance = square_root(across[lane] + down[lane]);
                    let weight = clamp_unit(discs.reach[lane] - distance);
                    let is_its = ((column as i32) < columns.count[lane])
                        & ((line as i32) < lines.count[lane]);
                    if is_its { weight } else { 0.0 }
                });
                sum = lanes(|lane| sum[lane] + weights[lane]);
            }
        }
        Self {
            columns,
            lines,
            most,
            weights,
            gain: lanes(|lane| {
                let radius_px = discs.radius_px[lane];
                PI * radius_px * radius_px * reciprocal(sum[lane])
            }),
        }
    }

    /// What the pixels in that column and line get.
    #[inline(always)]
    pub(crate) fn weights(&self, column: usize, line: usize) -> Lanes<f32> {
        let weights = &self.weights[column][line];
        lanes(|lane| at_least_zero(weights[lane] * self.gain[lane]))
    }
}
