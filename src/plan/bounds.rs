//! How many particles a scene can have at once, and for how long one can live.

use super::PlanError;
use super::variant::{PlannedSystem, Variant};
use crate::scene::Scene;

/// The largest capacity that a plan takes.
const MOST_PARTICLES: u64 = 1_000_000_000;

/// Most (system, frame) pairs that are looked at to find a bound.
const MOST_STEPS: u64 = 1 << 26;

/// L_max: the longest lifetime that any system can draw, frames.
pub(super) fn lifetime_bound(scenes: &[&Scene]) -> u32 {
    scenes
        .iter()
        .flat_map(|scene| &scene.systems)
        .map(|system| {
            // Lifetimes are rounded to the nearest; the hundredth stands for single precision.
            let most = f64::from(system.lifetime.mean) + f64::from(system.lifetime.var);
            (most + 0.51).floor() as u32
        })
        .fold(1, u32::max)
}

/// A bound on the particles in the pool at any frame below `frame_end`, newborns and those about
/// to be culled included.
pub(super) fn capacity(
    variants: &[Variant],
    lifetime_bound: u32,
    frame_end: u32,
) -> Result<u32, PlanError> {
    let unknown = |message: String| PlanError {
        message,
        help: "give the scene `capacity = N`, the most particles alive at once; births beyond it \
               are left out and counted as dropped"
            .into(),
    };
    // Steps up and down of the bound, by frame.
    let mut changes = vec![0i64; frame_end as usize + 2];
    let mut steps = 0u64;
    for (at, variant) in variants.iter().enumerate() {
        let until = variants
            .get(at + 1)
            .map_or(frame_end, |next| next.first_frame.min(frame_end));
        for system in &variant.systems {
            let first = variant.first_frame.max(system.first_frame);
            let last = system.end_frame.map_or(until, |end| end.min(until));
            for frame in first..last {
                steps += 1;
                if steps > MOST_STEPS {
                    return Err(unknown(
                        "this scene is too long to bound its particles".into(),
                    ));
                }
                let births = births_bound(system, frame);
                if births == 0 && system.births.delta_mean_parts <= 0.0 {
                    break;
                }
                let dead = frame as usize + lifetime_bound.min(frame_end) as usize + 1;
                changes[frame as usize] += births;
                changes[dead.min(frame_end as usize + 1)] -= births;
            }
        }
    }
    let mut present = 0i64;
    let most = changes
        .iter()
        .map(|change| {
            present += change;
            present
        })
        .max()
        .unwrap_or(0);
    if most as u64 > MOST_PARTICLES {
        return Err(unknown(format!(
            "this scene can have {most} particles at once, more than {MOST_PARTICLES}"
        )));
    }
    Ok((most as u32).max(1))
}

/// The most births that the system can ask for in `frame`.
fn births_bound(system: &PlannedSystem, frame: u32) -> i64 {
    let (mean, var) = system.births_at(frame);
    let most = (f64::from(mean) + f64::from(var)) * f64::from(system.births_scale);
    // Births are below 2^24 a system and frame.
    if most <= 0.0 {
        0
    } else {
        (most.ceil() as i64 + 1).min(1 << 24)
    }
}
