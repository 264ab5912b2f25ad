// bin_flames: which tiles each flame of a slice may touch, and which of its ages where.
//
// One invocation a flame. Reads: flame_bounds, flame_discs. Writes: flame_tiles (atomic ors and adds).
// Invariant: the bit of a flame that is not small is set in every tile of which it may light a pixel, and that of an age in
// every band of lines and of columns; bits do not depend on the order of invocations.

#import motes::dispatch::linear_index
#import motes::exact::{reciprocal, to_i32}
#import motes::flame_tile::{
    BANDS, GLOW_BLOCK_LINES, GLOW_BLOCK_PX, FlameTiling, band_shift, first_band, first_word, is_small, touched_word,
}
#import motes::layout::{FLAME_STEPS, FlameDisc}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether some particles have a matrix.
const SKEWS: bool = #{SKEWS};

var<immediate> tiling: FlameTiling;

@group(0) @binding(0) var<storage, read> flame_bounds: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> flame_discs: array<FlameDisc>;
@group(0) @binding(2) var<storage, read_write> flame_tiles: array<atomic<u32>>;

// The first and the last band that what is within `reach` of `middle` touches.
fn bands_of(middle: f32, inverse_reach: f32, first: u32, shift: u32) -> vec2<u32> {
    if SKEWS {
        return vec2<u32>(0u, BANDS - 1u);
    }
    // A pixel is more than rounding.
    let reach = reciprocal(inverse_reach) + 1.0f;
    let low = max(to_i32(middle - reach) - i32(first), 0i);
    let high = max(to_i32(middle + reach) - i32(first), 0i);
    return min(vec2<u32>(u32(low), u32(high)) >> vec2<u32>(shift), vec2<u32>(BANDS - 1u));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn bin_flames(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= tiling.count {
        return;
    }
    let bounds = flame_bounds[tiling.first + at].xy;
    let first = bounds & vec2<u32>(0xffffu);
    let end = bounds >> vec2<u32>(16u);
    if first.x >= end.x || first.y >= end.y || is_small(end - first) {
        return;
    }
    let low = first / tiling.tile_px;
    let high = (end - vec2<u32>(1u)) / tiling.tile_px;
    let word = at / 32u;
    let touched = touched_word(tiling);
    for (var y = low.y; y <= high.y; y += 1u) {
        for (var x = low.x; x <= high.x; x += 1u) {
            let tile = y * tiling.across + x;
            if atomicOr(&flame_tiles[first_word(tile)], 1u << word) == 0u {
                let nth = atomicAdd(&flame_tiles[touched], 1u);
                atomicStore(&flame_tiles[touched + 1u + nth], tile);
            }
            atomicOr(&flame_tiles[first_word(tile) + 1u + word], 1u << (at % 32u));
        }
    }
    let shifts = vec2<u32>(
        band_shift(end.x - first.x, GLOW_BLOCK_PX), band_shift(end.y - first.y, GLOW_BLOCK_LINES),
    );
    let lines = first_band(tiling, at);
    let columns = lines + BANDS;
    for (var band = 0u; band < 2u * BANDS; band += 1u) {
        atomicStore(&flame_tiles[lines + band], 0u);
    }
    for (var age = 0u; age < FLAME_STEPS; age += 1u) {
        let place = bitcast<vec4<f32>>(flame_discs[(tiling.first + at) * FLAME_STEPS + age].place);
        let of_lines = bands_of(place.y, place.w, first.y, shifts.y);
        for (var band = of_lines.x; band <= of_lines.y; band += 1u) {
            atomicOr(&flame_tiles[lines + band], 1u << age);
        }
        let of_columns = bands_of(place.x, place.z, first.x, shifts.x);
        for (var band = of_columns.x; band <= of_columns.y; band += 1u) {
            atomicOr(&flame_tiles[columns + band], 1u << age);
        }
    }
}
