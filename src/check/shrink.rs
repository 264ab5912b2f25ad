//! A scene made small enough to be checked in seconds, with all that makes it what it is.

use crate::plan::{Plan, PlanError};
use crate::scene::{BirthUnit, Fire, Scene, System};

/// Most particles alive at once in a shrunk scene, about.
const MOST_PARTICLES: u32 = 20_000;

/// Most flames that stand on roots in a shrunk scene, about.
const MOST_FLAMES: u32 = 2_000;

/// A shrunk picture fits in this, pixels.
const MOST_WIDTH: u32 = 320;
/// See [`MOST_WIDTH`].
const MOST_HEIGHT: u32 = 180;

/// Frames that are enough where nothing lives long.
const FEW_FRAMES: u32 = 48;

/// Frames after the first deaths of old age.
const FRAMES_AFTER_DEATHS: u32 = 12;

/// Frames after the first births that are enough whatever happens later.
const MANY_FRAMES: u32 = 160;

/// Factors are tried until one fits; the bound on particles is nearly linear in births, so few
/// are needed.
const MOST_TRIES: u32 = 16;

/// How many frames show births and deaths of every system: at least 48, at most 160 from the first
/// births on, and no more than the scene lasts.
pub fn default_frames(scene: &Scene) -> u32 {
    let starts = || scene.systems.iter().flat_map(begins_at);
    let first = starts().min().unwrap_or(0).max(0).cast_unsigned();
    let last = starts().max().unwrap_or(0).max(0).cast_unsigned();
    let longest_life = scene
        .systems
        .iter()
        .filter_map(|system| system.lifetime)
        .map(|lifetime| (lifetime.mean + lifetime.var).ceil() as u32)
        .fold(0, u32::max);
    let enough = (last + longest_life + FRAMES_AFTER_DEATHS).clamp(FEW_FRAMES, first + MANY_FRAMES);
    scene.frames.min(enough)
}

/// The frames at which births of a system begin: those of each trigger, and bursts.
fn begins_at(system: &System) -> impl Iterator<Item = i32> + '_ {
    let triggers = match system.trigger_frames.as_slice() {
        [] => &[0],
        triggers => triggers,
    };
    triggers.iter().flat_map(move |trigger| {
        let bursts = system.bursts.iter().map(|burst| burst.frame);
        let births = std::iter::once(system.first_frame);
        births.chain(bursts).map(move |frame| trigger + frame)
    })
}

/// The scene with a picture that fits in 320×180 and fewer births, so that about 20,000 particles
/// are alive at once at most in its first `frames` frames, and as many boids,
/// and 2,000 flames. A scene that is small enough keeps its
/// births. Depends on nothing but its arguments.
///
/// # Errors
/// The scene cannot be planned however few its births.
pub fn shrunk(scene: &Scene, frames: u32) -> Result<Scene, PlanError> {
    let mut small = scene.clone();
    small.frames = frames;
    let image = &mut small.image;
    let fit = f64::min(
        f64::from(MOST_WIDTH) / f64::from(image.width),
        f64::from(MOST_HEIGHT) / f64::from(image.height),
    );
    if fit < 1.0 {
        let side = |pixels: u32| ((f64::from(pixels) * fit) as u32).max(1);
        (image.width, image.height) = (side(image.width), side(image.height));
    }
    let boids: u32 = small.flocks.iter().map(|flock| flock.count).sum();
    let share = f64::from(MOST_PARTICLES) / f64::from(boids.max(MOST_PARTICLES));
    for flock in &mut small.flocks {
        flock.count = ((f64::from(flock.count) * share) as u32).max(1);
    }
    let flames: u32 = small.fires.iter().map(Fire::count).sum();
    let share = f64::from(MOST_FLAMES) / f64::from(flames.max(MOST_FLAMES));
    for fire in &mut small.fires {
        fire.roots.scale(share);
    }
    if let Some(capacity) = scene.capacity
        && scene.systems.iter().any(|system| system.parent.is_some())
    {
        // What systems ask for that are yet to be born has a bound far above it; the capacity says
        // more, and births by screen area fall with the picture.
        let by_area = |system: &System| {
            system.births.per == BirthUnit::ScreenArea && !scene.bears_systems(&system.name)
        };
        let falls = if scene.systems.iter().any(by_area) {
            fit.min(1.0) * fit.min(1.0)
        } else {
            1.0
        };
        let likely = f64::from(capacity) * falls;
        let mut small = small.with_births((f64::from(MOST_PARTICLES) / likely).min(1.0));
        small.capacity = Some(capacity.min(MOST_PARTICLES));
        return Plan::new(&small, frames).map(|_| small);
    }
    let mut factor = 1.0f64;
    for _ in 0..MOST_TRIES {
        // The scene's own capacity says nothing about how many there will be.
        let unbounded = Scene {
            capacity: None,
            ..small.with_births(factor)
        };
        factor *= match Plan::new(&unbounded, frames) {
            Ok(plan) if plan.capacity <= MOST_PARTICLES => break,
            // A little further than the proportion, for the bound counts whole particles.
            Ok(plan) => 0.95 * f64::from(MOST_PARTICLES) / f64::from(plan.capacity),
            Err(_) => 1.0 / 1024.0,
        };
    }
    let mut small = small.with_births(factor);
    small.capacity = small.capacity.map(|most| most.min(MOST_PARTICLES));
    Plan::new(&small, frames).map(|_| small)
}
