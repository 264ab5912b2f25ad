//! surface: the triangles and pillars that are seen in a pixel, lit (Reeves 1983, section 3; Perry 1994, 3.2.4).
//! Twin of `wgsl/draw/surface.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use crate::cpu::cluster::{fallen, way_to};
use crate::cpu::grain::grain_at;
use crate::cpu::pillar::{Meeting, meeting, passed};
use crate::cpu::raster::{SAMPLES_DOWN, SAMPLES_RIGHT, normal_of, world_of};
use crate::exact::{
    at_least_zero, bits_of, clamp_unit, cross3, dot3, f32_of_u32, inverse_square_root, less,
    normalize_exact, reciprocal, shared_constants, square_root,
};
use crate::layout::{FlameLight, Frame, SurfaceFrame, SurfaceLight};
use crate::plan::FrameInputs;

shared_constants! {
    /// A ground or a pillar that covers more of its pixel hides.
    const HIDES: f32 = 0.5;
    /// No pillar.
    pub const NO_PILLAR: u32 = 0xffff_ffff;
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
    /// Corners of all stored triangles.
    pub corners: &'a [[u32; 4]],
}

fn three(of: &[f32]) -> Vec3 {
    Vec3::from_slice(of)
}

/// The way from the eye through a place in the picture, as far as depth 1.
fn way_through(frame: &Frame, right: f32, up: f32) -> Vec3 {
    let share = reciprocal(frame.focal_px);
    three(&frame.view_from_world_z)
        + three(&frame.view_from_world_x) * (right * share)
        + three(&frame.view_from_world_y) * (up * share)
}

/// Whether something that is no triangle is met before that depth.
fn is_hidden(lit: Lit<'_>, light: &SurfaceLight, way: Vec3, depth: f32) -> bool {
    let mut hidden = false;
    if !lit.inputs.planets.is_empty() {
        let along = dot3(way, three(&light.planet));
        let squared = dot3(way, way);
        let inside = along * along - squared * light.planet[3];
        let far = (along - square_root(at_least_zero(inside))) * reciprocal(squared);
        hidden = less(0.0, inside) && less(0.0, far) && less(far, depth);
    }
    if !lit.inputs.grounds.is_empty() {
        let far = -light.plane[3] * reciprocal(dot3(way, three(&light.plane)));
        let from_middle = three(&light.eye) + way * far - three(&light.middle);
        let near = at_least_zero(1.0 - dot3(from_middle, from_middle) * light.middle[3]);
        let is_met = less(0.0, light.middle[3]) && less(0.0, far) && less(far, depth);
        hidden |= is_met && less(HIDES, near * near);
        let pixel = reciprocal(lit.inputs.frame.focal_px);
        for pillar in &lit.inputs.pillars {
            let met = meeting(pillar, three(&light.eye), way, pixel);
            hidden |= less(HIDES, met.covered) && less(met.far, depth);
        }
    }
    hidden
}

/// A place of a surface, its unit normal, its pillar, and what that lets through: how much, and the
/// inverse of the squared distance at which it is half.
struct Spot {
    place: Vec3,
    normal: Vec3,
    pillar: Option<usize>,
    through: Vec2,
}

/// How much of a point light of that squared extent there is, as a share of what it is a unit away.
fn from_point(lit: Lit<'_>, spot: &Spot, lamp: Vec3, extent: f32, through: f32) -> f32 {
    let away = lamp - spot.place;
    let squared = dot3(away, away);
    let near = inverse_square_root(squared + extent);
    let mut seen = at_least_zero(dot3(spot.normal, away) * near);
    if !lit.inputs.grounds.is_empty() {
        for (at, pillar) in lit.inputs.pillars.iter().enumerate() {
            if Some(at) != spot.pillar {
                seen *= passed(pillar, spot.place, lamp);
            }
        }
        seen += through * reciprocal(1.0 + squared * spot.through.y);
    }
    seen * near * near
}

fn light_on(lit: Lit<'_>, light: &SurfaceLight, spot: &Spot) -> Vec3 {
    let straight = at_least_zero(dot3(spot.normal, three(&light.light_from)));
    let mut sum = three(&light.ambient) + three(&light.light_color) * straight;
    for lamp in lit.inputs.lamps.iter().take(light.kinds[0] as usize) {
        let from = three(&lamp.place) + three(&light.lamps_from);
        sum += three(&lamp.color) * (lamp.place[3] * from_point(lit, spot, from, 0.0, 0.0));
    }
    for flame in lit.flames.iter().take(light.kinds[1] as usize) {
        let [x, y, z, extent] = flame.place.map(f32::from_bits);
        let color = three(&flame.color.map(f32::from_bits));
        sum += color * from_point(lit, spot, Vec3::new(x, y, z), extent, spot.through.x);
    }
    for cluster in lit.clusters {
        let way = way_to(cluster, spot.place, spot.normal);
        let mut falls = fallen(way, spot.normal);
        for (at, pillar) in lit.inputs.pillars.iter().enumerate() {
            if Some(at) != spot.pillar {
                falls *= passed(pillar, spot.place, spot.place + way);
            }
        }
        sum += three(&cluster.color.map(f32::from_bits)) * falls;
    }
    sum
}

fn turned(surface: &SurfaceFrame, v: Vec3) -> Vec3 {
    Vec3::new(
        dot3(three(&surface.world_from_mesh_x), v),
        dot3(three(&surface.world_from_mesh_y), v),
        dot3(three(&surface.world_from_mesh_z), v),
    )
}

/// What a triangle sends back from where the way ends on it.
fn shaded(lit: Lit<'_>, light: &SurfaceLight, face: u32, way: Vec3, depth: f32) -> Vec3 {
    let of_face = |surface: &&SurfaceFrame| surface.faces[2] <= face && surface.faces[1] > 0;
    let surfaces = &lit.inputs.surfaces;
    let Some(surface) = surfaces.iter().rev().find(of_face) else {
        return Vec3::ZERO;
    };
    let corner = (surface.faces[0] + face - surface.faces[2]) as usize * 3;
    let words = [0, 1, 2].map(|at| lit.corners[corner + at]);
    let [a, b, c] = words.map(|words| three(&words.map(f32::from_bits)));
    let place = three(&light.eye) + way * depth;
    // Lengths as parts of an edge's, in which nothing is too small.
    let edge_b = turned(surface, b - a);
    let edge_c = turned(surface, c - a);
    let part = inverse_square_root(dot3(edge_b, edge_b));
    let to_b = edge_b * part;
    let to_c = edge_c * part;
    let to_place = (place - world_of(surface, a)) * part;
    let across = cross3(to_b, to_c);
    let inverse = reciprocal(dot3(across, across));
    let of_b = clamp_unit(dot3(cross3(to_place, to_c), across) * inverse);
    let of_c = clamp_unit(dot3(cross3(to_b, to_place), across) * inverse);
    let of_a = at_least_zero(1.0 - of_b - of_c);
    let [at_a, at_b, at_c] = words.map(|words| normal_of(words[3]));
    let own = at_a * of_a + at_b * of_b + at_c * of_c;
    let front = normalize_exact(turned(surface, own));
    let normal = if less(0.0, dot3(across, way)) {
        -front
    } else {
        front
    };
    let at = a * of_a + b * of_b + c * of_c;
    let [kind, key, ..] = surface.grain_kind;
    let dense = grain_at([kind, key], &surface.grain, &surface.grain_shape, at);
    let shade = 1.0 - dense * surface.grain_shape[0];
    let spot = Spot {
        place,
        normal,
        pillar: None,
        through: Vec2::ZERO,
    };
    three(&surface.color) * shade * light_on(lit, light, &spot)
}

/// The nearest pillar that the way meets and that covers more of the pixel than that.
fn nearest_pillar(
    lit: Lit<'_>,
    light: &SurfaceLight,
    way: Vec3,
    least: f32,
) -> Option<(usize, Meeting)> {
    let pixel = reciprocal(lit.inputs.frame.focal_px);
    let mut nearest: Option<(usize, Meeting)> = None;
    for (at, pillar) in lit.inputs.pillars.iter().enumerate() {
        let here = meeting(pillar, three(&light.eye), way, pixel);
        let is_nearer = nearest.is_none_or(|(_, met)| less(here.far, met.far));
        if less(least, here.covered) && is_nearer {
            nearest = Some((at, here));
        }
    }
    nearest
}

/// What a pillar sends back from where the way meets it.
fn pillar_light(
    lit: Lit<'_>,
    light: &SurfaceLight,
    (at, met): (usize, Meeting),
    way: Vec3,
) -> Vec3 {
    let pillar = &lit.inputs.pillars[at];
    let spot = Spot {
        place: three(&light.eye) + way * met.far,
        normal: met.normal,
        pillar: Some(at),
        through: Vec2::new(pillar.extent[1], pillar.extent[2]),
    };
    three(&pillar.color) * light_on(lit, light, &spot)
}

/// One pixel, of which `nearness` and `faces` tell the samples: red, green and blue as bits, and what
/// shows of what is behind.
pub fn surface(
    lit: Lit<'_>,
    pixel: u32,
    nearness: &mut [u32; 4],
    faces: &mut [u32; 4],
) -> [u32; 4] {
    let frame = &lit.inputs.frame;
    let light = &lit.inputs.surface_lights[0];
    let right = f32_of_u32(pixel % frame.width) - frame.center_x_px;
    let up = frame.center_y_px - f32_of_u32(pixel / frame.width);
    let rights = Vec4::splat(right) + SAMPLES_RIGHT;
    let ups = Vec4::splat(up) - SAMPLES_DOWN;
    let mut left = Vec::with_capacity(4);
    for sample in 0..4 {
        let way = way_through(frame, rights[sample], ups[sample]);
        if faces[sample] != 0 {
            let depth = reciprocal(f32::from_bits(nearness[sample]));
            if is_hidden(lit, light, way, depth) {
                (faces[sample], nearness[sample]) = (0, 0);
            } else {
                left.push(sample);
            }
        }
        if faces[sample] == 0 {
            let before = nearest_pillar(lit, light, way, HIDES);
            nearness[sample] = before.map_or(0, |(_, met)| bits_of(reciprocal(met.far)));
        }
    }
    let mut clear = 1.0 - f32_of_u32(left.len() as u32) * 0.25;
    let mut sum = Vec3::ZERO;
    while let Some(&first) = left.first() {
        let face = faces[first];
        let (mut count, mut right, mut up, mut near) = (0.0, 0.0, 0.0, 0.0);
        for sample in 0..4 {
            if faces[sample] == face {
                count += 1.0;
                right += rights[sample];
                up += ups[sample];
                near += f32::from_bits(nearness[sample]);
            }
        }
        left.retain(|sample| faces[*sample] != face);
        let share = reciprocal(count);
        let way = way_through(frame, right * share, up * share);
        sum += shaded(lit, light, face - 1, way, reciprocal(near * share)) * (count * 0.25);
    }
    let middle = way_through(
        frame,
        f32_of_u32(pixel % frame.width) + 0.5 - frame.center_x_px,
        frame.center_y_px - f32_of_u32(pixel / frame.width) - 0.5,
    );
    if let Some(seen) = nearest_pillar(lit, light, middle, 0.0) {
        let (_, Meeting { covered, .. }) = seen;
        sum += pillar_light(lit, light, seen, middle) * (covered * clear);
        clear *= 1.0 - covered;
    }
    [
        bits_of(sum.x),
        bits_of(sum.y),
        bits_of(sum.z),
        bits_of(clear),
    ]
}
