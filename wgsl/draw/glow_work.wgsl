// glow_work: as many invocations draw flames as there are blocks in the tiles that they touch.
//
// One invocation in all. Reads: flame_tiles. Writes: dispatches.
// Invariant: tiles that no flame touches cost nothing.

#import motes::dispatch::dispatch_for
#import motes::flame_tile::{FlameTiling, blocks_a_tile, touched_word}
#import motes::layout::Dispatch

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

var<immediate> tiling: FlameTiling;

@group(0) @binding(0) var<storage, read> flame_tiles: array<u32>;
@group(0) @binding(1) var<storage, read_write> dispatches: array<Dispatch>;

@compute @workgroup_size(1)
fn glow_work() {
    let blocks = flame_tiles[touched_word(tiling)] * blocks_a_tile(tiling);
    dispatches[tiling.dispatch] = dispatch_for(blocks, WORKGROUP_SIZE);
}
