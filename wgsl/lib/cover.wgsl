// What covers: which part of a pixel a primitive covers, in which colour, and how one stands over
// what is behind it.
//
// Porter and Duff, "Compositing digital images" (1984), from near to far: `clear` is how much of what
// is behind shows through all that has come before. Discs and segments cover a pixel by the distance
// of its centre, with an edge one pixel wide (motes::reach), cones, too; squares and triangles by
// their area in it. Spheres and cones are lit as Lambert has it. Outside its bounds a primitive covers exactly nothing, so a
// pixel does not depend on which others it is looked up with. What is mirrored covers a pixel as its
// original covers the one across the picture's upright middle line, bit for bit.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/cover.rs.
#define_import_path motes::cover

#import motes::exact::{
    clamp_exact, dot3, f32_of_i32, inverse_square_root, less, max_exact, min_exact, reciprocal, snap, snap3,
    square_root, to_i32,
}
#import motes::reach::{center_of, overlap}
#import motes::layout::{
    COVER_CONE, COVER_MIRRORED, COVER_NONE, COVER_SEGMENT, COVER_SLANTED, COVER_SOFT_DISC, COVER_SQUARE,
    COVER_STROKE, COVER_TRIANGLE, COVER_TWIN, Cover, STROKE_UNCUT,
}

// What shows less than this of itself is hidden.
const HIDDEN: f32 = 0.0000152587890625f;
// A triangle that covers less of a pixel covers nothing of it.
const LEAST_AREA: f32 = 0.000244140625f;
// Edges that run across a pixel's height by less than this count as upright there.
const UPRIGHT: f32 = 0.00390625f;
// What lies farther from the picture's corner counts as there.
const FARTHEST: f32 = 1048576.0f;
// A distance is wrong by less than this part of the largest number that it is made of.
const ROUNDING: f32 = 0.0000038146973f;
// Sine of the angle between a cone's axis and its side, as boids have it, and what it says of its cosine.
const SINE_OF_CONE: f32 = 0.25f;
const INVERSE_SQUARED_COSINE: f32 = 1.0666667f;
// A cone ends here, in parts of its length.
const NEXT_TO_APEX: f32 = 0.98f;

// Which kinds there may be, discs apart, and whether any of them is mirrored.
struct Kinds {
    squares: bool,
    segments: bool,
    triangles: bool,
    mirrors: bool,
    cones: bool,
    slants: bool,
    strokes: bool,
}

// A pixel on the way from near to far: light that is seen, and how much of the rest shows through.
struct Layered {
    color: vec3<f32>,
    clear: f32,
}

// The key that sorts from far to near, 0 for what covers nothing.
fn far_to_near(cover: Cover) -> u32 {
    let depth = cover.shape.w;
    let rising = select(depth | 0x80000000u, ~depth, depth >= 0x80000000u);
    return select(~rising, 0u, cover.shape.z == COVER_NONE);
}

// First pixel and one past the last, across and down, that its shape may cover where it is, in a
// picture of that size. Distances that are rounded may fall short, by less than the margin.
fn bounds_here(cover: Cover, width: u32, height: u32) -> vec4<i32> {
    let points = bitcast<vec4<f32>>(cover.points);
    let shape = bitcast<vec2<f32>>(cover.shape.xy);
    let is_stroke = cover.shape.z == COVER_STROKE;
    let is_segment = cover.shape.z == COVER_SEGMENT || cover.shape.z == COVER_CONE || is_stroke;
    let end = select(points.xy, points.zw, is_segment);
    let largest = max_exact(
        max_exact(abs(points.x), abs(points.y)),
        max_exact(max_exact(abs(end.x), abs(end.y)), shape.x),
    );
    let of_stroke = max_exact(max_exact(shape.x, shape.y), 0.5f) + 0.5f;
    let reach = select(shape.x, of_stroke, is_stroke) + largest * ROUNDING;
    var low = vec2<f32>(min_exact(points.x, end.x), min_exact(points.y, end.y)) - vec2<f32>(reach);
    var high = vec2<f32>(max_exact(points.x, end.x), max_exact(points.y, end.y)) + vec2<f32>(reach);
    if cover.shape.z == COVER_TRIANGLE {
        low.x = min_exact(min_exact(points.x, points.z), shape.x);
        low.y = min_exact(min_exact(points.y, points.w), shape.y);
        high.x = max_exact(max_exact(points.x, points.z), shape.x);
        high.y = max_exact(max_exact(points.y, points.w), shape.y);
    }
    return vec4<i32>(
        max(to_i32(clamp_exact(low.x, -FARTHEST, FARTHEST)), 0),
        max(to_i32(clamp_exact(low.y, -FARTHEST, FARTHEST)), 0),
        min(to_i32(clamp_exact(high.x, -FARTHEST, FARTHEST)) + 1, i32(width)),
        min(to_i32(clamp_exact(high.y, -FARTHEST, FARTHEST)) + 1, i32(height)),
    );
}

// The same wherever it is drawn.
fn bounds_of(cover: Cover, width: u32, height: u32) -> vec4<i32> {
    let here = bounds_here(cover, width, height);
    let across = vec4<i32>(i32(width) - here.z, here.y, i32(width) - here.x, here.w);
    let both = vec4<i32>(min(here.x, across.x), here.y, max(here.z, across.z), here.w);
    let moved = select(here, across, cover.lit.w == COVER_MIRRORED);
    return select(moved, both, cover.lit.w == COVER_TWIN);
}

// Bounds within a picture, four halves of words.
fn packed_bounds(bounds: vec4<i32>) -> vec2<u32> {
    let words = vec4<u32>(bounds);
    return words.xy | words.zw << vec2<u32>(16u);
}

// Whether such bounds hold one of the four pixels from there to the right.
fn may_touch(packed: vec2<u32>, x: i32, y: i32) -> bool {
    let low = vec2<i32>(packed & vec2<u32>(0xffffu));
    let high = vec2<i32>(packed >> vec2<u32>(16u));
    return y >= low.y && y < high.y && x + 3 >= low.x && x < high.x;
}

// Whether what may cover so much of a picture of that width overlaps its mirror image.
fn straddles(bounds: vec4<i32>, width: u32) -> bool {
    return 2i * bounds.x < i32(width) && 2i * bounds.z > i32(width);
}

// The mean of x clamped to 0 .. 1, along a line from `a` to `b`.
fn mean_clamped(a: f32, b: f32) -> f32 {
    let low = min_exact(a, b);
    let high = max_exact(a, b);
    if less(high - low, UPRIGHT) || !less(0.0f, high) || !less(low, 1.0f) {
        return clamp_exact(0.5f * (low + high), 0.0f, 1.0f);
    }
    let begin = clamp_exact(low, 0.0f, 1.0f);
    let end = clamp_exact(high, 0.0f, 1.0f);
    let within = 0.5f * (end * end - begin * begin) + max_exact(high - 1.0f, 0.0f);
    return within * reciprocal(high - low);
}

// The signed area between an edge and the left side of the unit square, within the square.
fn beside_edge(ax: f32, ay: f32, bx: f32, by: f32) -> f32 {
    let begin = clamp_exact(ay, 0.0f, 1.0f);
    let end = clamp_exact(by, 0.0f, 1.0f);
    let slope = (bx - ax) * reciprocal(by - ay);
    let low = min_exact(ax, bx);
    let high = max_exact(ax, bx);
    let at_from = clamp_exact(ax + (begin - ay) * slope, low, high);
    let at_to = clamp_exact(ax + (end - ay) * slope, low, high);
    return (end - begin) * mean_clamped(at_from, at_to);
}

// The part of a pixel that a triangle covers, its corners given from the pixel's.
fn triangle_area(a: vec2<f32>, b: vec2<f32>, c: vec2<f32>) -> f32 {
    let high_x = max_exact(max_exact(a.x, b.x), c.x);
    let low_x = min_exact(min_exact(a.x, b.x), c.x);
    let high_y = max_exact(max_exact(a.y, b.y), c.y);
    let low_y = min_exact(min_exact(a.y, b.y), c.y);
    if less(high_x, 0.0f) || less(high_y, 0.0f) || less(1.0f, low_x) || less(1.0f, low_y) {
        return 0.0f;
    }
    let area = abs(
        beside_edge(a.x, a.y, b.x, b.y) + beside_edge(b.x, b.y, c.x, c.y) + beside_edge(c.x, c.y, a.x, a.y),
    );
    return select(min_exact(area, 1.0f), 0.0f, less(area, LEAST_AREA));
}

// How far a place is from a segment.
fn distance_from(x: f32, y: f32, points: vec4<f32>) -> f32 {
    let along_x = points.z - points.x;
    let along_y = points.w - points.y;
    let dx = x - points.x;
    let dy = y - points.y;
    let along = (dx * along_x + dy * along_y) * reciprocal(along_x * along_x + along_y * along_y);
    let t = clamp_exact(along, 0.0f, 1.0f);
    let ex = dx - t * along_x;
    let ey = dy - t * along_y;
    return square_root(ex * ex + ey * ey);
}

// A place as a cone has it, whose base has that radius: from its centre along its axis in the picture,
// and to the right of it; how long the axis is there; sine and cosine of the angle between it and
// the outline, 1 and 0 where nothing but the base is seen.
struct InCone {
    along: f32,
    across: f32,
    length: f32,
    sine: f32,
    cosine: f32,
    // The axis.
    way: vec2<f32>,
}

fn in_cone(points: vec4<f32>, radius: f32, x: f32, y: f32) -> InCone {
    let axis = points.zw - points.xy;
    let squared = axis.x * axis.x + axis.y * axis.y;
    // Straight from or to the viewer, any.
    let way = select(vec2<f32>(1.0f, 0.0f), axis * inverse_square_root(squared), less(0.0f, squared));
    let dx = x - points.x;
    let dy = y - points.y;
    let length = square_root(squared);
    let sine = select(1.0f, radius * reciprocal(length), less(radius, length));
    return InCone(
        dx * way.x + dy * way.y,
        dy * way.x - dx * way.y,
        length,
        sine,
        square_root(max_exact(1.0f - sine * sine, 0.0f)),
        way,
    );
}

// Whether the outline next to the place is that of the base.
fn is_by_base(at: InCone) -> bool {
    return !less(at.sine, 1.0f) || less(at.cosine * at.along, at.sine * abs(at.across));
}

// How far a place is outside a cone: of the hull of a disc and a point.
fn distance_from_cone(points: vec4<f32>, radius: f32, x: f32, y: f32) -> f32 {
    let at = in_cone(points, radius, x, y);
    let aside = abs(at.across);
    if is_by_base(at) {
        return square_root(at.along * at.along + aside * aside) - radius;
    }
    if less(at.cosine * at.length, at.cosine * at.along - at.sine * aside) {
        let beyond = at.along - at.length;
        return square_root(beyond * beyond + aside * aside);
    }
    return at.cosine * aside + at.sine * at.along - radius;
}

// How straight the light falls on the cone that is seen in the pixel, 0 to 1. A cone is what balls fill
// that shrink to nothing on their way from the base to the apex; the one that is seen there touches its
// side, which tells it by the root of a square. Lengths are parts of the cone's.
fn light_on_cone(cover: Cover, light_from: vec3<f32>, x: f32, y: f32) -> f32 {
    let points = bitcast<vec4<f32>>(cover.points);
    let radius = bitcast<f32>(cover.shape.x) - 0.5f;
    let is_ahead = !less(bitcast<f32>(cover.shape.y), 0.0f);
    let at = in_cone(points, radius, x, y);
    let part_of_px = SINE_OF_CONE * reciprocal(radius);
    let slant = min_exact(at.length * part_of_px, 1.0f);
    let along = at.along * part_of_px;
    let across = at.across * part_of_px;
    let e = SINE_OF_CONE * SINE_OF_CONE - slant * along;
    let f = slant * slant - SINE_OF_CONE * SINE_OF_CONE;
    let aside = SINE_OF_CONE * SINE_OF_CONE - across * across - along * along;
    let k = ((1.0f - slant * slant) * aside - e * e) * INVERSE_SQUARED_COSINE;
    let root = square_root(max_exact(e * e + f * k, 0.0f));
    var t = select((root - e) * reciprocal(f), k * reciprocal(e + root), less(0.0f, e));
    if !is_ahead {
        t = select(0.0f, k * reciprocal(e - root), less(e, 0.0f));
    }
    // Beyond the apex; and on the base, which is a ball.
    t = select(t, select(0.0f, NEXT_TO_APEX, less(0.0f, f)), less(NEXT_TO_APEX, t));
    t = max_exact(t, 0.0f);
    let inverse = reciprocal(SINE_OF_CONE * (1.0f - t));
    let ahead = (along - slant * t) * inverse;
    let right = across * inverse;
    let toward = square_root(max_exact(1.0f - ahead * ahead - right * right, 0.0f));
    // In the space of the light y goes up.
    let normal = vec3<f32>(at.way.x * ahead - at.way.y * right, -at.way.y * ahead - at.way.x * right, toward);
    return clamp_exact(dot3(normal, light_from), 0.0f, 1.0f);
}

// Whether a place is ahead of a line across a direction: that of the number, -2 to 2, which says where
// the direction meets a square.
fn is_ahead(cut: f32, away: vec2<f32>) -> bool {
    let right = 1.0f - abs(cut);
    let down = select(1.0f - abs(right), abs(right) - 1.0f, less(cut, 0.0f));
    return !less(away.x * right + away.y * down, 0.0f);
}

// How much of the pixel a piece of a stroke covers. Pieces that follow each other are cut off at one
// line, so that a pixel's centre is in one of them; where nothing is cut off, the end is round. What is
// thinner than a pixel is that much clearer.
fn coverage_of_stroke(cover: Cover, x: f32, y: f32) -> f32 {
    let points = bitcast<vec4<f32>>(cover.points);
    let half = bitcast<vec2<f32>>(cover.shape.xy);
    let cuts = bitcast<vec2<f32>>(cover.lit.xy);
    let axis = points.zw - points.xy;
    let from_begin = vec2<f32>(x, y) - points.xy;
    let from_end = vec2<f32>(x, y) - points.zw;
    let inverse = reciprocal(axis.x * axis.x + axis.y * axis.y);
    let along = clamp_exact((from_begin.x * axis.x + from_begin.y * axis.y) * inverse, 0.0f, 1.0f);
    let aside = from_begin - axis * along;
    let half_px = half.x + (half.y - half.x) * along;
    let distance = square_root(aside.x * aside.x + aside.y * aside.y);
    let within = clamp_exact(max_exact(half_px, 0.5f) + 0.5f - distance, 0.0f, 1.0f);
    let is_before = less(cuts.x, STROKE_UNCUT) && !is_ahead(cuts.x, from_begin);
    let is_past = less(cuts.y, STROKE_UNCUT) && is_ahead(cuts.y, from_end);
    return select(within * min_exact(2.0f * half_px, 1.0f), 0.0f, is_before || is_past);
}

// How much of the pixel it covers, 0 to 1.
fn coverage_at(cover: Cover, kinds: Kinds, x: i32, y: i32) -> f32 {
    let points = bitcast<vec4<f32>>(cover.points);
    let shape = bitcast<vec2<f32>>(cover.shape.xy);
    let kind = cover.shape.z;
    let center_x = f32_of_i32(x) + 0.5f;
    let center_y = f32_of_i32(y) + 0.5f;
    if kinds.squares && kind == COVER_SQUARE {
        return overlap(center_of(x), points.x - shape.x, points.x + shape.x)
            * overlap(center_of(y), points.y - shape.x, points.y + shape.x);
    }
    if kinds.triangles && kind == COVER_TRIANGLE {
        let corner = vec2<f32>(f32_of_i32(x), f32_of_i32(y));
        return triangle_area(points.xy - corner, points.zw - corner, shape - corner);
    }
    if kinds.cones && kind == COVER_CONE {
        let outside = distance_from_cone(points, shape.x - 0.5f, center_x, center_y);
        return clamp_exact(0.5f - outside, 0.0f, 1.0f);
    }
    if kinds.strokes && kind == COVER_STROKE {
        return coverage_of_stroke(cover, center_x, center_y);
    }
    var distance: f32;
    if kinds.segments && kind == COVER_SEGMENT {
        distance = distance_from(center_x, center_y, points);
    } else {
        let dx = center_x - points.x;
        let dy = center_y - points.y;
        var squared = dx * dx + dy * dy;
        if kinds.slants && kind == COVER_SLANTED {
            // How much farther away its place in this pixel is than its middle.
            let behind_px = points.z * dx + points.w * dy;
            squared += behind_px * behind_px;
        }
        distance = square_root(squared);
    }
    let within = clamp_exact((shape.x - distance) * shape.y, 0.0f, 1.0f);
    let is_soft = kind == COVER_SOFT_DISC || (kinds.slants && kind == COVER_SLANTED);
    return select(within, within * within * (3.0f - 2.0f * within), is_soft);
}

// How straight the light falls on the ball that is seen in the pixel, 0 to 1.
fn light_on(cover: Cover, light_from: vec3<f32>, x: i32, y: i32) -> f32 {
    let points = bitcast<vec4<f32>>(cover.points);
    let right = (f32_of_i32(x) + 0.5f - points.x) * points.z;
    let up = (points.y - f32_of_i32(y) - 0.5f) * points.z;
    let aside = right * right + up * up;
    let toward = square_root(max_exact(1.0f - aside, 0.0f));
    // Past its rim, in the pixels of its edge, a ball is as at its rim.
    return clamp_exact(right * light_from.x + up * light_from.y + toward * light_from.z, 0.0f, 1.0f);
}

// Where a pixel is, and how wide the picture.
struct Spot {
    x: i32,
    y: i32,
    width: i32,
}

// How much of what is behind it hides in the pixel, 0 to 1, and how straight the light falls on it.
struct Part {
    alpha: f32,
    light: f32,
}

fn part_here(cover: Cover, kinds: Kinds, light_from: vec3<f32>, x: i32, y: i32) -> Part {
    let alpha = snap(bitcast<f32>(cover.color.w) * coverage_at(cover, kinds, x, y));
    if kinds.cones && cover.shape.z == COVER_CONE {
        return Part(alpha, light_on_cone(cover, light_from, f32_of_i32(x) + 0.5f, f32_of_i32(y) + 0.5f));
    }
    let light = light_on(cover, light_from, x, y);
    return Part(alpha, select(light, 0.0f, kinds.strokes && cover.shape.z == COVER_STROKE));
}

// The same wherever it is drawn. Two that overlap are the same whichever is in front.
fn part_at(cover: Cover, kinds: Kinds, light_from: vec3<f32>, spot: Spot) -> Part {
    let across = spot.width - 1i - spot.x;
    let is_across = kinds.mirrors && cover.lit.w == COVER_MIRRORED;
    let own = part_here(cover, kinds, light_from, select(spot.x, across, is_across), spot.y);
    if !kinds.mirrors || cover.lit.w != COVER_TWIN {
        return own;
    }
    let other = part_here(cover, kinds, light_from, across, spot.y);
    let sum = own.alpha + other.alpha;
    let light = (own.alpha * own.light + other.alpha * other.light) * reciprocal(sum);
    return Part(snap(sum - own.alpha * other.alpha), light);
}

// The pixel with `cover` behind what it has so far.
fn behind(above: Layered, cover: Cover, kinds: Kinds, light_from: vec3<f32>, spot: Spot) -> Layered {
    let color = bitcast<vec4<f32>>(cover.color);
    let lit = bitcast<vec3<f32>>(cover.lit.xyz);
    let part = part_at(cover, kinds, light_from, spot);
    let alpha = part.alpha;
    let seen = select(above.clear * alpha, 0.0f, less(above.clear, HIDDEN));
    let look = color.xyz + lit * part.light;
    let clear = select(above.clear * (1.0f - alpha), above.clear, less(above.clear, HIDDEN));
    return Layered(snap3(above.color + look * seen), snap(clear));
}
