//! splat: particles add their light to the pixels that they cover (Reeves 1983, 2.5 and 3).
//! Twin of `wgsl/draw/splat.wgsl` and `wgsl/draw/splat_large.wgsl`, which share the work out.
//!
//! Here the picture is in bands of rows. What is seen of the particles is listed by band; then each
//! band is added to by one thread alone, without atomics, in a part of the picture that caches hold.

use std::sync::atomic::AtomicU64;

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::cpu::disc::{Discs, Ranges, SMALL_REACH_PX, SMALL_SIZES, Weighed, reach_of, size_of};
use crate::cpu::draw::planet::is_beyond;
use crate::cpu::footprint::Footprint;
use crate::cpu::lanes::{LANES, Lanes, lanes};
use crate::cpu::light::{FEW_STEPS, LIGHT_STEPS, LightSums, few_steps_of, steps_of};
use crate::cpu::particle::row_index;
use crate::cpu::reach::{is_visible, moves};
use crate::cpu::sprite::{Sprite, each_sprite, next_layer, sprite_of};
use crate::cpu::veil::{front_of, open_share};
use crate::exact::{dot3, less};
use crate::layout::{Particle, ROW_OVER, SystemRow};
use crate::plan::FrameInputs;

/// Rows of a band.
const BAND_ROWS: u32 = 32;
/// Particles that are listed together.
const LIST_LEN: usize = 16_384;
/// Lists at a time: what they hold stays in caches until it is drawn.
const LISTS: usize = 16;

/// A particle's colour, and how near its front is.
#[derive(Clone, Copy, Debug, Default)]
struct Shown {
    color: Vec3,
    front: u32,
}

/// A streak, a square or a larger disc.
#[derive(Clone, Copy, Debug, Default)]
struct Shape {
    footprint: Footprint,
    shown: Shown,
}

/// A small disc at rest.
#[derive(Clone, Copy, Debug, Default)]
struct Disc {
    center: Vec2,
    radius_px: f32,
    reach: f32,
    shown: Shown,
}

/// Things that have rows in bands, sorted by band and there by class; what has some rows in several is
/// there in each.
#[derive(Debug)]
struct ByBand<T, const CLASSES: usize> {
    things: Vec<T>,
    /// First and last band of each, and its class.
    spans: Vec<[u32; 3]>,
    sorted: Vec<T>,
    /// Where those of each band and class start, and the end.
    starts: Vec<u32>,
}

impl<T, const CLASSES: usize> Default for ByBand<T, CLASSES> {
    fn default() -> Self {
        Self {
            things: Vec::new(),
            spans: Vec::new(),
            sorted: Vec::new(),
            starts: Vec::new(),
        }
    }
}

impl<T: Copy + Default, const CLASSES: usize> ByBand<T, CLASSES> {
    fn clear(&mut self) {
        self.things.clear();
        self.spans.clear();
    }

    fn sort(&mut self, bands: usize) {
        let bucket = |band: u32, class: u32| band as usize * CLASSES + class as usize;
        self.starts.clear();
        self.starts.resize(bands * CLASSES + 1, 0);
        for &[first, last, class] in &self.spans {
            for band in first..=last {
                self.starts[bucket(band, class) + 1] += 1;
            }
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        self.sorted.resize(sum as usize, T::default());
        for (thing, &[first, last, class]) in self.things.iter().zip(&self.spans) {
            for band in first..=last {
                let start = &mut self.starts[bucket(band, class)];
                self.sorted[*start as usize] = *thing;
                *start += 1;
            }
        }
        // Each start has become the next one's.
        self.starts.rotate_right(1);
        self.starts[0] = 0;
    }

    fn of(&self, band: usize) -> &[T] {
        let [start, end] = [band, band + 1].map(|band| self.starts[band * CLASSES] as usize);
        &self.sorted[start..end]
    }
}

/// The band of a row of pixels, or of the row of the picture that is nearest.
#[inline(always)]
fn band_of(row: i32, height: i32) -> u32 {
    row.clamp(0, height - 1) as u32 / BAND_ROWS
}

/// What is seen of particles, as it is drawn.
#[derive(Debug, Default)]
pub struct Seen {
    /// Those of like size side by side, for they are drawn together.
    discs: ByBand<Disc, SMALL_SIZES>,
    shapes: ByBand<Shape, 1>,
}

/// Which particles are drawn, and as of which frame.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// What the frame is told.
    pub inputs: &'a FrameInputs,
    /// Parameter rows of systems at their births' frames.
    pub rows: &'a [SystemRow],
    /// How near surfaces are in each pixel's samples; empty if there are none.
    pub nearness: &'a [[u32; 4]],
    /// Which side of a planet's outline is drawn.
    pub is_behind: bool,
}

impl View<'_> {
    /// The parameter row of a particle, unless such cover.
    #[inline]
    fn row_of(&self, particle: &Particle) -> Option<&SystemRow> {
        let frame = &self.inputs.frame;
        let birth_frame = frame.frame.wrapping_sub(particle.age(frame.frame));
        let row = &self.rows[row_index(particle.slot(), birth_frame, frame.row_mask)];
        (row.kinds[3] & ROW_OVER == 0).then_some(row)
    }
}

/// A band of rows of the picture.
struct Band<'a> {
    sums: &'a mut [AtomicU64],
    nearness: &'a [[u32; 4]],
    width: usize,
    /// Its first row and one past its last.
    first: i32,
    end: i32,
}

impl Band<'_> {
    /// Adds to pixels of the band, one a lane.
    #[inline(always)]
    fn add(&mut self, places: &[i32], steps: &[Lanes<u32>; 3]) {
        let (pixels, _) = self.sums.as_chunks_mut::<3>();
        for (lane, place) in places.iter().enumerate() {
            for (sum, steps) in pixels[*place as usize].iter_mut().zip(steps) {
                let sum = sum.get_mut();
                *sum = sum.wrapping_add(u64::from(steps[lane]));
            }
        }
    }

    /// Takes from the light of pixels of the band what is behind surfaces.
    #[inline(always)]
    fn veil(&self, weights: &mut Lanes<f32>, places: &Lanes<i32>, fronts: &Lanes<u32>) {
        if self.nearness.is_empty() {
            return;
        }
        let first = self.first as usize * self.width;
        for ((weight, place), front) in weights.iter_mut().zip(places).zip(fronts) {
            *weight *= open_share(self.nearness[first + *place as usize], *front);
        }
    }
}

/// Whether [`few_steps_of`] holds for light of which no channel is above these; rounded, too, for there is a
/// factor of two between the limits.
#[inline(always)]
fn is_dim(most: [f32; 3]) -> bool {
    let few = |channel: f32| (0.0..FEW_STEPS * 0.5).contains(&(channel * LIGHT_STEPS));
    most.into_iter().all(few)
}

/// Light in steps, by channel and lane, where `is_dim` tells of all of it.
#[inline(always)]
fn steps_of_each(light: impl Fn(usize, usize) -> f32, is_dim: bool) -> [Lanes<u32>; 3] {
    let mut steps = [[0; LANES]; 3];
    for (channel, steps) in steps.iter_mut().enumerate() {
        *steps = if is_dim {
            lanes(|lane| few_steps_of(light(channel, lane)))
        } else {
            lanes(|lane| steps_of(light(channel, lane)))
        };
    }
    steps
}

/// The layer, from 1, that a world place is in.
#[inline]
pub(super) fn layer_of(planes: &[[f32; 4]], world: Vec3) -> u32 {
    let mut layer = 0;
    for (at, [x, y, z, offset]) in planes.iter().enumerate() {
        let signed_distance = dot3(Vec3::new(*x, *y, *z), world) - offset;
        layer = next_layer(layer, at as u32, signed_distance);
    }
    if layer == 0 {
        planes.len() as u32 + 1
    } else {
        layer
    }
}

/// Draws what is in the band of up to so many discs.
fn draw_discs(of: &[Disc], band: &mut Band<'_>) {
    let mut discs = Discs::default();
    let mut color = [[0.0; LANES]; 3];
    let mut fronts = [0; LANES];
    for (lane, disc) in of.iter().take(LANES).enumerate() {
        discs.x[lane] = disc.center.x;
        discs.y[lane] = disc.center.y;
        discs.radius_px[lane] = disc.radius_px;
        discs.reach[lane] = disc.reach;
        [color[0][lane], color[1][lane], color[2][lane]] = disc.shown.color.to_array();
        fronts[lane] = disc.shown.front;
    }
    let weighed = Weighed::new(&discs);
    let (left, top) = (&weighed.columns.first, &weighed.lines.first);
    let width = band.width as i32;
    let first_places = lanes(|lane| (top[lane] - band.first) * width + left[lane]);
    let is_dim = (0..LANES).all(|lane| {
        let most = |channel: &Lanes<f32>| channel[lane] * weighed.gain[lane];
        is_dim(color.each_ref().map(most))
    });
    for column in 0..weighed.most[0] {
        for line in 0..weighed.most[1] {
            let (across, down) = (column as i32, line as i32);
            // What is outside adds nothing, to some pixel or other.
            let is_inside = lanes(|lane| {
                let (x, y) = (left[lane] + across, top[lane] + down);
                (x >= 0) & (x < width) & (y >= band.first) & (y < band.end)
            });
            let place = lanes(|lane| {
                let place = first_places[lane] + down * width + across;
                if is_inside[lane] { place } else { 0 }
            });
            let mut weights = weighed.weights(column, line);
            band.veil(&mut weights, &place, &fronts);
            weights = lanes(|lane| if is_inside[lane] { weights[lane] } else { 0.0 });
            let light = |channel: usize, lane: usize| color[channel][lane] * weights[lane];
            let steps = steps_of_each(light, is_dim);
            band.add(&place[..of.len()], &steps);
        }
    }
}

impl Shape {
    /// Draws what is in the band.
    fn draw(&self, band: &mut Band<'_>) {
        let (shape, shown) = (&self.footprint, self.shown);
        let rows = (band.first, band.end);
        let (majors, minors) = if shape.steep {
            (rows, (0, shape.minor_size))
        } else {
            ((shape.first, shape.last), rows)
        };
        let majors = shape.first.max(majors.0)..shape.last.min(majors.1);
        let width = band.width as i32;
        let color = shown.color.to_array();
        let most = shape.most_weight();
        let is_dim = is_dim(color.map(|channel| channel * most));
        shape.each_cells(majors, minors.0..minors.1, |cells| {
            let (x, y) = if shape.steep {
                (&cells.minor, &cells.major)
            } else {
                (&cells.major, &cells.minor)
            };
            // Lanes without a pixel add nothing, to some pixel or other.
            let place = lanes(|lane| {
                let place = (y[lane] - band.first) * width + x[lane];
                if lane < cells.count { place } else { 0 }
            });
            let weights = shape.weights_at(cells);
            let mut weights = lanes(|lane| weights[lane] * shape.gain);
            band.veil(&mut weights, &place, &[shown.front; LANES]);
            let light = |channel: usize, lane: usize| color[channel] * weights[lane];
            let steps = steps_of_each(light, is_dim);
            band.add(&place[..cells.count], &steps);
        });
    }
}

impl Seen {
    /// Lists what is seen of `particles` in a picture of so many bands.
    fn list(&mut self, particles: &[Particle], view: View<'_>, bands: usize) {
        self.discs.clear();
        self.shapes.clear();
        let (blocks, rest) = particles.as_chunks::<LANES>();
        for block in blocks {
            self.see_block(block, view);
        }
        for particle in rest {
            self.see_one(particle, view);
        }
        self.span_discs(view.inputs.frame.height);
        self.discs.sort(bands);
        self.shapes.sort(bands);
    }

    /// Lists particles; those of one system and one birth frame together.
    fn see_block(&mut self, block: &[Particle; LANES], view: View<'_>) {
        let birth = block[0].velocity_and_birth[3];
        let is_of_it = |particle: &Particle| particle.velocity_and_birth[3] == birth;
        if !block.iter().all(is_of_it) {
            for particle in block {
                self.see_one(particle, view);
            }
            return;
        }
        if let Some(row) = view.row_of(&block[0]) {
            each_sprite(view.inputs, row, block, |sprite, reach| {
                self.see(sprite, reach, view);
            });
        }
    }

    fn see_one(&mut self, particle: &Particle, view: View<'_>) {
        if let Some(row) = view.row_of(particle) {
            let sprite = sprite_of(view.inputs, row, particle);
            self.see(sprite, reach_of(sprite.radius_px), view);
        }
    }

    /// Lists a sprite that reaches so far at rest, if it is seen and on that side of a planet's outline.
    #[inline]
    fn see(&mut self, sprite: Sprite, reach: f32, view: View<'_>) {
        let inputs = view.inputs;
        let frame = &inputs.frame;
        let Sprite {
            start,
            end,
            radius_px,
            ..
        } = sprite;
        if !is_visible(frame, start, end, radius_px) {
            return;
        }
        if frame.layer != 0 && layer_of(&inputs.layer_planes, sprite.world) != frame.layer {
            return;
        }
        if !inputs.planets.is_empty() && is_beyond(frame, sprite.world) != view.is_behind {
            return;
        }
        let shown = Shown {
            color: sprite.color,
            front: if view.nearness.is_empty() {
                0
            } else {
                front_of(frame, start.depth, radius_px)
            },
        };
        let rests = !moves(start, end) && !sprite.square;
        if rests && less(reach, SMALL_REACH_PX) {
            self.discs.things.push(Disc {
                center: Vec2::new(start.x, start.y),
                radius_px,
                reach,
                shown,
            });
            return;
        }
        let (square, conserved) = (sprite.square, sprite.conserved);
        let footprint = Footprint::new(frame, start, end, radius_px, square, conserved);
        let [first, end] = footprint.rows();
        let height = frame.height as i32;
        if first < end.min(height) && end > 0 {
            let (first, last) = (band_of(first, height), band_of(end - 1, height));
            self.shapes.spans.push([first, last, 0]);
            self.shapes.things.push(Shape { footprint, shown });
        }
    }

    /// Tells the bands and the sizes of discs.
    fn span_discs(&mut self, height: u32) {
        for discs in self.discs.things.chunks(LANES) {
            let (mut x, mut y, mut reach) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            for (lane, disc) in discs.iter().enumerate() {
                x[lane] = disc.center.x;
                y[lane] = disc.center.y;
                reach[lane] = disc.reach;
            }
            let (columns, lines) = (Ranges::new(&x, &reach), Ranges::new(&y, &reach));
            let first = lanes(|lane| band_of(lines.first[lane], height as i32));
            let last = lanes(|lane| {
                let last = lines.first[lane] + lines.count[lane] - 1;
                band_of(last, height as i32)
            });
            let size = lanes(|lane| size_of(columns.count[lane], lines.count[lane]));
            let spans = (0..discs.len()).map(|lane| [first[lane], last[lane], size[lane]]);
            self.discs.spans.extend(spans);
        }
    }

    /// Draws what is seen in the band of that number.
    fn draw(&self, number: usize, band: &mut Band<'_>) {
        for discs in self.discs.of(number).chunks(LANES) {
            draw_discs(discs, band);
        }
        for shape in self.shapes.of(number) {
            shape.draw(band);
        }
    }
}

/// Adds the light of `particles`; `seen` is room for lists, from frame to frame.
pub fn splat(particles: &[Particle], view: View<'_>, light: &mut LightSums, seen: &mut Vec<Seen>) {
    let (width, height) = (light.width as usize, light.height as usize);
    let rows = BAND_ROWS as usize;
    let bands = height.div_ceil(rows);
    let lists = particles.len().div_ceil(LIST_LEN).min(LISTS);
    if seen.len() < lists {
        seen.resize_with(lists, Seen::default);
    }
    for round in particles.chunks(LIST_LEN * LISTS) {
        let chunks = round.par_chunks(LIST_LEN);
        let seen = &mut seen[..chunks.len()];
        let lists = seen.par_iter_mut().zip(chunks).with_max_len(1);
        lists.for_each(|(list, chunk)| list.list(chunk, view, bands));
        let drawn = light.bands_mut(rows).enumerate().with_max_len(1);
        drawn.for_each(|(number, sums)| {
            let first = number * rows;
            let mut band = Band {
                sums,
                nearness: view.nearness,
                width,
                first: first as i32,
                end: (first + rows).min(height) as i32,
            };
            for list in &*seen {
                list.draw(number, &mut band);
            }
        });
    }
}
