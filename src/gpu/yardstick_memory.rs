//! The buffers that yardsticks work on.

use super::device::GpuDevice;
use super::memory::check_available;
use super::readback;
use crate::backend::BackendError;
use crate::layout::{Counts, Frame, FrameStats, Particle, SpreadCounts};

/// Words that atomic additions are spread over: as many as a picture of 1280 x 720 pixels has in
/// one limb of its light, rounded to a power of two.
pub const TABLE_WORDS: u32 = 1 << 21;

/// Words that are written at a time.
const CHUNK_WORDS: u32 = 1 << 20;

/// Records of 32 bytes in pages, as the pools have them, and what else yardsticks bind.
#[derive(Debug)]
pub struct YardstickMemory {
    pub(super) gpu: GpuDevice,
    pub(super) records: u32,
    pub(super) pages: Vec<Page>,
    named: Vec<(&'static str, wgpu::Buffer)>,
}

/// A binding's worth of records.
#[derive(Debug)]
pub(super) struct Page {
    pub(super) records: u32,
    pub(super) source: wgpu::Buffer,
    pub(super) destination: wgpu::Buffer,
}

impl YardstickMemory {
    /// Room for `records` (1 ..= 10^9) that are read and as many that are written.
    ///
    /// # Errors
    /// Out of memory, or the device fails.
    pub fn new(gpu: &GpuDevice, records: u32) -> Result<Self, BackendError> {
        let limits = gpu.device.limits();
        let most = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size);
        let page_len = (most / size_of::<Particle>() as u64).min(1 << 23) as u32 / 2048 * 2048;
        let records = records.max(1);
        check_available(gpu, u64::from(records) * 64 + u64::from(TABLE_WORDS) * 4)?;
        gpu.watched(|| {
            let starts = (0..records).step_by(page_len as usize);
            let page = |start: u32| page(gpu, start, page_len.min(records - start));
            let pages = starts.map(page).collect::<Result<_, _>>()?;
            Ok(Self {
                gpu: gpu.clone(),
                records,
                pages,
                named: named(gpu, records)?,
            })
        })
    }

    /// Records of each kind.
    pub fn records(&self) -> u32 {
        self.records
    }

    /// Words of what is read, all pages after each other.
    ///
    /// # Errors
    /// The device fails.
    pub fn read_source(&self) -> Result<Vec<u32>, BackendError> {
        self.read(|page| &page.source)
    }

    /// Words of what is written.
    ///
    /// # Errors
    /// The device fails.
    pub fn read_destination(&self) -> Result<Vec<u32>, BackendError> {
        self.read(|page| &page.destination)
    }

    fn read(&self, of: impl Fn(&Page) -> &wgpu::Buffer) -> Result<Vec<u32>, BackendError> {
        self.gpu.watched(|| {
            let mut all = Vec::new();
            for page in &self.pages {
                let bytes = u64::from(page.records) * size_of::<Particle>() as u64;
                all.extend(readback::words(&self.gpu, of(page), bytes)?);
            }
            Ok(all)
        })
    }

    pub(super) fn named<'a>(
        &'a self,
        name: &str,
        page: Option<&'a Page>,
    ) -> Option<&'a wgpu::Buffer> {
        match (name, page) {
            ("source", Some(page)) => Some(&page.source),
            ("destination", Some(page)) => Some(&page.destination),
            _ => self
                .named
                .iter()
                .find_map(|(of, buffer)| (*of == name).then_some(buffer)),
        }
    }
}

pub(super) fn buffer(
    gpu: &GpuDevice,
    label: &str,
    bytes: u64,
    more: wgpu::BufferUsages,
) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.next_multiple_of(16),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC | more,
        mapped_at_creation: false,
    })
}

/// Fills with random words from number `first` on: a copy of zeros can be quicker than one of data.
pub(super) fn fill(gpu: &GpuDevice, buffer: &wgpu::Buffer, first: u64) -> Result<(), BackendError> {
    let words = buffer.size() / 4;
    for start in (0..words).step_by(CHUNK_WORDS as usize) {
        let end = (start + u64::from(CHUNK_WORDS)).min(words);
        let chunk: Vec<u32> = (start..end)
            .map(|at| {
                ((first + at) as u32)
                    .wrapping_mul(0x9e37_79b9)
                    .rotate_left(13)
            })
            .map(|word| word.wrapping_mul(0x85eb_ca6b))
            .collect();
        gpu.write(buffer, start * 4, bytemuck::cast_slice(&chunk))?;
    }
    Ok(())
}

fn page(gpu: &GpuDevice, start: u32, records: u32) -> Result<Page, BackendError> {
    let bytes = u64::from(records) * size_of::<Particle>() as u64;
    let of = |label| buffer(gpu, label, bytes, wgpu::BufferUsages::STORAGE);
    let (source, destination) = (of("source"), of("destination"));
    fill(gpu, &source, u64::from(start) * 8)?;
    // What is written for the first time is given its memory then.
    fill(gpu, &destination, 5)?;
    gpu.wait()?;
    Ok(Page {
        records,
        source,
        destination,
    })
}

/// What is not in pages: the table of the atomics, and all that the prefix sum binds.
fn named(gpu: &GpuDevice, records: u32) -> Result<Vec<(&'static str, wgpu::Buffer)>, BackendError> {
    let storage = |name: &'static str, words: u32| {
        let buffer = buffer(gpu, name, u64::from(words) * 4, wgpu::BufferUsages::STORAGE);
        (name, buffer)
    };
    let words_of = |bytes: usize| (bytes / 4) as u32;
    let list = vec![
        storage("table", TABLE_WORDS),
        storage("alive_bits", records.div_ceil(32)),
        storage("word_ranks", 2 * records.div_ceil(32)),
        storage("sums_1", records.div_ceil(2048)),
        storage("sums_2", records.div_ceil(131_072)),
        storage("deaths", 4),
        storage("counts", words_of(size_of::<Counts>())),
        storage("tree_counts", words_of(size_of::<Counts>())),
        storage("spread_counts", words_of(size_of::<SpreadCounts>())),
        storage("statistics", words_of(size_of::<FrameStats>()) * 256),
        (
            "frame",
            buffer(
                gpu,
                "frame",
                size_of::<Frame>() as u64,
                wgpu::BufferUsages::UNIFORM,
            ),
        ),
    ];
    for (name, buffer) in &list {
        match *name {
            "alive_bits" | "tree_counts" | "spread_counts" => fill(gpu, buffer, 0)?,
            "counts" => {
                let counts = Counts {
                    total: records,
                    ..Counts::default()
                };
                gpu.write(buffer, 0, bytemuck::bytes_of(&counts))?;
            }
            _ => {}
        }
    }
    Ok(list)
}
