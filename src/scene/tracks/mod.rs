//! Values that change with the frame, by keys (Reeves 1983, 2.1, further work; section 3 for the
//! camera).
//!
//! Wherever a scene file takes a number or an array of numbers, a table `{ keys = [[0, 1.0],
//! [30, 2.5]] }` may stand instead. The scene then holds the first key's value, and a [`Track`]
//! holds the rest; [`Scene::at`] is the scene as it is at one time.

mod form;
mod places;
mod read;

use std::borrow::Cow;

pub(super) use form::{is_animated, pairs};
pub(super) use read::{collect, find};

use super::Scene;
use places::numbers_of;

/// How a value gets from one key to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// In a straight line.
    Linear,
    /// In a cubic without a corner at the keys, which never leaves the range of two neighbours
    /// (Fritsch and Butland 1984).
    Smooth,
    /// Not at all: it jumps at the next key.
    Step,
}

/// A value at a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// The frame.
    pub frame: f64,
    /// One to three numbers; the rest are 0.
    pub value: [f32; 3],
}

/// Whose value changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// [`Scene::image`].
    Image,
    /// [`Scene::camera`].
    Camera,
    /// One of [`Scene::systems`].
    System(usize),
    /// One of [`Scene::flocks`].
    Flock(usize),
    /// One of [`Scene::winds`].
    Wind(usize),
    /// One of [`Scene::lamps`].
    Lamp(usize),
    /// One of [`Scene::fires`].
    Fire(usize),
    /// One of [`Scene::surfaces`].
    Surface(usize),
}

/// A value that changes with the frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Whose.
    pub owner: Owner,
    /// Which value of it, as scene files have it: `position`, `speed.mean`.
    pub key: String,
    /// How it changes between keys.
    pub interpolation: Interpolation,
    /// In ascending order of frames, at least one; before the first and after the last it stays.
    pub keys: Vec<Key>,
}

impl Track {
    /// The value at a time, in frames. The same on every processor.
    pub fn at(&self, time: f64) -> [f32; 3] {
        let after = self.keys.partition_point(|key| key.frame <= time);
        let (Some(next), Some(here)) = (self.keys.get(after), after.checked_sub(1)) else {
            let end = if after == 0 {
                self.keys.first()
            } else {
                self.keys.last()
            };
            return end.map_or([0.0; 3], |key| key.value);
        };
        let key = &self.keys[here];
        let span = next.frame - key.frame;
        let t = (time - key.frame) / span;
        std::array::from_fn(|i| {
            let [low, high] = [key, next].map(|key| f64::from(key.value[i]));
            let value = match self.interpolation {
                Interpolation::Step => low,
                Interpolation::Linear => low + (high - low) * t,
                Interpolation::Smooth => {
                    let [leaving, arriving] = [here, after].map(|at| self.rise(at, i, span));
                    let u = 1.0 - t;
                    low * (u * u * (1.0 + 2.0 * t))
                        + leaving * (t * u * u)
                        + high * (t * t * (3.0 - 2.0 * t))
                        - arriving * (t * t * u)
                }
            };
            value as f32
        })
    }

    /// How far number `i` would go in `span` frames with its slope at a key: the harmonic mean of
    /// those to its neighbours, or 0 at an end and where they differ in sign.
    fn rise(&self, at: usize, i: usize, span: f64) -> f64 {
        let (Some(before), Some(next)) = (at.checked_sub(1), self.keys.get(at + 1)) else {
            return 0.0;
        };
        let [before, here] = [before, at].map(|at| self.keys[at]);
        let step = |from: Key, to: Key| f64::from(to.value[i]) - f64::from(from.value[i]);
        let (arriving, leaving) = (step(before, here), step(here, *next));
        if arriving == 0.0 || leaving == 0.0 || (arriving < 0.0) != (leaving < 0.0) {
            return 0.0;
        }
        // Frames can be so near that a slope is infinite; their ratios to the span are not.
        let (since, until) = (here.frame - before.frame, next.frame - here.frame);
        2.0 / ((since / arriving + until / leaving) / span)
    }

    /// Whether it is a value that newborns keep for life, and not one that acts on a whole system,
    /// on how many are born, or on all alike.
    pub fn rules_newborns(&self) -> bool {
        let acts_at_once = ["position", "rotation_degrees", "acceleration", "drag"];
        matches!(self.owner, Owner::System(_))
            && !acts_at_once.contains(&self.key.as_str())
            && !self.key.contains("_parts")
    }

    /// The greatest value at any key, number by number.
    fn greatest(&self) -> [f32; 3] {
        let numbers = |i: usize| self.keys.iter().map(move |key| key.value[i]);
        std::array::from_fn(|i| numbers(i).fold(f32::MIN, f32::max))
    }

    /// The least value at any key, number by number.
    fn least(&self) -> [f32; 3] {
        let numbers = |i: usize| self.keys.iter().map(move |key| key.value[i]);
        std::array::from_fn(|i| numbers(i).fold(f32::MAX, f32::min))
    }

    /// Puts the value at a time into its place in the scene.
    pub(super) fn put(&self, scene: &mut Scene, time: f64) {
        self.put_value(scene, self.at(time));
    }

    fn put_value(&self, scene: &mut Scene, value: [f32; 3]) {
        if let Some(numbers) = numbers_of(scene, self.owner, &self.key) {
            let count = numbers.len();
            numbers.copy_from_slice(&value[..count]);
        }
    }
}

impl Scene {
    /// The scene as it is at a time, in frames.
    pub fn at(&self, time: f64) -> Cow<'_, Self> {
        self.with(|track| track.at(time))
    }

    /// The scene as it is at a time within a frame of `frame`, as seen from it: values that jump at
    /// keys are those of the frame itself, and do not pass through what lies between.
    pub fn seen_from(&self, frame: f64, time: f64) -> Cow<'_, Self> {
        self.with(|track| match track.interpolation {
            Interpolation::Step => track.at(frame),
            Interpolation::Linear | Interpolation::Smooth => track.at(time),
        })
    }

    /// A scene that never is: every number with keys is as great as at the key where it is greatest.
    /// What any frame of the scene has of something that grows with its numbers, this has.
    pub fn greatest(&self) -> Cow<'_, Self> {
        self.with(Track::greatest)
    }

    /// As [`Scene::greatest`], of the least values.
    pub fn least(&self) -> Cow<'_, Self> {
        self.with(Track::least)
    }

    /// The scene without keys, each value that has some being what `value` says.
    fn with(&self, value: impl Fn(&Track) -> [f32; 3]) -> Cow<'_, Self> {
        if self.tracks.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut scene = Self {
            tracks: Vec::new(),
            ..self.clone()
        };
        for track in &self.tracks {
            track.put_value(&mut scene, value(track));
        }
        Cow::Owned(scene)
    }

    /// Every frame that a value has a key at.
    pub fn key_frames(&self) -> impl Iterator<Item = f64> + '_ {
        self.tracks
            .iter()
            .flat_map(|track| track.keys.iter().map(|key| key.frame))
    }
}
