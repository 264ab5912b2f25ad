//! The stable sort alone: as many pairs of random keys as asked for, put back before each run.

use super::device::GpuDevice;
use super::memory::check_available;
use super::readback;
use super::sort::{DIGIT_BITS, DIGITS, PASSES, RUN, counts};
use super::yardstick::{Ready, Work, Yardstick, compiled, ready};
use super::yardstick_memory::{buffer, fill};
use crate::backend::BackendError;

/// Bytes of a key and its value.
const PAIR: u64 = 8;

/// A kernel, with its invocations for so many pairs.
type Step = (&'static str, fn(u32) -> u32);

/// The kernels of a pass.
const KERNELS: [Step; 4] = [
    ("sort/count_digits", |pairs| pairs.div_ceil(RUN)),
    ("sort/sum_digits", |_| DIGITS),
    ("sort/start_digits", |_| 1),
    ("sort/place_digits", |pairs| pairs.div_ceil(RUN)),
];

/// The sort alone, and what it sorts.
#[derive(Debug)]
pub struct SortYardstick {
    /// To be run.
    pub yardstick: Yardstick,
    gpu: GpuDevice,
    unsorted: wgpu::Buffer,
    pairs: wgpu::Buffer,
    count: u32,
}

impl SortYardstick {
    /// The sort of `pairs` (1 ..= 10^9) of random keys, or of as many as one binding holds.
    ///
    /// # Errors
    /// Out of memory, or the device fails.
    pub fn new(gpu: &GpuDevice, pairs: u32, workgroup_size: u32) -> Result<Self, BackendError> {
        let limits = gpu.device.limits();
        let binding = limits.max_storage_buffer_binding_size;
        let most = binding.min(limits.max_buffer_size) / PAIR;
        let count = u64::from(pairs).clamp(1, most) as u32;
        let bytes = u64::from(count) * PAIR;
        check_available(gpu, 3 * bytes + u64::from(counts(count)) * 4)?;
        gpu.watched(|| {
            let storage = |name, bytes| buffer(gpu, name, bytes, wgpu::BufferUsages::STORAGE);
            let unsorted = storage("unsorted pairs", bytes);
            fill(gpu, &unsorted, 0)?;
            let list = [
                ("sort_pairs", storage("sort_pairs", bytes)),
                ("sorted_pairs", storage("sorted_pairs", bytes)),
                ("sort_count", storage("sort_count", 16)),
                (
                    "digit_counts",
                    storage("digit_counts", u64::from(counts(count)) * 4),
                ),
                (
                    "digit_starts",
                    storage("digit_starts", u64::from(DIGITS) * 4),
                ),
            ];
            gpu.write(&list[2].1, 0, bytemuck::bytes_of(&count))?;
            let mut dispatches: Vec<Ready> = Vec::new();
            let mut kernels = Vec::new();
            for (name, invocations) in KERNELS {
                kernels.push((compiled(gpu, name, workgroup_size)?, invocations(count)));
            }
            for pass in 0..PASSES {
                // Pairs go to and fro.
                let named = |name: &str| {
                    let name = match (name, pass % 2 == 1) {
                        ("sort_pairs", true) => "sorted_pairs",
                        ("sorted_pairs", true) => "sort_pairs",
                        (name, _) => name,
                    };
                    let mut all = list.iter();
                    all.find_map(|(of, buffer)| (*of == name).then_some(buffer))
                };
                for (kernel, invocations) in &kernels {
                    let work = (*invocations, kernel.compiled.workgroup_size[0]);
                    let immediates = [pass * DIGIT_BITS];
                    dispatches.push(ready(gpu, kernel, &named, &immediates, work)?);
                }
            }
            let work = Work::Dispatches(dispatches);
            let before = vec![(unsorted.clone(), list[0].1.clone())];
            Ok(Self {
                yardstick: Yardstick::new(gpu, "sort", work).after(before),
                gpu: gpu.clone(),
                unsorted,
                pairs: list[0].1.clone(),
                count,
            })
        })
    }

    /// How many pairs it sorts.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// What it sorts: keys and values in turn.
    ///
    /// # Errors
    /// The device fails.
    pub fn read_unsorted(&self) -> Result<Vec<u32>, BackendError> {
        self.read(&self.unsorted)
    }

    /// What it made of that when it was last run.
    ///
    /// # Errors
    /// The device fails.
    pub fn read_sorted(&self) -> Result<Vec<u32>, BackendError> {
        self.read(&self.pairs)
    }

    fn read(&self, of: &wgpu::Buffer) -> Result<Vec<u32>, BackendError> {
        let bytes = u64::from(self.count) * PAIR;
        self.gpu.watched(|| readback::words(&self.gpu, of, bytes))
    }
}
