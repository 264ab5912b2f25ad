// cover: in every pixel, what of a round covers it, from near to far.
//
// Porter and Duff (1984), "over". One invocation four pixels in a row of a tile, so that a record is
// loaded once for them; it passes over records whose bounds do not hold them, each invocation at its
// own pace. Reads: frame, ranked_covers, ranked_bounds, tile_summaries, tile_bits, surface_nearness.
// Writes: cover_rg, cover_bt (red and green, blue and how much of what is behind shows through, as
// bits), where there are surfaces cover_front (how much of them does).
// Invariant: a pixel depends on the records that cover it and on their order alone, not on tiles or
// rounds: what is kept between rounds is snapped after every record.

#import motes::behind::{Parted, behind_parted, is_closed_pixel}
#import motes::cover::{HIDDEN, Kinds, Layered, Spot, behind, may_touch}
#import motes::dispatch::linear_index
#import motes::exact::{bits_of, less}
#import motes::layout::{Cover, Frame}
#import motes::tile::{Tiling, fours_a_tile, summaries_a_tile, words_a_tile}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// None is left.
const NO_RECORD: u32 = 0xffffffffu;
// Which kinds of shapes there may be.
const RECTANGLES: bool = #{RECTANGLES};
const STREAKS: bool = #{STREAKS};
const TRIANGLES: bool = #{TRIANGLES};
const CONES: bool = #{CONES};
const MARKS: bool = #{MARKS};
const STROKES: bool = #{STROKES};
// Whether any is mirrored.
const MIRRORS: bool = #{MIRRORS};
// Whether surfaces hide what is behind them.
const SURFACES: bool = #{SURFACES};

var<immediate> tiling: Tiling;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> ranked_covers: array<Cover>;
@group(0) @binding(2) var<storage, read> ranked_bounds: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> tile_summaries: array<u32>;
@group(0) @binding(4) var<storage, read> tile_bits: array<u32>;
@group(0) @binding(5) var<storage, read_write> cover_rg: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read_write> cover_bt: array<vec2<u32>>;
@group(0) @binding(7) var<storage, read_write> cover_front: array<u32>;
@group(0) @binding(8) var<storage, read> surface_nearness: array<vec4<u32>>;

// What the rounds before have left of a pixel of the picture.
fn begun(x: i32, y: i32) -> Parted {
    if tiling.round == 0u || x >= i32(frame.width) || y >= i32(frame.height) {
        return Parted(Layered(vec3<f32>(0.0f), 1.0f), 1.0f);
    }
    let at = u32(y) * frame.width + u32(x);
    let rg = bitcast<vec2<f32>>(cover_rg[at]);
    let bt = bitcast<vec2<f32>>(cover_bt[at]);
    var front = 1.0f;
    if SURFACES {
        front = bitcast<f32>(cover_front[at]);
    }
    return Parted(Layered(vec3<f32>(rg, bt.x), bt.y), front);
}

fn keep(x: i32, y: i32, pixel: Parted) {
    if x >= i32(frame.width) || y >= i32(frame.height) {
        return;
    }
    let at = u32(y) * frame.width + u32(x);
    cover_rg[at] = vec2<u32>(bits_of(pixel.open.color.x), bits_of(pixel.open.color.y));
    cover_bt[at] = vec2<u32>(bits_of(pixel.open.color.z), bits_of(pixel.open.clear));
    if SURFACES {
        cover_front[at] = bits_of(pixel.front);
    }
}

// How near surfaces are in a pixel's samples.
fn nearness_at(x: i32, y: i32) -> vec4<u32> {
    if !SURFACES || x >= i32(frame.width) || y >= i32(frame.height) {
        return vec4<u32>(0u);
    }
    return surface_nearness[u32(y) * frame.width + u32(x)];
}

fn is_closed(pixel: Parted, nearness: vec4<u32>) -> bool {
    if SURFACES {
        return is_closed_pixel(pixel, nearness);
    }
    return less(pixel.open.clear, HIDDEN);
}

fn with_record(above: Parted, record: Cover, kinds: Kinds, spot: Spot, nearness: vec4<u32>) -> Parted {
    let light_from = frame.light_from.xyz;
    if SURFACES {
        return behind_parted(above, record, kinds, light_from, spot, nearness);
    }
    return Parted(behind(above.open, record, kinds, light_from, spot), 1.0f);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn cover(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let work = linear_index(global_id, WORKGROUP_SIZE);
    let tile = work / fours_a_tile(tiling);
    if tile >= tiling.across * tiling.down {
        return;
    }
    let in_tile = work % fours_a_tile(tiling);
    let fours_across = tiling.tile_px / 4u;
    let x = i32((tile % tiling.across) * tiling.tile_px + (in_tile % fours_across) * 4u);
    let y = i32((tile / tiling.across) * tiling.tile_px + in_tile / fours_across);
    let kinds = Kinds(RECTANGLES, STREAKS, TRIANGLES, MIRRORS, CONES, MARKS, STROKES);
    let width = i32(frame.width);
    let near_a = nearness_at(x, y);
    let near_b = nearness_at(x + 1, y);
    let near_c = nearness_at(x + 2, y);
    let near_d = nearness_at(x + 3, y);
    var a = begun(x, y);
    var b = begun(x + 1, y);
    var c = begun(x + 2, y);
    var d = begun(x + 3, y);
    let first_summary = tile * summaries_a_tile(tiling);
    // Where in the tile's bits it is: the summary at hand, the word, and what is left of both.
    var at = 0u;
    var summary = tile_summaries[first_summary];
    var word = 0u;
    var bits = 0u;
    while !(is_closed(a, near_a) && is_closed(b, near_b) && is_closed(c, near_c) && is_closed(d, near_d)) {
        var rank = NO_RECORD;
        while rank == NO_RECORD && at < summaries_a_tile(tiling) {
            if bits != 0u {
                let next = word * 32u + firstTrailingBit(bits);
                bits &= bits - 1u;
                rank = select(NO_RECORD, next, may_touch(ranked_bounds[next], x, y));
            } else if summary != 0u {
                word = at * 32u + firstTrailingBit(summary);
                summary &= summary - 1u;
                bits = tile_bits[tile * words_a_tile(tiling) + word];
            } else {
                at += 1u;
                summary = tile_summaries[first_summary + min(at, summaries_a_tile(tiling) - 1u)];
            }
        }
        if rank == NO_RECORD {
            break;
        }
        let record = ranked_covers[rank];
        a = with_record(a, record, kinds, Spot(x, y, width), near_a);
        b = with_record(b, record, kinds, Spot(x + 1, y, width), near_b);
        c = with_record(c, record, kinds, Spot(x + 2, y, width), near_c);
        d = with_record(d, record, kinds, Spot(x + 3, y, width), near_d);
    }
    keep(x, y, a);
    keep(x + 1, y, b);
    keep(x + 2, y, c);
    keep(x + 3, y, d);
}
