//! ground: a plane behind everything and the cylinders on it, in the light of flames (Perry 1994,
//! 3.2.4). Twin of `wgsl/draw/ground.wgsl`.

use glam::{Vec2, Vec3};

use crate::cpu::cluster::{fallen, way_to};
use crate::cpu::pillar::{Meeting, meeting, passed};
use crate::exact::{
    at_least_zero, bits_of, clamp_unit, dot3, f32_of_u32, inverse_square_root, less, reciprocal,
    shared_constants,
};
use crate::layout::{FlameLight, Frame, Ground};
use crate::noise::noise;
use crate::plan::FrameInputs;

shared_constants! {
    /// No pillar.
    pub const NO_PILLAR: u32 = 0xffff_ffff;
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

/// A place of a surface, its unit normal, its pillar, and what that lets through: how much, and the
/// inverse of the squared distance at which it is half.
struct Spot {
    place: Vec3,
    normal: Vec3,
    pillar: Option<usize>,
    through: Vec2,
}

fn three(of: &[f32]) -> Vec3 {
    Vec3::from_slice(of)
}

/// A point light: where, its squared extent, its colour a unit away, what of it passes through.
struct Point {
    place: Vec3,
    extent: f32,
    color: Vec3,
    through: f32,
}

fn from_point(lit: Lit<'_>, spot: &Spot, light: &Point) -> Vec3 {
    let away = light.place - spot.place;
    let near = inverse_square_root(dot3(away, away) + light.extent);
    let falls = at_least_zero(dot3(spot.normal, away) * near);
    let mut seen = 1.0;
    for (at, pillar) in lit.inputs.pillars.iter().enumerate() {
        if Some(at) != spot.pillar {
            seen *= passed(pillar, spot.place, light.place);
        }
    }
    let own = light.through * reciprocal(1.0 + dot3(away, away) * spot.through.y);
    light.color * ((falls * seen + own) * near * near)
}

/// The light of particles.
fn from_cluster(lit: Lit<'_>, spot: &Spot, light: &FlameLight) -> Vec3 {
    let way = way_to(light, spot.place, spot.normal);
    let mut falls = fallen(way, spot.normal);
    for (at, pillar) in lit.inputs.pillars.iter().enumerate() {
        if Some(at) != spot.pillar {
            falls *= passed(pillar, spot.place, spot.place + way);
        }
    }
    three(&light.color.map(f32::from_bits)) * falls
}

fn light_on(lit: Lit<'_>, ground: &Ground, spot: &Spot) -> Vec3 {
    let straight = at_least_zero(dot3(spot.normal, three(&ground.light_from)));
    let mut light = three(&ground.ambient) + three(&ground.light_color) * straight;
    for lamp in &lit.inputs.lamps[..ground.kinds[2] as usize] {
        let point = Point {
            place: three(&lamp.place) + three(&ground.lamps_from),
            extent: 0.0,
            color: three(&lamp.color) * lamp.place[3],
            through: 0.0,
        };
        light += from_point(lit, spot, &point);
    }
    for flame in &lit.flames[..ground.kinds[3] as usize] {
        let [x, y, z, extent] = flame.place.map(f32::from_bits);
        let point = Point {
            place: Vec3::new(x, y, z),
            extent,
            color: three(&flame.color.map(f32::from_bits)),
            through: spot.through.x,
        };
        light += from_point(lit, spot, &point);
    }
    for cluster in lit.clusters {
        light += from_cluster(lit, spot, cluster);
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
    let spot = Spot {
        place,
        normal,
        pillar: None,
        through: Vec2::ZERO,
    };
    let light = three(&ground.color) * shade * light_on(lit, ground, &spot);
    (light, covered)
}

/// The nearest pillar that the way from the eye meets.
fn nearest(lit: Lit<'_>, eye: Vec3, way: Vec3, pixel: f32) -> Option<(usize, Meeting)> {
    let mut nearest: Option<(usize, Meeting)> = None;
    for (at, pillar) in lit.inputs.pillars.iter().enumerate() {
        let here = meeting(pillar, eye, way, pixel);
        let is_nearer = nearest.is_none_or(|(_, met)| less(here.far, met.far));
        if less(0.0, here.covered) && is_nearer {
            nearest = Some((at, here));
        }
    }
    nearest
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
    let eye = three(&ground.eye);
    let nearest = nearest(lit, eye, way, pixel);
    let met = nearest.map_or(0.0, |(_, met)| met.covered);
    let (light, covered) = if less(met, 1.0) {
        plane_at(lit, ground, way, pixel)
    } else {
        (Vec3::ZERO, 0.0)
    };
    let mut sum = light * covered;
    let mut clear = 1.0 - covered;
    if let Some((at, met)) = nearest {
        let pillar = &lit.inputs.pillars[at];
        let spot = Spot {
            place: eye + way * met.far,
            normal: met.normal,
            pillar: Some(at),
            through: Vec2::new(pillar.extent[1], pillar.extent[2]),
        };
        let light = three(&pillar.color) * light_on(lit, ground, &spot);
        sum = sum * (1.0 - met.covered) + light * met.covered;
        clear *= 1.0 - met.covered;
    }
    let [red, green, blue] = sum.to_array().map(bits_of);
    [red, green, blue, bits_of(clear)]
}
