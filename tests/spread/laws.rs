//! Other laws of speed, and grain (Perry 1994, 3.3.3 and 4.4).

use motes::simulation::PointState;

use crate::support::*;

/// A plane that faces +z, on which edges do not count.
fn on_plane(fire: &str, spread: &str) -> motes::scene::Scene {
    let spread = format!(
        "mesh = \"plane\"\nscale = 4\ncurvature = \"ignored\"\nignition_heat = 1\nseparation = 100\n{spread}"
    );
    scene(fire, &spread, &["position = [-1, 1, 0]\npoints = 128"], "")
}

#[test]
fn p71_a_spill_moves_only_downhill() {
    // Gravity leans by 30 degrees against the plane: along it, half of it is left, and the front is a
    // circle through where it began, straight below that.
    let (sine, rate) = (0.5, 0.13 * 0.04);
    let fire = "gravity = [0, -0.5, -0.8660254]";
    let scene = on_plane(fire, "law = \"spill\"\ntime_scale = 0.04");
    let points = points_at(&scene, 200);
    let far = 200.0 * rate * sine;
    for point in &points {
        let [x, y, _] = minus(place(point.position), [-1.0, 1.0, 0.0]);
        assert!(y < 1e-6, "uphill by {y}");
        assert_close(
            (x * x + (y + 0.5 * far) * (y + 0.5 * far)).sqrt(),
            0.5 * far,
            1e-3 * far,
        );
    }
    let area = std::f64::consts::PI * 0.25 * far * far;
    assert_close(flat_area(&points) / area, 1.0, 0.01);
    // Where it is level, nothing runs.
    let level = on_plane("gravity = [0, 0, -1]", "law = \"spill\"\ntime_scale = 0.04");
    assert!(
        points_at(&level, 60)
            .iter()
            .all(|point| point.travelled == 0.0)
    );
}

#[test]
fn p94_a_stain_grows_with_the_root_of_the_time() {
    let scene = on_plane("", "law = \"stain\"\ntime_scale = 0.5");
    for frame in [1u32, 4, 100, 250] {
        let far = 0.09 * 0.5 * f64::from(frame).sqrt();
        for point in points_at(&scene, frame) {
            let away = length(minus(place(point.position), [-1.0, 1.0, 0.0]));
            assert_close(away, far, 1e-3 * far);
        }
    }
}

#[test]
fn p92_stripes_hold_a_fire_up_as_long_as_they_are_wide() {
    // 0.25 wide each, every other one as slow as the strength says.
    for (strength, slow) in [(0.5, 0.5), (0.75, 0.25), (0.0, 1.0)] {
        let grain = format!(
            "grain = {{ pattern = \"stripes\", direction = [2, 0, 0], scale = 2, strength = {strength} }}"
        );
        let scene = on_plane("buoyancy = 0", &format!("time_scale = 0.02\n{grain}"));
        let speed = 0.09 * 0.02;
        let mut run = run(&scene);
        let mut arrivals = Vec::new();
        for frame in 0..1200 {
            run.seek(frame).expect("it runs");
            // The point that heads along +x began at x = -1, where a fast stripe begins.
            let points = run.control_points().expect("they are read");
            let heads = |point: &&PointState| point.heading[0] > 0.9999;
            let point = points.iter().find(heads).expect("a point goes there");
            let x = f64::from(point.position[0]) + 1.0;
            if x >= 0.25 * (arrivals.len() + 1) as f64 {
                arrivals.push(f64::from(frame));
            }
        }
        let fast = 0.25 / speed;
        let mut wanted = 0.0;
        assert!(arrivals.len() >= 3, "{arrivals:?}");
        for (nth, arrival) in arrivals.iter().enumerate() {
            wanted += if nth % 2 == 0 { fast } else { fast / slow };
            assert_close(*arrival, wanted, 0.01 * wanted + 2.0);
        }
    }
}

#[test]
fn p92_rings_of_wood_hold_a_fire_up_across_but_not_along() {
    // Around the y axis, four in a unit: the mean slowness of 1 - s |2 u - 1| over a period is
    // -ln(1 - s)/s. Along the middle of a ring there is none.
    let grain = "grain = { pattern = \"rings\", direction = [0, 1, 0], scale = 4, strength = 0.6 }";
    let spread = format!(
        "mesh = \"plane\"\nscale = 4\ncurvature = \"ignored\"\nignition_heat = 1\nseparation = 10\ntime_scale = 0.02\n{grain}"
    );
    let scene = scene(
        "buoyancy = 0",
        &spread,
        &["position = [1.125, 0, 0]\npoints = 8"],
        "",
    );
    let speed = 0.09 * 0.02;
    let points = points_at(&scene, 600);
    let towards = |x: f64, y: f64| {
        let heads = |point: &&PointState| dot(place(point.heading), [x, y, 0.0]) > 0.999;
        let point = points.iter().find(heads).expect("a point goes there");
        f64::from(point.travelled) / (600.0 * speed)
    };
    assert_close(towards(0.0, 1.0), 1.0, 1e-4);
    let across = 0.6 / -(0.4f64).ln();
    assert_close(towards(1.0, 0.0), across, 0.03);
}

#[test]
fn p92_noise_shifts_the_grain_and_nothing_else() {
    let travelled = |shift: f64| {
        let grain = format!(
            "grain = {{ scale = 3, strength = 0.9, shift = {shift}, noise_scale = 2, direction = [0, 1, 0] }}"
        );
        let scene = on_plane("buoyancy = 0", &format!("time_scale = 0.05\n{grain}"));
        points_at(&scene, 120)
    };
    let (still, shifted) = (travelled(0.0), travelled(0.8));
    assert_ne!(still, shifted);
    let most = 120.0 * 0.09 * 0.05;
    for point in still.iter().chain(&shifted) {
        let share = f64::from(point.travelled) / most;
        assert!((0.1..=1.0 + 1e-5).contains(&share), "{share}");
    }
}
