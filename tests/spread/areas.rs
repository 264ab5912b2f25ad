//! Burnt areas and shapes that are known exactly.

use crate::support::*;
use motes::scene::Scene;

/// A plane 5 wide that the wind blows along to +x; a frame is 0.01 units of time.
fn windy(spread: &str, points: u32) -> Scene {
    let spread = format!(
        "mesh = \"plane\"\nscale = 2.5\ntime_scale = 0.01\nignition_heat = 1\ndouble_burning = \"ignored\"\n{spread}"
    );
    let ignition = format!("position = [0, 0, 0]\npoints = {points}");
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [0.7, 0, 0]\n";
    scene("buoyancy = 0", &spread, &[&ignition], wind)
}

#[test]
fn pa3_points_that_keep_their_headings_burn_a_limacon() {
    let lone = points_at(&windy("separation = 100", 256), 1000);
    assert_eq!(lone.len(), 256);
    assert_close(flat_area(&lone) / 100.0, 0.062_120_1, 0.005 * 0.062_120_1);
    for point in &lone {
        let [x, y, _] = place(point.position);
        let (r, [hx, ..]) = ((x * x + y * y).sqrt(), place(point.heading));
        assert_close(r, 10.0 * (0.09 + 0.13 * hx.max(0.0)), 2e-4);
    }
    // From 16 points, the rest inserted.
    let grown = points_at(&windy("separation = 0.03", 16), 1000);
    assert!(grown.len() > 256, "{}", grown.len());
    assert_close(flat_area(&grown) / 100.0, 0.062_120_1, 0.005 * 0.062_120_1);
}

#[test]
fn pa3_points_that_head_along_the_normal_burn_a_stadium() {
    let spread = "heading = \"normal\"\nseparation = 100";
    let lone = points_at(&windy(spread, 256), 1000);
    assert_close(flat_area(&lone) / 100.0, 0.048_846_9, 0.005 * 0.048_846_9);
    let grown = points_at(&windy("heading = \"normal\"\nseparation = 0.03", 16), 1000);
    assert!(grown.len() > 256, "{}", grown.len());
    assert_close(flat_area(&grown) / 100.0, 0.048_846_9, 0.005 * 0.048_846_9);
}

#[test]
fn p62_on_a_flat_face_without_wind_a_fire_is_a_circle() {
    let spread = "mesh = \"plane\"\nscale = 2\ntime_scale = 0.01\nseparation = 100";
    let still = scene(
        "buoyancy = 0",
        spread,
        &["position = [0.1, -0.1, 0]\npoints = 33"],
        "",
    );
    for point in points_at(&still, 1000) {
        let away = minus(place(point.position), [0.1, -0.1, 0.0]);
        assert_close(length(away), 1.8, 1.8e-4);
        assert_close(point.travelled.into(), 1.8, 1.8e-4);
    }
}

#[test]
fn p63_inserted_points_are_on_the_circle() {
    for (insertion, is_arc) in [("arc", true), ("midpoint", false)] {
        let spread = format!(
            "mesh = \"plane\"\nscale = 2\ntime_scale = 0.01\nseparation = 0.1\ninsertion = \"{insertion}\""
        );
        let still = scene(
            "buoyancy = 0",
            &spread,
            &["position = [0, 0, 0]\npoints = 8"],
            "",
        );
        let mut run = run(&still);
        for frame in 0..=1000 {
            run.seek(frame).expect("it runs");
            if frame % 50 != 0 || frame == 0 {
                continue;
            }
            let points = run.control_points().expect("they are read");
            let radius = 0.0018 * f64::from(frame);
            // Each insertion is off by less than d_s^2 / 8 r at the radius where it is.
            let most = if is_arc {
                1e-4 * radius
            } else {
                0.1 * 0.1 / (8.0 * 0.1)
            };
            for point in &points {
                assert_close(length(place(point.position)), radius, most);
            }
            let next = points.iter().cycle().skip(1);
            for (a, b) in points.iter().zip(next) {
                let apart = length(minus(place(a.position), place(b.position)));
                assert!(apart <= 0.1 + 0.0036, "{apart} at frame {frame}");
            }
        }
        let points = run.control_points().expect("they are read");
        assert!(
            points.len() > 2 * 31 && points.len() < 8 * 32,
            "{}",
            points.len()
        );
    }
}

#[test]
fn p93_circles_on_a_sphere_have_the_area_that_curved_ones_have() {
    let spread = "mesh = \"sphere\"\ncurvature = \"ignored\"\nignition_heat = 1\ntime_scale = 0.05\n\
                  separation = 0.05";
    let still = scene(
        "buoyancy = 0",
        spread,
        &["position = [0.1, 0.2, 1]\npoints = 32"],
        "",
    );
    let rho: f64 = 0.05 * 0.09 * 250.0;
    let points = points_at(&still, 250);
    // The cap's rim is at one distance from its middle: cos(rho) of the radius along the axis.
    let middle = [0.1, 0.2, 1.0f64];
    let axis = middle.map(|x| x / length(middle));
    let mean = points
        .iter()
        .map(|point| dot(place(point.position), axis))
        .sum::<f64>()
        / points.len() as f64;
    let area = 2.0 * std::f64::consts::PI * (1.0 - mean);
    let wanted = 2.0 * std::f64::consts::PI * (1.0 - rho.cos());
    assert_close(area / wanted, 1.0, 0.005);
}
