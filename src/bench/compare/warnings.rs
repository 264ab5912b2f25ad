//! What differs between the sides besides the build.

use super::super::groups::groups;
use super::super::record::{Record, Run};
use super::{BETWEEN_RUNS, bootstrap};

/// A copy by a kernel that changed by more says that the machine did.
const MOST_COPY_CHANGE: f64 = 0.03;

/// All that a reader should know before believing the answer.
pub(super) fn warnings(old: &[Record], new: &[Record]) -> Vec<String> {
    let (Some(first), Some(second)) = (old.first(), new.first()) else {
        return Vec::new();
    };
    let mut warnings = limits(old, new);
    let mut differs = |what: &str, old: &str, new: &str| {
        if old != new {
            warnings.push(format!("{what} differs: {old:?} before, {new:?} now"));
        }
    };
    differs("the processor", &first.cpu, &second.cpu);
    differs("the system", &first.os, &second.os);
    let threads = [first, second].map(|record| record.cpu_threads.to_string());
    differs("the number of threads", &threads[0], &threads[1]);
    let options = [first, second].map(|record| {
        let options = record
            .options
            .iter()
            .map(|(key, value)| format!("{key} {value}"));
        options.collect::<Vec<_>>().join(", ")
    });
    differs("how kernels were run", &options[0], &options[1]);
    for run in &first.runs {
        let same = |other: &&Run| other.scene == run.scene && other.particles == run.particles;
        let Some(other) = second.runs.iter().find(same) else {
            continue;
        };
        let clock = |run: &Run| run.frame_ms.clock.name();
        differs(
            &format!("the size of {}'s picture", run.scene),
            &pixels(run),
            &pixels(other),
        );
        differs(
            &format!("the clock of {}", run.scene),
            clock(run),
            clock(other),
        );
        let live = [run, other].map(|run| run.live.unwrap_or(run.particles) as f64);
        if (live[1] / live[0].max(1.0) - 1.0).abs() > 0.02 {
            differs(
                &format!("the number of live particles of {}", run.scene),
                &live[0].to_string(),
                &live[1].to_string(),
            );
        }
    }
    warnings.extend(copy_warning(old, new));
    warnings
}

/// What the data cannot tell.
fn limits(old: &[Record], new: &[Record]) -> Vec<String> {
    let mut limits = Vec::new();
    if old.len().min(new.len()) < 2 {
        limits.push(format!(
            "one record a side cannot show how much two runs of one build differ: {:.0} % is allowed for that, \
             so nothing smaller is found; for more give several records, taken in turns (OLD1,OLD2,… NEW1,NEW2,…)",
            (BETWEEN_RUNS - 1.0) * 100.0
        ));
    }
    let runs = || old.iter().chain(new).flat_map(|record| &record.runs);
    let paces = |run: &Run| groups(&run.frame_ms.samples);
    let found: Vec<f64> = runs().filter_map(paces).map(|it| it.ratio).collect();
    if let Some(most) = found.iter().copied().reduce(f64::max) {
        limits.push(format!(
            "in {} of {} runs the frames fall into two groups, up to {most:.2} times apart: the machine changed its \
             pace, and what lies between the groups cannot be told from one record a side",
            found.len(),
            runs().count()
        ));
    }
    limits
}

fn pixels(run: &Run) -> String {
    run.image_px
        .map_or(String::new(), |[across, down]| format!("{across}x{down}"))
}

/// A copy does not depend on the build.
fn copy_warning(old: &[Record], new: &[Record]) -> Option<String> {
    let rate = |records: &[Record]| {
        let rates: Vec<f64> = records
            .iter()
            .filter_map(|it| it.copy_kernel_gb_per_s)
            .collect();
        (!rates.is_empty()).then(|| bootstrap::median(&rates))
    };
    let change = rate(new)? / rate(old).filter(|rate| *rate > 0.0)? - 1.0;
    (change.abs() > MOST_COPY_CHANGE).then(|| {
        let faster = if change > 0.0 { "faster" } else { "slower" };
        format!(
            "the copy by a kernel is {:.1} % {faster} now: unless it was changed itself, the machine was, and other \
             times with it",
            change.abs() * 100.0
        )
    })
}
