//! The planet, what it hides, and the light above the rings (Reeves 1983, section 3).

use motes::scene::Scene;

use crate::common;
use crate::support::simulation;

/// A planet of radius 10 at the origin, a camera 30 units away on the z axis, and particles.
fn scene(particles: &str, more: &str) -> Scene {
    common::scene_of(&format!(
        "image = {{ width = 200, height = 200 }}
         camera = {{ position = [0, 0, 30], target = [0, 0, 0], vertical_fov_degrees = 60 }}
         {more}
         [[system]]
         name = \"points\"
         initial_mean_parts = 1
         birth_rounding = \"nearest\"
         end_frame = 1
         speed = 0
         color = [1, 1, 1]
         {particles}"
    ))
}

const PLANET: &str = "planet = { radius = 10, color = [0.5, 0.5, 0.5] }
    light = { direction = [0, 0, 1], color = [0, 0, 0], ambient = [0, 0, 0] }";

/// Light of all pixels, red, in 255ths.
fn picture(scene: &Scene) -> Vec<u8> {
    let mut simulation = simulation(scene);
    simulation.seek(0).expect("it steps");
    simulation.draw().expect("it draws");
    let bytes = simulation.image().expect("it can be read");
    bytes.chunks(4).map(|pixel| pixel[0]).collect()
}

fn light(scene: &Scene) -> u32 {
    picture(scene).iter().map(|red| u32::from(*red)).sum()
}

#[test]
fn r63_a_particle_behind_the_disc_is_hidden_and_one_past_the_limb_is_seen() {
    let at = |[x, y, z]: [f32; 3], planet: &str| {
        let point = format!(
            "position = [{x}, {y}, {z}]\nsize = 0.2\ngeneration_shape = {{ kind = \"sphere\", radius = 0 }}"
        );
        light(&scene(&point, planet))
    };
    // The outline's plane is at z = 100 / 30, its circle has a radius of 9.43.
    for place in [
        [0.0, 0.0, -12.0],
        [4.0, 3.0, -20.0],
        [9.0, 0.0, 3.0],
        [0.0, -9.8, 0.0],
        // Just behind its plane, all over the disc.
        [5.0, 0.0, 3.32],
        [-3.0, -6.0, 3.32],
        [0.0, 8.5, 3.32],
    ] {
        assert!(at(place, "") > 200, "{place:?} can be seen");
        assert_eq!(at(place, PLANET), 0, "{place:?} is hidden");
    }
    for place in [
        [0.0, 0.0, 10.5],
        [9.0, 1.0, 4.6],
        [0.0, 13.0, -2.0],
        [-14.0, 0.0, -5.0],
        // Just before its plane.
        [5.0, 0.0, 3.35],
        [-3.0, -6.0, 3.35],
        [0.0, 8.5, 3.35],
    ] {
        assert_eq!(at(place, PLANET), at(place, ""), "{place:?}");
    }
}

#[test]
fn r63_of_a_hundred_thousand_particles_those_behind_the_disc_are_lost() {
    let many = "size = 0.02
        generation_shape = { kind = \"box\", length = 30, width = 30, height = 40 }";
    let mut with = scene(many, PLANET);
    with.systems[0].births.initial_mean_parts = 100_000.0;
    with.systems[0].color.initial.mean = [0.02; 3];
    let inputs = |scene: &Scene| {
        let plan = motes::plan::Plan::new(scene, 1).expect("it can be planned");
        plan.inputs(0).frame.planet_outline.map(f64::from)
    };
    let [nx, ny, nz, distance] = inputs(&with);
    let mut run = simulation(&with);
    run.seek(0).expect("it steps");
    let particles = run.particles().expect("they can be read");
    assert_eq!(particles.len(), 100_000);
    let behind = particles
        .iter()
        .filter(|particle| {
            let [_, _, z] = particle.position.map(f64::from);
            assert!((nx, ny, nz) == (0.0, 0.0, 1.0) && (distance - 100.0 / 30.0).abs() < 1e-5);
            z < 100.0 / 30.0
        })
        .count();
    assert!((40_000..70_000).contains(&behind), "{behind}");
    // The picture is that of those before the plane alone, where the planet is behind all of them.
    let picture = picture(&with);
    let mut before = with.clone();
    before.planet = None;
    let plain = self::picture(&before);
    let pixel = |x: usize, y: usize| y * 200 + x;
    // At the centre what is behind is lost; in the corner nothing is.
    let sum = |picture: &[u8], range: std::ops::Range<usize>| -> u32 {
        let rows = range
            .clone()
            .flat_map(|y| range.clone().map(move |x| pixel(x, y)));
        rows.map(|at| u32::from(picture[at])).sum()
    };
    assert_eq!(sum(&picture, 0..20), sum(&plain, 0..20));
    let share = f64::from(sum(&picture, 80..120)) / f64::from(sum(&plain, 80..120));
    assert!((0.2..0.75).contains(&share), "{share}");
}

#[test]
fn r63_the_outline_is_where_lines_from_the_eye_touch() {
    let away =
        "position = [0, 500, 0]\nsize = 0.1\ngeneration_shape = { kind = \"sphere\", radius = 0 }";
    let planet = "planet = { radius = 10, color = [1, 1, 1] }
        light = { direction = [0, 0, 1], color = [0, 0, 0], ambient = [1, 1, 1] }";
    let picture = picture(&scene(away, planet));
    let area: f64 = picture.iter().map(|red| f64::from(*red) / 255.0).sum();
    // tan of the half-angle whose sine is 1/3, in pixels: focal length 100 / tan 30 degrees.
    let radius = 100.0 / 30f64.to_radians().tan() * (1.0 / 3.0) / (8.0f64 / 9.0).sqrt();
    let expected = std::f64::consts::PI * radius * radius;
    assert!((area / expected - 1.0).abs() < 2e-3, "{area} of {expected}");
    // Its edge is smooth: some pixels are neither black nor white, and few.
    let between = picture
        .iter()
        .filter(|red| !matches!(**red, 0 | 255))
        .count() as f64;
    assert!((1.0..10.0 * radius).contains(&between), "{between}");
}

#[test]
fn r64_a_lamp_above_the_rings_makes_the_ground_glow_there() {
    let away =
        "position = [0, 500, 0]\nsize = 0.1\ngeneration_shape = { kind = \"sphere\", radius = 0 }";
    let lamp = "lamp = [{ position = [0, 0, 13], color = [1, 0.5, 0.2], distance = 3 }]";
    let lit = picture(&scene(away, &format!("{PLANET}\n{lamp}")));
    let dark = picture(&scene(away, PLANET));
    let at = |x: usize, y: usize| lit[y * 200 + x];
    // Nearest the centre of the rings it is brightest: half of white, straight, at its distance.
    assert!((126..=129).contains(&at(100, 100)), "{}", at(100, 100));
    assert!(at(100, 100) > at(125, 100) && at(125, 100) > at(145, 100));
    for (pixel, (lit, dark)) in lit.iter().zip(&dark).enumerate() {
        let [x, y] = [pixel % 200, pixel / 200].map(|at| at as f64 + 0.5 - 100.0);
        if lit != dark {
            assert!((x * x + y * y).sqrt() < 62.3, "only the planet: {x} {y}");
        }
    }
}
