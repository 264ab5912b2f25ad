//! One call of `motes bench`: everything that was asked for, on every target.

use super::budget::Budget;
use super::error::BenchError;
use super::job::Job;
use super::machine::record_of;
use super::micro::micro_in;
use super::record::{Measure, Record};
use super::run::{Watch, run_in};
use super::spread::Spread;
use super::target::Target;
use super::yard::{FAR, NEAR, Yard, YardTimes};
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
    let mut yards = Vec::new();
    for (target, record) in targets.iter().zip(&mut records) {
        let mut yard = Yard::new(target)?;
        let copied = copies(&mut yard, record)?;
        record.micro = match request.micro {
            true => alone(&mut yard, target, request, watch)?,
            false => copied,
        };
        yards.push(yard);
    }
    for scene in &request.scenes {
        for job in request.jobs(scene) {
            let runs = run_in(&mut yards, targets, &job, budget, watch)?;
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

/// The copies that all is held against, and what a dispatch costs, before anything else is run.
fn copies(yard: &mut Yard, record: &mut Record) -> Result<Vec<Measure>, BenchError> {
    let mut times = YardTimes::default();
    yard.measure_enough(&mut times)?;
    let rates = times.rates();
    record.copy_kernel_gb_per_s = rates.kernel;
    record.copy_buffer_gb_per_s = rates.buffer;
    record.dispatch_ms.clone_from(&rates.dispatch_ms);
    let copy = |name: &str, records: u32, ms: Spread, by_interface| {
        let bytes = u64::from(records) * 64;
        let measure = Measure::new(name, ms.samples, ms.clock, records.into(), bytes, None);
        measure.held_against(rates.floor_ms(bytes, by_interface))
    };
    let mut measures = vec![
        Measure {
            note: Some(yard.form().to_owned()),
            ..copy("copy_kernel", FAR, rates.copy_ms.clone(), false)
        },
        copy("copy_buffer", FAR, rates.buffer_ms.clone(), true),
        copy("copy_in_cache", NEAR, rates.near_ms.clone(), false),
    ];
    if let Some(ms) = &rates.dispatch_ms {
        let measure = Measure::new("dispatch", ms.samples.clone(), ms.clock, 1, 0, None);
        measures.push(Measure {
            note: Some("one that does nothing".into()),
            ..measure
        });
    }
    Ok(measures)
}

/// Kernels alone at every count; those of several carry it behind their names.
fn alone(
    yard: &mut Yard,
    target: &Target,
    request: &Request,
    watch: &mut Watch,
) -> Result<Vec<Measure>, BenchError> {
    let mut counts = request.particles.clone();
    if counts.is_empty() {
        counts.push(MICRO_RECORDS);
    }
    counts.sort_unstable();
    let mut all = Vec::new();
    for count in &counts {
        let mut measures = micro_in(yard, target, *count, &request.budget, watch)?;
        if counts.len() > 1 {
            for measure in &mut measures {
                measure.name = format!("{}@{count}", measure.name);
            }
        }
        all.extend(measures);
    }
    Ok(all)
}
