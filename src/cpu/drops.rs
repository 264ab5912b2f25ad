//! How many flames a control point drops on its way, and how far it has come since the last (Perry 1994,
//! 3.4). Twin of `wgsl/lib/drops.wgsl`.

use crate::exact::{less, shared_constants, snap};
use crate::layout::{SPREAD_CARRIES, SpreadFrame};

shared_constants! {
    /// Flames that a point drops in one step at most.
    pub const MOST_DROPS: u32 = 64;
}

/// How many flames a point drops that has come so far since the last.
pub fn drops_of(spread: &SpreadFrame, come: f32) -> u32 {
    let carries = spread.kinds[1] & SPREAD_CARRIES != 0;
    let most = if carries { MOST_DROPS } else { 1 };
    let mut rest = come;
    let mut drops = 0;
    while drops < most && !less(rest, spread.distances[1]) {
        rest = snap(rest - spread.distances[1]);
        drops += 1;
    }
    drops
}

/// How far a point has come since the last flame when it has dropped so many.
pub fn rest_of(spread: &SpreadFrame, come: f32, drops: u32) -> f32 {
    if drops > 0 && spread.kinds[1] & SPREAD_CARRIES == 0 {
        return 0.0;
    }
    (0..drops).fold(come, |rest, _| snap(rest - spread.distances[1]))
}
