//! Births by screen area: Reeves (1983), section 2.1, and RA3.

use std::f64::consts::PI;

use crate::support::{Run, assert_within, on_every_backend, scene};

/// Births of every system in each frame below `frame_end`, found without bearing anybody.
fn births(on: &str, picture: &str, systems: &[String], frame_end: u32) -> Vec<Vec<u32>> {
    let systems: Vec<&str> = systems.iter().map(String::as_str).collect();
    let scene = scene(&format!("capacity = 1\n{picture}"), &systems);
    let mut run = Run::new(on, &scene, frame_end);
    let frame = |frame| {
        run.step_to(frame);
        run.births_by_system()
    };
    (0..frame_end).map(frame).collect()
}

/// Systems of a sphere each, a thousand births a pixel.
fn spheres(places: &[([f64; 3], f64)]) -> Vec<String> {
    let lines = |(at, &(place, radius)): (usize, &([f64; 3], f64))| {
        format!(
            "name = \"s{at}\"\n position = {place:?}\n initial_mean_parts_per_area = 1000
            generation_shape = {{ kind = \"sphere\", radius = {radius:?} }}"
        )
    };
    places.iter().enumerate().map(lines).collect()
}

/// Pixels of a picture that a disc covers, column by column; the picture is 64 x 36.
fn covered([x, y]: [f64; 2], radius: f64) -> f64 {
    const COLUMNS: u32 = 640_000;
    let width = 64.0 / f64::from(COLUMNS);
    let column = |at| {
        let dx = (f64::from(at) + 0.5) * width - x;
        let half = (radius * radius - dx * dx).max(0.0).sqrt();
        let [top, bottom] = [y - half, y + half].map(|edge| edge.clamp(0.0, 36.0));
        (bottom - top) * width
    };
    (0..COLUMNS).map(column).sum()
}

#[test]
fn r6_twice_as_far_is_a_quarter_of_the_births() {
    // At 32 units a unit is a pixel. The camera jumps back, and the systems stay.
    let keys = "[[0, [0, 0, 32]], [1, [0, 0, 64]], [2, [0, 0, 128]], [3, [0, 0, 1000]]]";
    let picture = format!("camera.position = {{ keys = {keys}, interpolation = \"step\" }}");
    let systems = spheres(&[([0.0; 3], 8.0), ([2.0, -3.0, 0.0], 5.0)]);
    on_every_backend(|on| {
        let births = births(on, &picture, &systems, 4);
        for (system, radius) in [(0, 8.0f64), (1, 5.0)] {
            let of = |frame: usize| f64::from(births[frame][system]);
            assert_within(
                "births at 32 units",
                of(0),
                1000.0 * PI * radius * radius,
                0.002,
            );
            assert_within("twice as far", of(1) / of(0), 0.25, 0.02);
            assert_within("twice as far again", of(2) / of(1), 0.25, 0.02);
            assert_within("far away", of(3) / of(0), (32.0f64 / 1000.0).powi(2), 0.02);
        }
    });
}

#[test]
fn r6_what_covers_four_pixels_makes_four() {
    // The text's example, near and far: a million pixels' worth of detail is not made.
    let radius = 250.0f64;
    let far = 32.0 * radius / (4.0 / PI).sqrt();
    let picture = format!(
        "camera.position = {{ keys = [[0, [0, 0, 32]], [1, [0, 0, {far:?}]]], interpolation = \"step\" }}"
    );
    let system = format!(
        "initial_mean_parts_per_area = 1\n generation_shape = {{ kind = \"sphere\", radius = {radius:?} }}"
    );
    on_every_backend(|on| {
        let births = births(on, &picture, std::slice::from_ref(&system), 2);
        assert_eq!(births, [[64 * 64], [4]]);
    });
}

#[test]
fn r6_births_follow_a_moving_camera() {
    let picture = "camera.position = { keys = [[0, [0, 0, 32]], [40, [0, 0, 128]]] }";
    let zoom = "camera.vertical_fov_degrees = { keys = [[0, 90], [40, 20]] }";
    let system = spheres(&[([0.0; 3], 6.0)]);
    on_every_backend(|on| {
        for (frame, births) in births(on, picture, &system, 42).iter().enumerate() {
            let distance = 32.0 + 96.0 * (frame as f64 / 40.0).min(1.0);
            let radius = 6.0 * 32.0 / distance;
            let expected = 1000.0 * PI * radius * radius;
            assert_within("moving", f64::from(births[0]), expected, 0.002);
        }
        for (frame, births) in births(on, zoom, &system, 42).iter().enumerate() {
            let degrees = 90.0 - 70.0 * (frame as f64 / 40.0).min(1.0);
            let radius = 6.0 / (0.5 * degrees).to_radians().tan();
            let expected = 1000.0 * covered_in_square(radius);
            assert_within("zooming", f64::from(births[0]), expected, 0.002);
        }
    });
}

/// Pixels of a 64 x 64 picture that a disc in its middle covers: four times the integral of
/// sqrt(r^2 - x^2) cut at 32, in closed form.
fn covered_in_square(radius: f64) -> f64 {
    const HALF: f64 = 32.0;
    if radius <= HALF {
        return PI * radius * radius;
    }
    if radius >= HALF * 2.0f64.sqrt() {
        return 4.0 * HALF * HALF;
    }
    let corner = (radius * radius - HALF * HALF).sqrt();
    let integral = |x: f64| {
        0.5 * (x * (radius * radius - x * x).sqrt() + radius * radius * (x / radius).asin())
    };
    4.0 * (corner * HALF + integral(HALF) - integral(corner))
}

#[test]
fn r6_an_orthographic_view_does_not_shrink_what_is_far() {
    let picture = "camera.projection = \"orthographic\"
        camera.view_height = { keys = [[0, 64], [1, 128], [2, 32]], interpolation = \"step\" }";
    let systems = spheres(&[
        ([0.0, 0.0, 20.0], 7.0),
        ([0.0, 0.0, -5000.0], 7.0),
        // Behind the camera.
        ([0.0, 0.0, 40.0], 7.0),
    ]);
    on_every_backend(|on| {
        let births = births(on, picture, &systems, 3);
        for (births, px_per_unit) in births.iter().zip([1.0, 0.5, 2.0]) {
            let expected = 1000.0 * PI * 49.0 * px_per_unit * px_per_unit;
            assert_within("near", f64::from(births[0]), expected, 0.002);
            assert_within("far", f64::from(births[1]), expected, 0.002);
            assert_eq!(births[2], 0, "behind");
        }
    });
}

#[test]
fn r6_what_the_picture_cuts_off_does_not_count() {
    // A picture of 64 x 36 pixels, 18 to the unit of x / z, seen from 18 units: a pixel a unit.
    let picture = "image.height = 36\n camera.position = [0, 0, 18]";
    let places: Vec<([f64; 3], f64)> = vec![
        ([0.0, 0.0, 0.0], 10.0),
        // Over one edge each, in the middle of it, and a corner.
        ([-32.0, 0.0, 0.0], 9.0),
        ([33.0, 2.0, 0.0], 9.0),
        ([3.0, 18.0, 0.0], 9.0),
        ([-7.0, -21.0, 0.0], 9.0),
        ([30.0, 16.5, 0.0], 8.0),
        // A sliver.
        ([-40.0, 3.0, 0.0], 8.5),
        // Above and below at once, and all around.
        ([5.0, 1.0, 0.0], 24.0),
        ([0.0, 0.0, 0.0], 60.0),
        ([20.0, 9.0, 0.0], 35.0),
        // Outside on each side, and behind.
        ([-45.0, 0.0, 0.0], 12.0),
        ([45.0, 0.0, 0.0], 12.0),
        ([0.0, 31.0, 0.0], 12.0),
        ([0.0, -31.0, 0.0], 12.0),
        ([0.0, 0.0, 19.0], 12.0),
        // Nothing at all.
        ([0.0, 0.0, 0.0], 0.0),
    ];
    on_every_backend(|on| {
        let births = births(on, picture, &spheres(&places), 1);
        for (&(place, radius), &births) in places.iter().zip(&births[0]) {
            let [x, y, z] = place;
            let expected = if z < 18.0 {
                1000.0 * covered([32.0 + x, 18.0 - y], radius)
            } else {
                0.0
            };
            let off = (f64::from(births) - expected).abs();
            assert!(
                off <= 1.0 + 0.003 * expected,
                "{radius} at {place:?}: {births} births, expected {expected}"
            );
        }
    });
}

#[test]
fn r6_the_sphere_is_around_what_is_born() {
    // Far to the left and turned so that local +z is to the right: radius, and where its middle is.
    let shapes = [
        ("{ kind = \"circle\", radius = 6 }", 6.0, 0.0),
        (
            "{ kind = \"ring\", inner_radius = 2, outer_radius = 5 }",
            5.0,
            0.0,
        ),
        ("{ kind = \"rectangle\", length = 6, width = 8 }", 5.0, 0.0),
        (
            "{ kind = \"box\", length = 4, width = 4, height = 2 }",
            3.0,
            0.0,
        ),
        ("{ kind = \"line\", length = 14 }", 7.0, 0.0),
        (
            "{ kind = \"attractor\", attractor = \"lorenz\", radius = 4 }",
            4.0,
            0.0,
        ),
        // From apex to rim: half of 16 up, and 12 tan(45 degrees) wide there.
        (
            "{ kind = \"cone\", height = 12, angle_degrees = 45 }",
            (6.0f64 * 6.0 + 12.0 * 12.0).sqrt(),
            6.0,
        ),
        (
            "{ kind = \"mesh\", mesh = \"cylinder\", scale = 3 }",
            18f64.sqrt(),
            0.0,
        ),
    ];
    let systems: Vec<String> = shapes
        .iter()
        .enumerate()
        .map(|(at, (shape, ..))| {
            format!(
                "name = \"s{at}\"\n position = [-30, 4, 0]\n rotation_degrees = [0, 90]
                initial_mean_parts_per_area = 1000\n generation_shape = {shape}"
            )
        })
        .collect();
    let picture = "image.height = 36\n camera.position = [0, 0, 18]";
    on_every_backend(|on| {
        let births = births(on, picture, &systems, 1);
        for (&(shape, radius, along), &births) in shapes.iter().zip(&births[0]) {
            let expected = 1000.0 * covered([2.0 + along, 14.0], radius);
            assert_within(shape, f64::from(births), expected, 0.003);
        }
    });
}
