//! The stable radix sort of pairs (key, value) by 8 bits a pass. Twin of `wgsl/lib/sort.wgsl`.
//!
//! `sort_pairs` are sorted by `sort/count_digits`, `sum_digits`, `start_digits` and `place_digits` into
//! `sorted_pairs`, which change places with them for the next pass.

use crate::exact::shared_constants;

shared_constants! {
    /// Pairs that an invocation takes.
    pub const RUN: u32 = 512;
    /// Values of a digit.
    pub const DIGITS: u32 = 256;
}

/// Bits of a digit.
pub(super) const DIGIT_BITS: u32 = 8;

/// Passes over 32 bits; an even number, so that the pairs end up where they began.
pub(super) const PASSES: u32 = 32 / DIGIT_BITS;

/// Counts that a pass over so many pairs takes.
pub(super) fn counts(pairs: u32) -> u32 {
    pairs.div_ceil(RUN) * DIGITS
}
