//! At most 255 colours for one patch: black, and the colours that stand for the rest with the least error.
//!
//! The cells of the histogram are split by the box of largest squared error at the mean of its widest channel (as in
//! Wu 1991, with means in place of the best cut), and the colours are then moved to the means of the cells nearest to
//! them (Lloyd 1982).

use rayon::prelude::*;

use super::histogram::{EXACT_COLOURS, Histogram};

/// Rounds of Lloyd's algorithm: 3 % less error than without, in fireworks and glows. More change little.
const REFINEMENTS: usize = 3;

/// The colours of a patch; number 0 is black.
pub(super) struct Palette {
    /// Packed colours.
    colours: Vec<u32>,
    /// Whether every pixel of the patch has its own colour in it.
    is_exact: bool,
}

/// The colours of a cell in one point, with its say in where the palette goes.
#[derive(Clone, Copy)]
struct Sample {
    colour: [f32; 3],
    weight: f32,
}

impl Palette {
    /// The best colours for what was counted.
    pub(super) fn fit(histogram: &Histogram) -> Self {
        let mut colours = vec![0];
        if let Some(exact) = histogram.exact_colours() {
            colours.extend(exact);
            return Self {
                colours,
                is_exact: true,
            };
        }
        let mut samples: Vec<Sample> = histogram
            .filled_cells()
            .map(|(_, cell)| Sample {
                colour: cell.mean(),
                // A spark of ten pixels catches the eye like a haze of a thousand.
                weight: (cell.count as f32).sqrt(),
            })
            .collect();
        let mut centres = split(&mut samples);
        for _ in 0..REFINEMENTS {
            refine(&mut centres, &samples);
        }
        colours.extend(centres.iter().map(|&centre| packed(centre)));
        colours[1..].sort_unstable();
        colours.dedup();
        Self {
            colours,
            is_exact: false,
        }
    }

    /// Number of colours, at most 255.
    pub(super) fn len(&self) -> usize {
        self.colours.len()
    }

    /// The packed colour of an index.
    pub(super) fn colour(&self, index: u8) -> u32 {
        self.colours[usize::from(index)]
    }

    /// All packed colours.
    pub(super) fn colours(&self) -> &[u32] {
        &self.colours
    }

    /// Whether no pixel needs dithering.
    pub(super) fn is_exact(&self) -> bool {
        self.is_exact
    }

    /// Red, green, blue of every colour, and one more entry for transparent where it is needed.
    pub(super) fn bytes(&self, has_transparent: bool) -> Vec<u8> {
        let transparent = has_transparent.then_some(&0);
        self.colours
            .iter()
            .chain(transparent)
            .flat_map(|colour| colour.to_le_bytes().into_iter().take(3))
            .collect()
    }
}

/// The means of boxes that the samples are split into.
fn split(samples: &mut [Sample]) -> Vec<[f32; 3]> {
    let mut boxes = vec![ColourBox::around(samples, 0, samples.len())];
    while boxes.len() < EXACT_COLOURS {
        let Some((worst, _)) = boxes
            .iter()
            .enumerate()
            .filter(|(_, b)| b.spread > 0.0)
            .max_by(|(_, a), (_, b)| a.spread.total_cmp(&b.spread))
        else {
            break;
        };
        let ColourBox {
            start,
            end,
            channel,
            mean,
            ..
        } = boxes[worst];
        let middle = start + partition(&mut samples[start..end], channel, mean[channel]);
        if middle == start || middle == end {
            // The spread was but a rounding error.
            boxes[worst].spread = 0.0;
            continue;
        }
        boxes[worst] = ColourBox::around(samples, start, middle);
        boxes.push(ColourBox::around(samples, middle, end));
    }
    boxes.iter().map(|b| b.mean).collect()
}

/// Samples `start..end`, with what decides about splitting them.
struct ColourBox {
    start: usize,
    end: usize,
    mean: [f32; 3],
    /// Sum of squared distances from the mean along `channel`.
    spread: f32,
    /// The channel along which they spread most.
    channel: usize,
}

impl ColourBox {
    fn around(samples: &[Sample], start: usize, end: usize) -> Self {
        let samples = &samples[start..end];
        let total: f32 = samples.iter().map(|sample| sample.weight).sum();
        let mut mean = [0.0; 3];
        for sample in samples {
            for (mean, value) in mean.iter_mut().zip(sample.colour) {
                *mean += sample.weight * value;
            }
        }
        let mean = mean.map(|sum| sum / total);
        let mut spreads = [0.0_f32; 3];
        for sample in samples {
            for channel in 0..3 {
                let difference = sample.colour[channel] - mean[channel];
                spreads[channel] += sample.weight * difference * difference;
            }
        }
        let mut channel = 0;
        for other in 1..3 {
            if spreads[other] > spreads[channel] {
                channel = other;
            }
        }
        Self {
            start,
            end,
            mean,
            spread: spreads[channel],
            channel,
        }
    }
}

/// Moves samples up to `limit` along a channel before the others and gives their number.
fn partition(samples: &mut [Sample], channel: usize, limit: f32) -> usize {
    let mut low = 0;
    for at in 0..samples.len() {
        if samples[at].colour[channel] <= limit {
            samples.swap(low, at);
            low += 1;
        }
    }
    low
}

/// One round of Lloyd's algorithm. Black is a colour as well, and stays.
fn refine(centres: &mut [[f32; 3]], samples: &[Sample]) {
    let search = Nearest::new(std::iter::once([0.0; 3]).chain(centres.iter().copied()));
    let nearest: Vec<u8> = samples
        .par_iter()
        .with_min_len(256)
        .map(|sample| search.index(sample.colour))
        .collect();
    let mut sums = vec![[0.0_f32; 4]; centres.len() + 1];
    for (sample, &nearest) in samples.iter().zip(&nearest) {
        let Sample { colour, weight } = *sample;
        let [red, green, blue] = colour.map(|value| weight * value);
        let sum = &mut sums[usize::from(nearest)];
        for (sum, part) in sum.iter_mut().zip([red, green, blue, weight]) {
            *sum += part;
        }
    }
    for (centre, [red, green, blue, weight]) in centres.iter_mut().zip(sums.into_iter().skip(1)) {
        if weight > 0.0 {
            *centre = [red / weight, green / weight, blue / weight];
        }
    }
}

/// Colours laid out for a search through all of them, channel by channel.
pub(super) struct Nearest {
    pub(super) channels: [Vec<f32>; 3],
}

impl Nearest {
    /// For at most 256 colours.
    pub(super) fn new(colours: impl Iterator<Item = [f32; 3]>) -> Self {
        let mut channels = [const { Vec::new() }; 3];
        for colour in colours {
            for (channel, value) in channels.iter_mut().zip(colour) {
                channel.push(value);
            }
        }
        Self { channels }
    }

    /// The number of the nearest colour, the lowest of equals.
    pub(super) fn index(&self, colour: [f32; 3]) -> u8 {
        let [reds, greens, blues] = &self.channels;
        let mut distances = [f32::INFINITY; 256];
        for (((distance, red), green), blue) in
            distances.iter_mut().zip(reds).zip(greens).zip(blues)
        {
            let (r, g, b) = (red - colour[0], green - colour[1], blue - colour[2]);
            *distance = r * r + g * g + b * b;
        }
        lowest(&distances)
    }
}

/// The place of the lowest value, the first of equals.
pub(super) fn lowest(values: &[f32; 256]) -> u8 {
    let lowest = values.iter().copied().fold(f32::INFINITY, f32::min);
    values
        .iter()
        .position(|&value| value == lowest)
        .unwrap_or(0) as u8
}

fn packed(colour: [f32; 3]) -> u32 {
    let [red, green, blue] = colour.map(|channel| (channel + 0.5).clamp(0.0, 255.0) as u8);
    u32::from_le_bytes([red, green, blue, 0])
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Palette {
        /// A palette as it is given.
        pub(in super::super) fn of(colours: [u32; 3], is_exact: bool) -> Self {
            let colours = colours.to_vec();
            Self { colours, is_exact }
        }
    }

    #[test]
    fn refining_moves_colours_to_the_means_of_what_is_nearest() {
        let sample = |value: f32, weight: f32| Sample {
            colour: [value, 0.0, 50.0],
            weight,
        };
        // The first is nearer to black than to any other.
        let samples = [
            sample(1.0, 9.0),
            sample(90.0, 1.0),
            sample(130.0, 3.0),
            sample(250.0, 1.0),
        ];
        let mut centres = [[110.0, 0.0, 50.0], [255.0, 0.0, 0.0]];
        refine(&mut centres, &samples);
        assert_eq!(centres, [[120.0, 0.0, 50.0], [250.0, 0.0, 50.0]]);
    }

    #[test]
    fn splitting_finds_far_clusters_of_little_weight() {
        let mut samples: Vec<Sample> = (0..300)
            .map(|i| Sample {
                colour: [100.0 + i as f32 / 300.0, 100.0, 100.0],
                weight: 100.0,
            })
            .collect();
        let spark = [255.0, 10.0, 0.0];
        samples.push(Sample {
            colour: spark,
            weight: 1.0,
        });
        let centres = split(&mut samples);
        assert!(centres.len() == EXACT_COLOURS && centres.contains(&spark));
    }
}
