//! ground: a plane behind everything, in the light of flames (Perry 1994, 3.2.4). Twin of
//! `wgsl/draw/ground.wgsl`.

use glam::Vec3;

use crate::cpu::cluster::{fallen, way_to};
use crate::cpu::pillar::passed;
use crate::exact::{
    at_least_zero, bits_of, clamp_unit, dot3, f32_of_u32, inverse_square_root, less, reciprocal,
    shared_constants,
};
use crate::layout::{FlameLight, Frame, Ground};
use crate::noise::noise;
use crate::plan::FrameInputs;

shared_constants! {
    /// Ways to the ground, in lengths of the way, at most.
    pub const FARTHEST_GROUND: f32 = 1e6;
}

/// Everything that light comes from or falls on.
#[derive(Clone, Copy, Debug)]
pub struct Lit<'a> {
    /// The frame's surfaces and lamps.
    pub inputs: &'a FrameInputs,
    /// The lights of flames.
    pub flames: &'a [FlameLight],
    /// Those of particles.
    pub clusters: &'a [FlameLight],
}

fn three(of: &[f32]) -> Vec3 {
    Vec3::from_slice(of)
}

/// A point light: where, its squared extent, its colour a unit away.
struct Point {
    place: Vec3,
    extent: f32,
    color: Vec3,
}

fn from_point(lit: Lit<'_>, ground: &Ground, spot: Vec3, light: &Point) -> Vec3 {
    let away = light.place - spot;
    let near = inverse_square_root(dot3(away, away) + light.extent);
    let mut seen = at_least_zero(dot3(three(&ground.plane), away) * near);
    for pillar in &lit.inputs.pillars {
        seen *= passed(pillar, spot, light.place);
    }
    light.color * (seen * near * near)
}

/// The light of particles.
fn from_cluster(lit: Lit<'_>, ground: &Ground, spot: Vec3, light: &FlameLight) -> Vec3 {
    let normal = three(&ground.plane);
    let way = way_to(light, spot, normal);
    let mut falls = fallen(way, normal);
    for pillar in &lit.inputs.pillars {
        falls *= passed(pillar, spot, spot + way);
    }
    three(&light.color.map(f32::from_bits)) * falls
}

fn light_on(lit: Lit<'_>, ground: &Ground, spot: Vec3) -> Vec3 {
    let straight = at_least_zero(dot3(three(&ground.plane), three(&ground.light_from)));
    let mut light = three(&ground.ambient) + three(&ground.light_color) * straight;
    for lamp in &lit.inputs.lamps[..ground.kinds[2] as usize] {
        let point = Point {
            place: three(&lamp.place) + three(&ground.lamps_from),
            extent: 0.0,
            color: three(&lamp.color) * lamp.place[3],
        };
        light += from_point(lit, ground, spot, &point);
    }
    for flame in &lit.flames[..ground.kinds[3] as usize] {
        let [x, y, z, extent] = flame.place.map(f32::from_bits);
        let point = Point {
            place: Vec3::new(x, y, z),
            extent,
            color: three(&flame.color.map(f32::from_bits)),
        };
        light += from_point(lit, ground, spot, &point);
    }
    for cluster in lit.clusters {
        light += from_cluster(lit, ground, spot, cluster);
    }
    light
}

/// The share of its colour that the ground has at a place: octaves of noise, those left out that are
/// finer than `seen` there.
fn shade_at(ground: &Ground, place: Vec3, seen: f32) -> f32 {
    let mut sum = 0.0;
    let mut scale = ground.light_from[3];
    let mut weight = ground.color[3];
    for octave in 0..ground.kinds[0] {
        let clear = clamp_unit(2.0 - 2.0 * seen * scale);
        sum += noise(place * scale, ground.kinds[1].wrapping_add(octave)).w * (weight * clear);
        scale *= 2.0;
        weight *= 0.6;
    }
    at_least_zero(1.0 + sum)
}

/// Light of the plane where the way from the eye meets it, and how much of it is seen.
fn plane_at(lit: Lit<'_>, ground: &Ground, way: Vec3, pixel: f32) -> (Vec3, f32) {
    let normal = three(&ground.plane);
    let slant = dot3(way, normal);
    let far = -ground.plane[3] * reciprocal(slant);
    if !less(0.0, far) || less(FARTHEST_GROUND, far) {
        return (Vec3::ZERO, 0.0);
    }
    let place = three(&ground.eye) + way * far;
    let from_middle = place - three(&ground.middle);
    let near = at_least_zero(1.0 - dot3(from_middle, from_middle) * ground.middle[3]);
    let covered = if less(0.0, ground.middle[3]) {
        near * near
    } else {
        0.0
    };
    if !less(0.0, covered) {
        return (Vec3::ZERO, 0.0);
    }
    let shade = shade_at(ground, place, (far * pixel * reciprocal(slant)).abs());
    let light = three(&ground.color) * shade * light_on(lit, ground, place);
    (light, covered)
}

/// One pixel: red, green and blue as bits, and what shows of what is behind.
pub fn ground(lit: Lit<'_>, ground: &Ground, at: u32) -> [u32; 4] {
    let frame: &Frame = &lit.inputs.frame;
    let x = f32_of_u32(at % frame.width) + 0.5;
    let y = f32_of_u32(at / frame.width) + 0.5;
    let pixel = reciprocal(frame.focal_px);
    let way = three(&frame.view_from_world_z)
        + three(&frame.view_from_world_x) * ((x - frame.center_x_px) * pixel)
        + three(&frame.view_from_world_y) * ((frame.center_y_px - y) * pixel);
    let (light, covered) = plane_at(lit, ground, way, pixel);
    let [red, green, blue] = (light * covered).to_array().map(bits_of);
    [red, green, blue, bits_of(1.0 - covered)]
}
