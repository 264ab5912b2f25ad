//! 64 bits that tell whether two lists of records are the same: the sum, by halves, of a hash of
//! each record's index and words. Twin of `wgsl/digest/digest.wgsl`.

use glam::UVec4;
use rayon::prelude::*;

use crate::rng::pcg4d;

/// Digest of records of `vectors_per_record` × 4 words. Words missing from the last vector are 0.
pub fn digest(words: &[u32], vectors_per_record: usize) -> u64 {
    digest_from(0, words, vectors_per_record)
}

/// As [`digest`], of records that are counted from `first_index`.
pub fn digest_from(first_index: u32, words: &[u32], vectors_per_record: usize) -> u64 {
    let record_words = vectors_per_record * 4;
    let (low, high) = words
        .par_chunks(record_words * 4096)
        .enumerate()
        .map(|(chunk, words)| {
            let first = chunk * 4096;
            let mut sums = (0u32, 0u32);
            for (at, record) in words.chunks(record_words).enumerate() {
                let mut hash = pcg4d(UVec4::new(
                    first_index.wrapping_add((first + at) as u32),
                    0,
                    0,
                    0,
                ));
                for vector in record.chunks(4) {
                    let word = |i: usize| vector.get(i).copied().unwrap_or(0);
                    hash = pcg4d(hash ^ UVec4::new(word(0), word(1), word(2), word(3)));
                }
                sums = (sums.0.wrapping_add(hash.x), sums.1.wrapping_add(hash.y));
            }
            sums
        })
        .reduce(
            || (0, 0),
            |a, b| (a.0.wrapping_add(b.0), a.1.wrapping_add(b.1)),
        );
    u64::from(low) | (u64::from(high) << 32)
}
