//! How strips along flames are shared out to invocations.

use std::ops::Range;

use crate::layout::FLAME_STEPS;
use crate::plan::Plan;

/// Pieces of a strip.
pub(super) const PIECES: u32 = FLAME_STEPS - 1;

/// Turns of an invocation's loop, at most: drivers end loops that turn 65,535 times.
const MOST_TURNS: u32 = 60_000;

/// Invocations a dispatch, but where one flame has more.
const MOST_INVOCATIONS: u32 = 1 << 22;

/// Invocations that share a piece of a strip: more where flames are few, and never so few that one turns
/// its loop more often than drivers let it, even where the piece fills the picture.
pub(super) fn strip_shares_of(plan: &Plan) -> u32 {
    let wanted = if plan.flame_count > 1024 { 4 } else { 32 };
    shares_of(plan.width * plan.height, wanted)
}

fn shares_of(pixels: u32, wanted: u32) -> u32 {
    pixels.div_ceil(MOST_TURNS).max(wanted).next_power_of_two()
}

/// The flames of a page, cut into runs of which each has a dispatch.
pub(super) fn strip_runs(count: u32, shares: u32) -> impl Iterator<Item = Range<u32>> {
    let len = (MOST_INVOCATIONS / (PIECES * shares)).max(1);
    (0..count.div_ceil(len)).map(move |at| at * len..count.min((at + 1) * len))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn p80_the_strips_of_a_page_are_all_drawn_and_no_pixel_of_them_is_left_out() {
        for pixels in [1, 160 * 120, 3840 * 2160, 8_400_000, 16_384 * 16_384] {
            for wanted in [4, 32] {
                let shares = shares_of(pixels, wanted);
                assert!(u64::from(shares) * 65_535 >= u64::from(pixels));
                for count in [0, 1, 31, 1024, 43_690, 43_691, 1_000_000] {
                    let mut next = 0;
                    for run in strip_runs(count, shares) {
                        assert_eq!(run.start, next);
                        assert!(run.end > run.start);
                        let flames = u64::from(run.end - run.start);
                        let invocations = flames * u64::from(PIECES * shares);
                        assert!(invocations < 1 << 31, "{invocations}");
                        next = run.end;
                    }
                    assert_eq!(next, count);
                }
            }
        }
    }
}
