//! Sweeps as straight lines: what a frame takes with nothing in it, and what each one more costs.

use serde::Serialize;

use super::record::{Part, Run};

/// Counts below this say what a frame costs, not what one more particle does.
const MANY: f64 = 1e4;

/// Passes that take less of every frame are left out.
const LEAST_SHARE: f64 = 0.01;

/// What takes `a_ms` and `b_ns` each.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// A pass, or `whole step`, `whole draw`, `whole frame`.
    pub name: String,
    /// Half of the frame that a pass belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<Part>,
    /// Milliseconds with nothing in it.
    pub a_ms: f64,
    /// Nanoseconds that each one more takes, over the whole sweep.
    pub b_ns: f64,
    /// How far the time of any count is from the line, as a part of the line's.
    pub off: f64,
    /// The least and the most that each one more takes from one count to the next, of counts from 10^4
    /// on; `None` where there are fewer than three.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_ns: Option<[f64; 2]>,
}

impl Fit {
    /// How much more the dearest step costs than the cheapest; `None` where that says nothing.
    pub fn strays(&self) -> Option<f64> {
        let [least, most] = self.steps_ns?;
        (least > 0.0).then(|| most / least - 1.0)
    }

    /// The line through times of counts in ascending order; `None` of fewer than three.
    fn of(name: &str, part: Option<Part>, points: &[[f64; 2]]) -> Option<Self> {
        if points.len() < 3 || points.iter().any(|[_, ms]| *ms <= 0.0) {
            return None;
        }
        // Times of different counts are uncertain by as many percent, not milliseconds: each weighs
        // by the inverse of its square.
        let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
            points.iter().map(|[n, ms]| of(*n, *ms) / (ms * ms)).sum()
        };
        let (ones, n, nn) = (sum(&|_, _| 1.0), sum(&|n, _| n), sum(&|n, _| n * n));
        let (t, nt) = (sum(&|_, ms| ms), sum(&|n, ms| n * ms));
        let determinant = ones * nn - n * n;
        if determinant <= 0.0 {
            return None;
        }
        let free = [
            (t * nn - nt * n) / determinant,
            (ones * nt - n * t) / determinant,
        ];
        // Nothing takes less than no time.
        let [a_ms, b_ms] = match free {
            [a, _] if a < 0.0 => [0.0, nt / nn],
            [_, b] if b < 0.0 => [t / ones, 0.0],
            free => free,
        };
        let steps = points.windows(2).filter(|pair| pair[0][0] >= MANY);
        let steps: Vec<f64> = steps
            .map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]) * 1e6)
            .collect();
        let steps_ns = (steps.len() > 1).then(|| {
            let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
            let most = steps.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            [least, most]
        });
        let residual = |[n, ms]: &[f64; 2]| (ms / (a_ms + b_ms * n) - 1.0).abs();
        Some(Self {
            name: name.to_owned(),
            part,
            a_ms,
            b_ns: b_ms * 1e6,
            off: points.iter().map(residual).fold(0.0, f64::max),
            steps_ns,
        })
    }
}

/// The lines of a scene that was measured at three counts or more: of the passes that matter at some
/// count, then of step, drawing and frame. `runs` are all of one scene.
pub fn fits(runs: &[&Run]) -> Vec<Fit> {
    let count = |run: &Run| run.particles as f64;
    let mut runs = runs.to_vec();
    runs.sort_by(|a, b| count(a).total_cmp(&count(b)));
    runs.dedup_by(|a, b| count(a) == count(b));
    let Some(last) = runs.last() else {
        return Vec::new();
    };
    let matters = |name: &str| {
        runs.iter().any(|run| {
            let least_ms = run.frame_ms.median * LEAST_SHARE;
            let mut passes = run.passes.iter();
            passes.any(|pass| pass.name == name && pass.ms.median >= least_ms)
        })
    };
    let heavy = last.passes.iter().filter(|pass| matters(&pass.name));
    let mut fits: Vec<Fit> = heavy
        .filter_map(|heavy| {
            let point = |run: &&Run| {
                let pass = run.passes.iter().find(|pass| pass.name == heavy.name)?;
                Some([count(run), pass.ms.median])
            };
            let points: Vec<[f64; 2]> = runs.iter().filter_map(point).collect();
            Fit::of(&heavy.name, heavy.part, &points)
        })
        .collect();
    let whole = |name: &str, ms: fn(&Run) -> f64| {
        let points: Vec<[f64; 2]> = runs.iter().map(|run| [count(run), ms(run)]).collect();
        Fit::of(name, None, &points)
    };
    fits.extend(whole("whole step", |run| run.step_ms.median));
    fits.extend(whole("whole draw", |run| run.draw_ms.median));
    fits.extend(whole("whole frame", |run| run.frame_ms.median));
    fits
}

/// Scenes in the order in which they stand, each with its runs.
pub(super) fn by_scene(runs: &[Run]) -> Vec<(&str, Vec<&Run>)> {
    let mut scenes: Vec<(&str, Vec<&Run>)> = Vec::new();
    for run in runs {
        match scenes.iter_mut().find(|(scene, _)| *scene == run.scene) {
            Some((_, of_scene)) => of_scene.push(run),
            None => scenes.push((&run.scene, vec![run])),
        }
    }
    scenes
}

/// The lines of one scene of a record.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Sweep<'a> {
    scene: &'a str,
    counts: Vec<u64>,
    fits: Vec<Fit>,
}

/// Of each scene that was measured at three counts or more.
pub(super) fn sweeps(runs: &[Run]) -> Vec<Sweep<'_>> {
    let sweep = |(scene, runs): (_, Vec<&Run>)| {
        let fits = fits(&runs);
        let mut counts: Vec<u64> = runs.iter().map(|run| run.particles).collect();
        counts.sort_unstable();
        (!fits.is_empty()).then_some(Sweep {
            scene,
            counts,
            fits,
        })
    };
    by_scene(runs).into_iter().filter_map(sweep).collect()
}
