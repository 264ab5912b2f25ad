// Records of what covers (motes::layout::Cover): one function a kind of shape.
//
// Families of particles, boids and flames write what they look like by these.
// Reads and writes no buffers. Invariant: exact on every driver, and records hold no zero with a
// sign; twin of src/cpu/shape.rs.
#define_import_path motes::shape

#import motes::cover::{bounds_here, straddles}
#import motes::exact::{
    bits_of, clamp_exact, f32_of_i32, less, max_exact, min_exact, reciprocal, square_root, to_i32,
}
#import motes::footprint::LARGE_RADIUS_PX
#import motes::reach::{PI, edged_radius}
#import motes::layout::{
    COVER_CONE, COVER_DISC, COVER_MIRRORED, COVER_NONE, COVER_SEGMENT, COVER_SLANTED, COVER_SOFT_DISC,
    COVER_SQUARE, COVER_STROKE,
    COVER_TRIANGLE, COVER_TWIN, Cover, Frame,
}

// What a shape looks like: its depth along the view axis, its colour and alpha, and what the light
// adds where it falls on a ball straight.
struct Look {
    depth: f32,
    color: vec4<f32>,
    lit: vec3<f32>,
}

fn record(kind: u32, points: vec4<f32>, more: vec2<f32>, alpha: f32, look: Look) -> Cover {
    return Cover(
        vec4<u32>(bits_of(points.x), bits_of(points.y), bits_of(points.z), bits_of(points.w)),
        vec4<u32>(bits_of(more.x), bits_of(more.y), kind, bits_of(look.depth)),
        vec4<u32>(
            bits_of(look.color.x), bits_of(look.color.y), bits_of(look.color.z),
            bits_of(clamp_exact(alpha, 0.0f, 1.0f)),
        ),
        vec4<u32>(bits_of(look.lit.x), bits_of(look.lit.y), bits_of(look.lit.z), 0u),
    );
}

// What makes the sum of a small disc's pixels its area.
fn gain_of_disc(x: f32, y: f32, radius_px: f32, reach: f32) -> f32 {
    if !less(radius_px, LARGE_RADIUS_PX) {
        return 1.0f;
    }
    let right = to_i32(x + reach);
    let bottom = to_i32(y + reach);
    var sum = 0.0f;
    for (var row = to_i32(y - reach); row <= bottom; row += 1) {
        for (var column = to_i32(x - reach); column <= right; column += 1) {
            let dx = f32_of_i32(column) + 0.5f - x;
            let dy = f32_of_i32(row) + 0.5f - y;
            sum += clamp_exact(reach - square_root(dx * dx + dy * dy), 0.0f, 1.0f);
        }
    }
    return PI * radius_px * radius_px * reciprocal(sum);
}

// A disc; `softness` is the part of its radius that its edge takes.
fn disc_of(x: f32, y: f32, radius_px: f32, softness: f32, look: Look) -> Cover {
    let edge = edged_radius(radius_px);
    let reach = edge + 0.5f;
    let is_soft = less(0.0f, softness);
    var gain = 1.0f;
    if !is_soft {
        gain = gain_of_disc(x, y, radius_px, reach);
    }
    return record(
        select(COVER_DISC, COVER_SOFT_DISC, is_soft),
        vec4<f32>(x, y, reciprocal(edge), 0.0f),
        vec2<f32>(reach, reciprocal(1.0f + softness * (reach - 1.0f))),
        look.color.w * gain,
        look,
    );
}

// A soft disc that is seen at a slant: `slope` is how much farther away it is a pixel to the right and
// down, in pixels.
fn slanted_disc_of(x: f32, y: f32, radius_px: f32, softness: f32, slope: vec2<f32>, look: Look) -> Cover {
    let reach = edged_radius(radius_px) + 0.5f;
    return record(
        COVER_SLANTED,
        vec4<f32>(x, y, slope.x, slope.y),
        vec2<f32>(reach, reciprocal(1.0f + softness * (reach - 1.0f))),
        look.color.w,
        look,
    );
}

// A square along the axes, of half that width.
fn square_of(x: f32, y: f32, half_px: f32, look: Look) -> Cover {
    return record(
        COVER_SQUARE, vec4<f32>(x, y, 0.0f, 0.0f), vec2<f32>(half_px, 0.0f), look.color.w, look,
    );
}

// A segment of half that width with round ends; what is thinner than a pixel is that much clearer.
fn segment_of(begin: vec2<f32>, end: vec2<f32>, half_px: f32, look: Look) -> Cover {
    return record(
        COVER_SEGMENT,
        vec4<f32>(begin, end),
        vec2<f32>(max_exact(half_px, 0.5f) + 0.5f, 1.0f),
        look.color.w * min_exact(2.0f * half_px, 1.0f),
        look,
    );
}

// A triangle, its corners in either order.
fn triangle_of(a: vec2<f32>, b: vec2<f32>, c: vec2<f32>, look: Look) -> Cover {
    return record(COVER_TRIANGLE, vec4<f32>(a, b), c, look.color.w, look);
}

// A cone with a round base of that radius around its centre, `ahead` how much its axis points to the
// viewer; what is thinner than a pixel is that much clearer.
fn cone_of(base: vec2<f32>, apex: vec2<f32>, radius_px: f32, ahead: f32, look: Look) -> Cover {
    let part = min_exact(2.0f * radius_px, 1.0f);
    return record(
        COVER_CONE,
        vec4<f32>(base, apex),
        vec2<f32>(max_exact(radius_px, 0.5f) + 0.5f, ahead),
        look.color.w * part * part,
        look,
    );
}

// A piece of a stroke, half as wide at its ends as `half_px` says, cut off there across the directions of
// those numbers.
fn stroke_of(begin: vec2<f32>, end: vec2<f32>, half_px: vec2<f32>, cuts: vec2<f32>, look: Look) -> Cover {
    var own = look;
    own.lit = vec3<f32>(cuts, 0.0f);
    return record(COVER_STROKE, vec4<f32>(begin, end), half_px, look.color.w, own);
}

fn nothing_of() -> Cover {
    return Cover(vec4<u32>(0u), vec4<u32>(0u, 0u, COVER_NONE, 0u), vec4<u32>(0u), vec4<u32>(0u));
}

// The two records of what is mirrored: it and its mirror image or, where they overlap, both in one, for
// neither may be in front of the other, and nothing.
fn mirrored(cover: Cover, view: Frame) -> array<Cover, 2> {
    if cover.shape.z == COVER_NONE {
        return array<Cover, 2>(cover, cover);
    }
    var own = cover;
    var other = cover;
    if straddles(bounds_here(cover, view.width, view.height), view.width) {
        own.lit.w = COVER_TWIN;
        other = nothing_of();
    } else {
        other.lit.w = COVER_MIRRORED;
    }
    return array<Cover, 2>(own, other);
}
