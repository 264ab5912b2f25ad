// How the picture is cut into tiles for the flames, and what is known of these.
//
// Flames of a few pixels are not in them: for these, going through tiles costs more than it spares.
// Flames come in slices of 1,024. A tile has 33 words: bit w of the first says whether word w of the 32
// behind it is not zero; their bits say which flames of the slice may touch the tile. So no tile has too
// many, and memory has a bound whatever comes. Behind them is how many tiles any touches, and which; and
// for each flame 32 words: its bounds are cut into 16 bands of lines and 16 of columns, and bits say which
// ages touch one. Twin of gpu/flame_tiling.rs.
#define_import_path motes::flame_tile

// Words of a tile.
const TILE_STRIDE: u32 = 33u;
// Pixels across and lines of a block, which is what an invocation draws.
const GLOW_BLOCK_PX: u32 = 8u;
const GLOW_BLOCK_LINES: u32 = 4u;
// Bands of lines, and of columns.
const BANDS: u32 = 16u;

// Pixels across and lines of flames that are drawn without tiles, at most.
const SMALL_PX: u32 = 24u;
const SMALL_LINES: u32 = 32u;
// Invocations that share such a flame, and pixels that one sums at a time.
const SMALL_SHARES: u32 = 8u;
const SMALL_RUN: u32 = 8u;

struct FlameTiling {
    // Pixels of a tile's side, a multiple of 8, and tiles across and down.
    tile_px: u32,
    across: u32,
    down: u32,
    // The first flame of the slice in its page, and how many it has.
    first: u32,
    count: u32,
    // The place of what draws it among the dispatches.
    dispatch: u32,
}

// Where a tile's words are.
fn first_word(tile: u32) -> u32 {
    return tile * TILE_STRIDE;
}

// Where it stands how many tiles are touched; which, is behind it.
fn touched_word(tiling: FlameTiling) -> u32 {
    return tiling.across * tiling.down * TILE_STRIDE;
}

// Where the bands of lines of a flame of the slice are; those of columns are behind them.
fn first_band(tiling: FlameTiling, flame: u32) -> u32 {
    return tiling.across * tiling.down * (TILE_STRIDE + 1u) + 1u + flame * (2u * BANDS);
}

fn blocks_a_tile(tiling: FlameTiling) -> u32 {
    return (tiling.tile_px / GLOW_BLOCK_PX) * (tiling.tile_px / GLOW_BLOCK_LINES);
}

// Bands are 2^this wide: blocks of no more pixels touch two at most.
fn band_shift(extent: u32, block: u32) -> u32 {
    var shift = firstTrailingBit(block);
    while (BANDS << shift) < extent {
        shift += 1u;
    }
    return shift;
}

// Whether a flame that touches so many pixels across, and lines, is drawn without tiles.
fn is_small(extent: vec2<u32>) -> bool {
    return extent.x <= SMALL_PX && extent.y <= SMALL_LINES;
}
