//! Kernels alone: the yardsticks that passes are held against, all in the same run, in turn.

mod cpu;
mod gpu;

use std::time::Instant;

use super::budget::Budget;
use super::copy::{Copy, CpuCopy, Fastest};
use super::error::BenchError;
use super::flames::{FLAME_SIZES, FlameSize};
use super::lane::Lane;
use super::record::Measure;
use super::run::{Progress, Watch};
use super::splats::{SHAPES, SIZE_PX};
use super::spread::{Clock, Spread};
use super::target::Target;
use super::yard::{Rates, Yard, YardTimes};
use crate::backend::BackendError;
use crate::layout::FLAME_STEPS;
use crate::plan::{FrameInputs, Stage};

/// The part of the time for a scene that one kernel may take.
const PART_OF_TIME: f64 = 0.2;

/// Runs a kernel once and tells its time.
type Run = Box<dyn FnMut() -> Result<(f64, Clock), BackendError>>;

/// A kernel under measurement.
struct Entry {
    name: String,
    note: Option<String>,
    /// Whether it is a form of the copy, of which the fastest is `copy_kernel`.
    is_copy: bool,
    /// Whether it is a command of the interface, no kernel.
    by_interface: bool,
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
            by_interface: false,
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
/// sample of noise; the prefix sum; the splat of each shape; flames of each size; and what the device's own rasteriser
/// needs for the same picture. The first is always `copy_kernel`, the second `copy_buffer`. Shares
/// are of copies that fit in no cache, measured beside them.
///
/// # Errors
/// [`BenchError`]: the machine fails, or `watch` says stop.
pub fn micro(
    target: &Target,
    particles: u32,
    budget: &Budget,
    watch: &mut Watch,
) -> Result<Vec<Measure>, BenchError> {
    micro_in(&mut Yard::new(target)?, target, particles, budget, watch)
}

/// The same, held against copies that are there already.
pub(super) fn micro_in(
    yard: &mut Yard,
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
            let copy = copy_entry(Fastest::of(target, particles)?.copy(particles)?);
            std::iter::once(copy)
                .chain(cpu::entries(particles)?)
                .collect()
        }
        Target::Gpu(device) => gpu::entries(device, particles)?,
    };
    for shape in SHAPES {
        entries.push(splat(target, shape, (particles / shape.share).max(1))?);
    }
    for size in FLAME_SIZES {
        entries.push(flames(target, size, particles)?);
    }
    if let Target::Gpu(device) = target {
        entries.extend(gpu::rasters(device, particles)?);
    }
    let mut times = YardTimes::default();
    take(&mut entries, (yard, &mut times), &budget, &mut |round| {
        watch(&rounds(particles, round))
    })?;
    Ok(told(entries, &times.rates()))
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

/// The processor's own copy of so many records, as an interface would do it.
pub(super) fn copy_by_one_thread(records: u32) -> Result<CpuCopy, BackendError> {
    CpuCopy::new(records, usize::MAX)
}

/// Runs all in turn, until each has been run often enough.
fn take(
    entries: &mut [Entry],
    (yard, times): (&mut Yard, &mut YardTimes),
    budget: &Budget,
    go_on: &mut dyn FnMut(u32) -> bool,
) -> Result<(), BenchError> {
    // The first run of each compiles it, and gives its memory to what is written.
    for entry in &mut *entries {
        (entry.run)()?;
    }
    let begun = Instant::now();
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
        yard.measure_beside(times, begun.elapsed().as_secs_f64())?;
        if entries.iter().all(|entry| entry.is_done(budget)) {
            break;
        }
    }
    yard.measure_enough(times).map_err(BenchError::from)
}

fn told(mut entries: Vec<Entry>, rates: &Rates) -> Vec<Measure> {
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
    let measure = |entry: Entry| {
        let Entry {
            name,
            note,
            by_interface,
            covered_px,
            items,
            bytes,
            samples,
            clock,
            ..
        } = entry;
        let measure = Measure::new(name, samples, clock, items, bytes, None)
            .held_against(rates.floor_ms(bytes, by_interface));
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

/// Items are the particles along flames, each a fan of triangles.
fn flames(target: &Target, size: &FlameSize, particles: u32) -> Result<Entry, BenchError> {
    let (mut lane, inputs): (Lane, FrameInputs) = size.lane(target, particles)?;
    let clock = lane.clock();
    let count = size.flames(particles);
    let covered = size.covered_px() * f64::from(count);
    let fans = u64::from(count * FLAME_STEPS);
    // A fan's place is read, and it is written and read as it is seen.
    let bytes = fans * (16 + 2 * 48);
    let stages = [Stage::FlameDiscs, Stage::Glow];
    let run = Box::new(move || Ok((lane.stages_ms(&stages, &inputs)?, clock)));
    Ok(Entry {
        covered_px: Some(covered),
        ..Entry::new(size.name, fans, bytes, run).noted(size.about())
    })
}
