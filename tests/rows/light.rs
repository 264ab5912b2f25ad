//! Pictures as sums of light, before they are clamped to bytes.

use std::cell::RefCell;
use std::collections::HashMap;

use motes::plan::Plan;

use crate::support::{Run, scene};

/// The sums of light of an image, three channels a pixel, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Light {
    pub(crate) width: usize,
    /// Counts of 2^-20.
    pub(crate) steps: Vec<u64>,
}

impl Light {
    /// Light of a channel of the pixel at column `x`, row `y`.
    pub(crate) fn at(&self, x: usize, y: usize, channel: usize) -> f64 {
        self.steps[(y * self.width + x) * 3 + channel] as f64 / f64::from(1 << 20)
    }

    /// Every pixel's centre, in pixels from the left top corner, and its light in a channel.
    pub(crate) fn pixels(&self, channel: usize) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let places = (0..self.steps.len() / 3).map(|at| (at % self.width, at / self.width));
        places.map(move |(x, y)| (x as f64 + 0.5, y as f64 + 0.5, self.at(x, y, channel)))
    }

    /// All light of a channel.
    pub(crate) fn total(&self, channel: usize) -> f64 {
        self.pixels(channel).map(|(_, _, light)| light).sum()
    }

    /// Whether no light has fallen anywhere.
    pub(crate) fn is_dark(&self) -> bool {
        self.steps.iter().all(|&steps| steps == 0)
    }
}

/// Bright, so that rounding to steps of light does not matter; sums are not clamped.
const BRIGHT: &str = "lifetime = 1\n color = [64, 32, 16]";

thread_local! {
    /// Runs by backend, size of the picture and shape of the particles: a run takes long to begin
    /// on an adapter, and particles of one frame leave no trace in the next.
    static KEPT: RefCell<HashMap<String, Run>> = RefCell::default();
}

/// Drops the kept runs, also when a test fails: a device cannot be let go of when its thread's
/// own variables are gone.
pub(crate) struct EmptyAtTheEnd;

impl Drop for EmptyAtTheEnd {
    fn drop(&mut self) {
        KEPT.with_borrow_mut(HashMap::clear);
    }
}

/// What one particle of these lines adds to the picture of its only frame.
pub(crate) fn light_of(on: &str, picture: &str, lines: &str) -> Light {
    let scene = scene(picture, &[&format!("{BRIGHT}\n{lines}")]);
    let plan = Plan::new(&scene, 1).expect("the scene can be planned");
    let shape = scene.systems[0].particle_shape;
    let key = format!("{on}, {} x {}, {shape:?}", plan.width, plan.height);
    KEPT.with_borrow_mut(|kept| {
        let run = kept
            .entry(key)
            .or_insert_with(|| Run::of_plan(on, plan.clone()));
        run.simulation
            .step_with(plan.inputs(0))
            .expect("the backend steps");
        run.light()
    })
}

/// Pixels that the light of such a particle would fill.
pub(crate) fn coverage(light: &Light) -> f64 {
    light.total(0) / 64.0
}
