//! How the picture is cut into tiles, and what covers into rounds. Twin of `wgsl/lib/tile.wgsl`.

use super::options::GpuOptions;
use crate::plan::Plan;

/// Words of a tile's bits in all tiles, at most: 64 MiB.
const MOST_WORDS: u32 = 16 << 20;

/// Tiles at most: an invocation that touches all of them loops no longer than drivers let it.
const MOST_TILES: u32 = 40_000;

/// Pixels of a tile's side where nobody says otherwise.
const TILE_PX: u32 = 16;

/// Records a round where nobody says otherwise, and at least.
const MOST_SLICE: u32 = 32_768;
const LEAST_SLICE: u32 = 1024;

/// How the picture is cut, and into how many rounds the records come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tiling {
    pub(super) rounds: u32,
    /// Records a round.
    pub(super) slice: u32,
    /// Pixels of a tile's side.
    pub(super) tile_px: u32,
    pub(super) across: u32,
    pub(super) down: u32,
}

impl Tiling {
    pub(super) fn new(plan: &Plan, options: &GpuOptions) -> Self {
        let mut tile_px = match options.tile_px {
            0 => TILE_PX,
            px => px,
        };
        let tiles = |px: u32| plan.width.div_ceil(px) * plan.height.div_ceil(px);
        while tiles(tile_px) > MOST_TILES {
            tile_px *= 2;
        }
        let capacity = plan.cover_capacity();
        let mut slice = match options.cover_slice {
            0 => MOST_SLICE.min(capacity.next_power_of_two()),
            records => records,
        };
        while u64::from(tiles(tile_px)) * u64::from(slice / 32) > u64::from(MOST_WORDS) {
            slice /= 2;
        }
        slice = slice.next_multiple_of(LEAST_SLICE);
        Self {
            rounds: capacity.div_ceil(slice),
            slice,
            tile_px,
            across: plan.width.div_ceil(tile_px),
            down: plan.height.div_ceil(tile_px),
        }
    }

    pub(super) fn tiles(&self) -> u32 {
        self.across * self.down
    }

    /// What kernels are told, in a round.
    pub(super) fn immediates(&self, round: u32) -> [u32; 6] {
        let Self {
            rounds,
            slice,
            tile_px,
            across,
            down,
        } = *self;
        [rounds, round, slice, tile_px, across, down]
    }
}
