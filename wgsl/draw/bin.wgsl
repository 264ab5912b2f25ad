// bin: which tiles each record of a round may touch.
//
// One invocation a record, from near to far. Reads: frame, sort_count, cover_counts, sort_pairs,
// covers. Writes: ranked_covers, ranked_bounds, tile_bits and tile_summaries (atomic ors).
// Invariant: bit r of a tile is set if the record of rank r in this round may cover a pixel of it; the
// bits do not depend on the order of invocations.

#import motes::cover::{bounds_of, packed_bounds}
#import motes::dispatch::linear_index
#import motes::layout::{COVERS_SEEN, Cover, Frame}
#import motes::tile::{Tiling, records_of_round, summaries_a_tile, words_a_tile}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

var<immediate> tiling: Tiling;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> sort_count: array<u32>;
@group(0) @binding(2) var<storage, read> cover_counts: array<u32>;
@group(0) @binding(3) var<storage, read> sort_pairs: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> covers: array<Cover>;
@group(0) @binding(5) var<storage, read_write> ranked_covers: array<Cover>;
@group(0) @binding(6) var<storage, read_write> ranked_bounds: array<vec2<u32>>;
@group(0) @binding(7) var<storage, read_write> tile_bits: array<atomic<u32>>;
@group(0) @binding(8) var<storage, read_write> tile_summaries: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn bin(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let rank = linear_index(global_id, WORKGROUP_SIZE);
    if rank >= records_of_round(tiling, tiling.round, cover_counts[COVERS_SEEN]) {
        return;
    }
    let from_near = tiling.round * tiling.slice + rank;
    let cover = covers[sort_pairs[sort_count[0] - 1u - from_near].y];
    ranked_covers[rank] = cover;
    let bounds = bounds_of(cover, frame.width, frame.height);
    if bounds.x >= bounds.z || bounds.y >= bounds.w {
        return;
    }
    ranked_bounds[rank] = packed_bounds(bounds);
    let first = vec2<u32>(bounds.xy) / tiling.tile_px;
    let last = vec2<u32>(bounds.zw - vec2<i32>(1)) / tiling.tile_px;
    let word = rank / 32u;
    for (var y = first.y; y <= last.y; y += 1u) {
        for (var x = first.x; x <= last.x; x += 1u) {
            let tile = y * tiling.across + x;
            atomicOr(&tile_bits[tile * words_a_tile(tiling) + word], 1u << (rank % 32u));
            let summary = tile * summaries_a_tile(tiling) + word / 32u;
            atomicOr(&tile_summaries[summary], 1u << (word % 32u));
        }
    }
}
