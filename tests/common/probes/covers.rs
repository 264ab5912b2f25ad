//! Probes of what covers: records of every kind around a few pixels, and what they make of one.

use glam::{Vec2, Vec3, Vec4};
use motes::cpu::cover::{Layered, Spot, behind, bounds_of, coverage_at, far_to_near};
use motes::cpu::shape::{
    Look, cone_of, disc_of, segment_of, slanted_disc_of, square_of, stroke_of, triangle_of,
};
use motes::exact::f32_of_u32;
use motes::layout::Cover;

use super::Arguments;

pub(super) const COVER_IMPORTS: &str = "#import motes::layout::Cover
#import motes::cover::{Kinds, Layered, Spot, behind, bounds_of, coverage_at, far_to_near}
#import motes::shape::{Look, cone_of, disc_of, segment_of, slanted_disc_of, square_of, stroke_of, triangle_of}
const KINDS: Kinds = Kinds(true, true, true, true, true, true, true);
// So many bits of a word, in quarters.
fn quarters(word: u32, shift: u32, count: u32) -> f32 {
    return f32_of_u32((word >> shift) & ((1u << count) - 1u)) * 0.25f;
}
// How far to the left and up some segments end.
fn far(i: u32) -> vec2<f32> {
    return vec2<f32>(f32_of_u32((i >> 5u) & 1u), f32_of_u32((i >> 11u) & 1u)) * 262144.0f;
}
// What a piece is cut off by at its ends, or nothing.
fn cuts(w: u32, i: u32) -> vec2<f32> {
    return vec2<f32>(quarters(w, 16u, 5u) - 2.0f, quarters(i, 23u, 5u) - 2.0f);
}
fn some(kind: u32, w: u32, i: u32) -> Cover {
    let alpha = quarters(w, 24u, 3u) * 0.625f;
    let color = vec4<f32>(0.3f, quarters(i, 2u, 5u), 0.9f, alpha);
    let look = Look(1.0f + quarters(w, 3u, 7u), color, vec3<f32>(0.5f, quarters(w, 7u, 3u), 0.125f));
    let a = vec2<f32>(quarters(w, 0u, 6u) + 0.1f, quarters(w, 6u, 6u) - 0.3f);
    let b = vec2<f32>(quarters(i, 0u, 6u), quarters(i, 6u, 6u) + 0.7f);
    let c = vec2<f32>(quarters(i, 12u, 6u) - 0.2f, quarters(w, 12u, 6u));
    let size = quarters(i, 18u, 5u) * 0.9f;
    switch kind {
        case 0u: { return disc_of(a.x, a.y, size, 0.0f, look); }
        case 1u: { return disc_of(a.x, a.y, size, quarters(w, 18u, 3u) * 0.5f, look); }
        case 2u: { return square_of(a.x, a.y, size, look); }
        case 3u: { return segment_of(a, b - far(i), size * 0.3f, look); }
        case 6u: { return slanted_disc_of(a.x, a.y, size, quarters(w, 18u, 3u) * 0.5f, b * 0.1f - 0.6f, look); }
        case 7u: { return stroke_of(a, b, vec2<f32>(size * 0.3f, quarters(w, 12u, 3u)), cuts(w, i), look); }
        case 5u: { return cone_of(a, b, size, quarters(w, 12u, 3u) * 0.5f - 0.9f, look); }
        default: { return triangle_of(a, b, c, look); }
    }
}
// The same at one side of the picture, or at both.
fn sided(kind: u32, w: u32, i: u32) -> Cover {
    var it = some(kind, w, i);
    it.lit.w = (w >> 21u) % 3u;
    return it;
}
fn part(kind: u32, w: u32, i: u32) -> f32 {
    return coverage_at(some(kind, w, i), KINDS, i32(w >> 28u), i32(i >> 28u));
}
fn record(kind: u32, w: u32, i: u32, word: u32) -> u32 {
    let it = some(kind, w, i);
    var vectors = array<vec4<u32>, 4>(it.points, it.shape, it.color, it.lit);
    return vectors[word / 4u][word % 4u];
}
fn sides(kind: u32, w: u32, i: u32) -> u32 {
    let it = bounds_of(sided(kind, w, i), 13u, 9u);
    return u32(it.x + it.y * 100 + it.z * 10000 + it.w * 1000000);
}
fn bounds(kind: u32, w: u32, i: u32) -> u32 {
    let it = bounds_of(some(kind, w, i), 13u, 9u);
    return u32(it.x + it.y * 100 + it.z * 10000 + it.w * 1000000);
}
fn over(kind: u32, c: f32, w: u32, i: u32) -> vec4<f32> {
    var clear = quarters(i, 24u, 3u) * 0.5f;
    if (w & 7u) == 0u {
        clear = 0.0000152f + quarters(i, 24u, 3u) * 0.0000003f;
    }
    let above = Layered(vec3<f32>(0.1f, 0.0f, abs(c)), clear);
    let from_there = vec3<f32>(0.36f, -0.48f, 0.8f);
    let spot = Spot(i32(w >> 28u), i32(i >> 28u), 13);
    let pixel = behind(above, sided(kind, w, i), KINDS, from_there, spot);
    return vec4<f32>(pixel.color, pixel.clear);
}
fn key(p: f32, w: u32) -> u32 {
    let shape = vec4<u32>(0u, 0u, w & 1u, bits_of(p));
    return far_to_near(Cover(vec4<u32>(0u), shape, vec4<u32>(0u), vec4<u32>(0u)));
}";

fn quarters(word: u32, shift: u32, count: u32) -> f32 {
    f32_of_u32((word >> shift) & ((1 << count) - 1)) * 0.25
}

/// How far to the left and up some segments end.
fn far(i: u32) -> Vec2 {
    Vec2::new(f32_of_u32((i >> 5) & 1), f32_of_u32((i >> 11) & 1)) * 262_144.0
}

fn some(r: &Arguments, kind: u32) -> Cover {
    let (w, i) = (r.w, r.i);
    let alpha = quarters(w, 24, 3) * 0.625;
    let look = Look {
        depth: 1.0 + quarters(w, 3, 7),
        color: Vec4::new(0.3, quarters(i, 2, 5), 0.9, alpha),
        lit: Vec3::new(0.5, quarters(w, 7, 3), 0.125),
    };
    let a = Vec2::new(quarters(w, 0, 6) + 0.1, quarters(w, 6, 6) - 0.3);
    let b = Vec2::new(quarters(i, 0, 6), quarters(i, 6, 6) + 0.7);
    let c = Vec2::new(quarters(i, 12, 6) - 0.2, quarters(w, 12, 6));
    let size = quarters(i, 18, 5) * 0.9;
    match kind {
        0 => disc_of(a.x, a.y, size, 0.0, &look),
        1 => disc_of(a.x, a.y, size, quarters(w, 18, 3) * 0.5, &look),
        2 => square_of(a.x, a.y, size, &look),
        3 => segment_of(a, b - far(i), size * 0.3, &look),
        6 => slanted_disc_of(
            a.x,
            a.y,
            size,
            quarters(w, 18, 3) * 0.5,
            b * 0.1 - 0.6,
            &look,
        ),
        7 => {
            let halves = [size * 0.3, quarters(w, 12, 3)];
            let cuts = [quarters(w, 16, 5) - 2.0, quarters(i, 23, 5) - 2.0];
            stroke_of(a, b, halves, cuts, &look)
        }
        5 => cone_of(a, b, size, quarters(w, 12, 3) * 0.5 - 0.9, &look),
        _ => triangle_of(a, b, c, &look),
    }
}

fn sided(r: &Arguments, kind: u32) -> Cover {
    let mut it = some(r, kind);
    it.lit[3] = (r.w >> 21) % 3;
    it
}

/// The pixel that is looked at.
fn pixel(r: &Arguments) -> (i32, i32) {
    ((r.w >> 28) as i32, (r.i >> 28) as i32)
}

pub(super) fn part(r: &Arguments, kind: u32) -> f32 {
    let (x, y) = pixel(r);
    coverage_at(&some(r, kind), x, y)
}

pub(super) fn record(r: &Arguments, kind: u32, word: usize) -> u32 {
    bytemuck::cast::<Cover, [u32; 16]>(some(r, kind))[word]
}

pub(super) fn sides(r: &Arguments, kind: u32) -> u32 {
    let [left, top, right, bottom] = bounds_of(&sided(r, kind), 13, 9);
    (left + top * 100 + right * 10_000 + bottom * 1_000_000).cast_unsigned()
}

pub(super) fn bounds(r: &Arguments, kind: u32) -> u32 {
    let [left, top, right, bottom] = bounds_of(&some(r, kind), 13, 9);
    (left + top * 100 + right * 10_000 + bottom * 1_000_000).cast_unsigned()
}

pub(super) fn over(r: &Arguments, kind: u32) -> [f32; 4] {
    let mut clear = quarters(r.i, 24, 3) * 0.5;
    if r.w & 7 == 0 {
        clear = 0.000_015_2 + quarters(r.i, 24, 3) * 0.000_000_3;
    }
    let above = Layered {
        color: Vec3::new(0.1, 0.0, r.c.abs()),
        clear,
    };
    let (x, y) = pixel(r);
    let from = Vec3::new(0.36, -0.48, 0.8);
    let spot = Spot { x, y, width: 13 };
    let pixel = behind(above, &sided(r, kind), from, spot);
    [pixel.color.x, pixel.color.y, pixel.color.z, pixel.clear]
}

pub(super) fn key(r: &Arguments) -> u32 {
    far_to_near(&Cover {
        shape: [0, 0, r.w & 1, motes::exact::bits_of(r.p)],
        ..Cover::default()
    })
}
