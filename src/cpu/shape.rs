//! Records of what covers: one function a kind of shape. Twin of `wgsl/lib/shape.wgsl`, line by line.

use glam::{Vec2, Vec3, Vec4};

use crate::cpu::cover::{bounds_here, straddles};
use crate::cpu::footprint::LARGE_RADIUS_PX;
use crate::cpu::reach::{PI, edged_radius};
use crate::exact::{
    bits_of, clamp_exact, f32_of_i32, less, max_exact, min_exact, reciprocal, square_root, to_i32,
};
use crate::layout::{
    COVER_CONE, COVER_DISC, COVER_MIRRORED, COVER_NONE, COVER_SEGMENT, COVER_SLANTED,
    COVER_SOFT_DISC, COVER_SQUARE, COVER_STROKE, COVER_TRIANGLE, COVER_TWIN, Cover, Frame,
};

/// What a shape looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Depth along the view axis, world units.
    pub depth: f32,
    /// Red, green, blue before exposure, and alpha, 0 to 1.
    pub color: Vec4,
    /// What the light adds to the colour where it falls on a ball straight.
    pub lit: Vec3,
}

fn record(kind: u32, points: [f32; 4], more: [f32; 2], alpha: f32, look: &Look) -> Cover {
    let [red, green, blue] = [look.color.x, look.color.y, look.color.z].map(bits_of);
    let [lit_red, lit_green, lit_blue] = look.lit.to_array().map(bits_of);
    Cover {
        points: points.map(bits_of),
        shape: [
            bits_of(more[0]),
            bits_of(more[1]),
            kind,
            bits_of(look.depth),
        ],
        color: [red, green, blue, bits_of(clamp_exact(alpha, 0.0, 1.0))],
        lit: [lit_red, lit_green, lit_blue, 0],
    }
}

/// What makes the sum of a small disc's pixels its area.
fn gain_of_disc(x: f32, y: f32, radius_px: f32, reach: f32) -> f32 {
    if !less(radius_px, LARGE_RADIUS_PX) {
        return 1.0;
    }
    let mut sum = 0.0;
    for row in to_i32(y - reach)..=to_i32(y + reach) {
        for column in to_i32(x - reach)..=to_i32(x + reach) {
            let dx = f32_of_i32(column) + 0.5 - x;
            let dy = f32_of_i32(row) + 0.5 - y;
            sum += clamp_exact(reach - square_root(dx * dx + dy * dy), 0.0, 1.0);
        }
    }
    PI * radius_px * radius_px * reciprocal(sum)
}

/// A disc, pixels; `softness` is the part of its radius that its edge takes, 0 to 1.
pub fn disc_of(x: f32, y: f32, radius_px: f32, softness: f32, look: &Look) -> Cover {
    let edge = edged_radius(radius_px);
    let reach = edge + 0.5;
    let is_soft = less(0.0, softness);
    let gain = if is_soft {
        1.0
    } else {
        gain_of_disc(x, y, radius_px, reach)
    };
    record(
        if is_soft { COVER_SOFT_DISC } else { COVER_DISC },
        [x, y, reciprocal(edge), 0.0],
        [reach, reciprocal(1.0 + softness * (reach - 1.0))],
        look.color.w * gain,
        look,
    )
}

/// A soft disc that is seen at a slant, pixels: `slope` is how much farther away it is a pixel to the
/// right and down, in pixels.
pub fn slanted_disc_of(
    x: f32,
    y: f32,
    radius_px: f32,
    softness: f32,
    slope: Vec2,
    look: &Look,
) -> Cover {
    let reach = edged_radius(radius_px) + 0.5;
    record(
        COVER_SLANTED,
        [x, y, slope.x, slope.y],
        [reach, reciprocal(1.0 + softness * (reach - 1.0))],
        look.color.w,
        look,
    )
}

/// A square along the axes, of half that width, pixels.
pub fn square_of(x: f32, y: f32, half_px: f32, look: &Look) -> Cover {
    let alpha = look.color.w;
    record(COVER_SQUARE, [x, y, 0.0, 0.0], [half_px, 0.0], alpha, look)
}

/// A segment of half that width, pixels, with round ends; what is thinner than a pixel is that much
/// clearer.
pub fn segment_of(from: Vec2, to: Vec2, half_px: f32, look: &Look) -> Cover {
    record(
        COVER_SEGMENT,
        [from.x, from.y, to.x, to.y],
        [max_exact(half_px, 0.5) + 0.5, 1.0],
        look.color.w * min_exact(2.0 * half_px, 1.0),
        look,
    )
}

/// A triangle, its corners in either order, pixels.
pub fn triangle_of(a: Vec2, b: Vec2, c: Vec2, look: &Look) -> Cover {
    let points = [a.x, a.y, b.x, b.y];
    record(COVER_TRIANGLE, points, c.to_array(), look.color.w, look)
}

/// A cone with a round base of that radius around its centre, pixels, `ahead` how much its axis points
/// to the viewer, -1 to 1; what is thinner than a pixel is that much clearer.
pub fn cone_of(base: Vec2, apex: Vec2, radius_px: f32, ahead: f32, look: &Look) -> Cover {
    let part = min_exact(2.0 * radius_px, 1.0);
    record(
        COVER_CONE,
        [base.x, base.y, apex.x, apex.y],
        [max_exact(radius_px, 0.5) + 0.5, ahead],
        look.color.w * part * part,
        look,
    )
}

/// A piece of a stroke, half as wide at its ends as `half_px` says, cut off there across the directions of
/// those numbers.
pub fn stroke_of(begin: Vec2, end: Vec2, half_px: [f32; 2], cuts: [f32; 2], look: &Look) -> Cover {
    let own = Look {
        lit: Vec3::new(cuts[0], cuts[1], 0.0),
        ..*look
    };
    let points = [begin.x, begin.y, end.x, end.y];
    record(COVER_STROKE, points, half_px, look.color.w, &own)
}

/// The two records of what is mirrored: it and its mirror image or, where they overlap, both in one,
/// for neither may be in front of the other, and nothing.
pub fn mirrored(cover: Cover, view: &Frame) -> [Cover; 2] {
    if cover.shape[2] == COVER_NONE {
        return [cover; 2];
    }
    let (mut own, mut other) = (cover, cover);
    if straddles(bounds_here(&cover, view.width, view.height), view.width) {
        own.lit[3] = COVER_TWIN;
        other = Cover::default();
    } else {
        other.lit[3] = COVER_MIRRORED;
    }
    [own, other]
}
