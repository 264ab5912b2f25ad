// glow: flames add their light to the pixels they touch.
//
// Perry 1994, 3.2.2: the particles along a flame accumulate, whichever comes first. One invocation a block
// of 8 by 4 pixels: it goes through the flames of its tile and the ages that touch the block, so that a
// particle is loaded once for 32 pixels; flames of a few pixels are glow_small's. What the 25 particles of a flame add to a pixel is summed before
// it is rounded; what flames add is a sum of integers.
// A disc is as near as the place that it is around, and its front.
// Loops end at their heads: a software driver loses what lanes did that leave one at its foot.
// Reads: frame, flame_discs, flame_skews, flame_bounds, flame_steps, flame_tiles, surface_nearness.
// Writes: light_low, light_high.
// Invariant: the image does not depend on the order of flames, nor on tiles or slices.

#import motes::fan::{Fan, Lit, with_fan}
#import motes::dispatch::linear_index
#import motes::exact::{f32_of_u32, reciprocal}
#import motes::flame_tile::{
    BANDS, GLOW_BLOCK_LINES, GLOW_BLOCK_PX, FlameTiling, band_shift, blocks_a_tile, first_band, first_word, touched_word,
}
#import motes::layout::{FLAME_STEPS, FlameDisc, Frame}
#import motes::light::steps_of
#import motes::veil::{front_of, open_share}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether some particles have a matrix.
const SKEWS: bool = #{SKEWS};
// Whether some have a second layer.
const INNERS: bool = #{INNERS};
// Whether surfaces hide what is behind them.
const SURFACES: bool = #{SURFACES};

var<immediate> tiling: FlameTiling;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> flame_discs: array<FlameDisc>;
@group(0) @binding(2) var<storage, read> flame_bounds: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> light_low: array<u32>;
@group(0) @binding(4) var<storage, read_write> light_high: array<u32>;
@group(0) @binding(5) var<storage, read> flame_skews: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read> flame_steps: array<vec4<u32>>;
@group(0) @binding(7) var<storage, read> surface_nearness: array<vec4<u32>>;
@group(0) @binding(8) var<storage, read> flame_tiles: array<u32>;

// How near surfaces are in each sample of four pixels.
struct Samples {
    a: vec4<u32>,
    b: vec4<u32>,
    c: vec4<u32>,
    d: vec4<u32>,
}

// What is added to the left and the right four pixels of a line, and to the four lines.
struct Line {
    near: Lit,
    far: Lit,
}

struct Block {
    a: Line,
    b: Line,
    c: Line,
    d: Line,
}

// Of four pixels: both limbs of each channel.
struct Steps {
    low_red: vec4<u32>,
    high_red: vec4<u32>,
    low_green: vec4<u32>,
    high_green: vec4<u32>,
    low_blue: vec4<u32>,
    high_blue: vec4<u32>,
}

fn no_line() -> Line {
    let dark = Lit(vec4<f32>(0.0f), vec4<f32>(0.0f), vec4<f32>(0.0f));
    return Line(dark, dark);
}

fn no_steps() -> Steps {
    let none = vec4<u32>(0u);
    return Steps(none, none, none, none, none, none);
}

fn with_four(sum: Lit, fan: Fan, columns: vec4<f32>, down: f32) -> Lit {
    return with_fan(sum, fan, columns, down, SKEWS, INNERS);
}

fn with_open(sum: Lit, more: Lit, open: vec4<f32>) -> Lit {
    return Lit(sum.red + more.red * open, sum.green + more.green * open, sum.blue + more.blue * open);
}

// What surfaces leave of four pixels.
fn open_four(near: Samples, front: u32) -> vec4<f32> {
    return vec4<f32>(
        open_share(near.a, front), open_share(near.b, front), open_share(near.c, front), open_share(near.d, front),
    );
}

// A line with a particle of which the front is so near, where surfaces are.
fn with_line(sum: Line, fan: Fan, columns: vec4<f32>, line: f32, left: Samples, right: Samples) -> Line {
    let down = line - fan.place.y;
    if SURFACES {
        let near = with_four(no_line().near, fan, columns, down);
        let far = with_four(no_line().near, fan, columns + 4.0f, down);
        return Line(
            with_open(sum.near, near, open_four(left, fan.front)),
            with_open(sum.far, far, open_four(right, fan.front)),
        );
    }
    return Line(with_four(sum.near, fan, columns, down), with_four(sum.far, fan, columns + 4.0f, down));
}

fn nearness_at(x: u32, y: u32) -> vec4<u32> {
    return surface_nearness[min(y, frame.height - 1u) * frame.width + min(x, frame.width - 1u)];
}

fn samples_at(x: u32, y: u32) -> Samples {
    if SURFACES {
        return Samples(nearness_at(x, y), nearness_at(x + 1u, y), nearness_at(x + 2u, y), nearness_at(x + 3u, y));
    }
    return Samples(vec4<u32>(0u), vec4<u32>(0u), vec4<u32>(0u), vec4<u32>(0u));
}

// The ages of which the particle may touch the block, as bits.
fn ages_at(flame: u32, bounds: vec2<u32>, x: u32, y: u32) -> u32 {
    let first = bounds & vec2<u32>(0xffffu);
    let end = bounds >> vec2<u32>(16u);
    let of_lines = first_band(tiling, flame);
    let of_columns = of_lines + BANDS;
    let across = band_shift(end.x - first.x, GLOW_BLOCK_PX);
    let down = band_shift(end.y - first.y, GLOW_BLOCK_LINES);
    let left = min((max(x, first.x) - first.x) >> across, BANDS - 1u);
    let right = min((max(x + GLOW_BLOCK_PX - 1u, first.x) - first.x) >> across, BANDS - 1u);
    let top = min((max(y, first.y) - first.y) >> down, BANDS - 1u);
    let bottom = min((max(y + GLOW_BLOCK_LINES - 1u, first.y) - first.y) >> down, BANDS - 1u);
    return (flame_tiles[of_lines + top] | flame_tiles[of_lines + bottom])
        & (flame_tiles[of_columns + left] | flame_tiles[of_columns + right]);
}

fn fan_at(at: u32, inner: vec2<f32>) -> Fan {
    let disc = flame_discs[at];
    var skew = vec4<f32>(0.0f);
    if SKEWS {
        skew = bitcast<vec4<f32>>(flame_skews[at]);
    }
    let place = bitcast<vec4<f32>>(disc.place);
    var front = 0u;
    if SURFACES {
        let world = bitcast<vec3<f32>>(flame_steps[at].xyz);
        let row = frame.view_from_world_z;
        let depth = row.x * world.x + row.y * world.y + row.z * world.z + row.w;
        front = front_of(frame, depth, reciprocal(abs(place.z) + abs(skew.x)));
    }
    return Fan(place, skew, inner, bitcast<vec4<f32>>(disc.center), bitcast<vec4<f32>>(disc.rim), front);
}

// What a flame of the slice adds to the block at `x`, `y`, where surfaces are so near.
fn flame_light(nth: u32, x: u32, y: u32, near: ptr<function, array<Samples, 8>>) -> Block {
    var sum = Block(no_line(), no_line(), no_line(), no_line());
    let columns = f32_of_u32(x) + 0.5f + vec4<f32>(0.0f, 1.0f, 2.0f, 3.0f);
    let line = f32_of_u32(y) + 0.5f;
    let flame = tiling.first + nth;
    let bounds = flame_bounds[flame];
    let inner = bitcast<vec2<f32>>(bounds.zw);
    var ages = ages_at(nth, bounds.xy, x, y);
    while ages != 0u {
        let fan = fan_at(flame * FLAME_STEPS + firstTrailingBit(ages), inner);
        sum = Block(
            with_line(sum.a, fan, columns, line, (*near)[0], (*near)[1]),
            with_line(sum.b, fan, columns, line + 1.0f, (*near)[2], (*near)[3]),
            with_line(sum.c, fan, columns, line + 2.0f, (*near)[4], (*near)[5]),
            with_line(sum.d, fan, columns, line + 3.0f, (*near)[6], (*near)[7]),
        );
        ages &= ages - 1u;
    }
    return sum;
}

fn four_steps_of(light: vec4<f32>) -> vec4<u32> {
    return vec4<u32>(steps_of(light.x), steps_of(light.y), steps_of(light.z), steps_of(light.w));
}

fn carry(sum: vec4<u32>, more: vec4<u32>) -> vec4<u32> {
    return select(vec4<u32>(0u), vec4<u32>(1u), sum < more);
}

fn with_light(sum: Steps, light: Lit) -> Steps {
    let red = four_steps_of(light.red);
    let green = four_steps_of(light.green);
    let blue = four_steps_of(light.blue);
    let low_red = sum.low_red + red;
    let low_green = sum.low_green + green;
    let low_blue = sum.low_blue + blue;
    return Steps(
        low_red, sum.high_red + carry(low_red, red),
        low_green, sum.high_green + carry(low_green, green),
        low_blue, sum.high_blue + carry(low_blue, blue),
    );
}

fn add_channel(at: u32, low: u32, high: u32) {
    let sum = light_low[at] + low;
    light_low[at] = sum;
    light_high[at] += high + select(0u, 1u, sum < low);
}

fn add_pixel(x: u32, y: u32, low: vec3<u32>, high: vec3<u32>) {
    if x < frame.width && y < frame.height {
        let first = (y * frame.width + x) * 3u;
        add_channel(first, low.x, high.x);
        add_channel(first + 1u, low.y, high.y);
        add_channel(first + 2u, low.z, high.z);
    }
}

fn add_four(x: u32, y: u32, s: Steps) {
    let low = s.low_red;
    let high = s.high_red;
    add_pixel(x, y, vec3<u32>(low.x, s.low_green.x, s.low_blue.x), vec3<u32>(high.x, s.high_green.x, s.high_blue.x));
    add_pixel(x + 1u, y, vec3<u32>(low.y, s.low_green.y, s.low_blue.y), vec3<u32>(high.y, s.high_green.y, s.high_blue.y));
    add_pixel(x + 2u, y, vec3<u32>(low.z, s.low_green.z, s.low_blue.z), vec3<u32>(high.z, s.high_green.z, s.high_blue.z));
    add_pixel(x + 3u, y, vec3<u32>(low.w, s.low_green.w, s.low_blue.w), vec3<u32>(high.w, s.high_green.w, s.high_blue.w));
}

// The light of all flames of the tile, which are some, on the block.
fn light_block(tile: u32, x: u32, y: u32) {
    var near = array<Samples, 8>(
        samples_at(x, y), samples_at(x + 4u, y), samples_at(x, y + 1u), samples_at(x + 4u, y + 1u),
        samples_at(x, y + 2u), samples_at(x + 4u, y + 2u), samples_at(x, y + 3u), samples_at(x + 4u, y + 3u),
    );
    let none = no_steps();
    var sums = array<Steps, 8>(none, none, none, none, none, none, none, none);
    // The words of the tile that are not looked at yet, the one at hand, and what is left of its bits.
    var words = flame_tiles[tile];
    var word = 0u;
    var bits = 0u;
    while (words | bits) != 0u {
        if bits == 0u {
            word = firstTrailingBit(words);
            words &= words - 1u;
            bits = flame_tiles[tile + 1u + word];
        }
        let light = flame_light(word * 32u + firstTrailingBit(bits), x, y, &near);
        sums[0] = with_light(sums[0], light.a.near);
        sums[1] = with_light(sums[1], light.a.far);
        sums[2] = with_light(sums[2], light.b.near);
        sums[3] = with_light(sums[3], light.b.far);
        sums[4] = with_light(sums[4], light.c.near);
        sums[5] = with_light(sums[5], light.c.far);
        sums[6] = with_light(sums[6], light.d.near);
        sums[7] = with_light(sums[7], light.d.far);
        bits &= bits - 1u;
    }
    add_four(x, y, sums[0]);
    add_four(x + 4u, y, sums[1]);
    add_four(x, y + 1u, sums[2]);
    add_four(x + 4u, y + 1u, sums[3]);
    add_four(x, y + 2u, sums[4]);
    add_four(x + 4u, y + 2u, sums[5]);
    add_four(x, y + 3u, sums[6]);
    add_four(x + 4u, y + 3u, sums[7]);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn glow(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let index = linear_index(global_id, WORKGROUP_SIZE);
    let blocks = blocks_a_tile(tiling);
    let touched = touched_word(tiling);
    let nth = index / blocks;
    if nth >= flame_tiles[touched] {
        return;
    }
    let tile = flame_tiles[touched + 1u + nth];
    let across = tiling.tile_px / GLOW_BLOCK_PX;
    let in_tile = index % blocks;
    let x = (tile % tiling.across) * tiling.tile_px + (in_tile % across) * GLOW_BLOCK_PX;
    let y = (tile / tiling.across) * tiling.tile_px + (in_tile / across) * GLOW_BLOCK_LINES;
    light_block(first_word(tile), x, y);
}
