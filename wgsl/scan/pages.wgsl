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

// Particles of the page from `start` on, `present` of them, up to the word with the last of those that
// go before place `end` of the other pool: those after it have no business with that target.
fn reaching(start: u32, present: u32, end: u32) -> u32 {
    var low = 0u;
    var high = (present + 31u) / 32u;
    while low < high {
        let middle = (low + high) / 2u;
        if survivors_before(start + 32u * middle) < end {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return min(32u * low, present);
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
            let target_end = target_start + frame.page_len;
            var work = 0u;
            if (first < target_end) & (last > target_start) & (last > first) {
                work = reaching(start, present, target_end);
            }
            let pair = source * (source + 1u) / 2u + target_page;
            dispatches[pairs + pair] = dispatch_for(work, WORKGROUP_SIZE);
        }
        let live = min(counts.live - min(counts.live, start), frame.page_len);
        dispatches[splats + source] = dispatch_for(live, WORKGROUP_SIZE);
    }
}
