//! One call of `motes bench`: everything that was asked for, on every target.

use super::budget::Budget;
use super::copy::MOST_BESIDE;
use super::error::BenchError;
use super::machine::record_of;
use super::micro::{copies, micro};
use super::record::{Measure, Record};
use super::run::{Job, Watch, run};
use super::target::Target;
use crate::plan::Plan;
use crate::scene::Scene;

/// Records of a kernel alone where nobody says how many.
const MICRO_RECORDS: u32 = 1_000_000;

/// What is to be measured.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Scenes, no two of one name.
    pub scenes: Vec<Scene>,
    /// Counts of particles, 1 ..= 10^9, each once; none for the scenes as they are.
    pub particles: Vec<u32>,
    /// Whether kernels are measured alone, too, at each of these counts, or at 10^6.
    pub micro: bool,
    /// How long.
    pub budget: Budget,
}

impl Request {
    /// Whether all of it can be planned; [`measure`] asks this, too, before it begins.
    ///
    /// # Errors
    /// The first scene, and the name of it, that cannot.
    pub fn check(&self) -> Result<(), (String, BenchError)> {
        for scene in &self.scenes {
            for job in self.jobs(scene) {
                let planned = || Plan::new(&job.scaled()?, 1).map_err(BenchError::from);
                planned().map_err(|error| (scene.name.clone(), error))?;
            }
        }
        Ok(())
    }

    fn jobs<'a>(&self, scene: &'a Scene) -> Vec<Job<'a>> {
        let job = |particles| Job { scene, particles };
        if self.particles.is_empty() {
            return vec![job(None)];
        }
        self.particles
            .iter()
            .map(|count| job(Some(*count)))
            .collect()
    }
}

/// Measures everything on all targets; a record for each, in their order.
///
/// # Errors
/// [`BenchError`]: the input's fault before anything is run; a machine fails; or `watch` says stop.
pub fn measure(
    targets: &[Target],
    request: &Request,
    watch: &mut Watch,
) -> Result<Vec<Record>, BenchError> {
    request.check().map_err(|(_, error)| error)?;
    let mut records: Vec<Record> = targets.iter().map(record_of).collect();
    let budget = &request.budget;
    for (target, record) in targets.iter().zip(&mut records) {
        record.micro = if request.micro {
            alone(target, request, watch)?
        } else {
            copies(target, MICRO_RECORDS, budget, watch)?
        };
        let rate = |name: &str| {
            let mut measures = record.micro.iter();
            let found = measures.find(|measure| base(&measure.name) == name);
            found.and_then(|measure| measure.gb_per_s)
        };
        let rates = (rate("copy_kernel"), rate("copy_buffer"));
        (record.copy_kernel_gb_per_s, record.copy_buffer_gb_per_s) = rates;
    }
    for scene in &request.scenes {
        for job in request.jobs(scene) {
            let runs = run(targets, &job, budget, watch)?;
            for (record, run) in records.iter_mut().zip(runs) {
                record.runs.push(run);
            }
        }
    }
    if targets.len() > 1 {
        let names: Vec<_> = targets.iter().map(Target::name).collect();
        let told = format!(
            "measured in turn on {}: peak memory is that of all together",
            names.join(", ")
        );
        for record in &mut records {
            record.warnings.push(told.clone());
        }
    }
    Ok(records)
}

/// Kernels alone at every count; those of several carry it behind their names.
fn alone(
    target: &Target,
    request: &Request,
    watch: &mut Watch,
) -> Result<Vec<Measure>, BenchError> {
    let mut counts = request.particles.clone();
    if counts.is_empty() {
        counts.push(MICRO_RECORDS);
    }
    // The largest that is no larger than what copies are measured beside comes first, for its
    // copies are the record's.
    counts.sort_unstable_by_key(|count| (*count > MOST_BESIDE, u32::MAX - *count));
    let mut all = Vec::new();
    for count in &counts {
        let mut measures = micro(target, *count, &request.budget, watch)?;
        if counts.len() > 1 {
            for measure in &mut measures {
                measure.name = format!("{}@{count}", measure.name);
            }
        }
        all.extend(measures);
    }
    Ok(all)
}

/// A kernel's name without its count.
fn base(name: &str) -> &str {
    name.split('@').next().unwrap_or(name)
}
