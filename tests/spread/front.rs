//! Rings of control points: how they begin, their order, their number.

use crate::support::*;
use motes::simulation::PointState;

#[test]
fn p61_a_ring_begins_with_headings_evenly_around_the_normal() {
    for (position, normal) in [
        ("[0.2, 0.1, 2]", [0.0, 0.0, 1.0]),
        ("[-3, 0.5, 0.2]", [-1.0, 0.0, 0.0]),
        ("[0, -1.5, 0]", [0.0, -1.0, 0.0]),
    ] {
        let ignition = format!("position = {position}\npoints = 12");
        let scene = scene("", "mesh = \"cube\"", &[&ignition], "");
        let points = points_at(&scene, 0);
        assert_eq!(points.len(), 12);
        let next = points.iter().cycle().skip(1);
        for (a, b) in points.iter().zip(next) {
            let (a, b) = (place(a.heading), place(b.heading));
            assert_close(length(a), 1.0, 1e-6);
            assert_close(dot(a, normal), 0.0, 1e-6);
            let (sin, cos) = (std::f64::consts::TAU / 12.0).sin_cos();
            assert_close(dot(a, b), cos, 1e-6);
            let cross = [
                a[1] * b[2] - a[2] * b[1],
                a[2] * b[0] - a[0] * b[2],
                a[0] * b[1] - a[1] * b[0],
            ];
            assert_close(dot(cross, normal), sin, 1e-6);
        }
        // At the place of the surface that is nearest.
        for point in &points {
            let at = place(point.position);
            assert_close(dot(at, normal), 1.0, 1e-6);
            assert_eq!(point.position, points[0].position);
        }
    }
}

/// The rings of points, in their order.
fn rings(points: &[PointState]) -> Vec<&[PointState]> {
    points.chunk_by(|a, b| a.ring == b.ring).collect()
}

#[test]
fn p60_rings_stay_whole_counterclockwise_and_in_order() {
    let spread = "mesh = \"plane\"\nscale = 4\ntime_scale = 0.1\nseparation = 0.1";
    let ignitions = [
        "position = [-2, 0, 0]\nfirst_frame = 5",
        "position = [2, 0, 0]",
        "position = [0, 2, 0]\nfirst_frame = 5\npoints = 9",
    ];
    let scene = scene("buoyancy = 0", spread, &ignitions, "");
    let mut run = run(&scene);
    for frame in 0..60 {
        run.seek(frame).expect("it runs");
        let points = run.control_points().expect("they are read");
        let rings = rings(&points);
        let numbers: Vec<u32> = rings.iter().map(|ring| ring[0].ring).collect();
        // By frame of ignition, then as in the file.
        let wanted: &[u32] = if frame < 5 { &[0] } else { &[0, 1, 2] };
        assert_eq!(numbers, wanted);
        let middles = [[2.0, 0.0], [-2.0, 0.0], [0.0, 2.0]];
        for (ring, middle) in rings.iter().zip(middles) {
            let age = if ring[0].ring == 0 { frame } else { frame - 5 };
            let radius = 0.018 * f64::from(age);
            if age == 0 {
                continue;
            }
            let area = std::f64::consts::PI * radius * radius;
            // A polygon of so many corners has less.
            let share = std::f64::consts::TAU / ring.len() as f64;
            let wanted = area * share.sin() / share;
            assert_close(flat_area(ring), wanted, 0.02 * area);
            let mut angles: Vec<f64> = Vec::new();
            for point in *ring {
                let [x, y, _] = place(point.position);
                let (x, y) = (x - middle[0], y - middle[1]);
                assert_close((x * x + y * y).sqrt(), radius, 1e-3 * radius + 1e-6);
                angles.push(y.atan2(x));
            }
            let next = angles.iter().cycle().skip(1);
            let falls = angles.iter().zip(next).filter(|(a, b)| b < a).count();
            assert_eq!(falls, 1, "{angles:?}");
        }
    }
}

#[test]
fn p63_what_has_no_room_is_counted_as_dropped() {
    let spread =
        "mesh = \"plane\"\nscale = 10\ntime_scale = 0.5\nseparation = 0.05\nmax_points = 100";
    let ignitions = [
        "position = [0, 0, 0]",
        "position = [3, 0, 0]\nfirst_frame = 40",
    ];
    let scene = scene("buoyancy = 0", spread, &ignitions, "");
    let mut run = run(&scene);
    run.seek(45).expect("it runs");
    assert_eq!(run.control_points().expect("they are read").len(), 100);
    let lines = run.take_statistics().expect("they are taken");
    let dropped = |frame: usize| lines[frame].points_requested - lines[frame].points_born;
    assert_eq!(dropped(1), 0);
    assert!(dropped(39) > 0);
    // A ring that has no room does not begin.
    assert!(
        dropped(40) >= dropped(41) + 16 - 5,
        "{} {}",
        dropped(40),
        dropped(41)
    );
    let points = run.control_points().expect("they are read");
    assert!(points.iter().all(|point| point.ring == 0));
}

#[test]
fn p78c_a_mesh_eight_times_as_large_burns_alike() {
    let of = |scale: f64| {
        let spread = format!(
            "mesh = \"torus\"\nscale = {}\ntime_scale = {}\nseparation = {}\ncurvature_distance = {}",
            scale,
            0.1 * scale,
            0.1 * scale,
            0.05 * scale
        );
        let ignition = format!("position = [{}, 0, 0]", scale);
        points_at(&scene("", &spread, &[&ignition], ""), 60)
    };
    let (small, large) = (of(1.0), of(8.0));
    assert_eq!(small.len(), large.len());
    for (a, b) in small.iter().zip(&large) {
        for (x, y) in a.position.iter().zip(b.position) {
            assert_close(f64::from(y) / 8.0, f64::from(*x), 1e-6);
        }
    }
}

#[test]
fn p78_a_run_can_be_entered_from_a_snapshot() {
    let spread = "mesh = \"cube\"\ntime_scale = 0.2\nseparation = 0.1";
    let ignitions = [
        "position = [0, 0, 1]",
        "position = [1, 0, 0]\nfirst_frame = 25",
    ];
    let scene = scene("", spread, &ignitions, "");
    let mut whole = run(&scene);
    whole.seek(20).expect("it runs");
    let snapshot = whole
        .snapshot()
        .expect("it is taken")
        .expect("it has begun");
    let mut bytes = Vec::new();
    snapshot.write_to(&mut bytes).expect("memory is written");
    let read = motes::simulation::Snapshot::from_bytes(&bytes).expect("it is whole");
    let mut other = run(&scene);
    other.restore(&read).expect("it is of the run");
    for simulation in [&mut whole, &mut other] {
        simulation.seek(40).expect("it runs");
    }
    let digests = [&mut whole, &mut other].map(|one| one.state_digest().expect("it is made"));
    assert_eq!(digests[0], digests[1]);
    // One of another run is refused.
    let spread = "mesh = \"cube\"\ntime_scale = 0.2\nmax_points = 8";
    let mut small = run(&crate::support::scene(
        "",
        spread,
        &["position = [0, 0, 1]\npoints = 8"],
        "",
    ));
    assert!(small.restore(&read).is_err());
}
