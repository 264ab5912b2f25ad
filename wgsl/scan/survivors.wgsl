// survivors: the last step up and the first step down of the prefix sum, and the frame's books.
//
// One invocation turns sums_2 into exclusive prefix sums, learns how many survive, and writes the
// frame's line of statistics. Reads: frame, deaths, tree_counts,
// spread_counts. Writes: sums_2, counts, statistics.
// Invariant: live(f) = live(f-1) + born - died.

#import motes::layout::{Counts, Frame, FrameStats, SpreadCounts}

// Lines in the statistics ring; as gpu::readback has it.
const STATISTICS_LEN: u32 = 256u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> deaths: array<u32>;
@group(0) @binding(2) var<storage, read_write> sums_2: array<u32>;
@group(0) @binding(3) var<storage, read_write> counts: Counts;
@group(0) @binding(4) var<storage, read_write> statistics: array<FrameStats>;
@group(0) @binding(5) var<storage, read> tree_counts: Counts;
@group(0) @binding(6) var<storage, read> spread_counts: SpreadCounts;

@compute @workgroup_size(1)
fn survivors() {
    let total = counts.total;
    let sums = (total + 131071u) / 131072u;
    var live = 0u;
    for (var at = 0u; at < sums; at += 1u) {
        let sum = sums_2[at];
        sums_2[at] = live;
        live += sum;
    }
    counts.live = live;
    counts.died = total - live;
    statistics[frame.frame % STATISTICS_LEN] = FrameStats(
        frame.frame,
        counts.requested,
        counts.born,
        total - live,
        live,
        counts.dropped,
        deaths[0],
        deaths[1],
        tree_counts.requested,
        tree_counts.born,
        tree_counts.died,
        tree_counts.live,
        spread_counts.requested,
        spread_counts.born,
        spread_counts.died,
        spread_counts.live,
        spread_counts.flames_requested,
        spread_counts.flames_born,
        spread_counts.flames_died,
        spread_counts.flames_live,
        spread_counts.marks_died,
        spread_counts.flames_total - spread_counts.marks_first - spread_counts.flames_live,
    );
}
