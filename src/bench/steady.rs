//! From which frame on a scene is worth measuring.

use super::budget::Budget;
use super::error::BenchError;
use super::lane::Lane;
use crate::layout::FrameStats;
use crate::plan::{FrameInputs, Plan};
use crate::scene::Scene;

/// A population is steady when its count has stayed within [`STEADY`] over so many frames.
const STEADY_FRAMES: usize = 48;
/// See [`STEADY_FRAMES`].
const STEADY: f64 = 0.005;

/// From which frame on to measure, and how many.
pub(super) struct Span {
    pub(super) first: i64,
    /// Where the warm-up ends at the latest.
    pub(super) warm_end: i64,
    /// Frames to measure at most.
    pub(super) most: u32,
}

impl Span {
    pub(super) fn new(scene: &Scene, plan: &Plan, budget: &Budget) -> Self {
        let first = i64::from(plan.first_frame);
        let frames = i64::from(scene.frames);
        let is_steady = scene.steady_particles.is_some();
        // A scene that never becomes steady is measured in its second half at the latest.
        let latest = if is_steady { frames } else { frames / 2 };
        let all_have_lived = first + i64::from(plan.lifetime_bound);
        let warm_end = all_have_lived.min(latest).max(0).max(first + 1);
        let most = match budget.frames {
            None if !is_steady => budget.most().min((frames - warm_end).max(3) as u32),
            _ => budget.most(),
        };
        Self {
            first,
            warm_end,
            most,
        }
    }
}

/// Is told whether what comes is warm-up, and how many frames were before; fails when it is to end.
pub(super) type Ask<'a> = dyn FnMut(bool, u32) -> Result<(), BenchError> + 'a;

pub(super) fn inputs_of(plan: &Plan, frame: i64) -> FrameInputs {
    plan.inputs((frame as i32).cast_unsigned())
}

/// Steps until the population is steady; the next frame.
pub(super) fn warm_up(
    plan: &Plan,
    span: &Span,
    lanes: &mut [Lane],
    ask: &mut Ask,
) -> Result<i64, BenchError> {
    let mut counts: Vec<u32> = Vec::new();
    let mut frame = span.first;
    while frame < span.warm_end {
        ask(true, (frame - span.first) as u32)?;
        let inputs = inputs_of(plan, frame);
        for lane in &mut *lanes {
            lane.backend().step(&inputs)?;
        }
        frame += 1;
        if frame % 16 == 0 || frame == span.warm_end {
            for (at, lane) in lanes.iter_mut().enumerate() {
                let stats = lane.statistics()?;
                if at == 0 {
                    let lives = |line: &FrameStats| {
                        line.live.saturating_add(plan.boid_count + plan.flame_count)
                    };
                    counts.extend(stats.iter().map(lives));
                }
            }
            if frame > 0 && is_steady(&counts) {
                break;
            }
        }
    }
    // What draws is compiled when it is first used.
    let inputs = inputs_of(plan, frame - 1);
    for lane in &mut *lanes {
        for _ in 0..2 {
            lane.backend().draw(&inputs)?;
        }
        lane.statistics()?;
    }
    Ok(frame)
}

fn is_steady(counts: &[u32]) -> bool {
    let Some(recent) = counts.len().checked_sub(STEADY_FRAMES) else {
        return false;
    };
    strays(&counts[recent..]).is_some_and(|strays| strays <= STEADY)
}

/// How far counts lie apart, as a share of the greatest; `None` if that is 0.
pub(super) fn strays(counts: &[u32]) -> Option<f64> {
    let most = counts.iter().copied().max().filter(|most| *most > 0)?;
    let least = counts.iter().copied().min()?;
    Some(f64::from(most - least) / f64::from(most))
}
