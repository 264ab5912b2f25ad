//! Kernels alone: the yardsticks that passes are held against, all in the same run, in turn.
//!
//! There is a place for the stable counting sort of cells in [`gpu`]: a kernel that binds
//! `source`, `destination` and `table` is one line there.

mod cpu;
mod gpu;

use super::budget::Budget;
use super::copy::Copy;
use super::error::BenchError;
use super::lane::Lane;
use super::record::{Measure, gb_per_s};
use super::run::{Progress, Watch};
use super::splats::{SHAPES, SIZE_PX};
use super::spread::{Clock, Spread};
use super::target::Target;
use crate::backend::BackendError;
use crate::plan::FrameInputs;

/// The part of the time for a scene that one kernel may take.
const PART_OF_TIME: f64 = 0.2;

/// Beside scenes the copies are measured again: there is no need for more.
const MOST_SECS_FOR_COPIES: f64 = 1.0;

/// Runs a kernel once and tells its time.
type Run = Box<dyn FnMut() -> Result<(f64, Clock), BackendError>>;

/// A kernel under measurement.
struct Entry {
    name: String,
    note: Option<String>,
    /// Whether it is a form of the copy, of which the fastest is `copy_kernel`.
    is_copy: bool,
    /// Pixels covered, for those that draw.
    covered_px: Option<f64>,
    items: u64,
    bytes: u64,
    run: Run,
    samples: Vec<f64>,
    clock: Clock,
}

impl Entry {
    fn new(name: impl Into<String>, items: u64, bytes: u64, run: Run) -> Self {
        Self {
            name: name.into(),
            note: None,
            is_copy: false,
            covered_px: None,
            items,
            bytes,
            run,
            samples: Vec::new(),
            clock: Clock::Wall,
        }
    }

    fn noted(self, note: impl Into<String>) -> Self {
        Self {
            note: Some(note.into()),
            ..self
        }
    }

    fn is_done(&self, budget: &Budget) -> bool {
        let secs = self.samples.iter().sum::<f64>() * 1e-3;
        budget.is_enough(&self.samples, secs)
    }
}

/// Measures kernels alone, over so many particles or records (1 ..= 10^9), on one target: the
/// fastest copy, in all its forms; the interface's own copy; reads, writes, atomic additions; a
/// sample of noise; the prefix sum; the splat of each shape; and what the device's own rasteriser
/// needs for the same picture. The first is always `copy_kernel`, the second `copy_buffer`.
///
/// # Errors
/// [`BenchError`]: the machine fails, or `watch` says stop.
pub fn micro(
    target: &Target,
    particles: u32,
    budget: &Budget,
    watch: &mut Watch,
) -> Result<Vec<Measure>, BenchError> {
    let budget = Budget {
        secs: budget.secs * PART_OF_TIME,
        ..*budget
    };
    let mut entries = match target {
        Target::Cpu => {
            let copy = copy_entry(Copy::fastest(target, particles)?);
            std::iter::once(copy)
                .chain(cpu::entries(particles)?)
                .collect()
        }
        Target::Gpu(device) => gpu::entries(device, particles)?,
    };
    for shape in SHAPES {
        entries.push(splat(target, shape, (particles / shape.share).max(1))?);
    }
    if let Target::Gpu(device) = target {
        entries.extend(gpu::rasters(device, particles)?);
    }
    take(&mut entries, &budget, &mut |round| {
        watch(&rounds(particles, round))
    })?;
    Ok(told(entries))
}

/// So many rounds of kernels have been run.
fn rounds(particles: u32, round: u32) -> Progress<'static> {
    Progress {
        what: "micro",
        particles: Some(particles),
        is_warm_up: false,
        frames: round,
    }
}

/// Measures the two copies alone.
pub(super) fn copies(
    target: &Target,
    records: u32,
    budget: &Budget,
    watch: &mut Watch,
) -> Result<Vec<Measure>, BenchError> {
    let budget = Budget {
        secs: (budget.secs * PART_OF_TIME).min(MOST_SECS_FOR_COPIES),
        ..*budget
    };
    let mut entries = vec![copy_entry(Copy::fastest(target, records)?)];
    entries.push(match target {
        Target::Cpu => cpu::copy_buffer(records)?,
        Target::Gpu(device) => gpu::copy_buffer(device, records)?,
    });
    take(&mut entries, &budget, &mut |round| {
        watch(&rounds(records, round))
    })?;
    Ok(told(entries))
}

/// Runs all in turn, until each has been run often enough.
fn take(
    entries: &mut [Entry],
    budget: &Budget,
    go_on: &mut dyn FnMut(u32) -> bool,
) -> Result<(), BenchError> {
    // The first run of each compiles it, and gives its memory to what is written.
    for entry in &mut *entries {
        (entry.run)()?;
    }
    for round in 0..budget.most() {
        if !go_on(round) {
            return Err(BenchError::Stopped);
        }
        // In turn, so that what else the machine does falls on all alike.
        for entry in &mut *entries {
            if !entry.is_done(budget) {
                let (ms, clock) = (entry.run)()?;
                entry.samples.push(ms);
                entry.clock = clock;
            }
        }
        if entries.iter().all(|entry| entry.is_done(budget)) {
            break;
        }
    }
    Ok(())
}

fn told(mut entries: Vec<Entry>) -> Vec<Measure> {
    // Of several forms of the copy, the fastest is it.
    let median = |entry: &Entry| Spread::new(entry.samples.clone(), entry.clock).median;
    let forms = entries.iter_mut().filter(|entry| entry.is_copy);
    if let Some(fastest) = forms.min_by(|a, b| median(a).total_cmp(&median(b))) {
        let mut copy = Entry::new(
            "copy_kernel",
            fastest.items,
            fastest.bytes,
            Box::new(nothing),
        );
        copy.note.clone_from(&fastest.note);
        copy.samples.clone_from(&fastest.samples);
        copy.clock = fastest.clock;
        entries.insert(0, copy);
    }
    let copy_rate = entries
        .first()
        .and_then(|copy| gb_per_s(copy.bytes, median(copy)));
    let measure = |entry: Entry| {
        let Entry {
            name,
            note,
            covered_px,
            items,
            bytes,
            samples,
            clock,
            ..
        } = entry;
        let measure = Measure::new(name, samples, clock, items, bytes, copy_rate);
        let per_pixel = covered_px.map(|covered| {
            let ns = measure.ms.median * 1e6 / covered;
            format!("{ns:.2} ns a covered pixel")
        });
        let notes: Vec<String> = note.into_iter().chain(per_pixel).collect();
        Measure {
            note: (!notes.is_empty()).then(|| notes.join(", ")),
            ..measure
        }
    };
    entries.into_iter().map(measure).collect()
}

/// Of what has been measured under another name.
fn nothing() -> Result<(f64, Clock), BackendError> {
    Ok((0.0, Clock::Wall))
}

fn copy_entry(mut copy: Copy) -> Entry {
    let (form, bytes, records) = (copy.form.clone(), copy.bytes(), copy.records().into());
    Entry::new("copy_kernel", records, bytes, Box::new(move || copy.run())).noted(form)
}

fn splat(
    target: &Target,
    shape: &super::splats::Shape,
    particles: u32,
) -> Result<Entry, BenchError> {
    let (mut lane, inputs): (Lane, FrameInputs) = shape.lane(target, particles)?;
    let clock = lane.clock();
    let covered = shape.covered_px() * f64::from(particles);
    // A particle is read; light is read and written, at most all over the picture.
    let pixels = f64::from(SIZE_PX[0] * SIZE_PX[1]).min(covered) as u64;
    let bytes = u64::from(particles) * 32 + pixels * 24;
    let run = Box::new(move || Ok((lane.splat_ms(&inputs)?, clock)));
    Ok(Entry {
        covered_px: Some(covered),
        ..Entry::new(shape.name, particles.into(), bytes, run).noted(shape.about())
    })
}
