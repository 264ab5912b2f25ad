// clear_tiles: no record touches any tile.
//
// One invocation a summary; only words that are not zero are written. Writes: tile_bits,
// tile_summaries.
// Invariant: afterwards all bits of both are zero.

#import motes::dispatch::linear_index
#import motes::tile::{Tiling, summaries_a_tile}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

var<immediate> tiling: Tiling;

@group(0) @binding(0) var<storage, read_write> tile_summaries: array<u32>;
@group(0) @binding(1) var<storage, read_write> tile_bits: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn clear_tiles(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= tiling.across * tiling.down * summaries_a_tile(tiling) {
        return;
    }
    var summary = tile_summaries[at];
    if summary == 0u {
        return;
    }
    tile_summaries[at] = 0u;
    while summary != 0u {
        tile_bits[at * 32u + firstTrailingBit(summary)] = 0u;
        summary &= summary - 1u;
    }
}
