//! Yardsticks of the processor, on all of its threads.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use std::time::Instant;

use glam::Vec3;
use rayon::prelude::*;

use super::Entry;
use crate::backend::BackendError;
use crate::bench::spread::Clock;
use crate::gpu::TABLE_WORDS;
use crate::noise::noise;

/// Records that a task takes.
const CHUNK: usize = 8192;

/// Times what runs once a sample.
fn entry(name: &str, items: u32, bytes: u64, mut work: impl FnMut() + 'static) -> Entry {
    let run = move || {
        let begun = Instant::now();
        work();
        Ok((begun.elapsed().as_secs_f64() * 1e3, Clock::Wall))
    };
    Entry::new(name, items.into(), bytes * u64::from(items), Box::new(run))
}

/// A word that no compiler can foresee.
fn mixed(word: u32) -> u32 {
    word.wrapping_mul(0x9e37_79b9).rotate_left(13) ^ word
}

fn place(at: u32) -> Vec3 {
    let word = mixed(at);
    let of = |shift: u32| (word.rotate_left(shift) >> 12) as f32 / 1024.0;
    Vec3::new(of(0), of(11), of(22))
}

/// A copy by one thread.
fn copy_buffer(records: u32) -> Result<Entry, BackendError> {
    let mut whole = super::copy_by_one_thread(records)?;
    let copied = move || {
        whole.run();
    };
    let copied = entry("copy_buffer", records, 64, copied).noted("one thread");
    Ok(Entry {
        by_interface: true,
        ..copied
    })
}

/// The stable sort of the standard library, by keys of 32 bits; putting them back is not timed.
fn sort(pairs: u32) -> Entry {
    let unsorted: Vec<[u32; 2]> = (0..pairs).map(|at| [mixed(at), at]).collect();
    let mut sorted = unsorted.clone();
    let run = move || {
        sorted.copy_from_slice(&unsorted);
        let begun = Instant::now();
        sorted.sort_by_key(|pair| pair[0]);
        std::hint::black_box(&mut sorted);
        Ok((begun.elapsed().as_secs_f64() * 1e3, Clock::Wall))
    };
    // Each pair is read and written once at least.
    let count = u64::from(pairs);
    Entry::new("sort", count, count * 16, Box::new(run))
        .noted("pairs by keys of 32 bits, one thread")
}

/// All of them.
pub(super) fn entries(records: u32) -> Result<Vec<Entry>, BackendError> {
    let zeroed = |what| crate::backend::try_zeroed::<[u32; 8]>(records as usize, what);
    let mut source = zeroed("records to read")?;
    for (record, at) in source.iter_mut().zip(0u32..) {
        *record = [mixed(at) | 1; 8];
    }
    let mut written = zeroed("records to write")?;
    let table = || -> Vec<AtomicU32> { (0..TABLE_WORDS).map(|_| AtomicU32::new(0)).collect() };
    let (spread, contended) = (table(), AtomicU32::new(0));
    Ok(vec![
        copy_buffer(records)?,
        entry("read_only", records, 32, move || {
            let sum = |chunk: &[[u32; 8]]| {
                let words = chunk.iter().flatten();
                words.fold(0, |all, word| all | *word)
            };
            let all = source.par_chunks(CHUNK).map(sum);
            std::hint::black_box(all.reduce(|| 0, |a, b| a | b));
        })
        .noted("32 bytes a record"),
        entry("write_only", records, 32, move || {
            let chunks = written.par_chunks_mut(CHUNK).enumerate();
            chunks.for_each(|(at, chunk)| chunk.fill([at as u32; 8]));
            std::hint::black_box(&mut written);
        })
        .noted("32 bytes a record"),
        entry("atomic_add_spread", records, 8, move || {
            (0..records)
                .into_par_iter()
                .with_min_len(CHUNK)
                .for_each(|at| {
                    let word = at.wrapping_mul(0x9e37_79b9) >> 11;
                    spread[word as usize].fetch_add(1, Relaxed);
                });
        })
        .noted("over 2^21 words"),
        entry("atomic_add_contended", records, 0, move || {
            (0..records)
                .into_par_iter()
                .with_min_len(CHUNK)
                .for_each(|_| {
                    contended.fetch_add(1, Relaxed);
                });
        })
        .noted("to one word"),
        entry("noise_simplex", records, 0, move || {
            let samples = (0..records).into_par_iter().with_min_len(CHUNK);
            let sum = samples.map(|at| noise(place(at), 1).w).sum::<f32>();
            std::hint::black_box(sum);
        })
        .noted("a sample of the wind's noise"),
        sort(records),
    ])
}
