// sum_gaps: what a run of 32 control points has: a bit for each insertion, how many move, and how many
// flames they drop.
//
// First step of the prefix sums over insertions and flames (Perry 1994, 3.3.2). Nothing is inserted off the
// surface. One invocation a run.
// Reads: spread_counts, walkers, gap_flags. Writes: gap_runs (bits, moving, come to rest, unused),
// drop_runs (flames, unused).
// Invariant: integers alone, so that the order of the invocations does not matter.

#import motes::dispatch::linear_index
#import motes::layout::{
    GAP_CAME_TO_REST, GAP_DROPS_SHIFT, GAP_INSERTS, GAP_MOVES, POINT_MOVES, SpreadCounts, Walker,
}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(1) var<storage, read> walkers: array<Walker>;
@group(0) @binding(2) var<storage, read> gap_flags: array<u32>;
@group(0) @binding(3) var<storage, read_write> gap_runs: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> drop_runs: array<vec2<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn sum_gaps(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let run = linear_index(global_id, WORKGROUP_SIZE);
    let first = run * 32u;
    if first >= spread_counts.total {
        return;
    }
    let end = min(first + 32u, spread_counts.total);
    var sums = vec4<u32>(0u);
    var drops = 0u;
    for (var at = first; at < end; at += 1u) {
        let flags = gap_flags[at];
        if (flags & GAP_INSERTS) != 0u && walkers[at].place.w == POINT_MOVES {
            sums.x |= 1u << (at - first);
        }
        drops += flags >> GAP_DROPS_SHIFT;
        sums.y += select(0u, 1u, (flags & GAP_MOVES) != 0u);
        sums.z += select(0u, 1u, (flags & GAP_CAME_TO_REST) != 0u);
    }
    gap_runs[run] = sums;
    drop_runs[run] = vec2<u32>(drops, 0u);
}
