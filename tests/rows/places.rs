//! Where particles are born and which way they leave: Reeves (1983), section 2.2.

use glam::DVec3;

use crate::common::statistics::{assert_distributed, assert_uniform, mean};
use crate::support::{Run, on_every_backend, scene};

const SAMPLES: &str = "initial_mean_parts = 100_000\n lifetime = 1";

/// A particle's place of birth and first velocity in its system's space.
struct Birth {
    place: DVec3,
    velocity: DVec3,
}

fn vector(words: [f32; 3]) -> DVec3 {
    DVec3::from_array(words.map(f64::from))
}

/// What frame 0 bears, unmoved.
fn born(on: &str, system: &str) -> Vec<Birth> {
    let mut run = Run::new(
        on,
        &scene("image.width = 8\n image.height = 8", &[system]),
        1,
    );
    run.step_to(0);
    let birth = |member: crate::support::Member| {
        let velocity = vector(member.raw.velocity());
        Birth {
            place: vector(member.raw.position()) - velocity,
            velocity,
        }
    };
    run.members().into_iter().map(birth).collect()
}

/// 100,000 of them, on the processor; the other backends give the same bits.
fn samples(lines: &str) -> Vec<Birth> {
    let births = born("cpu", &format!("{SAMPLES}\n{lines}"));
    assert_eq!(births.len(), 100_000);
    births
}

/// Turns around z, 0 .. 1.
fn turns(v: DVec3) -> f64 {
    (v.y.atan2(v.x) / std::f64::consts::TAU).rem_euclid(1.0)
}

fn each(births: &[Birth], value: impl Fn(&Birth) -> f64) -> Vec<f64> {
    births.iter().map(value).collect()
}

#[test]
fn r12_two_angles_turn_up_where_they_should() {
    let mut systems = Vec::new();
    let mut expected = Vec::new();
    for a in (-360..=360).step_by(45).chain([-90, 7, 100, 33]) {
        for b in (-360..=360).step_by(60).chain([-11, 90, 271]) {
            systems.push(format!(
                "name = \"s{}\"\n rotation_degrees = [{a}, {b}]\n speed = 1\n end_frame = 1
                generation_shape = {{ kind = \"circle\", radius = 0 }}",
                systems.len()
            ));
            // About x by a, then about y by b.
            let ((sa, ca), (sb, cb)) = (
                f64::from(a).to_radians().sin_cos(),
                f64::from(b).to_radians().sin_cos(),
            );
            expected.push(DVec3::new(ca * sb, -sa, ca * cb));
        }
    }
    let systems: Vec<&str> = systems.iter().map(String::as_str).collect();
    let scene = scene("", &systems);
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene, 1);
        run.step_to(0);
        let members = run.members();
        assert_eq!(members.len(), expected.len());
        for member in members {
            let expected = expected[member.state.system as usize];
            let off = (vector(member.state.velocity) - expected).length();
            assert!(
                off <= 1e-6,
                "{member:?}, expected {expected}, off by {off:e}"
            );
            let off = (vector(member.state.position) - expected).length();
            assert!(
                off <= 1e-6,
                "{member:?}, expected {expected}, off by {off:e}"
            );
        }
    });
}

#[test]
fn r12_the_origin_moves_places_and_not_velocities() {
    let at = |position: &str| {
        let lines = format!(
            "position = {position}\n rotation_degrees = [30, 40]\n speed = {{ mean = 0.5, var = 0.5 }}
            generation_shape = {{ kind = \"sphere\", radius = 2 }}\n initial_mean_parts = 100"
        );
        let mut run = Run::new("cpu", &scene("", &[&lines]), 1);
        run.step_to(0);
        run.members()
    };
    let (near, far) = (at("[0, 0, 0]"), at("[1000, -2000, 500]"));
    for (near, far) in near.iter().zip(&far) {
        assert_eq!(near.raw, far.raw, "a state is in its system's space");
        let moved = vector(far.state.position) - vector(near.state.position);
        assert!(
            (moved - DVec3::new(1000.0, -2000.0, 500.0)).length() < 5e-4,
            "{moved}"
        );
        let off = vector(far.state.velocity) - vector(near.state.velocity);
        assert!(off.length() < 1e-6, "the velocity has changed by {off}");
    }
}

#[test]
fn r13_a_sphere_is_filled_evenly() {
    let births = samples("generation_shape = { kind = \"sphere\", radius = 3 }\n speed = 0");
    assert!(births.iter().all(|birth| birth.place.length() <= 3.0));
    let radii = each(&births, |birth| birth.place.length());
    assert_distributed("radius", &radii, |rho| (rho / 3.0).clamp(0.0, 1.0).powi(3));
    let heights = each(&births, |birth| birth.place.z / birth.place.length());
    assert_uniform("height on the sphere", &heights, -1.0, 1.0);
    assert_uniform(
        "turns",
        &each(&births, |birth| turns(birth.place)),
        0.0,
        1.0,
    );
}

#[test]
fn r14_a_circle_is_filled_evenly() {
    let births = samples("generation_shape = { kind = \"circle\", radius = 3 }\n speed = 0");
    assert!(
        births
            .iter()
            .all(|birth| birth.place.z == 0.0 && birth.place.length() <= 3.0)
    );
    let radii = each(&births, |birth| birth.place.length());
    assert_distributed("radius", &radii, |rho| (rho / 3.0).clamp(0.0, 1.0).powi(2));
    assert_uniform(
        "turns",
        &each(&births, |birth| turns(birth.place)),
        0.0,
        1.0,
    );
}

#[test]
fn r15_a_rectangle_is_filled_evenly() {
    let births =
        samples("generation_shape = { kind = \"rectangle\", length = 5, width = 2 }\n speed = 0");
    let inside = |place: DVec3| place.z == 0.0 && place.x.abs() <= 2.5 && place.y.abs() <= 1.0;
    assert!(births.iter().all(|birth| inside(birth.place)));
    assert_uniform(
        "along the length",
        &each(&births, |birth| birth.place.x),
        -2.5,
        2.5,
    );
    assert_uniform(
        "along the width",
        &each(&births, |birth| birth.place.y),
        -1.0,
        1.0,
    );
}

#[test]
fn r17_a_sphere_ejects_outward() {
    for speed in ["{ mean = 0.5, var = 0.4 }", "{ mean = -0.5, var = 0.4 }"] {
        let sign = if speed.contains('-') { -1.0 } else { 1.0 };
        let lines =
            format!("generation_shape = {{ kind = \"sphere\", radius = 4 }}\n speed = {speed}");
        let outward = |birth: &Birth| {
            // A place within a few roundings of the centre has no direction to compare with.
            birth.place.length() < 0.05
                || sign * birth.place.normalize().dot(birth.velocity.normalize()) >= 1.0 - 1e-6
        };
        assert!(samples(&lines).iter().all(outward), "{speed}");
    }
    on_every_backend(|on| {
        // Born in the centre itself: any direction, of length 1.
        let births = born(on, "initial_mean_parts = 2000\n speed = 2");
        assert!(births.iter().all(|birth| birth.place.length() == 0.0));
        assert!(
            births
                .iter()
                .all(|birth| (birth.velocity.length() - 2.0).abs() <= 2e-6)
        );
        let heights = each(&births, |birth| birth.velocity.z / 2.0);
        assert_uniform("height of the direction", &heights, -1.0, 1.0);
        let around = each(&births, |birth| turns(birth.velocity));
        assert_uniform("turns of the direction", &around, 0.0, 1.0);
    });
}

#[test]
fn r18_circles_and_rectangles_eject_within_a_cone() {
    let shapes = [
        "{ kind = \"circle\", radius = 2 }",
        "{ kind = \"rectangle\", length = 3, width = 1 }",
    ];
    for shape in shapes {
        for degrees in [0.0f64, 30.0, 90.0, 180.0] {
            let births = samples(&format!(
                "generation_shape = {shape}\n ejection_angle_degrees = {degrees}\n speed = 1"
            ));
            let angle = |v: DVec3| v.truncate().length().atan2(v.z);
            let most = births
                .iter()
                .map(|birth| angle(birth.velocity))
                .fold(0.0, f64::max);
            let cone = degrees.to_radians();
            assert!(
                most <= cone + 1e-4,
                "{shape}: {most} rad at {degrees} degrees"
            );
            if degrees == 0.0 {
                continue;
            }
            // RA5: uniform in solid angle, so the cosine is uniform.
            let cosines = each(&births, |birth| birth.velocity.z / birth.velocity.length());
            assert_uniform(&format!("cosine at {degrees}"), &cosines, cone.cos(), 1.0);
            if degrees == 30.0 {
                let center = mean(&cosines);
                assert!((center - 0.93301).abs() <= 0.0005, "{shape}: {center}");
            }
            assert_uniform(
                "turns",
                &each(&births, |birth| turns(birth.velocity)),
                0.0,
                1.0,
            );
            // Not tied to the place: left and right of the middle leave alike.
            let (left, right): (Vec<&Birth>, Vec<&Birth>) =
                births.iter().partition(|birth| birth.place.x < 0.0);
            let sideways = |births: &[&Birth]| {
                births.iter().map(|birth| birth.velocity.x).sum::<f64>() / births.len() as f64
            };
            assert!((sideways(&left) - sideways(&right)).abs() < 0.015);
        }
    }
}

#[test]
fn r19_speed_is_uniform_about_its_mean() {
    let shapes = [
        "{ kind = \"circle\", radius = 0 }",
        "{ kind = \"sphere\", radius = 0 }",
    ];
    for shape in shapes {
        let births = samples(&format!(
            "generation_shape = {shape}\n ejection_angle_degrees = 180
            speed = {{ mean = 0.5, var = 0.3 }}"
        ));
        let speeds = each(&births, |birth| birth.velocity.length());
        assert!(
            speeds
                .iter()
                .all(|speed| (0.2 - 1e-6..=0.8 + 1e-6).contains(speed))
        );
        assert_uniform("speed", &speeds, 0.2, 0.8);
    }
}
