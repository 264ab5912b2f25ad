//! The large-scale wind against closed forms, and what small scales do to it: Perry (1994), 3.2.3.

use glam::{DVec3, Vec3};

use crate::flow::{Winds, field, place};

/// Fails unless the winds are `expected` anywhere, to 1e-5 of it.
fn assert_form(parts: &[&str], expected: impl Fn(DVec3) -> DVec3) {
    let winds = Winds::new(parts);
    let flow = field(&winds, 3);
    for at in 0..20_000 {
        // From the core outward.
        let place = place(at, [0.5, 4.0, 300.0][at as usize % 3]);
        let (got, expected) = (flow(place), expected(place.as_dvec3()));
        let off = (got - expected).length() / expected.length().max(1e-12);
        assert!(
            off < 1e-5,
            "{parts:?} at {place}: {got}, expected {expected}"
        );
    }
}

#[test]
fn p34_heat_rises_against_gravity_by_k_g() {
    for (gravity, k_g) in [
        ([0.0, -1.0, 0.0], 1.0),
        ([0.0, -1.0, 0.0], 0.25),
        ([0.5, -2.0, 0.25], 0.5),
    ] {
        let part = format!("{{ kind = \"buoyancy\", gravity = {gravity:?}, strength = {k_g} }}");
        let winds = Winds::new(&[&part]);
        for at in 0..100 {
            let flow = winds.flow(at, place(at, 50.0)).as_dvec3();
            assert_eq!(flow, -k_g * DVec3::from(gravity));
        }
    }
    let default = Winds::new(&["{ kind = \"buoyancy\", strength = 1 }"]);
    assert_eq!(default.flow(0, Vec3::ONE), Vec3::Y);
}

#[test]
fn p34_every_large_scale_wind_has_its_closed_form() {
    assert_form(
        &["{ kind = \"uniform\", velocity = [0.3, -0.2, 0.1] }"],
        |_| DVec3::from([0.3f32, -0.2, 0.1].map(f64::from)),
    );
    let center = DVec3::new(0.5, -1.0, 0.25);
    for (speed, radius) in [(0.25, 1.5), (-2.0, 0.125)] {
        let part = |kind: &str, what: &str| {
            format!(
                "{{ kind = \"{kind}\", position = [0.5, -1, 0.25], {what} = {speed}, \
                 radius = {radius} }}"
            )
        };
        // Scully's: 2 (r/R) / (1 + (r/R)^2) of the greatest speed, around the axis.
        let axis = DVec3::new(1.0, 2.0, -2.0);
        let vortex = part("vortex", "axis = [1, 2, -2], speed");
        assert_form(&[&vortex], |p| {
            let around = (axis / 3.0).cross(p - center);
            let r = around.length() / radius;
            around.normalize_or_zero() * speed * 2.0 * r / (1.0 + r * r)
        });
        let out = |p: DVec3| {
            let d = p - center;
            d * speed / (d.length_squared() + radius * radius).powf(1.5)
        };
        assert_form(&[&part("source", "strength")], out);
        assert_form(&[&part("sink", "strength")], |p| -out(p));
        assert_form(&[&part("attractor", "speed")], |p| {
            let d = p - center;
            -d * speed / (d.length_squared() + radius * radius).sqrt()
        });
    }
}

#[test]
fn p34_a_vortex_is_fastest_at_its_radius() {
    let winds =
        Winds::new(&["{ kind = \"vortex\", position = [0, 0, 0], speed = 0.5, radius = 2 }"]);
    let speed = |r: f32| winds.flow(0, Vec3::new(r, 7.0, 0.0)).length();
    assert!((speed(2.0) - 0.5).abs() < 1e-6);
    assert!(speed(1.9) < speed(2.0) && speed(2.1) < speed(2.0));
    assert_eq!(winds.flow(0, Vec3::new(0.0, 3.0, 0.0)), Vec3::ZERO);
    // Right-handed about its axis.
    assert!(winds.flow(0, Vec3::new(2.0, 0.0, 0.0)).z < -0.49);
}

#[test]
fn p34_parts_add_up() {
    let parts = [
        "{ kind = \"uniform\", velocity = [0.5, 0, 0] }",
        "{ kind = \"buoyancy\", strength = 0.25 }",
        "{ kind = \"attractor\", position = [1, 2, 3], speed = 0.5 }",
        "{ kind = \"vortex\", position = [0, 0, 0], speed = 0.5 }",
    ];
    let all = Winds::new(&parts);
    let each = parts.map(|part| Winds::new(&[part]));
    for at in 0..1000 {
        let place = place(at, 5.0);
        let sum: Vec3 = each.iter().map(|one| one.flow(0, place)).sum();
        assert!((all.flow(0, place) - sum).length() < 1e-6);
    }
    assert_eq!(Winds::new(&[]).flow(0, Vec3::ONE), Vec3::ZERO);
}

#[test]
fn p34_gusts_stray_from_their_mean_slowly_and_so_far() {
    const FRAMES: u32 = 40_000;
    let velocity = DVec3::new(0.5, 0.25, -1.0);
    for (amplitude, length) in [(0.5, 10.0), (1.5, 25.0)] {
        let winds = Winds::new(&[&format!(
            "{{ kind = \"gusts\", velocity = [0.5, 0.25, -1], amplitude = {amplitude}, \
             frames = {length} }}"
        )]);
        let factors: Vec<f64> = (0..FRAMES)
            .map(|frame| {
                let flow = winds.flow(frame, Vec3::ONE).as_dvec3();
                let factor = flow.dot(velocity) / velocity.length_squared();
                assert!(
                    (flow - factor * velocity).length() < 1e-6,
                    "another direction"
                );
                factor
            })
            .collect();
        let mean = factors.iter().sum::<f64>() / f64::from(FRAMES);
        let deviation = crate::common::statistics::standard_deviation(&factors);
        let fastest = factors
            .windows(2)
            .map(|w| (w[1] - w[0]).abs())
            .fold(0.0, f64::max);
        println!(
            "amplitude {amplitude}: mean {mean:.4}, deviation {deviation:.4}, {fastest:.4} a frame"
        );
        assert!((mean - 1.0).abs() < 0.05 * amplitude, "{mean}");
        assert!(
            factors
                .iter()
                .all(|factor| (factor - 1.0).abs() <= amplitude * 1.000_001)
        );
        assert!((0.3..0.7).contains(&(deviation / amplitude)), "{deviation}");
        assert!(fastest < 8.0 * amplitude / length, "{fastest}");
        // The same at all places.
        assert_eq!(
            winds.flow(9, Vec3::ONE),
            winds.flow(9, Vec3::new(-40.0, 3.0, 1e4))
        );
    }
}

const VORTEX: &str = "{ kind = \"vortex\", position = [0, 0, 0], speed = 0.4, radius = 2 }";

/// Around the axis, outward and upward: mean velocity on a circle, over places and times.
fn mean_velocity(winds: &Winds, radius: f64) -> DVec3 {
    const TIMES: u32 = 200;
    const PLACES: u32 = 200;
    let mut sum = DVec3::ZERO;
    for time in 0..TIMES {
        let flow = field(winds, 7 * time);
        for at in 0..PLACES {
            let turn = std::f64::consts::TAU * f64::from(at) / f64::from(PLACES);
            let outward = DVec3::new(turn.cos(), 0.0, turn.sin());
            let velocity = flow((outward * radius).as_vec3());
            sum += DVec3::new(
                velocity.dot(DVec3::Y.cross(outward)),
                velocity.dot(outward),
                velocity.y,
            );
        }
    }
    sum / f64::from(TIMES * PLACES)
}

#[test]
fn p36_a_vortex_is_tangential_and_its_mean_stays_so_in_turbulence() {
    let calm = Winds::new(&[VORTEX]);
    for at in 0..10_000 {
        let place = place(at, 10.0);
        let (d, v) = (
            place.as_dvec3() * DVec3::new(1.0, 0.0, 1.0),
            calm.flow(0, place).as_dvec3(),
        );
        assert!(
            v.dot(d).abs() <= 1e-6 * v.length() * d.length(),
            "radial at {place}"
        );
        assert_eq!(v.y, 0.0, "along the axis at {place}");
    }
    let noise = "{ kind = \"noise\", strength = 0.2, scale = [1, 1, 1], drift = [0, 0.3, 0] }";
    let perturbed = Winds::new(&[VORTEX, noise]);
    for radius in [1.0, 2.0, 5.0] {
        let r = radius / 2.0;
        let expected = 0.4 * 2.0 * r / (1.0 + r * r);
        let (calm, mean) = (
            mean_velocity(&calm, radius),
            mean_velocity(&perturbed, radius),
        );
        println!("radius {radius}: {calm:.5} and {mean:.5}, expected {expected:.5}");
        assert!((calm - DVec3::new(expected, 0.0, 0.0)).length() < 1e-5 * expected);
        assert!((mean - calm).length() < 0.1 * expected, "{mean}");
        // It is perturbed, though: one place at one time is off by more.
        let place = Vec3::new(radius as f32, 0.0, 0.0);
        let most = (0..50)
            .map(|time| perturbed.flow(7 * time, place) - Winds::new(&[VORTEX]).flow(0, place))
            .map(Vec3::length)
            .fold(0.0, f32::max);
        assert!(f64::from(most) > 0.3 * expected, "{most}");
    }
}
