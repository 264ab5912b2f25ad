//! How the picture is cut into tiles for the flames, and these into slices. Twin of
//! `wgsl/lib/flame_tile.wgsl`.

use super::memory::FlamePaging;
use super::tiling::Tiling;
use crate::exact::shared_constants;

/// Flames a slice, so that an invocation which goes through all ages of all of them turns its loops no
/// more often than drivers let it.
const SLICE: u32 = 1024;

shared_constants! {
    /// Words of a tile.
    const TILE_STRIDE: u32 = 33;
    /// Pixels across and lines of a block, which is what an invocation draws.
    const GLOW_BLOCK_PX: u32 = 8;
    const GLOW_BLOCK_LINES: u32 = 4;
    /// Bands of lines, and of columns.
    const BANDS: u32 = 16;
    /// Pixels across and lines of flames that are drawn without tiles, at most.
    const SMALL_PX: u32 = 24;
    const SMALL_LINES: u32 = 32;
    /// Invocations that share such a flame, and pixels that one sums at a time.
    pub(super) const SMALL_SHARES: u32 = 8;
    const SMALL_RUN: u32 = 8;
}

/// Flames that are drawn at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FlameSlice {
    pub(super) page: usize,
    /// The first of them in the page, and how many.
    pub(super) first: u32,
    pub(super) count: u32,
}

/// How the picture is cut for flames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FlameTiling {
    tile_px: u32,
    across: u32,
    down: u32,
    pub(super) slices: Vec<FlameSlice>,
}

impl FlameTiling {
    /// Tiles no smaller than those of what covers.
    pub(super) fn new(tiling: Tiling, [width, height]: [u32; 2], paging: FlamePaging) -> Self {
        let tile_px = tiling.tile_px.next_multiple_of(GLOW_BLOCK_PX);
        let of_page = |(page, (_, count)): (usize, (u32, u32))| {
            (0..count.div_ceil(SLICE)).map(move |nth| FlameSlice {
                page,
                first: nth * SLICE,
                count: SLICE.min(count - nth * SLICE),
            })
        };
        Self {
            tile_px,
            across: width.div_ceil(tile_px),
            down: height.div_ceil(tile_px),
            slices: paging.pages().enumerate().flat_map(of_page).collect(),
        }
    }

    pub(super) fn tiles(&self) -> u32 {
        self.across * self.down
    }

    /// Words of all tiles, of how many are touched, and which, and of the bands of a slice.
    pub(super) fn words(&self) -> u32 {
        self.tiles() * (TILE_STRIDE + 1) + 1 + SLICE * 2 * BANDS
    }

    /// What kernels are told of a slice.
    pub(super) fn immediates(&self, slice: FlameSlice, dispatch: u32) -> [u32; 6] {
        let Self {
            tile_px,
            across,
            down,
            ..
        } = *self;
        [tile_px, across, down, slice.first, slice.count, dispatch]
    }
}
