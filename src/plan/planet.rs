//! The planet's part of a frame.

use glam::Vec3;

use super::PlanError;
use super::system::name_key;
use crate::exact::{dot3, normalize_exact, reciprocal, snap};
use crate::layout;
use crate::scene::{Projection, Scene};

/// Marks the hash that makes the key of the planet's noise.
const KEY_TAG: u32 = 0x706c_616e;

/// The planet as a frame sees it.
pub(super) fn planet_of(scene: &Scene) -> Vec<layout::Planet> {
    let Some(planet) = scene.planet else {
        return Vec::new();
    };
    let center = Vec3::from(planet.center);
    let eye = Vec3::from(scene.camera.position);
    let ahead = center - eye;
    let squared = dot3(ahead, ahead);
    let with = |v: Vec3, w: f32| [v.x, v.y, v.z, w].map(snap);
    let color = |color: [f32; 3], w: f32| with(Vec3::from(color), w);
    let light = &scene.light;
    let (lamps, _) = lamps_of(scene);
    let of_frame = layout::Planet {
        place: with(ahead, planet.radius),
        eye: with(eye, squared - planet.radius * planet.radius),
        color: color(planet.color, planet.relief),
        ground: [planet.scale, planet.contrast, 0.0, 0.0].map(snap),
        light_from: with(normalize_exact(Vec3::from(light.direction)), 0.0),
        light_color: color(light.color, 0.0),
        ambient: color(light.ambient, 0.0),
        kinds: [
            planet.octaves,
            name_key(scene.seed, "planet", KEY_TAG),
            lamps.len() as u32,
            0,
        ],
    };
    vec![of_frame]
}

/// The scene's lamps, and where their places are counted from: the planet's centre, if there is one.
pub(super) fn lamps_of(scene: &Scene) -> (Vec<layout::Lamp>, Vec3) {
    let center = scene
        .planet
        .map_or(Vec3::ZERO, |planet| Vec3::from(planet.center));
    let with = |v: Vec3, w: f32| [v.x, v.y, v.z, w].map(snap);
    let lamps = scene.lamps.iter().map(|lamp| layout::Lamp {
        place: with(
            Vec3::from(lamp.position) - center,
            lamp.distance * lamp.distance,
        ),
        color: with(Vec3::from(lamp.color), 0.0),
    });
    (lamps.collect(), center)
}

/// The plane of the circle where lines from the eye touch the planet: R^2 / D from its centre.
pub(super) fn outline_of(scene: &Scene) -> [f32; 4] {
    let Some(planet) = scene.planet else {
        return [0.0; 4];
    };
    let center = Vec3::from(planet.center);
    let away = Vec3::from(scene.camera.position) - center;
    let toward = normalize_exact(away);
    let reach = planet.radius * planet.radius * reciprocal(dot3(away, toward));
    let distance = dot3(toward, center) + reach;
    [toward.x, toward.y, toward.z, distance].map(snap)
}

/// What is seen of a planet is seen from a place.
pub(super) fn check_planet(scene: &Scene) -> Result<(), PlanError> {
    if scene.planet.is_none() || scene.camera.projection == Projection::Perspective {
        return Ok(());
    }
    Err(PlanError {
        message: "this scene has a planet and an orthographic camera".into(),
        help: "a camera in perspective, or no `planet`".into(),
        key: Some("camera.projection".into()),
    })
}
