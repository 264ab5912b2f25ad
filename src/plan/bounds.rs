//! How many particles a scene can have at once, for how long one can live, and when it begins.

use super::PlanError;
use super::camera::camera_frame;
use super::stroke::is_stroke;
use super::system::{births_at, bounding_sphere, system_key};
use super::tree::bears_systems;
use crate::area::screen_area_px;
use crate::scene::{BirthUnit, Scene, System};

/// The largest capacity that a plan takes.
const MOST_PARTICLES: u64 = 1_000_000_000;

/// Most (system, frame) pairs that are looked at to find a bound.
const MOST_STEPS: u64 = 1 << 26;

/// What a pair costs more where values change with the frame: the scene is made anew for each, and
/// areas are found.
pub(super) const KEYED_COST: usize = 16;

/// Frames of a run in which some particle lives without limit, at most.
const MOST_UNLIMITED_FRAMES: i64 = 65_000;

/// No lifetime is longer: one with keys is at no time, though its greatest mean and half-width may
/// add up to more.
const MOST_LIFETIME: u32 = 65_001;

/// The frame that the run begins with: 0, or that of the earliest births.
pub(super) fn first_frame(scenes: &[&Scene]) -> i32 {
    let first = |system: &System| {
        let start = system.trigger_frames.first().copied().unwrap_or(0);
        let bursts = system.bursts.iter().map(|burst| burst.frame);
        start + bursts.fold(system.first_frame, i32::min)
    };
    let systems = scenes.iter().flat_map(|scene| &scene.systems);
    systems.map(first).fold(0, i32::min)
}

/// L_max: the longest lifetime that any system can draw, frames; that of the run where one is
/// unlimited.
pub(super) fn lifetime_bound(
    scenes: &[&Scene],
    first: i32,
    frame_end: u32,
) -> Result<u32, PlanError> {
    let frames = i64::from(frame_end) - i64::from(first);
    let mut longest = 1;
    for scene in scenes {
        let greatest = scene.greatest();
        for system in &greatest.systems {
            // Of systems that bear systems, it is those that live so long.
            if bears_systems(&greatest.systems, system) {
                continue;
            }
            // Strokes stay.
            let lifetime = match system.lifetime.filter(|_| !is_stroke(system)) {
                // Lifetimes are rounded to the nearest; the hundredth stands for single precision.
                Some(lifetime) => {
                    let own = system.inherit.lifetime;
                    let most = [lifetime.mean, lifetime.var, own.mean, own.var];
                    let most: f64 = most.into_iter().map(f64::from).sum();
                    (most + 0.51).floor() as u32
                }
                None if frames > MOST_UNLIMITED_FRAMES => {
                    return Err(PlanError {
                        message: format!(
                            "`system.{}` has no lifetime, or its strokes stay, and the run has {frames} \
                             frames",
                            system.name
                        ),
                        help: format!(
                            "a lifetime, or a scene (`frames`) and a run of at most \
                             {MOST_UNLIMITED_FRAMES} frames"
                        ),
                        key: Some(format!("system.{}", system.name)),
                    });
                }
                None => frames as u32 + 1,
            };
            longest = longest.max(lifetime);
        }
    }
    Ok(longest.min(MOST_LIFETIME))
}

/// A lifetime that no particle falls short of, at least 1 frame: the least mean at any time less
/// the greatest half-width.
pub(super) fn least_lifetime(scenes: &[&Scene]) -> u32 {
    let of_scene = |scene: &&Scene| {
        let (least, greatest) = (scene.least(), scene.greatest());
        let pairs = least.systems.iter().zip(&greatest.systems);
        let lifetimes = pairs.filter_map(|(least, greatest)| {
            let own = greatest.inherit.lifetime;
            let (least, greatest) = (least.lifetime?, greatest.lifetime?);
            // As in the bound above, a hundredth stands for single precision.
            let fewest = f64::from(least.mean) - f64::from(greatest.var) + 0.49
                - f64::from(own.mean)
                - f64::from(own.var);
            Some(fewest.floor().max(1.0) as u32)
        });
        lifetimes.min().unwrap_or(MOST_LIFETIME)
    };
    scenes.iter().map(of_scene).min().unwrap_or(1)
}

/// A bound on the particles in the pool at any frame below `frame_end`, newborns and those about
/// to be culled included. `births` is the most that all systems can ask for in a frame.
pub(super) fn capacity(
    births: impl Fn(i32) -> u64,
    systems: usize,
    lifetime_bound: u32,
    first: i32,
    frame_end: u32,
) -> Result<u32, PlanError> {
    let unknown = |message: String| PlanError {
        message,
        help: "give the scene `capacity = N`, the most particles alive at once; births beyond it \
               are left out and counted as dropped"
            .into(),
        key: None,
    };
    let frames = (i64::from(frame_end) - i64::from(first)) as usize;
    if frames as u64 * systems as u64 > MOST_STEPS {
        return Err(unknown(
            "this scene is too long to bound its particles".into(),
        ));
    }
    let life = lifetime_bound as usize;
    let mut born = Vec::with_capacity(frames);
    let mut present = 0u64;
    let mut most = 0;
    for at in 0..frames {
        born.push(births(first + at as i32));
        present += born[at];
        // Those born L_max + 1 frames ago were culled a frame ago.
        if let Some(dead) = at.checked_sub(life + 1) {
            present -= born[dead];
        }
        most = most.max(present);
    }
    if most > MOST_PARTICLES {
        return Err(unknown(format!(
            "this scene can have {most} particles at once, more than {MOST_PARTICLES}"
        )));
    }
    Ok((most as u32).max(1))
}

/// The screen area of each system, where births are counted by it; else 1.
pub(super) fn areas_of(now: &Scene) -> Vec<f32> {
    let view = camera_frame(now, now);
    let area = |system: &System| match system.births.per {
        BirthUnit::Frame => 1.0,
        BirthUnit::ScreenArea => screen_area_px(&view, bounding_sphere(system)),
    };
    now.systems.iter().map(area).collect()
}

/// The most births that all systems can ask for in a frame; `now` is the scene as it is then.
pub(super) fn births_bound(now: &Scene, areas: &[f32], frame: i32) -> u64 {
    let of_one = |(system, area): (&System, &f32)| {
        if system.parent.is_some() || bears_systems(&now.systems, system) {
            return 0;
        }
        let due = births_at(system, system_key(now.seed, &system.name), frame);
        let sum = |(mean, var)| f64::from(mean) + f64::from(var);
        let most = sum(due.births).max(0.0) * f64::from(*area) + sum(due.bursts).max(0.0);
        // Births are below 2^24 a system and frame.
        if most <= 0.0 {
            0
        } else {
            (most.ceil() as u64 + 1).min(1 << 24)
        }
    };
    now.systems.iter().zip(areas).map(of_one).sum()
}
