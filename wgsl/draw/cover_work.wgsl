// cover_work: how much work there is for what covers.
//
// One invocation. Reads: frame, cover_counts (word 0: records of something; the others: records of each
// family). Writes: sort_count, dispatches (those after the pages', as gpu::memory::Paging has them: the
// sort's runs, the records, and three for each round: clear_tiles, bin, cover).
// Invariant: every record that covers something is in one round; the first round is always drawn, so
// that every pixel is written.

#import motes::dispatch::{dispatch_for, first_spare}
#import motes::layout::{COVERS_OF_PARTICLES, COVERS_SEEN, Dispatch, Frame}
#import motes::sort::runs_of
#import motes::tile::{Tiling, fours_a_tile, records_of_round, summaries_a_tile}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Words of cover_counts.
const FAMILIES_END: u32 = 8u;

var<immediate> tiling: Tiling;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> cover_counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> sort_count: array<u32>;
@group(0) @binding(3) var<storage, read_write> dispatches: array<Dispatch>;

@compute @workgroup_size(1)
fn cover_work() {
    var records = 0u;
    for (var family = COVERS_OF_PARTICLES; family < FAMILIES_END; family += 1u) {
        records += cover_counts[family];
    }
    sort_count[0] = records;
    let first = first_spare(frame.page_count);
    dispatches[first] = dispatch_for(runs_of(records), WORKGROUP_SIZE);
    dispatches[first + 1u] = dispatch_for(records, WORKGROUP_SIZE);
    let tiles = tiling.across * tiling.down;
    for (var round = 0u; round < tiling.rounds; round += 1u) {
        let here = records_of_round(tiling, round, cover_counts[COVERS_SEEN]);
        let runs = here > 0u || round == 0u;
        let place = first + 2u + 3u * round;
        let summaries = select(0u, tiles * summaries_a_tile(tiling), runs);
        let fours = select(0u, tiles * fours_a_tile(tiling), runs);
        dispatches[place] = dispatch_for(summaries, WORKGROUP_SIZE);
        dispatches[place + 1u] = dispatch_for(here, WORKGROUP_SIZE);
        dispatches[place + 2u] = dispatch_for(fours, WORKGROUP_SIZE);
    }
}
