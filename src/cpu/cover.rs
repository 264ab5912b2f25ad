//! What covers: which part of a pixel a primitive covers, in which colour, and how one stands over what
//! is behind it. Twin of `wgsl/lib/cover.wgsl`, line by line; see there.

use glam::Vec3;

use crate::cpu::reach::{center_of, overlap};
use crate::exact::{
    clamp_exact, dot3, f32_of_i32, inverse_square_root, less, max_exact, min_exact, reciprocal,
    shared_constants, snap, snap3, square_root, to_i32,
};
use crate::layout::{
    COVER_CONE, COVER_MIRRORED, COVER_NONE, COVER_SEGMENT, COVER_SLANTED, COVER_SOFT_DISC,
    COVER_SQUARE, COVER_STROKE, COVER_TRIANGLE, COVER_TWIN, Cover, STROKE_UNCUT,
};

shared_constants! {
    /// What shows less than this of itself is hidden.
    pub(super) const HIDDEN: f32 = 0.000_015_258_789;
    /// A triangle that covers less of a pixel covers nothing of it.
    const LEAST_AREA: f32 = 0.000_244_140_63;
    /// Edges that run across a pixel's height by less than this count as upright there.
    const UPRIGHT: f32 = 0.003_906_25;
    /// What lies farther from the picture's corner counts as there.
    const FARTHEST: f32 = 1_048_576.0;
    /// A distance is wrong by less than this part of the largest number that it is made of.
    const ROUNDING: f32 = 0.000_003_814_697_3;
    /// Sine of the angle between a cone's axis and its side, as boids have it.
    const SINE_OF_CONE: f32 = 0.25;
    /// What it says of its cosine.
    const INVERSE_SQUARED_COSINE: f32 = 1.066_666_7;
    /// A cone ends here, in parts of its length.
    const NEXT_TO_APEX: f32 = 0.98;
}

/// A pixel on the way from near to far: light that is seen, and how much of the rest shows through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layered {
    /// Red, green, blue that is seen so far.
    pub color: Vec3,
    /// How much of what is behind shows through, 0 to 1.
    pub clear: f32,
}

impl Layered {
    /// Nothing yet.
    pub const EMPTY: Self = Self {
        color: Vec3::ZERO,
        clear: 1.0,
    };

    /// Whether nothing that lies behind is seen.
    #[inline]
    pub(crate) fn is_closed(&self) -> bool {
        less(self.clear, HIDDEN)
    }
}

/// The key that sorts from far to near, 0 for what covers nothing.
#[inline]
pub fn far_to_near(cover: &Cover) -> u32 {
    let depth = cover.shape[3];
    let rising = if depth >= 0x8000_0000 {
        !depth
    } else {
        depth | 0x8000_0000
    };
    if cover.shape[2] == COVER_NONE {
        0
    } else {
        !rising
    }
}

/// First pixel and one past the last, across and down, that its shape may cover where it is, in a
/// picture of that size. Distances that are rounded may fall short, by less than the margin.
#[inline]
pub fn bounds_here(cover: &Cover, width: u32, height: u32) -> [i32; 4] {
    let [ax, ay, bx, by] = cover.points.map(f32::from_bits);
    let [u, v] = [cover.shape[0], cover.shape[1]].map(f32::from_bits);
    let is_stroke = cover.shape[2] == COVER_STROKE;
    let is_segment = [COVER_SEGMENT, COVER_CONE].contains(&cover.shape[2]) || is_stroke;
    let (end_x, end_y) = if is_segment { (bx, by) } else { (ax, ay) };
    let largest = max_exact(
        max_exact(ax.abs(), ay.abs()),
        max_exact(max_exact(end_x.abs(), end_y.abs()), u),
    );
    let of_stroke = max_exact(max_exact(u, v), 0.5) + 0.5;
    let reach = if is_stroke { of_stroke } else { u } + largest * ROUNDING;
    let mut low = [min_exact(ax, end_x) - reach, min_exact(ay, end_y) - reach];
    let mut high = [max_exact(ax, end_x) + reach, max_exact(ay, end_y) + reach];
    if cover.shape[2] == COVER_TRIANGLE {
        low[0] = min_exact(min_exact(ax, bx), u);
        low[1] = min_exact(min_exact(ay, by), v);
        high[0] = max_exact(max_exact(ax, bx), u);
        high[1] = max_exact(max_exact(ay, by), v);
    }
    let pixel = |x: f32| to_i32(clamp_exact(x, -FARTHEST, FARTHEST));
    [
        pixel(low[0]).max(0),
        pixel(low[1]).max(0),
        (pixel(high[0]) + 1).min(width as i32),
        (pixel(high[1]) + 1).min(height as i32),
    ]
}

/// The same wherever it is drawn.
#[inline]
pub fn bounds_of(cover: &Cover, width: u32, height: u32) -> [i32; 4] {
    let [left, top, right, bottom] = bounds_here(cover, width, height);
    let (across_left, across_right) = (width as i32 - right, width as i32 - left);
    match cover.lit[3] {
        COVER_MIRRORED => [across_left, top, across_right, bottom],
        COVER_TWIN => [left.min(across_left), top, right.max(across_right), bottom],
        _ => [left, top, right, bottom],
    }
}

/// Whether what may cover so much of a picture of that width overlaps its mirror image.
#[inline]
pub fn straddles([left, _, right, _]: [i32; 4], width: u32) -> bool {
    2 * left < width as i32 && 2 * right > width as i32
}

/// The mean of x clamped to 0 .. 1, along a line from `a` to `b`.
fn mean_clamped(a: f32, b: f32) -> f32 {
    let low = min_exact(a, b);
    let high = max_exact(a, b);
    if less(high - low, UPRIGHT) || !less(0.0, high) || !less(low, 1.0) {
        return clamp_exact(0.5 * (low + high), 0.0, 1.0);
    }
    let from = clamp_exact(low, 0.0, 1.0);
    let to = clamp_exact(high, 0.0, 1.0);
    let within = 0.5 * (to * to - from * from) + max_exact(high - 1.0, 0.0);
    within * reciprocal(high - low)
}

/// The signed area between an edge and the left side of the unit square, within the square.
fn beside_edge([ax, ay]: [f32; 2], [bx, by]: [f32; 2]) -> f32 {
    let from = clamp_exact(ay, 0.0, 1.0);
    let to = clamp_exact(by, 0.0, 1.0);
    let slope = (bx - ax) * reciprocal(by - ay);
    let low = min_exact(ax, bx);
    let high = max_exact(ax, bx);
    let at_from = clamp_exact(ax + (from - ay) * slope, low, high);
    let at_to = clamp_exact(ax + (to - ay) * slope, low, high);
    (to - from) * mean_clamped(at_from, at_to)
}

/// The part of a pixel that a triangle covers, its corners given from the pixel's.
fn triangle_area(a: [f32; 2], b: [f32; 2], c: [f32; 2]) -> f32 {
    let high_x = max_exact(max_exact(a[0], b[0]), c[0]);
    let low_x = min_exact(min_exact(a[0], b[0]), c[0]);
    let high_y = max_exact(max_exact(a[1], b[1]), c[1]);
    let low_y = min_exact(min_exact(a[1], b[1]), c[1]);
    if less(high_x, 0.0) || less(high_y, 0.0) || less(1.0, low_x) || less(1.0, low_y) {
        return 0.0;
    }
    let area = (beside_edge(a, b) + beside_edge(b, c) + beside_edge(c, a)).abs();
    if less(area, LEAST_AREA) {
        0.0
    } else {
        min_exact(area, 1.0)
    }
}

/// How far a place is from a segment.
fn distance_from(x: f32, y: f32, [ax, ay, bx, by]: [f32; 4]) -> f32 {
    let along_x = bx - ax;
    let along_y = by - ay;
    let dx = x - ax;
    let dy = y - ay;
    let along = (dx * along_x + dy * along_y) * reciprocal(along_x * along_x + along_y * along_y);
    let t = clamp_exact(along, 0.0, 1.0);
    let ex = dx - t * along_x;
    let ey = dy - t * along_y;
    square_root(ex * ex + ey * ey)
}

/// A place as a cone has it, whose base has that radius: from its centre along its axis in the picture,
/// and to the right of it; how long the axis is there; sine and cosine of the angle between it and
/// the outline, 1 and 0 where nothing but the base is seen.
struct InCone {
    along: f32,
    across: f32,
    length: f32,
    sine: f32,
    cosine: f32,
    /// The axis.
    way: [f32; 2],
}

fn in_cone([base_x, base_y, apex_x, apex_y]: [f32; 4], radius: f32, x: f32, y: f32) -> InCone {
    let axis = [apex_x - base_x, apex_y - base_y];
    let squared = axis[0] * axis[0] + axis[1] * axis[1];
    let inverse = inverse_square_root(squared);
    // Straight from or to the viewer, any.
    let way = if less(0.0, squared) {
        axis.map(|part| part * inverse)
    } else {
        [1.0, 0.0]
    };
    let dx = x - base_x;
    let dy = y - base_y;
    let length = square_root(squared);
    let sine = if less(radius, length) {
        radius * reciprocal(length)
    } else {
        1.0
    };
    InCone {
        along: dx * way[0] + dy * way[1],
        across: dy * way[0] - dx * way[1],
        length,
        sine,
        cosine: square_root(max_exact(1.0 - sine * sine, 0.0)),
        way,
    }
}

/// Whether the outline next to the place is that of the base.
fn is_by_base(at: &InCone) -> bool {
    !less(at.sine, 1.0) || less(at.cosine * at.along, at.sine * at.across.abs())
}

/// How far a place is outside a cone: of the hull of a disc and a point.
fn distance_from_cone(points: [f32; 4], radius: f32, x: f32, y: f32) -> f32 {
    let at = in_cone(points, radius, x, y);
    let aside = at.across.abs();
    if is_by_base(&at) {
        return square_root(at.along * at.along + aside * aside) - radius;
    }
    if less(
        at.cosine * at.length,
        at.cosine * at.along - at.sine * aside,
    ) {
        let beyond = at.along - at.length;
        return square_root(beyond * beyond + aside * aside);
    }
    at.cosine * aside + at.sine * at.along - radius
}

/// How straight the light falls on the cone that is seen in the pixel, 0 to 1. A cone is what balls
/// fill that shrink to nothing on their way from the base to the apex; the one that is seen there
/// touches its side, which tells it by the root of a square. Lengths are parts of the cone's.
fn light_on_cone(cover: &Cover, light_from: Vec3, x: f32, y: f32) -> f32 {
    let radius = f32::from_bits(cover.shape[0]) - 0.5;
    let is_ahead = !less(f32::from_bits(cover.shape[1]), 0.0);
    let at = in_cone(cover.points.map(f32::from_bits), radius, x, y);
    let part_of_px = SINE_OF_CONE * reciprocal(radius);
    let slant = min_exact(at.length * part_of_px, 1.0);
    let along = at.along * part_of_px;
    let across = at.across * part_of_px;
    let e = SINE_OF_CONE * SINE_OF_CONE - slant * along;
    let f = slant * slant - SINE_OF_CONE * SINE_OF_CONE;
    let aside = SINE_OF_CONE * SINE_OF_CONE - across * across - along * along;
    let k = ((1.0 - slant * slant) * aside - e * e) * INVERSE_SQUARED_COSINE;
    let root = square_root(max_exact(e * e + f * k, 0.0));
    let mut t = match (is_ahead, less(0.0, e), less(e, 0.0)) {
        (true, true, _) => k * reciprocal(e + root),
        (true, false, _) => (root - e) * reciprocal(f),
        (false, _, true) => k * reciprocal(e - root),
        (false, _, false) => 0.0,
    };
    // Beyond the apex; and on the base, which is a ball.
    if less(NEXT_TO_APEX, t) {
        t = if less(0.0, f) { NEXT_TO_APEX } else { 0.0 };
    }
    t = max_exact(t, 0.0);
    let inverse = reciprocal(SINE_OF_CONE * (1.0 - t));
    let ahead = (along - slant * t) * inverse;
    let right = across * inverse;
    let toward = square_root(max_exact(1.0 - ahead * ahead - right * right, 0.0));
    // In the space of the light y goes up.
    let [x, y] = at.way;
    let normal = Vec3::new(x * ahead - y * right, -y * ahead - x * right, toward);
    clamp_exact(dot3(normal, light_from), 0.0, 1.0)
}

/// Whether a place is ahead of a line across a direction: that of the number, -2 to 2, which says where
/// the direction meets a square.
fn is_ahead(cut: f32, [away_x, away_y]: [f32; 2]) -> bool {
    let right = 1.0 - cut.abs();
    let down = if less(cut, 0.0) {
        right.abs() - 1.0
    } else {
        1.0 - right.abs()
    };
    !less(away_x * right + away_y * down, 0.0)
}

/// How much of the pixel a piece of a stroke covers. Pieces that follow each other are cut off at one
/// line, so that a pixel's centre is in one of them; where nothing is cut off, the end is round. What
/// is thinner than a pixel is that much clearer.
fn coverage_of_stroke(cover: &Cover, x: f32, y: f32) -> f32 {
    let [ax, ay, bx, by] = cover.points.map(f32::from_bits);
    let [half_begin, half_end] = [cover.shape[0], cover.shape[1]].map(f32::from_bits);
    let [cut_begin, cut_end] = [cover.lit[0], cover.lit[1]].map(f32::from_bits);
    let axis = [bx - ax, by - ay];
    let from_begin = [x - ax, y - ay];
    let from_end = [x - bx, y - by];
    let inverse = reciprocal(axis[0] * axis[0] + axis[1] * axis[1]);
    let along = clamp_exact(
        (from_begin[0] * axis[0] + from_begin[1] * axis[1]) * inverse,
        0.0,
        1.0,
    );
    let aside = [
        from_begin[0] - axis[0] * along,
        from_begin[1] - axis[1] * along,
    ];
    let half_px = half_begin + (half_end - half_begin) * along;
    let distance = square_root(aside[0] * aside[0] + aside[1] * aside[1]);
    let within = clamp_exact(max_exact(half_px, 0.5) + 0.5 - distance, 0.0, 1.0);
    let is_before = less(cut_begin, STROKE_UNCUT) && !is_ahead(cut_begin, from_begin);
    let is_past = less(cut_end, STROKE_UNCUT) && is_ahead(cut_end, from_end);
    if is_before || is_past {
        0.0
    } else {
        within * min_exact(2.0 * half_px, 1.0)
    }
}

/// How much of the pixel it covers, 0 to 1.
#[inline]
pub fn coverage_at(cover: &Cover, x: i32, y: i32) -> f32 {
    let points = cover.points.map(f32::from_bits);
    let [u, v] = [cover.shape[0], cover.shape[1]].map(f32::from_bits);
    let kind = cover.shape[2];
    let center_x = f32_of_i32(x) + 0.5;
    let center_y = f32_of_i32(y) + 0.5;
    let [ax, ay, bx, by] = points;
    if kind == COVER_SQUARE {
        return overlap(center_of(x), ax - u, ax + u) * overlap(center_of(y), ay - u, ay + u);
    }
    if kind == COVER_TRIANGLE {
        let corner = [f32_of_i32(x), f32_of_i32(y)];
        let from_corner = |x: f32, y: f32| [x - corner[0], y - corner[1]];
        return triangle_area(from_corner(ax, ay), from_corner(bx, by), from_corner(u, v));
    }
    if kind == COVER_CONE {
        let outside = distance_from_cone(points, u - 0.5, center_x, center_y);
        return clamp_exact(0.5 - outside, 0.0, 1.0);
    }
    if kind == COVER_STROKE {
        return coverage_of_stroke(cover, center_x, center_y);
    }
    let distance = if kind == COVER_SEGMENT {
        distance_from(center_x, center_y, points)
    } else {
        let dx = center_x - ax;
        let dy = center_y - ay;
        let mut squared = dx * dx + dy * dy;
        if kind == COVER_SLANTED {
            let behind_px = bx * dx + by * dy;
            squared += behind_px * behind_px;
        }
        square_root(squared)
    };
    let within = clamp_exact((u - distance) * v, 0.0, 1.0);
    if kind == COVER_SOFT_DISC || kind == COVER_SLANTED {
        within * within * (3.0 - 2.0 * within)
    } else {
        within
    }
}

/// How straight the light falls on the ball that is seen in the pixel, 0 to 1.
#[inline]
fn light_on(cover: &Cover, light_from: Vec3, x: i32, y: i32) -> f32 {
    let [center_x, center_y, inverse_radius, _] = cover.points.map(f32::from_bits);
    let right = (f32_of_i32(x) + 0.5 - center_x) * inverse_radius;
    let up = (center_y - f32_of_i32(y) - 0.5) * inverse_radius;
    let aside = right * right + up * up;
    let toward = square_root(max_exact(1.0 - aside, 0.0));
    // Past its rim, in the pixels of its edge, a ball is as at its rim.
    clamp_exact(
        right * light_from.x + up * light_from.y + toward * light_from.z,
        0.0,
        1.0,
    )
}

/// Where a pixel is, and how wide the picture.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// Pixels from the left.
    pub x: i32,
    /// Pixels from the top.
    pub y: i32,
    /// Pixels.
    pub width: i32,
}

/// How much of what is behind it hides in the pixel, 0 to 1, and how straight the light falls on it.
pub(super) struct Part {
    pub(super) alpha: f32,
    pub(super) light: f32,
}

#[inline]
fn part_here(cover: &Cover, light_from: Vec3, x: i32, y: i32) -> Part {
    let light = if cover.shape[2] == COVER_CONE {
        light_on_cone(cover, light_from, f32_of_i32(x) + 0.5, f32_of_i32(y) + 0.5)
    } else if cover.shape[2] == COVER_STROKE {
        0.0
    } else {
        light_on(cover, light_from, x, y)
    };
    Part {
        alpha: snap(f32::from_bits(cover.color[3]) * coverage_at(cover, x, y)),
        light,
    }
}

/// The same wherever it is drawn. Two that overlap are the same whichever is in front.
#[inline]
pub(super) fn part_at(cover: &Cover, light_from: Vec3, spot: Spot) -> Part {
    let across = spot.width - 1 - spot.x;
    let x = if cover.lit[3] == COVER_MIRRORED {
        across
    } else {
        spot.x
    };
    let own = part_here(cover, light_from, x, spot.y);
    if cover.lit[3] != COVER_TWIN {
        return own;
    }
    let other = part_here(cover, light_from, across, spot.y);
    let sum = own.alpha + other.alpha;
    Part {
        alpha: snap(sum - own.alpha * other.alpha),
        light: (own.alpha * own.light + other.alpha * other.light) * reciprocal(sum),
    }
}

/// The pixel with `cover` behind what it has so far.
#[inline]
pub fn behind(above: Layered, cover: &Cover, light_from: Vec3, spot: Spot) -> Layered {
    let [red, green, blue, _] = cover.color.map(f32::from_bits);
    let [lit_red, lit_green, lit_blue, _] = cover.lit.map(f32::from_bits);
    let color = Vec3::new(red, green, blue);
    let lit = Vec3::new(lit_red, lit_green, lit_blue);
    let Part { alpha, light } = part_at(cover, light_from, spot);
    if above.is_closed() {
        return above;
    }
    let seen = above.clear * alpha;
    let look = color + lit * light;
    let clear = above.clear * (1.0 - alpha);
    Layered {
        color: snap3(above.color + look * seen),
        clear: snap(clear),
    }
}
