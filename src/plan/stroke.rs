//! What falls on strokes, and what their shadows fall on (Reeves 1983, 4.3).

use glam::Vec3;

use super::planet::lamps_of;
use crate::exact::{dot3, less, normalize_exact, reciprocal, snap};
use crate::layout::{self, StrokeLight};
use crate::scene::{ParticleShape, Scene, System};

/// Whether its particles are seen as their whole trajectories.
pub(super) fn is_stroke(system: &System) -> bool {
    system.particle_shape == ParticleShape::Stroke
}

/// Of what strokes of all systems are drawn, at most: pieces of one, records of its shadow and it.
pub(super) fn records_of(scene: &Scene) -> [u32; 2] {
    let strokes = || scene.systems.iter().filter(|system| is_stroke(system));
    let pieces = strokes().map(|system| system.stroke_pieces).max();
    let pieces = pieces.unwrap_or(0);
    let has_shadows = strokes().any(|system| system.stroke_shadow > 0.0);
    [pieces, pieces * (1 + u32::from(has_shadows))]
}

/// [`SystemRow::kinds`](layout::SystemRow::kinds)`[2]` of a stroke.
pub(super) fn word_of(system: &System) -> u32 {
    let share = |part: f32| (part * layout::STROKE_SHARE_MASK as f32 + 0.5) as u32;
    system.stroke_pieces
        | share(system.stroke_taper) << layout::STROKE_TAPER_SHIFT
        | share(system.stroke_shadow) << layout::STROKE_SHADOW_SHIFT
}

/// What falls on strokes, if there are any.
pub(super) fn light_of(scene: &Scene) -> Vec<StrokeLight> {
    if !scene.systems.iter().any(is_stroke) {
        return Vec::new();
    }
    let with = |v: Vec3, w: f32| [v.x, v.y, v.z, w].map(snap);
    let (lamps, lamps_from) = lamps_of(scene);
    let mut light = StrokeLight {
        lamps_from: with(lamps_from, 0.0),
        kinds: [lamps.len() as u32, 0, 0, 0],
        ..StrokeLight::default()
    };
    let Some(ground) = &scene.ground else {
        return vec![light];
    };
    let normal = normalize_exact(Vec3::from(ground.normal));
    let middle = Vec3::from(ground.position);
    let from = normalize_exact(Vec3::from(scene.light.direction));
    let straight = dot3(normal, from);
    let seen = reciprocal(ground.radius) * reciprocal(ground.radius);
    let ambient = Vec3::from(scene.light.ambient);
    light.ground = with(normal, dot3(normal, middle));
    light.shade_from = with(from * reciprocal(straight), 0.0);
    light.shade_color = with(Vec3::from(ground.color) * ambient, 0.0);
    light.middle = with(middle, seen.max(1e-12));
    // Light that comes along the ground, or from below it, throws no shadows.
    light.kinds[1] = u32::from(less(LEAST_SINE, straight));
    light.kinds[2] = 1;
    vec![light]
}

/// Sine of the least height of the light above the ground with which it throws shadows.
const LEAST_SINE: f32 = 0.02;
