//! How light counts: while the shutter is open, with its distance, and in all. Reeves (1983), 2.5
//! and 3, with their further work.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::camera::{STREAK, moments, still};
use crate::light::{Light, light_of};
use crate::support::{Run, assert_within, on_every_backend, sample, scene};

/// The light of a bright particle's only frame, by a plan of its own.
fn light_of_new(on: &str, picture: &str, lines: &str) -> Light {
    let bright = format!("lifetime = 1\n color = [64, 32, 16]\n {lines}");
    let mut run = Run::new(on, &scene(picture, &[&bright]), 1);
    run.step_to(0);
    run.light()
}

/// How far the centre of a streak shifts when weights rise from 0 to 2 along it: even over the area
/// that a disc of that radius sweeps, it is at two thirds between its ends, and with the disc's
/// halves that lie beyond them, the first of weight 0, the last of weight 2.
fn full_shift(length: f64, size: f64) -> f64 {
    // What is thinner than a pixel is drawn as a pixel.
    let r = size.max(0.5);
    let between = 2.0 * r * length * length / 6.0;
    let beyond = PI * r * r * (length / 2.0 + 4.0 * r / (3.0 * PI));
    (between + beyond) / (2.0 * r * length + PI * r * r)
}

/// A streak through the middle, and the shift of its centre along it when the eye sees it.
fn eye_shift(on: &str, length: f64, degrees: f64, size: f64, share: &str) -> f64 {
    let a = degrees.to_radians();
    // It has gone one frame, and is drawn over half of another.
    let start = -2.5 * length * DVec2::new(a.cos(), a.sin());
    let lines = still(
        [start.x + 0.1, start.y + 0.3, 0.0],
        &format!(
            "{STREAK}\n {share}\n size = {size}\n speed = {}\n rotation_degrees = [{}, 90]",
            2.0 * length,
            -degrees
        ),
    );
    let lines = lines.replace("sphere", "circle");
    let of = |weighting: &str| {
        let picture = format!("image.shutter_weighting = \"{weighting}\"");
        moments(&light_of(on, &picture, &lines))
    };
    let (camera, eye) = (of("camera"), of("eye"));
    let what = format!("{length} px at {degrees} degrees, radius {size}, {share}");
    assert_within(&what, eye.0, camera.0, 0.01);
    // Rows count down.
    let shift = (eye.1 - camera.1).dot(DVec2::new(a.cos(), -a.sin()));
    println!("{what}: shifted by {shift:.4}");
    shift
}

#[test]
fn r62_the_eye_sees_the_end_more_than_the_beginning_and_as_much_in_all() {
    on_every_backend(|on| {
        for share in ["", "streak_light = \"constant\""] {
            for &(length, degrees, size) in sample(
                on,
                &[
                    (40.0, 0.0, 0.5),
                    (30.0, 33.0, 1.0),
                    (24.0, 90.0, 0.3),
                    (36.0, -50.0, 0.7),
                ],
            ) {
                let shift = eye_shift(on, length, degrees, size, share);
                let expected = full_shift(length, size);
                assert_within("a long streak's shift", shift, expected, 0.03);
            }
            // Short ones, shorter than they are wide, have less to shift.
            for &(length, degrees, size) in sample(
                on,
                &[
                    (1.0, 20.0, 2.0),
                    (0.2, 0.0, 0.5),
                    (3.0, 60.0, 3.0),
                    (0.05, 45.0, 0.2),
                ],
            ) {
                let shift = eye_shift(on, length, degrees, size, share);
                assert!(shift > -1e-3 && shift < full_shift(length, size), "{shift}");
            }
        }
        // What does not move is seen as by a camera.
        let lines = still([3.3, 4.4, 0.0], "size = 2");
        let eye = light_of(on, "image.shutter_weighting = \"eye\"", &lines);
        assert!(eye == light_of(on, "", &lines));
    });
}

/// The distance from the eye, which is at z = 32, changes; the picture of the particle does not.
fn total_at(on: &str, place: DVec3, rest: &str) -> f64 {
    let distance = 32.0 - place.z;
    let size = 2.0 * distance / 32.0;
    let lines = still(place.to_array(), &format!("size = {size}\n {rest}"));
    light_of_new(on, "", &lines).total(0)
}

#[test]
fn r36_light_falls_with_the_square_of_the_distance_if_asked_to() {
    on_every_backend(|on| {
        for &(far, aside) in sample(
            on,
            &[
                (8.0, 0.0),
                (16.0, 0.5),
                (64.0, 0.0),
                (200.0, 0.0),
                (50.0, -0.6),
                (4.0, 0.2),
            ],
        ) {
            let place = DVec3::new(aside * far, 0.25 * far, 32.0 - far);
            let distance = far * f64::sqrt(1.0 + aside * aside + 0.0625);
            let full = total_at(on, place, "");
            assert_within("without", full, 64.0 * PI * 4.0, 0.02);
            let falling = total_at(on, place, "light_distance = 16");
            let expected = 64.0 * PI * 4.0 * (16.0 / distance).powi(2);
            assert_within(&format!("at {distance}"), falling, expected, 0.02);
        }
    });
}

#[test]
fn r36_light_does_not_fall_within_an_orthographic_depth_alone() {
    // Nothing but light changes here with the distance.
    let picture = "camera.projection = \"orthographic\"\n camera.view_height = 16";
    on_every_backend(|on| {
        let at = |z: f64| {
            let lines = still([0.0, 0.0, z], "size = 1\n light_distance = 32");
            light_of_new(on, picture, &lines).total(0)
        };
        let unit = at(0.0);
        assert_within("at its unit", unit, 64.0 * PI * 16.0, 0.01);
        for &(z, expected) in sample(on, &[(-32.0, 0.25), (16.0, 4.0), (-288.0, 0.01)]) {
            assert_within("share", at(z) / unit, expected, 0.02);
        }
    });
}

#[test]
fn r39_exposure_is_a_factor_of_light_before_the_clamp_and_not_of_the_background() {
    let background = [0.2, 0.1, 0.0];
    let colors = [0.25, 0.03, 0.004];
    on_every_backend(|on| {
        for &exposure in sample(on, &[1.0, 2.0, 0.0, 0.5, 60.0, 1000.0]) {
            let picture = format!(
                "image.exposure = {exposure}\n image.background = {background:?}\n image.shutter = 0"
            );
            let lines = format!("color = {colors:?}\n size = 8\n particle_shape = \"rectangle\"");
            let mut run = Run::new(on, &scene(&picture, &[&lines]), 1);
            run.step_to(0);
            let image = run.image();
            let pixel = |x: usize, y: usize| &image[(y * 64 + x) * 4..][..4];
            let byte = |v: f64| (v.clamp(0.0, 1.0) * 255.0 + 0.5).floor() as u8;
            let lit: Vec<u8> = (0..3)
                .map(|at| byte(colors[at] * exposure + background[at]))
                .collect();
            assert_eq!(&pixel(32, 32)[..3], lit, "exposure {exposure}");
            assert_eq!(
                &pixel(2, 2)[..3],
                background.map(byte),
                "exposure {exposure}"
            );
        }
        // The light itself is the same: exposure comes last.
        let light = |picture: &str| light_of(on, picture, &still([1.0, 2.0, 0.0], "size = 3"));
        assert!(light("image.exposure = 2") == light(""));
    });
}
