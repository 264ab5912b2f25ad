// pages: which pages the survivors of each page go to, and how much work the advance and the
// splat have.
//
// The survivors of a page are contiguous in the other pool, at or before where they were, so only
// pairs (source, target) with target <= source can have work, and at most two targets a source do;
// all other pairs get empty dispatches. One invocation in all.
// Reads: frame, counts, word_ranks. Writes: dispatches.
// Invariant: each survivor is covered by the dispatch of exactly one pair.

#import motes::dispatch::dispatch_for
#import motes::layout::{Counts, Dispatch, Frame}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> counts: Counts;
@group(0) @binding(2) var<storage, read> word_ranks: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read_write> dispatches: array<Dispatch>;

// Survivors before particle `at`, a multiple of 32.
fn survivors_before(at: u32) -> u32 {
    if at >= counts.total {
        return counts.live;
    }
    return word_ranks[at / 32u].x;
}

@compute @workgroup_size(1)
fn pages() {
    let splats = 2u + 2u * frame.page_count;
    let pairs = splats + frame.page_count;
    for (var source = 0u; source < frame.page_count; source += 1u) {
        let start = source * frame.page_len;
        let present = min(counts.total - min(counts.total, start), frame.page_len);
        let first = survivors_before(start);
        let last = survivors_before(start + frame.page_len);
        for (var target_page = 0u; target_page <= source; target_page += 1u) {
            let target_start = target_page * frame.page_len;
            let meets = first < target_start + frame.page_len && last > target_start;
            let work = select(0u, present, meets && last > first);
            let pair = source * (source + 1u) / 2u + target_page;
            dispatches[pairs + pair] = dispatch_for(work, WORKGROUP_SIZE);
        }
        let live = min(counts.live - min(counts.live, start), frame.page_len);
        dispatches[splats + source] = dispatch_for(live, WORKGROUP_SIZE);
    }
}
