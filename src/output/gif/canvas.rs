//! What a viewer shows after the frames so far, and the patch that turns it into the next one.

use std::collections::TryReserveError;

use rayon::prelude::*;

use super::histogram::{Histogram, filled};
use super::mask;
use super::mixing::Mixing;
use super::palette::Palette;
use crate::output::picture::over_black;

/// A pixel's shown colour is kept while its wanted colour stays this near (a channel) to the one it was chosen for:
/// too little to see, and noise of that size costs half the file.
const KEPT_DIFFERENCE: u8 = 2;

/// Marks a pixel that keeps its colour. No colour has its highest byte set.
const KEEP: u32 = u32::MAX;

/// The screen of a viewer of the GIF. Colours are packed `0x00bbggrr`.
pub(super) struct Canvas {
    width: usize,
    is_first: bool,
    /// The colour wanted when the shown one was chosen.
    meant: Vec<u32>,
    /// The colour that the palette had for it.
    shown: Vec<u32>,
    /// The picture at hand: what each pixel should become, or `KEEP`.
    wanted: Vec<u32>,
    histogram: Histogram,
}

/// A rectangle of palette indices that is laid over what is shown.
pub(super) struct Patch {
    pub(super) left: u16,
    pub(super) top: u16,
    pub(super) width: u16,
    pub(super) height: u16,
    /// Red, green, blue of each palette entry.
    pub(super) palette: Vec<u8>,
    /// The palette index that leaves a pixel as it is.
    pub(super) transparent: Option<u8>,
    /// `width * height` indices, the top row first.
    pub(super) indices: Vec<u8>,
}

struct Rectangle {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

impl Canvas {
    /// # Errors
    /// There is no room for it.
    pub(super) fn new(width: u16, height: u16) -> Result<Self, TryReserveError> {
        let width = usize::from(width);
        let pixel_count = width * usize::from(height);
        Ok(Self {
            width,
            is_first: true,
            meant: filled(0, pixel_count)?,
            shown: filled(0, pixel_count)?,
            wanted: filled(0, pixel_count)?,
            histogram: Histogram::new()?,
        })
    }

    /// Makes the canvas show a picture (RGBA, `width * height`) and gives the patch that does it.
    pub(super) fn draw(&mut self, rgba: &[u8]) -> Patch {
        let changed = self.find_changes(rgba);
        let rows = changed.top..changed.bottom;
        let span = changed.left..changed.right;
        self.histogram.clear();
        for row in rows.clone() {
            let row = &self.wanted[row * self.width..][..self.width];
            for &colour in &row[span.clone()] {
                if colour != KEEP {
                    self.histogram.add(colour);
                }
            }
        }
        let palette = Palette::fit(&self.histogram);
        let mixing = Mixing::new(&palette, &self.histogram);
        let transparent = (!self.is_first).then_some(palette.len() as u8);
        self.is_first = false;
        let mut indices = vec![transparent.unwrap_or(0); span.len() * rows.len()];
        let width = self.width;
        indices
            .par_chunks_mut(span.len())
            .zip(rows.clone())
            .zip(self.wanted[rows.start * width..].par_chunks(width))
            .zip(self.meant[rows.start * width..].par_chunks_mut(width))
            .zip(self.shown[rows.start * width..].par_chunks_mut(width))
            .for_each(|((((indices, y), wanted), meant), shown)| {
                let thresholds = mask::thresholds(y);
                for (index, x) in indices.iter_mut().zip(span.clone()) {
                    let colour = wanted[x];
                    if colour != KEEP {
                        *index = mixing.index(colour, thresholds[x % mask::SIDE]);
                        meant[x] = colour;
                        shown[x] = palette.colour(*index);
                    }
                }
            });
        Patch {
            left: changed.left as u16,
            top: changed.top as u16,
            width: span.len() as u16,
            height: rows.len() as u16,
            palette: palette.bytes(transparent.is_some()),
            transparent,
            indices,
        }
    }

    /// Fills `wanted` and gives the smallest rectangle with all that changes; one pixel of it where nothing does.
    fn find_changes(&mut self, rgba: &[u8]) -> Rectangle {
        let (width, is_first) = (self.width, self.is_first);
        let spans: Vec<Option<(usize, usize)>> = self
            .wanted
            .par_chunks_mut(width)
            .zip(rgba.par_chunks(4 * width))
            .zip(self.meant.par_chunks(width))
            .zip(self.shown.par_chunks(width))
            .map(|(((wanted, rgba), meant), shown)| {
                let (pixels, _) = rgba.as_chunks::<4>();
                for (x, wanted) in wanted.iter_mut().enumerate() {
                    let [red, green, blue] = over_black(pixels[x]);
                    let colour = u32::from_le_bytes([red, green, blue, 0]);
                    let keep = !is_first && keeps(colour, meant[x], shown[x]);
                    *wanted = if keep { KEEP } else { colour };
                }
                let first = wanted.iter().position(|&colour| colour != KEEP)?;
                let last = wanted.iter().rposition(|&colour| colour != KEEP)?;
                Some((first, last + 1))
            })
            .collect();
        let changed = || spans.iter().flatten();
        Rectangle {
            left: changed().map(|span| span.0).min().unwrap_or(0),
            right: changed().map(|span| span.1).max().unwrap_or(1),
            top: spans.iter().position(Option::is_some).unwrap_or(0),
            bottom: spans.iter().rposition(Option::is_some).unwrap_or(0) + 1,
        }
    }
}

/// Whether a pixel may stay as it is. Black is exact: it is kept only where black is shown, and it does not linger.
fn keeps(wanted: u32, meant: u32, shown: u32) -> bool {
    if wanted == 0 {
        return shown == 0;
    }
    let pairs = wanted.to_le_bytes().into_iter().zip(meant.to_le_bytes());
    wanted == shown
        || pairs
            .map(|(wanted, meant)| wanted.abs_diff(meant))
            .fold(0, u8::max)
            <= KEPT_DIFFERENCE
}
