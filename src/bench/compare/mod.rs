//! Whether it got slower: records of two builds, held against each other.
//!
//! Runs are paired by scene and count, passes and kernels alone by name. Each is judged by
//! itself, with an interval of [`LEVEL`]: of a hundred that did not change, about one is called
//! slower or faster. What is too small to matter ([`LEAST_MS`], [`LEAST_SHARE`]) is told but fails nothing.

mod bootstrap;
mod pairing;
mod report;
mod student;
mod text;
mod warnings;

use std::collections::BTreeSet;
use std::fmt;

use super::record::Record;
pub use bootstrap::Change;
use pairing::one_adapter;
pub use report::comparisons_json;

/// Level of every interval.
pub const LEVEL: f64 = 0.99;

/// What takes less now, ms, fails nothing.
pub const LEAST_MS: f64 = 0.05;

/// A pass with a smaller share of the frame now fails nothing.
pub const LEAST_SHARE: f64 = 0.01;

/// How much longer one run of a build may take than another, at most, where no second run a side shows
/// it: an assumption, for machines that are not kept at one clock.
pub const BETWEEN_RUNS: f64 = 1.1;

/// An interval that reaches further from 1 than this tells nothing.
const WIDEST_SAME: f64 = 0.05;

/// The times of one adapter before and now.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Adapter, driver and interface of the old records.
    pub adapter: String,
    /// Those of the new records.
    pub new_adapter: String,
    /// Records before.
    pub old_records: usize,
    /// Records now.
    pub new_records: usize,
    /// All that both sides have, in the order of the old records.
    pub compared: Vec<Compared>,
    /// What only the old records have, in words.
    pub only_old: Vec<String>,
    /// What only the new records have, in words.
    pub only_new: Vec<String>,
    /// What a reader should know before believing the answer: first what the data cannot tell.
    pub warnings: Vec<String>,
}

/// What was timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A kernel alone.
    Micro,
    /// A pass of a run.
    Pass,
    /// The whole of a run's frame, step or drawing.
    Whole,
}

/// One thing, before and now.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Scene and particles; `None` for a kernel alone.
    pub run: Option<(String, u64)>,
    /// What was timed.
    pub kind: Kind,
    /// Its name; `frame`, `step` or `draw` for the whole.
    pub name: String,
    /// Median before, milliseconds.
    pub old_ms: f64,
    /// Median now, milliseconds.
    pub new_ms: f64,
    /// Its share of the frame now; `None` for a kernel alone.
    pub share_of_frame: Option<f64>,
    /// New time over old time; `None` where the samples are too few to tell.
    pub change: Option<Change>,
    /// The same of a pass, each frame's time over the pace of the frame's other passes: a machine that
    /// changes its pace hides a pass that slowed from the one, hardly from the other. `None` for what
    /// is no pass, or where there are too few others.
    pub against_rest: Option<Change>,
}

/// What an interval says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It lies above 1.
    Slower,
    /// It lies below 1.
    Faster,
    /// It holds 1, and nothing far from it.
    Same,
    /// It holds 1, and much else; or there is none.
    Unclear,
}

impl Compared {
    /// What its interval says.
    pub fn verdict(&self) -> Verdict {
        match self.change {
            Some(change) if change.low > 1.0 => Verdict::Slower,
            Some(change) if change.high < 1.0 => Verdict::Faster,
            Some(change) if change.reach() <= WIDEST_SAME => Verdict::Same,
            _ => Verdict::Unclear,
        }
    }

    /// Whether it is large enough to matter.
    pub fn matters(&self) -> bool {
        let share = self.share_of_frame.unwrap_or(1.0);
        self.new_ms >= LEAST_MS && share >= LEAST_SHARE
    }

    /// Whether it matters and its interval, or that against the rest of the frame, lies wholly above this
    /// many percent.
    pub fn is_slower_by(&self, percent: f64) -> bool {
        self.matters() && self.least_ratio() > 1.0 + percent / 100.0
    }

    /// How much longer it takes for certain: by its time, or by that against the rest of the frame.
    fn least_ratio(&self) -> f64 {
        let low = |change: Option<Change>| change.map_or(0.0, |change| change.low);
        // What is for certain faster by itself has not become slower.
        match self.verdict() {
            Verdict::Faster => low(self.change),
            _ => low(self.change).max(low(self.against_rest)),
        }
    }
}

impl Change {
    /// How far from 1 the interval reaches.
    fn reach(&self) -> f64 {
        (self.high - 1.0).max(1.0 - self.low)
    }
}

impl Comparison {
    /// What matters and slowed by more than this many percent, its whole interval.
    pub fn slower_by(&self, percent: f64) -> Vec<&Compared> {
        let compared = self.compared.iter();
        compared.filter(|it| it.is_slower_by(percent)).collect()
    }

    /// What slowed most for certain, of what matters. A pass or a kernel before the whole that it slows.
    pub fn slowed_most(&self) -> Option<&Compared> {
        let slower = || self.compared.iter().filter(|it| it.is_slower_by(0.0));
        let by_low = |it: &&Compared| it.least_ratio();
        let most = |all: &mut dyn Iterator<Item = _>| {
            all.max_by(|a: &&Compared, b: &&Compared| by_low(a).total_cmp(&by_low(b)))
        };
        most(&mut slower().filter(|it| it.kind != Kind::Whole)).or_else(|| most(&mut slower()))
    }
}

/// Records that cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CompareError {
    /// What is wrong.
    pub problem: String,
    /// What would be right.
    pub help: String,
}

impl fmt::Display for CompareError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error: {}\n  = help: {}", self.problem, self.help)
    }
}

impl std::error::Error for CompareError {}

/// Compares records, adapter by adapter. Equally many on both sides are taken as pairs, in their
/// order. With `any_adapter` those of one adapter are compared with those of another.
///
/// # Errors
/// The sides are of different adapters, or have nothing in common.
pub fn compare(
    old: &[Record],
    new: &[Record],
    any_adapter: bool,
) -> Result<Vec<Comparison>, CompareError> {
    let names = |records: &[Record]| records.iter().map(identity).collect::<BTreeSet<String>>();
    let (old_names, new_names) = (names(old), names(new));
    let joined = |names: &BTreeSet<String>| names.iter().cloned().collect::<Vec<_>>().join("; ");
    let mut comparisons = Vec::new();
    if old_names == new_names {
        for name in &old_names {
            let of = |records: &'_ [Record]| -> Vec<Record> {
                records
                    .iter()
                    .filter(|it| identity(it) == *name)
                    .cloned()
                    .collect()
            };
            comparisons.push(one_adapter(&of(old), &of(new)));
        }
    } else if !any_adapter {
        return Err(CompareError {
            problem: format!(
                "the records are of different adapters: {}, and {}",
                joined(&old_names),
                joined(&new_names)
            ),
            help: "measure both on one adapter and driver, or compare them all the same with --any-adapter".to_owned(),
        });
    } else if old_names.len() > 1 || new_names.len() > 1 {
        return Err(CompareError {
            problem: format!(
                "several adapters on a side cannot be matched with others: {}, and {}",
                joined(&old_names),
                joined(&new_names)
            ),
            help: "with --any-adapter, give records of one adapter a side".to_owned(),
        });
    } else {
        comparisons.push(one_adapter(old, new));
    }
    // Yardsticks are in every record: where both sides have scenes, they alone are nothing in common.
    let have_runs = |records: &[Record]| records.iter().any(|record| !record.runs.is_empty());
    let wants_runs = have_runs(old) && have_runs(new);
    let mut compared = comparisons.iter().flat_map(|it| &it.compared);
    match compared.any(|it| it.run.is_some() || !wants_runs) {
        true => Ok(comparisons),
        false => Err(CompareError {
            problem: "the records have no scene at the same count and no kernel alone in common"
                .to_owned(),
            help: "measure the same scenes with the same --particles".to_owned(),
        }),
    }
}

/// What must be equal for two records to be comparable.
fn identity(record: &Record) -> String {
    let Record {
        adapter,
        driver,
        backend,
        ..
    } = record;
    // The processor's driver is Motes itself, which is what may differ.
    match backend == "cpu" || driver.is_empty() {
        true => format!("{adapter} ({backend})"),
        false => format!("{adapter} ({backend}, {driver})"),
    }
}
