//! Which two palette colours stand for a colour between them, and in which proportion.
//!
//! Ordered dithering for any palette: per cell of nearby colours, the nearest palette colour and the one whose mixture
//! with it comes closest; per pixel, the colour's place on the line between the two against a threshold that belongs to
//! the pixel's place on the screen. Unlike error diffusion, a change here moves nothing there.

use rayon::prelude::*;

use super::histogram::{CELL_COUNT, Histogram, cell_of};
use super::mask::LEVELS;
use super::palette::{Nearest, Palette, lowest};

/// What a squared step between two dithered colours costs, against the squared error of their mixture. The step itself
/// counts, however rarely it is taken: with none of it in the balance, far colours would be strewn in as single specks.
/// Measured on glows, flames and sparks: 0.01 adds grain and little accuracy, 0.1 shows bands.
const GRAIN_PENALTY: f32 = 0.03;

/// The palette index for every colour of a patch.
pub(super) struct Mixing<'a> {
    palette: &'a Palette,
    /// By cell; empty where the palette is exact.
    pairs: Vec<[u8; 2]>,
}

impl<'a> Mixing<'a> {
    /// Finds the pairs for all cells that the patch uses.
    pub(super) fn new(palette: &'a Palette, histogram: &Histogram) -> Self {
        let mut pairs = Vec::new();
        if !palette.is_exact() {
            pairs = vec![[0; 2]; CELL_COUNT];
            let search = Nearest::new(palette.colours().iter().map(|&colour| floats(colour)));
            let cells: Vec<(usize, [f32; 3])> = histogram
                .filled_cells()
                .map(|(number, cell)| (number, cell.mean()))
                .collect();
            let found: Vec<[u8; 2]> = cells
                .par_iter()
                .with_min_len(128)
                .map(|&(_, mean)| best_pair(&search, mean))
                .collect();
            for (&(number, _), pair) in cells.iter().zip(found) {
                pairs[number] = pair;
            }
        }
        Self { palette, pairs }
    }

    /// The index for a packed colour where the threshold is that of the pixel's place.
    pub(super) fn index(&self, colour: u32, threshold: u8) -> u8 {
        if colour == 0 {
            return 0;
        }
        if self.palette.is_exact() {
            let colours = &self.palette.colours()[1..];
            let place = colours.binary_search(&colour);
            return 1 + place.unwrap_or_else(|near| near.min(colours.len() - 1)) as u8;
        }
        let [a, b] = self.pairs[cell_of(colour)];
        if a == b {
            return a;
        }
        let [from, to, at] =
            [self.palette.colour(a), self.palette.colour(b), colour].map(u32::to_le_bytes);
        let (mut along, mut length) = (0, 0);
        for channel in 0..3 {
            let whole = i32::from(to[channel]) - i32::from(from[channel]);
            along += whole * (i32::from(at[channel]) - i32::from(from[channel]));
            length += whole * whole;
        }
        // along / length > (threshold + 1/2) / LEVELS
        if along * 2 * LEVELS > (2 * i32::from(threshold) + 1) * length {
            b
        } else {
            a
        }
    }
}

/// The nearest colour, and the one to mix it with (itself where mixing does not help).
fn best_pair(search: &Nearest, colour: [f32; 3]) -> [u8; 2] {
    let nearest = search.index(colour);
    let [reds, greens, blues] = &search.channels;
    let at = usize::from(nearest);
    let from = [reds[at], greens[at], blues[at]];
    let [r0, g0, b0] = [0, 1, 2].map(|channel| colour[channel] - from[channel]);
    let mut errors = [f32::INFINITY; 256];
    for (((error, red), green), blue) in errors.iter_mut().zip(reds).zip(greens).zip(blues) {
        let (r, g, b) = (red - from[0], green - from[1], blue - from[2]);
        let length = r * r + g * g + b * b;
        // A length of 0, the nearest colour itself, gives a share of 0.
        let share = ((r * r0 + g * g0 + b * b0) / length.max(1.0)).clamp(0.0, 1.0);
        let (r, g, b) = (r0 - share * r, g0 - share * g, b0 - share * b);
        *error = r * r + g * g + b * b + GRAIN_PENALTY * length;
    }
    [nearest, lowest(&errors)]
}

fn floats(colour: u32) -> [f32; 3] {
    let [red, green, blue, _] = colour.to_le_bytes().map(f32::from);
    [red, green, blue]
}

#[cfg(test)]
mod tests {
    use super::super::mask;
    use super::*;

    /// Greys 100 and 108 with nothing between them: every grey between is mixed of them in its proportion.
    #[test]
    fn proportions_are_those_of_the_colour() {
        let grey = |value: u8| u32::from_le_bytes([value, value, value, 0]);
        let palette = Palette::of([0, grey(100), grey(108)], false);
        let mut histogram = Histogram::new().expect("there is room");
        (100..=108).for_each(|value| histogram.add(grey(value)));
        let mixing = Mixing::new(&palette, &histogram);
        for value in 100..=108 {
            let thresholds = (0..mask::SIDE).flat_map(mask::thresholds);
            let bright = thresholds
                .filter(|&threshold| mixing.index(grey(value), threshold) == 2)
                .count();
            assert_eq!(bright, 8 * usize::from(value - 100), "grey {value}");
        }
    }

    /// A colour next to a palette colour is not mixed with a far one, which would be a visible speck.
    #[test]
    fn far_colours_are_not_strewn_in() {
        let palette = Palette::of([0, 0x0064_6464, 0x00ff_ffff], false);
        let mut histogram = Histogram::new().expect("there is room");
        histogram.add(0x0066_6666);
        let mixing = Mixing::new(&palette, &histogram);
        assert!((0..LEVELS as u8).all(|threshold| mixing.index(0x0066_6666, threshold) == 1));
    }
}
