//! Generation shapes beyond the text's three, and the axes that particles leave along: Reeves
//! (1983), section 2.2, and RA5.

use glam::DVec3;

use crate::common::statistics::{assert_distributed, assert_uniform, mean};
use crate::support::{Run, on_every_backend, scene};

/// A particle's place of birth and first velocity in its system's space.
struct Birth {
    place: DVec3,
    velocity: DVec3,
}

fn vector(words: [f32; 3]) -> DVec3 {
    DVec3::from_array(words.map(f64::from))
}

fn born(on: &str, lines: &str, count: u32) -> Vec<Birth> {
    let lines = format!("initial_mean_parts = {count}\n lifetime = 1\n{lines}");
    let small = "image.width = 8\n image.height = 8";
    let mut run = Run::new(on, &scene(small, &[&lines]), 1);
    run.step_to(0);
    let birth = |member: crate::support::Member| {
        let velocity = vector(member.raw.velocity());
        Birth {
            place: vector(member.raw.position()) - velocity,
            velocity,
        }
    };
    let births: Vec<Birth> = run.members().into_iter().map(birth).collect();
    assert_eq!(births.len(), count as usize);
    births
}

/// 100,000 births on the processor; that the other backends give the same is a test of its own.
fn samples(lines: &str) -> Vec<Birth> {
    born("cpu", lines, 100_000)
}

fn each(births: &[Birth], value: impl Fn(&Birth) -> f64) -> Vec<f64> {
    births.iter().map(value).collect()
}

/// Turns around z, 0 .. 1.
fn turns(v: DVec3) -> f64 {
    (v.y.atan2(v.x) / std::f64::consts::TAU).rem_euclid(1.0)
}

fn assert_even_turns(births: &[Birth]) {
    assert_uniform("turns", &each(births, |birth| turns(birth.place)), 0.0, 1.0);
}

#[test]
fn r13_a_ring_is_filled_evenly() {
    for inner in [0.0, 2.0, 2.9] {
        let births = samples(&format!(
            "generation_shape = {{ kind = \"ring\", inner_radius = {inner:?}, outer_radius = 3 }}"
        ));
        let radii = each(&births, |birth| birth.place.length());
        let slack = 1e-6;
        let is_in = |radius: &f64| (inner - slack..=3.0 + slack).contains(radius);
        assert!(radii.iter().all(is_in) && births.iter().all(|birth| birth.place.z == 0.0));
        assert_distributed(&format!("radius from {inner}"), &radii, |rho| {
            ((rho * rho - inner * inner) / (9.0 - inner * inner)).clamp(0.0, 1.0)
        });
        assert_even_turns(&births);
        // Not spiral: turns do not depend on the radius.
        let middle = (0.5 * (9.0 + inner * inner)).sqrt();
        let (near, far): (Vec<Birth>, Vec<Birth>) = births
            .into_iter()
            .partition(|birth| birth.place.length() < middle);
        assert_even_turns(&near);
        assert_even_turns(&far);
    }
    // A circle is a ring without a hole, and without width it is a line.
    let thin = "generation_shape = { kind = \"ring\", inner_radius = 3, outer_radius = 3 }";
    let births = samples(thin);
    assert!(
        births
            .iter()
            .all(|birth| (birth.place.length() - 3.0).abs() < 1e-6)
    );
    assert_even_turns(&births);
}

#[test]
fn r13_a_box_is_filled_evenly() {
    let births =
        samples("generation_shape = { kind = \"box\", length = 5, width = 2, height = 0.5 }");
    for (axis, half) in [(0, 2.5), (1, 1.0), (2, 0.25)] {
        let along = each(&births, |birth| birth.place[axis]);
        assert!(along.iter().all(|at| at.abs() <= half));
        assert_uniform(&format!("axis {axis}"), &along, -half, half);
    }
    // Axes do not depend on each other: every octant of an octant is as full.
    let mut cells = [0u32; 64];
    for birth in &births {
        let cell = |axis: usize, half: f64| {
            let quarter = (birth.place[axis] / half + 1.0) * 2.0;
            (quarter as usize).min(3)
        };
        cells[cell(0, 2.5) * 16 + cell(1, 1.0) * 4 + cell(2, 0.25)] += 1;
    }
    let expected = 1e5 / 64.0;
    let chi_square: f64 = cells
        .iter()
        .map(|&count| (f64::from(count) - expected).powi(2) / expected)
        .sum();
    // 63 degrees of freedom: 1 % of draws are above.
    assert!(chi_square < 92.0, "chi-square {chi_square}");
}

#[test]
fn r13_a_cone_is_filled_evenly() {
    for degrees in [20.0f64, 60.0] {
        let births = samples(&format!(
            "generation_shape = {{ kind = \"cone\", height = 4, angle_degrees = {degrees:?} }}"
        ));
        let slope = degrees.to_radians().tan();
        let heights = each(&births, |birth| birth.place.z);
        assert!(
            heights
                .iter()
                .all(|height| (0.0..=4.0 + 1e-6).contains(height))
        );
        assert_distributed("height", &heights, |z| (z / 4.0).clamp(0.0, 1.0).powi(3));
        let shares = each(&births, |birth| {
            birth.place.truncate().length() / (slope * birth.place.z)
        });
        assert!(shares.iter().all(|&share| share <= 1.0 + 1e-5));
        assert_distributed("distance from the axis", &shares, |s| {
            s.clamp(0.0, 1.0).powi(2)
        });
        assert_even_turns(&births);
        // Born so, they leave straight away from the apex.
        let leaving = samples(&format!(
            "generation_shape = {{ kind = \"cone\", height = 4, angle_degrees = {degrees:?} }}
            speed = 0.5"
        ));
        let outward = |birth: &Birth| {
            birth.place.length() < 0.2
                || birth.place.normalize().dot(birth.velocity.normalize()) >= 1.0 - 1e-6
        };
        assert!(leaving.iter().all(outward));
    }
}

#[test]
fn r13_a_line_is_filled_evenly() {
    let births = samples("generation_shape = { kind = \"line\", length = 7 }");
    assert!(
        births
            .iter()
            .all(|birth| birth.place.y == 0.0 && birth.place.z == 0.0)
    );
    let along = each(&births, |birth| birth.place.x);
    assert!(along.iter().all(|at| at.abs() <= 3.5));
    assert_uniform("along", &along, -3.5, 3.5);
}

/// The axis of a birth in f64: up, away from the origin, or around z.
fn axis_of(axis: &str, birth: &Birth) -> DVec3 {
    match axis {
        "up" => DVec3::Z,
        "outward" => birth.place.normalize(),
        _ => DVec3::Z.cross(birth.place).normalize(),
    }
}

#[test]
fn r18_every_axis_has_its_cone() {
    // Far from where there is no outward or around.
    let shape = "generation_shape = { kind = \"ring\", inner_radius = 3, outer_radius = 9 }
        position = [1, 2, 3]\n rotation_degrees = [30, 200]";
    let alpha = 30f64.to_radians();
    for axis in ["up", "outward", "around"] {
        for spread in ["solid_angle", "angle"] {
            let births = samples(&format!(
                "{shape}\n ejection_axis = \"{axis}\"\n ejection_angle_degrees = 30
                ejection_spread = \"{spread}\"\n speed = 0.25"
            ));
            let what = format!("{axis}, {spread}");
            let cosines = each(&births, |birth| {
                axis_of(axis, birth).dot(birth.velocity.normalize())
            });
            let angles: Vec<f64> = births
                .iter()
                .map(|birth| axis_of(axis, birth).angle_between(birth.velocity))
                .collect();
            assert!(angles.iter().all(|&angle| angle <= alpha + 1e-4), "{what}");
            if spread == "angle" {
                assert_uniform(&what, &angles, 0.0, alpha);
                // The mean of cos over angles: sin(alpha) / alpha.
                let center = mean(&cosines);
                assert!((center - 0.954_93).abs() <= 0.0005, "{what}: {center}");
            } else {
                assert_uniform(&what, &cosines, alpha.cos(), 1.0);
                let center = mean(&cosines);
                assert!((center - 0.933_01).abs() <= 0.0005, "{what}: {center}");
            }
            // As many on each side of the axis: the direction about it is uniform.
            let about = each(&births, |birth| {
                let axis = axis_of(axis, birth);
                let (side, other) = axis.any_orthonormal_pair();
                let v = birth.velocity;
                (v.dot(other).atan2(v.dot(side)) / std::f64::consts::TAU).rem_euclid(1.0)
            });
            assert_uniform(&format!("{what}: about the axis"), &about, 0.0, 1.0);
        }
    }
}

#[test]
fn r18_any_shape_takes_any_axis() {
    let shapes = [
        "{ kind = \"sphere\", radius = 4 }",
        "{ kind = \"circle\", radius = 4 }",
        "{ kind = \"rectangle\", length = 4, width = 3 }",
        "{ kind = \"ring\", inner_radius = 2, outer_radius = 4 }",
        "{ kind = \"box\", length = 4, width = 3, height = 2 }",
        "{ kind = \"cone\", height = 4, angle_degrees = 30 }",
        "{ kind = \"line\", length = 9 }",
    ];
    let axes = ["up", "outward", "around"];
    // A system each, straight along its axis; then in cones of either kind.
    let mut systems = Vec::new();
    for cone in ["0", "40", "40\n ejection_spread = \"angle\""] {
        for (shape, axis) in shapes
            .iter()
            .flat_map(|shape| axes.map(|axis| (shape, axis)))
        {
            systems.push(format!(
                "name = \"s{}\"\n initial_mean_parts = 500\n generation_shape = {shape}
                ejection_axis = \"{axis}\"\n speed = 0.25\n ejection_angle_degrees = {cone}",
                systems.len()
            ));
        }
    }
    let systems: Vec<&str> = systems.iter().map(String::as_str).collect();
    let scene = scene("image.width = 8\n image.height = 8", &systems);
    let members = |on: &str| {
        let mut run = Run::new(on, &scene, 1);
        run.step_to(0);
        run.members()
    };
    let expected: Vec<_> = members("cpu").iter().map(|member| member.raw).collect();
    assert_eq!(expected.len(), 500 * systems.len());
    for (at, raw) in expected.iter().enumerate() {
        let velocity = vector(raw.velocity());
        let place = vector(raw.position()) - velocity;
        let birth = Birth { place, velocity };
        let system = at / 500;
        let speed = velocity.length();
        assert!((speed - 0.25).abs() < 1e-6, "{}: {speed}", systems[system]);
        // Near the axis there is hardly an around, and no outward in the origin.
        if place.truncate().length() > 0.05 {
            let angle = axis_of(axes[system % 3], &birth).angle_between(velocity);
            let most = if system < 21 {
                0.002
            } else {
                40f64.to_radians() + 1e-4
            };
            assert!(angle < most, "{}: {angle}", systems[system]);
        }
    }
    on_every_backend(|on| {
        let raw: Vec<_> = members(on).iter().map(|member| member.raw).collect();
        assert!(raw == expected, "{on}");
    });
}

#[test]
fn r17_a_particle_without_an_outward_leaves_all_the_same() {
    // Born in the origin itself, or on the axis: any direction will do, but with its speed.
    let points = [
        ("{ kind = \"sphere\", radius = 0 }", "outward"),
        ("{ kind = \"circle\", radius = 0 }", "outward"),
        ("{ kind = \"circle\", radius = 0 }", "around"),
        ("{ kind = \"sphere\", radius = 0 }", "around"),
        ("{ kind = \"line\", length = 0 }", "outward"),
        (
            "{ kind = \"cone\", height = 2, angle_degrees = 0 }",
            "around",
        ),
    ];
    let mut wrong = Vec::new();
    for (shape, axis) in points {
        let lines =
            format!("generation_shape = {shape}\n ejection_axis = \"{axis}\"\n speed = 0.25");
        let births = born("cpu", &lines, 100);
        let slow = births
            .iter()
            .filter(|birth| (birth.velocity.length() - 0.25).abs() > 1e-6)
            .count();
        if slow > 0 {
            wrong.push(format!(
                "{shape}, {axis}: {slow} of 100 without their speed"
            ));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
