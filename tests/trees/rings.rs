//! Rings of explosions that run over a planet (Reeves 1983, section 3).

use std::f64::consts::{PI, TAU};

use motes::backend::Backend;
use motes::scene::Scene;

use crate::common::statistics::assert_uniform;
use crate::support::{Run, dot, length, origin, particles, scene, up};

const RADIUS: f64 = 10.0;
const WALL_SPEED: f64 = 0.125;

/// Rings each fourth frame from frame 3 on, around a point of a planet at the origin.
fn wall(rotation: &str, more: &str) -> Scene {
    let (position, rotation) = match rotation {
        "" => ("[0, 0, 10]", "[0, 0]"),
        _ => ("[0, 10, 0]", rotation),
    };
    scene(&[
        &format!(
            "name = \"wall\"
             position = {position}
             rotation_degrees = {rotation}
             first_frame = 3
             generation_shape = {{ kind = \"rings\", radius = 10, wall_speed = 0.125, ring_frames = 4, density = 2 }}
             speed = 0
             lifetime = 500
             color = [0, 0, 0]
             size = 1"
        ),
        &format!(
            "name = \"explosion\"
             parent = \"wall\"
             generation_shape = {{ kind = \"circle\", radius = 0.4 }}
             ejection_angle_degrees = 25
             speed = {{ mean = 0.1, var = 0.02 }}
             lifetime = 30
             acceleration = [0, 0, -0.005]
             acceleration_space = \"system\"
             color = [0.4, 0.1, 0.02]
             size = 0.05
             extinction = [{{ kind = \"sphere\", center = [0, 0, 0], radius = 10, kills = \"inside\" }}]
             {more}"
        ),
    ])
}

const FEW: &str = "initial_mean_parts = 5";

#[test]
fn r48_all_origins_are_on_the_sphere_and_up_is_away_from_it() {
    // A turn by -90 degrees about x brings +z to +y.
    for rotation in ["", "[-90, 0]"] {
        let mut run = Run::new(&wall(rotation, FEW));
        (0..60).for_each(|_| run.step());
        let borne = run.borne();
        assert!(borne.len() > 300);
        for (_, system, _) in &borne {
            let (place, up) = (origin(system), up(system));
            assert!((length(place) - RADIUS).abs() < 1e-5 * RADIUS, "{place:?}");
            let away = dot(place, up) / length(place);
            assert!((away - 1.0).abs() < 1e-5, "{place:?} {up:?}");
        }
    }
}

#[test]
fn r49_a_ring_has_as_many_systems_as_its_circumference_says() {
    let mut run = Run::new(&wall("", FEW));
    let mut around = Vec::new();
    for frame in 0..60u32 {
        run.step();
        let born = run.newborn();
        let since = frame.checked_sub(3).filter(|since| since % 4 == 0);
        let rho = since.map_or(0.0, |since| f64::from(since) * WALL_SPEED);
        let wanted = (2.0 * TAU * RADIUS * (rho / RADIUS).sin()).round() as usize;
        assert_eq!(born.len(), wanted, "frame {frame}");
        around.extend(born.iter().map(|(_, system, _)| {
            let [x, y, _] = origin(system);
            y.atan2(x).rem_euclid(TAU)
        }));
    }
    assert_uniform("azimuths", &around, 0.0, TAU);
}

#[test]
fn r50_systems_begin_when_the_wall_reaches_them() {
    let mut run = Run::new(&wall("", FEW));
    (0..60).for_each(|_| run.step());
    for (node, system, _) in run.borne() {
        let [x, y, z] = origin(&system);
        let rho = RADIUS * (x * x + y * y).sqrt().atan2(z);
        let begun = 3.0 + rho / WALL_SPEED;
        assert!(
            (begun - f64::from(node.who[1])).abs() < 1e-3,
            "{begun} {:?}",
            node.who
        );
    }
}

#[test]
fn r50_rings_end_on_the_other_side() {
    let mut scene = wall("", FEW);
    scene.frames = 400;
    scene.systems[1].births.initial_mean_parts = 0.0;
    let mut run = Run::new(&scene);
    let mut last = 0;
    for frame in 0..300 {
        run.step();
        if run.counts().born > 0 {
            last = frame;
        }
    }
    // Half way around is 251.3 frames from frame 3 on; the last ring has less than one system.
    let end = 3.0 + PI * RADIUS / WALL_SPEED;
    assert!((f64::from(last) - end).abs() < 8.0, "{last} of {end}");
    assert_eq!(run.counts().dropped, 0);
}

#[test]
fn r51_particles_leave_a_circle_within_a_cone_about_the_normal() {
    let scene = wall("[-90, 0]", FEW);
    let mut run = Run::new(&scene);
    (0..40).for_each(|_| run.step());
    let borne = run.borne();
    let mut seen = 0;
    for particle in particles(&scene, 39)
        .iter()
        .filter(|particle| particle.age == 0)
    {
        // Slots from 2 on, in order, none of them free.
        let (_, system, _) = &borne[particle.system as usize - 2];
        let (place, normal) = (origin(system), up(system));
        // It has moved one frame, and its velocity has been pulled once.
        let velocity = particle.velocity.map(f64::from);
        let first = [0, 1, 2].map(|i| velocity[i] + 0.005 * normal[i]);
        let born = [0, 1, 2].map(|i| f64::from(particle.position[i]) - first[i] - place[i]);
        assert!(
            length(born) <= 0.4001 && dot(born, normal).abs() < 1e-4,
            "{born:?}"
        );
        let cosine = dot(first, normal) / length(first);
        assert!(cosine >= 25f64.to_radians().cos() - 1e-3, "{cosine}");
        seen += 1;
    }
    assert!(seen > 500, "{seen}");
}

#[test]
fn r53_nearer_explosions_bear_more() {
    let of = |distance: f32| {
        let mut scene = wall(
            "",
            "initial_mean_parts_per_area = 0.5\nbirth_rounding = \"nearest\"",
        );
        scene.capacity = Some(1_000_000);
        scene.image.width = 640;
        scene.image.height = 360;
        scene.camera.position = [0.0, 0.0, 10.0 + distance];
        scene.camera.target = [0.0, 0.0, 0.0];
        let mut run = Run::new(&scene);
        (0..12).for_each(|_| run.step());
        f64::from(run.births().iter().sum::<u32>())
    };
    // All of them are near the point below the camera: twice as far is a quarter.
    let (near, far) = (of(20.0), of(40.0));
    let ratio = near / far;
    assert!((ratio - 4.0).abs() < 0.25, "{near} and {far}");
}

#[test]
fn r89_a_frames_work_follows_the_area_that_the_systems_have_in_the_picture() {
    // What stages go over particle by particle, and pixels that get light, of the same wall of fire: from
    // far away, at which all of it is as far, and in pictures of as many pixels.
    let of = |distance: f32, pixels: u32| {
        let mut scene = wall(
            "",
            "initial_mean_parts_per_area = 0.25\nbirth_rounding = \"nearest\"",
        );
        scene.capacity = Some(1_000_000);
        scene.image.width = 16 * pixels;
        scene.image.height = 9 * pixels;
        scene.camera.position = [0.0, 0.0, 10.0 + distance];
        scene.camera.target = [0.0, 0.0, 0.0];
        let mut run = Run::new(&scene);
        (0..40).for_each(|_| run.step());
        let inputs = run.plan.inputs(39);
        run.backend.draw(&inputs).expect("it draws");
        let live = run.backend.read("counts").expect("it is read")[0];
        let light = run.backend.read("light_low").expect("it is read");
        let lit = light.chunks(3).filter(|pixel| **pixel != [0; 3]).count();
        [run.counts().live, live, lit as u32].map(f64::from)
    };
    let [systems, near, near_pixels] = of(80.0, 80);
    for (distance, pixels, share) in [(160.0, 80, 0.25), (320.0, 80, 1.0 / 16.0), (80.0, 40, 0.25)]
    {
        let [same_systems, live, lit] = of(distance, pixels);
        println!(
            "{distance} away, {pixels}: {live} live, {lit} pixels; {near} and {near_pixels} near"
        );
        assert_eq!(systems, same_systems);
        assert!((live / near / share - 1.0).abs() < 0.1, "{live} of {near}");
        assert!(
            (lit / near_pixels / share - 1.0).abs() < 0.25,
            "{lit} of {near_pixels}"
        );
    }
}

#[test]
fn r57_nobody_is_below_the_ground() {
    let living = particles(&wall("[-90, 0]", FEW), 59);
    assert!(living.len() > 5000);
    for particle in living {
        let place = particle.position.map(f64::from);
        assert!(length(place) >= RADIUS - 2e-6, "{place:?}");
    }
}
