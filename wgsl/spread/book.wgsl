// book: where inserted control points go, which rings begin, and the frame's books of both.
//
// Last step of the prefix sum over insertions, by one invocation, for runs are few. What does not fit
// are the last insertions, and whole rings.
// Reads: due_ignitions. Writes: gap_runs (w: insertions before the run), spread_counts.
// Invariant: born + dropped = requested; live(f) = live(f-1) + born - died.

#import motes::layout::{Ignition, SpreadCounts}

struct Work {
    // Points that there is room for.
    room: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> due_ignitions: array<Ignition>;
@group(0) @binding(1) var<storage, read_write> gap_runs: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> spread_counts: SpreadCounts;

@compute @workgroup_size(1)
fn book() {
    let before = spread_counts.total;
    let runs = (before + 31u) / 32u;
    var requested = 0u;
    var live = 0u;
    var died = 0u;
    for (var run = 0u; run < runs; run += 1u) {
        let sums = gap_runs[run];
        gap_runs[run].w = requested;
        requested += countOneBits(sums.x);
        live += sums.y;
        died += sums.z;
    }
    let inserted = min(requested, work.room - before);
    // The first of the due ignitions says how many points they have together.
    let due = due_ignitions[0].order.z;
    let ignites = due <= work.room - before - inserted;
    let ignited = select(0u, due, ignites);
    spread_counts = SpreadCounts(
        before + inserted + ignited,
        live + inserted + ignited,
        requested + due,
        inserted + ignited,
        died,
        before,
        inserted,
        before + inserted,
    );
}
