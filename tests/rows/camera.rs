//! What the camera does to the picture: Reeves (1983), 2.5 and 3, with their further work.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use motes::plan::Plan;

use crate::light::{Light, light_of};
use crate::support::{assert_within, on_every_backend, sample, scene};

/// A camera in double precision, for a picture of 64 x 64 pixels.
#[derive(Clone, Copy)]
struct Eye {
    position: DVec3,
    target: DVec3,
    /// The vertical angle of view; 0 for an orthographic one of 8 units.
    fov_degrees: f64,
}

impl Eye {
    fn new(position: [f64; 3], target: [f64; 3], fov_degrees: f64) -> Self {
        Self {
            position: position.into(),
            target: target.into(),
            fov_degrees,
        }
    }

    fn pixel_of(&self, place: DVec3) -> DVec2 {
        let forward = (self.target - self.position).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let seen = place - self.position;
        let scale = if self.fov_degrees == 0.0 {
            64.0 / 8.0
        } else {
            32.0 / (self.fov_degrees.to_radians() / 2.0).tan() / seen.dot(forward)
        };
        DVec2::new(32.0 + seen.dot(right) * scale, 32.0 - seen.dot(up) * scale)
    }
}

/// A thing at rest at a place.
pub(crate) fn still(place: [f64; 3], rest: &str) -> String {
    format!(
        "position = {place:?}\n generation_shape = {{ kind = \"sphere\", radius = 0 }}\n {rest}"
    )
}

pub(crate) const STREAK: &str = "particle_shape = \"streak\"";

/// Total light, its centre, its main axis, and its variance along that.
pub(crate) fn moments(light: &Light) -> (f64, DVec2, DVec2, f64) {
    let total = light.total(0);
    let mean = |of: &dyn Fn(DVec2) -> f64| -> f64 {
        let sum: f64 = light
            .pixels(0)
            .map(|(x, y, light)| light * of(DVec2::new(x, y)))
            .sum();
        sum / total
    };
    let center = DVec2::new(mean(&|p| p.x), mean(&|p| p.y));
    let [xx, xy, yy] = [
        mean(&|p| (p - center).x.powi(2)),
        mean(&|p| (p - center).x * (p - center).y),
        mean(&|p| (p - center).y.powi(2)),
    ];
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let axis = DVec2::new(angle.cos(), angle.sin());
    let along = axis.x * axis.x * xx + 2.0 * axis.x * axis.y * xy + axis.y * axis.y * yy;
    (total, center, axis, along)
}

/// Variance along a streak from point to point so far apart, even over the area that a disc of that
/// radius sweeps.
fn variance(length: f64, radius: f64) -> f64 {
    let r = radius;
    let second = 2.0 * r * length.powi(3) / 12.0
        + PI * r * r * length * length / 4.0
        + 4.0 / 3.0 * r.powi(3) * length
        + PI * r.powi(4) / 4.0;
    second / (2.0 * r * length + PI * r * r)
}

/// Fails unless the light is a streak between the two points.
fn assert_streak(what: &str, light: &Light, radius: f64, ends: [DVec2; 2]) {
    let (_, center, axis, along) = moments(light);
    let span = ends[1] - ends[0];
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if variance(middle, radius) < along {
            low = middle;
        } else {
            high = middle;
        }
    }
    let off = center - (ends[0] + ends[1]) / 2.0;
    let aside = axis.perp_dot(span.normalize_or_zero()).abs();
    println!(
        "{what}: {low:.3} px long, expected {:.3}, off by {off:.3}, aside by {aside:.4}",
        span.length()
    );
    assert!(
        (low - span.length()).abs() < 0.15,
        "{what}: {low}, expected {}",
        span.length()
    );
    assert!(off.length() < 0.1, "{what}: {center} is off by {off}");
    assert!(aside < 0.02, "{what}: {axis} is not along {span}");
}

fn keyed(value: &str, from: impl std::fmt::Debug, to: impl std::fmt::Debug) -> String {
    format!("{value} = {{ keys = [[0, {from:?}], [1, {to:?}]] }}\n")
}

/// A camera that goes from one to the other in a frame.
fn moving(from: Eye, to: Eye) -> String {
    keyed(
        "camera.position",
        from.position.to_array(),
        to.position.to_array(),
    ) + &keyed(
        "camera.target",
        from.target.to_array(),
        to.target.to_array(),
    ) + &keyed(
        "camera.vertical_fov_degrees",
        from.fov_degrees,
        to.fov_degrees,
    )
}

/// The camera half a frame later.
fn halfway(from: Eye, to: Eye) -> Eye {
    Eye {
        position: (from.position + to.position) / 2.0,
        target: (from.target + to.target) / 2.0,
        fov_degrees: (from.fov_degrees + to.fov_degrees) / 2.0,
    }
}

#[test]
fn r61_a_camera_that_moves_blurs_what_is_at_rest() {
    let rest = Eye::new([0.0, 0.0, 32.0], [0.0; 3], 90.0);
    let moves = [
        // 40 pixels a frame, 20 while the shutter is open.
        (
            "pan",
            [12.0, 4.0, 0.0],
            Eye::new([40.0, 0.0, 32.0], [40.0, 0.0, 0.0], 90.0),
        ),
        (
            "dolly",
            [10.0, -8.0, 0.0],
            Eye::new([0.0, 0.0, 12.0], [0.0; 3], 90.0),
        ),
        (
            "zoom",
            [-9.0, 7.0, 0.0],
            Eye {
                fov_degrees: 40.0,
                ..rest
            },
        ),
        (
            "turn",
            [3.0, 9.0, 2.0],
            Eye {
                target: DVec3::new(20.0, 12.0, 0.0),
                ..rest
            },
        ),
        (
            "crane",
            [4.0, 2.0, 3.0],
            Eye::new([6.0, 30.0, 30.0], [2.0, 10.0, 0.0], 80.0),
        ),
    ];
    on_every_backend(|on| {
        for &(what, place, to) in sample(on, &moves) {
            let size = 1.5;
            let lines = still(place, &format!("{STREAK}\n size = {size}"));
            let ends = [rest, halfway(rest, to)].map(|eye| eye.pixel_of(place.into()));
            let light = light_of(on, &moving(rest, to), &lines);
            let radius = size * 32.0 / (32.0 - place[2]);
            assert_streak(what, &light, radius, ends);
            assert_within(what, light.total(0) / 64.0, PI * radius * radius, 0.01);
            // What is no streak stays where it was when the frame began.
            let disc = light_of(
                on,
                &moving(rest, to),
                &still(place, &format!("size = {size}")),
            );
            assert!(
                disc == light_of(on, "", &still(place, &format!("size = {size}"))),
                "{what}"
            );
        }
    });
}

#[test]
fn r61_panning_along_stops_the_blur() {
    on_every_backend(|on| {
        // The particle goes 40 to the right a frame, and so does the camera: from frame 0 to 1.
        let lines = still(
            [-40.0, 3.0, 0.0],
            &format!("{STREAK}\n speed = 40\n rotation_degrees = [0, 90]\n size = 1.5"),
        );
        let lines = lines.replace("sphere", "circle");
        let (from, to) = (
            Eye::new([0.0, 0.0, 32.0], [0.0; 3], 90.0),
            Eye::new([40.0, 0.0, 32.0], [40.0, 0.0, 0.0], 90.0),
        );
        let light = light_of(on, &moving(from, to), &lines);
        assert!(
            light
                == light_of(
                    on,
                    "",
                    &still([0.0, 3.0, 0.0], &format!("{STREAK}\n size = 1.5"))
                )
        );
        let light = light_of(on, "", &lines);
        assert_streak(
            "still",
            &light,
            1.5,
            [DVec2::new(32.0, 29.0), DVec2::new(52.0, 29.0)],
        );
    });
}

#[test]
fn r61_a_system_that_moves_takes_its_particles_along() {
    on_every_backend(|on| {
        let system = |space: &str, motion: &str| {
            format!(
                "size = 1.5\n {STREAK}
                particle_space = \"{space}\"\n {motion}"
            )
        };
        let going = keyed("position", [-10.0, -5.0, 0.0], [14.0, 13.0, 0.0]);
        let ends = [DVec2::new(22.0, 37.0), DVec2::new(34.0, 28.0)];
        let light = light_of(on, "", &system("system", &going));
        assert_streak("with its system", &light, 1.5, ends);
        let light = light_of(on, "", &system("world", &going));
        let rest = still([-10.0, -5.0, 0.0], &format!("{STREAK}\n size = 1.5"));
        assert!(light == light_of(on, "", &rest), "it stays behind");

        // And when it turns: after a step of 12 along +z turned about x (down) and y.
        let speed = "generation_shape = { kind = \"circle\", radius = 0 }\n speed = 12\n";
        let turning = speed.to_owned() + &keyed("rotation_degrees", [0.0, 90.0], [-60.0, 90.0]);
        let at = |a_degrees: f64, along: f64| {
            let a = a_degrees.to_radians();
            // Turned about x by a, then about y by 90 degrees: +z goes to +x.
            DVec2::new(32.0 + along * a.cos(), 32.0 + along * a.sin())
        };
        let light = light_of(on, "", &system("system", &turning));
        assert_streak("turned", &light, 1.5, [at(0.0, 12.0), at(-30.0, 18.0)]);
        let light = light_of(on, "", &system("world", &turning));
        assert_streak("not turned", &light, 1.5, [at(0.0, 12.0), at(0.0, 18.0)]);
    });
}

#[test]
fn r37_an_orthographic_view_shows_the_same_size_at_all_depths() {
    let eye = Eye::new([3.0, 4.0, 12.0], [0.5, 0.0, 0.0], 0.0);
    let picture = "camera.position = [3, 4, 12]\n camera.target = [0.5, 0, 0]
        camera.projection = \"orthographic\"\n camera.view_height = 8";
    on_every_backend(|on| {
        for &place in sample(
            on,
            &[
                [0.0, 0.0, 0.0],
                [1.0, -1.5, 6.0],
                [-2.0, 1.0, -300.0],
                [0.5, -1.0, 3.0],
            ],
        ) {
            let expected = eye.pixel_of(place.into());
            let in_picture = (0.0..64.0).contains(&expected.x) && (0.0..64.0).contains(&expected.y);
            let light = light_of(on, picture, &still(place, "size = 0.5"));
            println!("{place:?}: {expected}");
            if in_picture {
                let (total, center, ..) = moments(&light);
                assert!(
                    (center - expected).length() < 0.05,
                    "{center}, expected {expected}"
                );
                // Half a unit is 4 pixels.
                assert_within("coverage", total / 64.0, PI * 16.0, 0.01);
            } else {
                assert!(light.is_dark());
            }
        }
        // Behind the eye is behind it, and height of view is what scales.
        assert!(light_of(on, picture, &still([4.0, 6.0, 20.0], "size = 0.5")).is_dark());
        let twice = picture.replace("view_height = 8", "view_height = 16");
        let light = light_of(on, &twice, &still([0.5, 0.0, 0.0], "size = 0.5"));
        assert_within(
            "coverage at half the scale",
            light.total(0) / 64.0,
            PI * 4.0,
            0.01,
        );
    });
}

#[test]
fn r61_keys_of_the_camera_reach_the_frames_between_them() {
    let picture = keyed("camera.position", [0.0, 0.0, 32.0], [8.0, 0.0, 32.0])
        .replace("[1,", "[8,")
        + &keyed("camera.target", [0.0, 0.0, 0.0], [8.0, 0.0, 0.0]).replace("[1,", "[8,");
    let plan = Plan::new(&scene(&picture, &[""]), 12).expect("the scene can be planned");
    for frame in 0..12u32 {
        let moved = frame.min(8) as f32;
        let inputs = plan.inputs(frame).frame;
        assert_eq!(inputs.view_from_world_x, [1.0, 0.0, 0.0, -moved]);
        let closing = (frame as f32 + 0.5).min(8.0);
        assert_eq!(inputs.closing_view_from_world_x, [1.0, 0.0, 0.0, -closing]);
    }
}
