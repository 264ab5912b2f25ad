//! Steps across edges, over corners and to borders.

use std::f64::consts::FRAC_1_SQRT_2;

use motes::scene::Scene;

use crate::support::*;

/// A cube of edge 2 that burns from `position`, as fast everywhere: 0.01 a frame.
fn cube(position: &str, points: u32, lines: &str) -> Scene {
    let spread = format!(
        "mesh = \"cube\"\ncurvature = \"ignored\"\nopposed_flux = 1\nconcurrent_flux = 0\n\
         ignition_heat = 1\ntime_scale = 0.01\n{lines}"
    );
    let ignition = format!("position = {position}\npoints = {points}");
    scene("", &spread, &[&ignition], "")
}

/// The place on the side x = 1 of the cube, in the plane of its top: folded up about their edge.
fn unfolded([_, y, z]: Place) -> [f64; 2] {
    [1.0 + (1.0 - z), y]
}

#[test]
fn p64_a_path_is_straight_over_an_edge_and_keeps_its_length() {
    let scene = cube("[0.7, 0.1, 1]", 64, "separation = 100");
    let begun = points_at(&scene, 0);
    for frame in [20, 45, 70] {
        let travelled = 0.01 * f64::from(frame);
        let mut beyond = 0;
        for (from, point) in begun.iter().zip(points_at(&scene, frame)) {
            let at = place(point.position);
            let [hx, hy, _] = place(from.heading);
            assert_close(point.travelled.into(), travelled, 1e-5);
            let wanted = [0.7 + hx * travelled, 0.1 + hy * travelled];
            let flat = if wanted[0] > 1.0 {
                beyond += 1;
                assert_close(at[0], 1.0, 1e-5);
                // The heading turns with the path.
                let heading = place(point.heading);
                assert_close(heading[2], -hx, 1e-5);
                assert_close(heading[1], hy, 1e-5);
                unfolded(at)
            } else {
                assert_close(at[2], 1.0, 1e-5);
                [at[0], at[1]]
            };
            assert_close(flat[0], wanted[0], 1e-5);
            assert_close(flat[1], wanted[1], 1e-5);
        }
        assert!(frame == 20 || beyond > 8, "{beyond} at frame {frame}");
    }
}

#[test]
fn p64_points_stay_on_the_surface() {
    for frame in [150, 300] {
        for point in points_at(&cube("[0.2, -0.3, 1]", 100, "separation = 100"), frame) {
            let at = place(point.position).map(f64::abs);
            let farthest = at.into_iter().fold(0.0, f64::max);
            assert_close(farthest, 1.0, 1e-5);
        }
    }
}

#[test]
fn pa12_over_a_corner_a_path_leaves_as_much_to_either_side() {
    // From the middle of the top along the diagonals: each corner has three right angles around it, so
    // the path goes down the edge between the two sides.
    let scene = cube("[0, 0, 1]", 8, "separation = 100");
    let travelled = 1.0 / FRAC_1_SQRT_2 + 0.5;
    let points = points_at(&scene, (travelled / 0.01).round() as u32);
    let down = points.iter().map(|point| place(point.position));
    let at_edges =
        down.filter(|[x, y, _]| (x.abs() - 1.0).abs() < 1e-3 && (y.abs() - 1.0).abs() < 1e-3);
    let at_edges: Vec<Place> = at_edges.collect();
    assert_eq!(at_edges.len(), 4, "{points:?}");
    for [.., z] in at_edges {
        let whole = 0.01 * (travelled / 0.01).round();
        assert_close(z, 1.0 - (whole - 2f64.sqrt()), 1e-4);
    }
}

#[test]
fn p65_points_end_where_nothing_is_beyond() {
    let spread = "mesh = \"plane\"\nopposed_flux = 1\nconcurrent_flux = 0\nignition_heat = 1\n\
                  time_scale = 0.02\nseparation = 0.1";
    let scene = scene("", spread, &["position = [0.3, 0.2, 0]\npoints = 16"], "");
    let mut run = run(&scene);
    run.seek(200).expect("it runs");
    let points = run.control_points().expect("they are read");
    for point in &points {
        assert_eq!(point.inert, 1, "{point:?}");
        let [x, y, _] = place(point.position);
        assert_close(x.abs().max(y.abs()), 1.0, 1e-5);
    }
    let lines = run.take_statistics().expect("they are taken");
    let mut live = 0;
    for line in &lines {
        assert_eq!(line.points_requested, line.points_born);
        live = live + line.points_born - line.points_died;
        assert_eq!(line.points_live, live, "frame {}", line.frame);
    }
    assert_eq!(live, 0);
    // Born are those that are there.
    let born: u32 = lines.iter().map(|line| line.points_born).sum();
    assert_eq!(born as usize, points.len());
    // The whole square has burnt.
    assert_close(flat_area(&points), 4.0, 0.02);
}
