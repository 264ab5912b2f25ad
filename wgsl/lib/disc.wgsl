// A small disc at rest: the pixels that it covers, and how much of each, antialiased.
//
// Reeves 1983, 2.5. A pixel is covered by the distance of its centre from the disc's, with an edge
// one pixel wide; a gain then makes the sum of the weights the disc's area (its total light),
// wherever it stands between pixels. Reads and writes no buffers. Twin of src/cpu/disc.rs.
#define_import_path motes::disc

#import motes::exact::{clamp_unit, less, reciprocal, square_root, to_i32}
#import motes::reach::{PI, center_of, edged_radius}

// A small disc reaches no further than this, and covers pixels of a square of so many at a side.
const SMALL_REACH_PX: f32 = 2.47f;
const SMALL_SIDE: u32 = 5u;

struct Disc {
    center: vec2<f32>,
    // Of the outermost covered pixel centre.
    reach: f32,
    // First pixel of its square, and that pixel's centre.
    first: vec2<i32>,
    first_center: vec2<f32>,
}

// The pixels of a disc's square that it covers, a bit each, column by column; and what its weights
// are to be multiplied by.
struct Covered {
    bits: u32,
    gain: f32,
}

// How far a disc reaches at rest.
fn reach_of(radius_px: f32) -> f32 {
    return edged_radius(radius_px) + 0.5f;
}

fn disc_at(center: vec2<f32>, reach: f32) -> Disc {
    let left = to_i32(center.x - reach + 0.5f);
    let top = to_i32(center.y - reach + 0.5f);
    let first_center = vec2<f32>(center_of(left), center_of(top));
    return Disc(center, reach, vec2<i32>(left, top), first_center);
}

// The column of a bit, and its line.
fn place_of(bit: u32) -> vec2<u32> {
    // A fifth, of numbers below 64: a division is many instructions where words are in vectors.
    let column = (bit * 13u) >> 6u;
    return vec2<u32>(column, bit - column * SMALL_SIDE);
}

// How much of the pixel around `place` the disc covers, 0 to 1.
fn weight_at(disc: Disc, place: vec2<f32>) -> f32 {
    let dx = place.x - disc.center.x;
    let dy = place.y - disc.center.y;
    return clamp_unit(disc.reach - square_root(dx * dx + dy * dy));
}

// Bits below 2^count, of at most five.
fn low_bits(count: i32) -> u32 {
    return (1u << u32(clamp(count, 0, 5))) - 1u;
}

// What the disc covers of a picture of `size_px`.
fn covered_of(disc: Disc, radius_px: f32, size_px: vec2<i32>) -> Covered {
    let side = i32(SMALL_SIDE);
    let columns = min(to_i32(disc.center.x + disc.reach - 0.5f) - disc.first.x + 1, side);
    let lines = min(to_i32(disc.center.y + disc.reach - 0.5f) - disc.first.y + 1, side);
    // Lines of the square within the picture.
    let within = low_bits(size_px.y - disc.first.y) & ~low_bits(-disc.first.y);
    var bits = 0u;
    var sum = 0.0f;
    var place = disc.first_center;
    for (var column = 0; column < columns; column += 1) {
        var line_bits = 0u;
        place.y = disc.first_center.y;
        for (var line = 0; line < lines; line += 1) {
            let weight = weight_at(disc, place);
            line_bits |= select(0u, 1u, less(0.0f, weight)) << u32(line);
            sum += weight;
            place.y += 1.0f;
        }
        let x = disc.first.x + column;
        let here = line_bits & select(0u, within, x >= 0 && x < size_px.x);
        bits |= here << (u32(column) * SMALL_SIDE);
        place.x += 1.0f;
    }
    return Covered(bits, PI * radius_px * radius_px * reciprocal(sum));
}
