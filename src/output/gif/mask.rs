//! Thresholds of ordered dithering: the 8×8 matrix of Bayer 1973.
//!
//! Its regular texture costs an LZW coder less than noise does, and it stands still on the screen.

/// Pixels after which the thresholds repeat, both ways.
pub(super) const SIDE: usize = 8;

/// Thresholds are 0 to this minus 1, each once in the matrix.
pub(super) const LEVELS: i32 = 64;

/// The thresholds of a row of pixels; pixel `x` has that at `x % SIDE`.
pub(super) fn thresholds(y: usize) -> [u8; SIDE] {
    std::array::from_fn(|x| {
        // The bits of x ^ y and y, interleaved, the lowest bits weighing most.
        (0..3).fold(0, |threshold, bit| {
            let across = (x ^ y) >> bit & 1;
            let down = y >> bit & 1;
            threshold << 2 | (across << 1 | down) as u8
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matrix_is_bayers() {
        assert_eq!(thresholds(0), [0, 32, 8, 40, 2, 34, 10, 42]);
        assert_eq!(thresholds(1), [48, 16, 56, 24, 50, 18, 58, 26]);
        assert_eq!(thresholds(7), [63, 31, 55, 23, 61, 29, 53, 21]);
        let mut all: Vec<u8> = (8..16).flat_map(thresholds).collect();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..LEVELS as u8));
    }
}
