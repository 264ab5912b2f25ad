// clear_flame_tiles: no flame touches any tile.
//
// One invocation a tile; only words that are not zero are written. Writes: flame_tiles.
// Invariant: afterwards all words of tiles are zero, and no tile is touched.

#import motes::dispatch::linear_index
#import motes::flame_tile::{FlameTiling, first_word, touched_word}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

var<immediate> tiling: FlameTiling;

@group(0) @binding(0) var<storage, read_write> flame_tiles: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn clear_flame_tiles(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let tile = linear_index(global_id, WORKGROUP_SIZE);
    if tile >= tiling.across * tiling.down {
        return;
    }
    if tile == 0u {
        flame_tiles[touched_word(tiling)] = 0u;
    }
    let first = first_word(tile);
    var summary = flame_tiles[first];
    if summary == 0u {
        return;
    }
    flame_tiles[first] = 0u;
    while summary != 0u {
        flame_tiles[first + 1u + firstTrailingBit(summary)] = 0u;
        summary &= summary - 1u;
    }
}
