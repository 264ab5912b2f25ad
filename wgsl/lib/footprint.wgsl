// The pixels that a streak, a square or a larger disc covers, and how much of each, antialiased.
//
// Reeves 1983, 2.5 and 3. A streak is a disc swept from its place at the frame's start to its place
// when the shutter closes; a rectangle is a square that faces the viewer. Rows of pixels go across the
// axis along which it is longer.
// A disc or streak covers a pixel by the distance of the pixel's centre from the segment, with an
// edge one pixel wide; a gain then makes the sum of the weights the disc's area (its total light),
// wherever it stands between pixels and however long the streak is. Few pixels are summed one by
// one; of many, the sum is that of the integral. Reads and writes no buffers. Twin of
// src/cpu/footprint.rs.
#define_import_path motes::footprint

#import motes::exact::{
    clamp_unit, inverse_square_root, less, max_exact, min_exact, reciprocal, square_root, to_i32,
}
#import motes::layout::{FRAME_EYE, Frame}
#import motes::projection::Projected
#import motes::reach::{LEAST_WAY_SQUARED, PI, center_of, edged_radius, overlap}

// Footprints of at most this many pixels are summed one by one, and drawn by one invocation:
// drivers end an invocation's loops when they have turned 65,535 times in all.
const FEW_CELLS: u32 = 2048u;
// A disc of at least this radius needs no gain; below half of it, all of it.
const LARGE_RADIUS_PX: f32 = 4.0f;
// Pixels count by their centres, so rows of what is no farther away than this are narrower by
// nearly half a pixel on either side; a rest is left for rounding.
const NEAR_PX: f32 = 16384.0f;
const CENTER_TRIM_PX: f32 = 0.375f;
// Pixel coordinates are kept within these, and ranges of them below 2^15.
const FARTHEST_PX: i32 = 16777216;
const LONGEST_PX: i32 = 32768;

// Invocations that share a footprint of many pixels: rows enough for the largest picture.
const SHARES: u32 = 256u;

// large_particles: how many footprints of few pixels are listed, how many of many; the same once more,
// for splat_large, when all are; then from here indices, those of few from the front, of many from
// the back.
const LIST_START: u32 = 4u;

// A disc swept along a segment, or a square; `major` is the axis on which the segment is longer.
struct Footprint {
    // Whether it is a square at rest.
    square: bool,
    // Whether the major axis is y.
    steep: bool,
    start_major: f32,
    start_minor: f32,
    along_major: f32,
    along_minor: f32,
    // 1 / length squared; 0 at rest.
    inverse_length_squared: f32,
    // Reach of the outermost covered pixel centre, across the segment and along the minor axis.
    reach: f32,
    minor_reach: f32,
    slope: f32,
    gain: f32,
    // How much the light at the start and at the end counts: early + late t, 1 on average.
    early: f32,
    late: f32,
    // First and one past the last row of pixels across the major axis, within the picture.
    first: i32,
    last: i32,
    // Pixels of the picture along the minor axis.
    minor_size: i32,
}

// How much of the pixel with its centre there the disc or streak covers, 0 to 1, times how much that light counts.
fn weight_at(shape: Footprint, major: f32, minor: f32) -> f32 {
    let dx = major - shape.start_major;
    let dy = minor - shape.start_minor;
    let along = (dx * shape.along_major + dy * shape.along_minor) * shape.inverse_length_squared;
    let t = clamp_unit(along);
    let ex = dx - t * shape.along_major;
    let ey = dy - t * shape.along_minor;
    let distance = square_root(ex * ex + ey * ey);
    return clamp_unit(shape.reach - distance) * (shape.early + t * shape.late);
}

// How much of the pixel with its centre there the square covers, 0 to 1.
fn square_weight_at(shape: Footprint, major: f32, minor: f32) -> f32 {
    return overlap(major, shape.start_major - shape.reach, shape.start_major + shape.reach)
        * overlap(minor, shape.start_minor - shape.reach, shape.start_minor + shape.reach);
}

// First and one past the last pixel along the minor axis that may be covered, of the row whose
// centres are at `major`.
fn minor_range(shape: Footprint, major: f32) -> vec2<i32> {
    let middle = shape.start_minor + (major - shape.start_major) * shape.slope;
    return vec2<i32>(
        to_i32(middle - shape.minor_reach),
        to_i32(middle + shape.minor_reach) + 1,
    );
}

// Whether one invocation may draw it: its rows have at most FEW_CELLS pixels, were the picture
// without end.
fn is_for_one(start: Projected, end: Projected, radius_px: f32) -> bool {
    let way = max_exact(abs(end.x - start.x), abs(end.y - start.y));
    // Rows are as wide as across a segment at 45 degrees at most.
    let width = 2.83f * (max_exact(radius_px, 0.5f) + 0.5f) + 2.0f;
    return less((way + width) * width, f32(FEW_CELLS));
}

fn span(first: i32, last: i32) -> u32 {
    return u32(clamp(last - first, 0, LONGEST_PX));
}

// What makes the sum of the weights the area of the disc at rest, or with `swept` the area that it
// sweeps.
fn gain_of(
    shape: Footprint, radius_px: f32, first: i32, last: i32, cells: u32, moves: bool, swept: bool,
) -> f32 {
    if !moves && !less(radius_px, LARGE_RADIUS_PX) {
        return 1.0f;
    }
    let length_squared = shape.along_major * shape.along_major
        + shape.along_minor * shape.along_minor;
    let edge = shape.reach - 0.5f;
    let area = select(
        PI * radius_px * radius_px,
        PI * edge * edge + 2.0f * edge * square_root(length_squared),
        swept,
    );
    var sum = 2.0f * edge * square_root(length_squared)
        + PI * (edge * edge + 0.0833333333f);
    if cells <= FEW_CELLS {
        sum = 0.0f;
        var at_major = center_of(first);
        for (var major = first; major < last; major += 1) {
            let range = minor_range(shape, at_major);
            var at_minor = center_of(range.x);
            for (var minor = range.x; minor < range.y; minor += 1) {
                sum += weight_at(shape, at_major, at_minor);
                at_minor += 1.0f;
            }
            at_major += 1.0f;
        }
    }
    let gain = area * reciprocal(sum);
    let half = 0.5f * LARGE_RADIUS_PX;
    let share = clamp_unit((radius_px - half) * 0.5f);
    return select(gain + share * (1.0f - gain), gain, moves);
}

// The footprint of a disc that moves from `start` to `end`; of a square if it is to be one.
fn footprint_of(
    view: Frame, start: Projected, end: Projected, radius_px: f32, square: bool, conserved: bool,
) -> Footprint {
    var shape: Footprint;
    let dx = end.x - start.x;
    let dy = end.y - start.y;
    let length_squared = dx * dx + dy * dy;
    let moves = less(LEAST_WAY_SQUARED, length_squared);
    let steep = square || less(abs(dx), abs(dy));
    shape.steep = steep;
    shape.start_major = select(start.x, start.y, steep);
    shape.start_minor = select(start.y, start.x, steep);
    shape.along_major = select(0.0f, select(dx, dy, steep), moves);
    shape.along_minor = select(0.0f, select(dy, dx, steep), moves);
    let inverse_length = inverse_square_root(length_squared);
    shape.inverse_length_squared = select(0.0f, inverse_length * inverse_length, moves);
    shape.slope = shape.along_minor * reciprocal(shape.along_major);
    // A streak whose light is not conserved is a line of its own width, or a pixel's.
    let swept = !conserved && moves;
    let edge = select(edged_radius(radius_px), max_exact(radius_px, 0.5f), swept);
    shape.reach = select(edge + 0.5f, radius_px, square);
    let minor_reach = shape.reach * square_root(1.0f + shape.slope * shape.slope);
    let farthest = max_exact(
        max_exact(abs(start.x), abs(start.y)), max_exact(abs(end.x), abs(end.y)),
    );
    let is_near = !square && less(farthest, NEAR_PX);
    shape.minor_reach = select(minor_reach, minor_reach - CENTER_TRIM_PX, is_near);
    shape.gain = 1.0f;
    // An eye keeps what came last best: light counts in proportion to the time since the shutter
    // opened. What the early half loses, caps included, the late half gains.
    // Of a short streak hardly so, or a pixel's centre before its start could get it all.
    let eye = moves && (view.flags & FRAME_EYE) != 0u;
    let length = length_squared * inverse_length;
    let lateness = clamp_unit(0.25f * length * reciprocal(shape.reach));
    shape.early = select(1.0f, 1.0f - lateness, eye);
    shape.late = select(0.0f, 2.0f * lateness, eye);
    shape.square = square;
    let end_major = shape.start_major + shape.along_major;
    let first = clamp(
        to_i32(min_exact(shape.start_major, end_major) - shape.reach), -FARTHEST_PX, FARTHEST_PX,
    );
    let last = clamp(
        to_i32(max_exact(shape.start_major, end_major) + shape.reach) + 1, -FARTHEST_PX, FARTHEST_PX,
    );
    let width = i32(view.width);
    let height = i32(view.height);
    let across = u32(to_i32(2.0f * minor_reach)) + 2u;
    shape.first = max(first, 0);
    shape.last = min(last, select(width, height, steep));
    shape.minor_size = select(height, width, steep);
    if !square {
        let cells = span(first, last) * across;
        shape.gain = gain_of(shape, radius_px, first, last, cells, moves, swept);
    }
    return shape;
}
