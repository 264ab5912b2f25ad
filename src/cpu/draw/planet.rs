//! planet: the ball with a surface in a pixel (Reeves 1983, section 3). Twin of
//! `wgsl/draw/planet.wgsl`.

use glam::{Vec3, Vec4};

use crate::cpu::cluster::MOST_LIFT;
use crate::exact::{
    at_least_zero, bits_of, clamp_unit, dot3, f32_of_u32, inverse_square_root, less, min_exact,
    normalize_exact, reciprocal, shared_constants, square_root,
};
use crate::layout::{FlameLight, Frame, Planet};
use crate::noise::noise;
use crate::plan::FrameInputs;

shared_constants! {
    /// Lights of particles that are higher than a part of this above the horizon are seen in full.
    const HORIZON: f32 = 32.0;
}

/// The way from the eye through a place in the picture, as far as depth 1.
fn way_through(frame: &Frame, x: f32, y: f32) -> Vec3 {
    let share = reciprocal(frame.focal_px);
    let [right, up, forward] = [
        frame.view_from_world_x,
        frame.view_from_world_y,
        frame.view_from_world_z,
    ]
    .map(|row| Vec3::from_slice(&row));
    forward + right * ((x - frame.center_x_px) * share) + up * ((frame.center_y_px - y) * share)
}

/// Above 0 where the way meets the ball, 0 on its outline.
fn depth_in(planet: &Planet, way: Vec3) -> f32 {
    let along = dot3(way, Vec3::from_slice(&planet.place));
    along * along - dot3(way, way) * planet.eye[3]
}

/// The ground's slope, and its light in w.
fn ground_at(planet: &Planet, place: Vec3) -> Vec4 {
    let mut sum = Vec4::ZERO;
    let mut scale = planet.ground[0];
    let mut weight = 1.0;
    for octave in 0..planet.kinds[0] {
        let here = noise(place * scale, planet.kinds[1].wrapping_add(octave));
        sum += here * weight;
        scale *= 2.0;
        weight *= 0.6;
    }
    sum
}

/// How much falls of what a light of that squared extent sends out, so far away and so high, lifted over
/// the ball as by `way_to` of [`crate::cpu::cluster`]: its distance squared grows by as much as its
/// height squared.
fn fallen_on(away: Vec3, height: f32, normal: Vec3, up: Vec3, extent: f32) -> f32 {
    let height = at_least_zero(height);
    let high = height * height;
    let more = min_exact(extent, MOST_LIFT * high);
    let lifted = square_root(high + more);
    let near = inverse_square_root(dot3(away, away) + more);
    let slant = dot3(normal, away) + dot3(normal, up) * (lifted - height);
    let above = clamp_unit(HORIZON * lifted * near);
    at_least_zero(slant * near) * near * near * above
}

/// The light that falls on a place of the surface, from the centre, of that unit normal.
fn light_on(
    inputs: &FrameInputs,
    clusters: &[FlameLight],
    place: Vec3,
    normal: Vec3,
    up: Vec3,
) -> Vec3 {
    let planet = &inputs.planets[0];
    let from = Vec3::from_slice(&planet.light_from);
    let straight = at_least_zero(dot3(normal, from));
    let day = clamp_unit(8.0 * dot3(up, from));
    let mut light = Vec3::from_slice(&planet.ambient)
        + Vec3::from_slice(&planet.light_color) * (straight * day);
    for lamp in &inputs.lamps {
        let away = Vec3::from_slice(&lamp.place) - place;
        let near = inverse_square_root(dot3(away, away));
        let falls = at_least_zero(dot3(normal, away) * near);
        let above = clamp_unit(8.0 * dot3(up, away) * near);
        light += Vec3::from_slice(&lamp.color) * (falls * above * lamp.place[3] * near * near);
    }
    // They are counted from the world's origin.
    let eye = Vec3::from_slice(&planet.eye);
    let in_world = place + (eye + Vec3::from_slice(&planet.place));
    for cluster in clusters {
        let [x, y, z, extent] = cluster.place.map(f32::from_bits);
        let away = Vec3::new(x, y, z) - in_world;
        let height = dot3(up, away);
        // Most are below the horizon, and give nothing.
        if !less(0.0, height) {
            continue;
        }
        let [red, green, blue, _] = cluster.color.map(f32::from_bits);
        light += Vec3::new(red, green, blue) * fallen_on(away, height, normal, up, extent);
    }
    light
}

/// One pixel: red, green and blue as bits, and what shows of what is behind.
/// `clusters` are the lights of particles.
pub fn planet(inputs: &FrameInputs, clusters: &[FlameLight], pixel: u32) -> [u32; 4] {
    let (frame, planet) = (&inputs.frame, &inputs.planets[0]);
    let x = f32_of_u32(pixel % frame.width) + 0.5;
    let y = f32_of_u32(pixel / frame.width) + 0.5;
    let way = way_through(frame, x, y);
    let depth_at = |x: f32, y: f32| depth_in(planet, way_through(frame, x, y));
    let inside = depth_in(planet, way);
    let right = depth_at(x + 0.5, y) - depth_at(x - 0.5, y);
    let down = depth_at(x, y + 0.5) - depth_at(x, y - 0.5);
    let pixels = inside * inverse_square_root(right * right + down * down);
    let center = Vec3::from_slice(&planet.place);
    let along = dot3(way, center);
    let covered = if less(0.0, along) {
        clamp_unit(pixels + 0.5)
    } else {
        0.0
    };
    if !less(0.0, covered) {
        return [0, 0, 0, bits_of(1.0)];
    }
    let far = (along - square_root(at_least_zero(inside))) * reciprocal(dot3(way, way));
    let up = normalize_exact(way * far - center);
    let place = up * planet.place[3];
    let ground = ground_at(planet, place);
    let rise = ground.truncate();
    let slope = rise - up * dot3(rise, up);
    let normal = normalize_exact(up - slope * planet.color[3]);
    let albedo = Vec3::from_slice(&planet.color) * at_least_zero(1.0 + planet.ground[1] * ground.w);
    let light = albedo * light_on(inputs, clusters, place, normal, up) * covered;
    [
        bits_of(light.x),
        bits_of(light.y),
        bits_of(light.z),
        bits_of(1.0 - covered),
    ]
}

/// Whether a world place is beyond the plane of the planet's outline.
#[inline]
pub(super) fn is_beyond(frame: &Frame, world: Vec3) -> bool {
    let [x, y, z, distance] = frame.planet_outline;
    less(dot3(Vec3::new(x, y, z), world), distance)
}
