// offsets: where each system's newborns begin, how many there is room for, and how much work the
// emit, the cull and the scan have.
//
// One invocation in all: systems are few. Reads: frame, birth_counts. Writes: birth_offsets,
// counts, deaths, dispatches.
// Invariant: offsets never go down (a sum beyond 32 bits stays at their top);
// born + dropped = requested and live + born <= capacity; births that do not fit are
// the last ones, and they are counted.

#import motes::dispatch::dispatch_for
#import motes::layout::{Counts, Dispatch, Frame}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> birth_counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> birth_offsets: array<u32>;
@group(0) @binding(3) var<storage, read_write> counts: Counts;
@group(0) @binding(4) var<storage, read_write> deaths: array<u32>;
@group(0) @binding(5) var<storage, read_write> dispatches: array<Dispatch>;

// Groups of 64 that cover `count`.
fn runs(count: u32) -> u32 {
    return (count + 63u) / 64u;
}

@compute @workgroup_size(1)
fn offsets() {
    var requested = 0u;
    for (var slot = 0u; slot < frame.system_count; slot += 1u) {
        birth_offsets[slot] = requested;
        let next = requested + birth_counts[slot];
        requested = select(next, 0xffffffffu, next < requested);
    }
    birth_offsets[frame.system_count] = requested;

    let live = counts.live;
    let born = min(requested, frame.capacity - live);
    let total = live + born;
    counts.requested = requested;
    counts.born = born;
    counts.dropped = requested - born;
    counts.total = total;
    counts.died = 0u;
    deaths[0] = 0u;
    deaths[1] = 0u;

    let words = (total + 31u) / 32u;
    dispatches[0] = dispatch_for(runs(words), WORKGROUP_SIZE);
    dispatches[1] = dispatch_for(runs(runs(words)), WORKGROUP_SIZE);
    for (var page = 0u; page < frame.page_count; page += 1u) {
        let start = page * frame.page_len;
        let end = min(start + frame.page_len, total);
        let first_birth = max(start, live);
        let births = select(0u, end - first_birth, end > first_birth);
        let culled_words = select(0u, (end - start + 31u) / 32u, end > start);
        dispatches[2u + page] = dispatch_for(births, WORKGROUP_SIZE);
        dispatches[2u + frame.page_count + page] = dispatch_for(culled_words, WORKGROUP_SIZE);
    }
}
