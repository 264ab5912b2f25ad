//! The yardstick of all others: the fastest copy of 32-byte records that the target can be made to
//! do, in whatever form.

use std::time::Instant;

use rayon::prelude::*;

use super::spread::Clock;
use super::target::Target;
use crate::backend::BackendError;
use crate::gpu::{GpuDevice, Yardstick, YardstickMemory};
use crate::layout::Particle;

/// Most records that forms are tried on: 64 MiB read and written. In a cache other forms are the
/// fastest than out of it.
const TRIAL_RECORDS: u32 = 1 << 20;

/// A way to copy: its name, its kernel, its invocations for so many records.
pub(super) type Form = (&'static str, &'static str, fn(u32) -> u32);

/// Ways to copy with a kernel.
const FORMS: &[Form] = &[
    ("a record an invocation", "bench/copy", |records| records),
    ("four words an invocation", "bench/copy_vec4", |records| {
        2 * records
    }),
    ("four words of 64 bits an invocation", WIDE, |records| {
        records
    }),
    ("runs of 16 records", "bench/copy_runs", |records| {
        records.div_ceil(16)
    }),
    ("eight strides", "bench/copy_strides", |records| {
        records.div_ceil(4)
    }),
];

/// The form for devices with 64-bit integers alone.
const WIDE: &str = "bench/copy_wide";

/// Ways that the device can copy.
pub(super) fn forms(device: &GpuDevice) -> impl Iterator<Item = &'static Form> {
    let wide = device.is_wide();
    FORMS
        .iter()
        .filter(move |(_, kernel, _)| wide || *kernel != WIDE)
}

/// Workgroups to try.
const WORKGROUPS: [u32; 3] = [64, 128, 256];

/// Timed runs of each form before one is taken.
const TRIALS: usize = 5;

/// Rounds over all forms and workgroup sizes before one is taken.
const ROUNDS: usize = 7;

/// What is so many times slower than the fastest is tried no more.
const HOPELESS: f64 = 2.0;

/// A copy that can be run again and again.
pub(super) struct Copy {
    /// Which form it has.
    pub(super) form: String,
    records: u32,
    work: Work,
}

enum Work {
    /// With the buffers that it binds.
    Gpu(Box<(Yardstick, YardstickMemory)>),
    Cpu(CpuCopy),
}

/// How the processor copies.
pub(super) struct CpuCopy {
    from: Vec<Particle>,
    to: Vec<Particle>,
    /// Records that a task takes; all of them for a single thread.
    chunk: usize,
}

/// How a target copies fastest.
pub(super) enum Fastest<'a> {
    /// A device: in this form, with workgroups of this size.
    Gpu(&'a GpuDevice, &'static Form, u32),
    /// The processor: that depends on how many.
    Cpu,
}

impl<'a> Fastest<'a> {
    /// The fastest of all forms and workgroup sizes for so many records: each is tried in turn, and again,
    /// so that a machine that changes its pace does so for all alike.
    pub(super) fn of(target: &'a Target, records: u32) -> Result<Self, BackendError> {
        let Target::Gpu(device) = target else {
            return Ok(Self::Cpu);
        };
        let memory = YardstickMemory::new(device, records.min(TRIAL_RECORDS))?;
        let mut tried = Vec::new();
        for form in forms(device) {
            for size in WORKGROUPS {
                let mut copy = Yardstick::kernel(&memory, "copy_kernel", form.1, size, form.2)?;
                // The first run compiles.
                copy.run()?;
                tried.push((f64::INFINITY, form, size, copy));
            }
        }
        for _ in 0..ROUNDS {
            for (least, _, _, copy) in &mut tried {
                *least = copy.run()?.ms.min(*least);
            }
            let best = tried
                .iter()
                .fold(f64::INFINITY, |best, one| best.min(one.0));
            tried.retain(|(least, ..)| *least <= best * HOPELESS);
        }
        let none = || BackendError::Internal("no form of the copy".into());
        let best = tried.iter().min_by(|a, b| a.0.total_cmp(&b.0));
        let (_, form, size, _) = best.ok_or_else(none)?;
        Ok(Self::Gpu(device, form, *size))
    }

    /// A copy of so many records.
    pub(super) fn copy(&self, records: u32) -> Result<Copy, BackendError> {
        match self {
            Self::Gpu(device, form, workgroup_size) => {
                let memory = YardstickMemory::new(device, records)?;
                let (name, kernel, invocations) = form;
                let copy =
                    Yardstick::kernel(&memory, "copy_kernel", kernel, *workgroup_size, invocations);
                Ok(Copy {
                    form: format!("{name}, workgroups of {workgroup_size}"),
                    records,
                    work: Work::Gpu(Box::new((copy?, memory))),
                })
            }
            Self::Cpu => {
                let mut copy = CpuCopy::new(records, records.max(1) as usize)?;
                let mut best: Option<(f64, usize)> = None;
                for chunk in [records.max(1) as usize, 8192, 65_536] {
                    copy.chunk = chunk;
                    let times: Vec<f64> = (0..=TRIALS).map(|_| copy.run()).collect();
                    let ms = times[1..].iter().copied().fold(f64::INFINITY, f64::min);
                    if best.is_none_or(|(least, _)| ms < least) {
                        best = Some((ms, chunk));
                    }
                }
                copy.chunk = best.map_or(copy.chunk, |(_, chunk)| chunk);
                Ok(Copy {
                    form: copy.form(),
                    records,
                    work: Work::Cpu(copy),
                })
            }
        }
    }
}

impl Copy {
    /// So many of it in a run, pass after pass on a device; a run's time is that of one.
    pub(super) fn repeated(self, passes: u32) -> Self {
        let work = match self.work {
            Work::Gpu(both) => {
                let (copy, memory) = *both;
                Work::Gpu(Box::new((copy.repeated(passes), memory)))
            }
            cpu => cpu,
        };
        Self { work, ..self }
    }

    /// What it copies from and to, on a device.
    pub(super) fn memory(&self) -> Option<&YardstickMemory> {
        match &self.work {
            Work::Gpu(both) => Some(&both.1),
            Work::Cpu(_) => None,
        }
    }

    /// How many it copies.
    pub(super) fn records(&self) -> u32 {
        self.records
    }

    /// Bytes read and written by a run.
    pub(super) fn bytes(&self) -> u64 {
        u64::from(self.records) * 2 * size_of::<Particle>() as u64
    }

    /// Runs it once.
    pub(super) fn run(&mut self) -> Result<(f64, Clock), BackendError> {
        match &mut self.work {
            Work::Gpu(both) => timed(&mut both.0),
            Work::Cpu(copy) => Ok((copy.run(), Clock::Wall)),
        }
    }
}

/// One run of a device's yardstick.
pub(super) fn timed(yardstick: &mut Yardstick) -> Result<(f64, Clock), BackendError> {
    let timed = yardstick.run()?;
    let clock = if timed.by_device {
        Clock::GpuTimestamps
    } else {
        Clock::Wall
    };
    Ok((timed.ms, clock))
}

/// The fastest workgroup size for this form.
pub(super) fn of_form(
    memory: &YardstickMemory,
    (_, kernel, invocations): &Form,
) -> Result<(f64, u32, Yardstick), BackendError> {
    let mut best: Option<(f64, u32, Yardstick)> = None;
    for size in WORKGROUPS {
        let mut yardstick = Yardstick::kernel(memory, "copy_kernel", kernel, size, invocations)?;
        // The first run compiles.
        yardstick.run()?;
        let mut times = Vec::new();
        for _ in 0..TRIALS {
            times.push(yardstick.run()?.ms);
        }
        // The least: what else the machine does makes none faster.
        let ms = times.into_iter().fold(f64::INFINITY, f64::min);
        if best.as_ref().is_none_or(|(least, ..)| ms < *least) {
            best = Some((ms, size, yardstick));
        }
    }
    best.ok_or_else(|| BackendError::Internal("no workgroup size".into()))
}

impl CpuCopy {
    pub(super) fn new(records: u32, chunk: usize) -> Result<Self, BackendError> {
        let mut from = crate::backend::try_zeroed(records as usize, "records to copy")?;
        let to = from.clone();
        for (at, record) in from.iter_mut().enumerate() {
            let word = (at as u32).wrapping_mul(0x9e37_79b9);
            *record = Particle {
                position_and_index: [word; 4],
                velocity_and_birth: [!word; 4],
            };
        }
        Ok(Self { from, to, chunk })
    }

    /// In words.
    pub(super) fn form(&self) -> String {
        if self.chunk >= self.from.len() {
            "one thread".into()
        } else {
            format!("all threads, {} records at a time", self.chunk)
        }
    }

    /// Milliseconds of one copy.
    pub(super) fn run(&mut self) -> f64 {
        let begun = Instant::now();
        if self.chunk >= self.from.len() {
            self.to.copy_from_slice(&self.from);
        } else {
            let to = self.to.par_chunks_mut(self.chunk);
            let both = to.zip(self.from.par_chunks(self.chunk));
            both.for_each(|(to, from)| to.copy_from_slice(from));
        }
        std::hint::black_box(&mut self.to);
        begun.elapsed().as_secs_f64() * 1e3
    }
}
