// How the picture is cut into tiles, and what covers into rounds.
//
// A round takes the next `slice` records from near to far: for each tile, one bit a record says whether
// it may touch it, and one bit a word whether that word has any. So no tile has too many, the bits keep
// the order, and memory has a bound whatever comes. Twin of gpu/tiling.rs.
#define_import_path motes::tile

struct Tiling {
    // Rounds that there may be, and the one at hand.
    rounds: u32,
    round: u32,
    // Records a round: a multiple of 1024.
    slice: u32,
    // Pixels of a tile's side, a multiple of 4, and tiles across and down.
    tile_px: u32,
    across: u32,
    down: u32,
}

// Words of bits a tile, and words of bits that say which of them are not zero.
fn words_a_tile(tiling: Tiling) -> u32 {
    return tiling.slice / 32u;
}

fn summaries_a_tile(tiling: Tiling) -> u32 {
    return tiling.slice / 1024u;
}

// Invocations a tile of `cover`: one for every four pixels in a row.
fn fours_a_tile(tiling: Tiling) -> u32 {
    return tiling.tile_px * (tiling.tile_px / 4u);
}

// Records of the round, where there are `count` in all.
fn records_of_round(tiling: Tiling, round: u32, count: u32) -> u32 {
    let before = round * tiling.slice;
    return min(count - min(count, before), tiling.slice);
}
