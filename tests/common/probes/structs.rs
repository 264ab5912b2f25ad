//! Probes of functions that take structs: in WGSL and in Rust, from the same arguments.

use glam::{Vec3, Vec4};
use motes::area::screen_area_px;
use motes::cpu::wind::wind_of;
use motes::exact::f32_of_u32;
use motes::layout::{Frame, Wind};
use motes::noise::{corner_gradient, noise};

use super::Arguments;

pub(super) const NOISE_IMPORTS: &str = "#import motes::noise::{corner_gradient, noise}";

pub(super) fn corner(r: &Arguments) -> Vec3 {
    corner_gradient(r.w, r.i, r.w >> 7, r.i ^ r.w)
}

pub(super) fn anywhere(r: &Arguments) -> Vec4 {
    noise(Vec3::new(r.c, r.d, r.c * 0.37 - r.d), r.i)
}

/// A wind of some kind, and a place.
pub(super) const WIND_IMPORTS: &str = "#import motes::layout::Wind
#import motes::wind::{Kinds, wind_of}
fn flow(kind: u32, c: f32, d: f32, w: u32, i: u32) -> vec3<f32> {
    let wind = Wind(
        vec4<u32>(kind, 1u + (i & 3u), w, (w >> 9u) & 1u),
        vec4<f32>(d * 0.5f, 0.3f, -0.7f, 0.05f + abs(d) * 0.02f),
        vec4<f32>(0.6f, c * 0.01f, -0.48f, d * 0.1f),
        vec4<f32>(0.5f, c * 0.001f, 2.0f, 0.7f),
        vec4<f32>(-d, 3.7f, c * 0.01f, 0.0f),
    );
    let any = kind >= 4u || (w & 1u) == 0u;
    let flows = (kind > 0u && kind < 4u) || (w & 4u) == 0u;
    // One octave by either way.
    let many = wind.kinds.y != 1u || (w & 2u) == 0u;
    let folds = wind.kinds.w != 0u || (w & 8u) == 0u;
    return wind_of(wind, vec3<f32>(d, c, c * 0.25f), Kinds(flows, any, many, folds, kind == 5u));
}";

pub(super) fn flow(r: &Arguments, kind: u32) -> Vec3 {
    let (c, d) = (r.c, r.d);
    let wind = Wind {
        kinds: [kind, 1 + (r.i & 3), r.w, (r.w >> 9) & 1],
        place: [d * 0.5, 0.3, -0.7, 0.05 + d.abs() * 0.02],
        aim: [0.6, c * 0.01, -0.48, d * 0.1],
        scale: [0.5, c * 0.001, 2.0, 0.7],
        offset: [-d, 3.7, c * 0.01, 0.0],
    };
    wind_of(&wind, Vec3::new(d, c, c * 0.25))
}

/// A view of some picture, and a sphere: on the edges of the picture, around it, out of it.
pub(super) const AREA_IMPORTS: &str = "#import motes::area::screen_area_px
#import motes::layout::Frame
fn area_px(c: f32, d: f32, w: u32, i: u32) -> f32 {
    var view: Frame;
    view.view_from_world_x = vec4<f32>(1.0f, 0.25f, -0.5f, 0.125f);
    view.view_from_world_y = vec4<f32>(-0.2f, 1.0f, 0.3f, -0.25f);
    view.view_from_world_z = vec4<f32>(0.1f, -0.2f, 1.0f, 2.0f);
    view.focal_px = 8.0f + f32_of_u32(w & 255u);
    view.center_x_px = 0.5f * f32_of_u32(1u + ((w >> 8u) & 255u));
    view.center_y_px = 0.5f * f32_of_u32(1u + ((w >> 16u) & 255u));
    view.near = 0.1f;
    view.flags = i & 1u;
    let radius = 0.01f + f32_of_u32((w >> 24u) & 63u) * 0.0625f;
    return screen_area_px(view, vec4<f32>(c * 0.0625f, d * 0.0625f, d * c * 0.03125f, radius));
}";

pub(super) fn area_px(r: &Arguments) -> f32 {
    let view = Frame {
        view_from_world_x: [1.0, 0.25, -0.5, 0.125],
        view_from_world_y: [-0.2, 1.0, 0.3, -0.25],
        view_from_world_z: [0.1, -0.2, 1.0, 2.0],
        focal_px: 8.0 + f32_of_u32(r.w & 255),
        center_x_px: 0.5 * f32_of_u32(1 + ((r.w >> 8) & 255)),
        center_y_px: 0.5 * f32_of_u32(1 + ((r.w >> 16) & 255)),
        near: 0.1,
        flags: r.i & 1,
        ..Frame::default()
    };
    let radius = 0.01 + f32_of_u32((r.w >> 24) & 63) * 0.0625;
    let z = r.d * r.c * 0.03125;
    screen_area_px(&view, [r.c * 0.0625, r.d * 0.0625, z, radius])
}
