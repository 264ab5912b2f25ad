//! The part of a frame that surfaces have which flames light (Perry 1994, 3.2.4).

use glam::Vec3;

use super::PlanError;
use super::planet::lamps_of;
use super::system::name_key;
use crate::exact::{dot3, normalize_exact, reciprocal, snap};
use crate::layout;
use crate::scene::{Projection, Scene};

/// Marks the hash that makes the key of the ground's noise.
const KEY_TAG: u32 = 0x6772_6e64;

/// Whether the scene has a surface besides a planet.
pub(super) fn has_ground(scene: &Scene) -> bool {
    scene.ground.is_some() || !scene.pillars.is_empty()
}

/// The ground as a frame sees it, if it has a surface, and its pillars; `lights` is how many point
/// lights flames have.
pub(super) fn ground_of(scene: &Scene, lights: u32) -> (Vec<layout::Ground>, Vec<layout::Pillar>) {
    if !has_ground(scene) {
        return (Vec::new(), Vec::new());
    }
    let with = |v: Vec3, w: f32| [v.x, v.y, v.z, w].map(snap);
    let color = |color: [f32; 3], w: f32| with(Vec3::from(color), w);
    let pillar = |pillar: &crate::scene::Pillar| layout::Pillar {
        place: color(pillar.position, pillar.radius),
        extent: [
            pillar.position[1] + pillar.height,
            pillar.translucence,
            reciprocal(pillar.depth * pillar.depth),
            reciprocal(pillar.radius),
        ]
        .map(snap),
        color: color(pillar.color, 0.0),
    };
    let eye = Vec3::from(scene.camera.position);
    let light = &scene.light;
    let (lamps, lamps_from) = lamps_of(scene);
    let mut of_frame = layout::Ground {
        eye: with(eye, 0.0),
        light_from: with(normalize_exact(Vec3::from(light.direction)), 0.0),
        light_color: color(light.color, 0.0),
        ambient: color(light.ambient, 0.0),
        lamps_from: with(lamps_from, 0.0),
        kinds: [
            0,
            name_key(scene.seed, "ground", KEY_TAG),
            lamps.len() as u32,
            lights,
        ],
        counts: [scene.pillars.len() as u32, 0, 0, 0],
        ..layout::Ground::default()
    };
    if let Some(ground) = scene.ground {
        let normal = normalize_exact(Vec3::from(ground.normal));
        let middle = Vec3::from(ground.position);
        of_frame.plane = with(normal, dot3(eye - middle, normal));
        // Of the largest radius, that is just not too small to be told from none.
        let seen = reciprocal(ground.radius) * reciprocal(ground.radius);
        of_frame.middle = with(middle, seen.max(1e-12));
        of_frame.color = color(ground.color, ground.contrast);
        of_frame.light_from[3] = snap(ground.scale);
        of_frame.kinds[0] = ground.octaves;
    }
    (vec![of_frame], scene.pillars.iter().map(pillar).collect())
}

/// What is seen of a ground is seen from a place.
pub(super) fn check_ground(scene: &Scene) -> Result<(), PlanError> {
    if !has_ground(scene) || scene.camera.projection == Projection::Perspective {
        return Ok(());
    }
    Err(PlanError {
        message: "this scene has a ground or a pillar, and an orthographic camera".into(),
        help: "a camera in perspective, or neither `ground` nor `pillar`".into(),
        key: Some("camera.projection".into()),
    })
}
