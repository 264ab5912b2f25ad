//! Nothing burns twice.

use std::f64::consts::{PI, TAU};

use motes::backend::Backend;
use motes::layout::SpreadPoint;
use motes::plan::{Plan, Stage};
use motes::scene::Scene;

use crate::common;
use crate::support::*;

/// As fast everywhere: `step` a frame.
fn even(step: f64, lines: &str) -> String {
    format!(
        "curvature = \"ignored\"\nopposed_flux = 1\nconcurrent_flux = 0\nignition_heat = 1\n\
         time_scale = {step}\n{lines}"
    )
}

/// A tube of circumference 2 pi around the z axis, open at both ends, 20 long.
fn tube(sides: u32) -> (String, f64) {
    let side = TAU / f64::from(sides);
    let radius = 0.5 * side / (0.5 * side).sin();
    let mut text = String::new();
    for at in 0..sides {
        let (sin, cos) = (f64::from(at) * side).sin_cos();
        for z in [-10, 10] {
            text += &format!("v {} {} {z}\n", radius * cos, radius * sin);
        }
    }
    for at in 0..sides {
        let (a, b) = (2 * at + 1, 2 * ((at + 1) % sides) + 1);
        text += &format!("f {a} {b} {} {}\n", b + 1, a + 1);
    }
    (text, radius)
}

/// The area within a ring on the tube, laid flat.
fn tube_area(ring: &[motes::simulation::PointState]) -> f64 {
    let mut flat: Vec<[f64; 2]> = Vec::new();
    for point in ring {
        let [x, y, z] = place(point.position);
        let mut around = y.atan2(x);
        if let Some([before, _]) = flat.last() {
            around += TAU * ((before - around) / TAU).round();
        }
        flat.push([around, z]);
    }
    let next = flat.iter().cycle().skip(1);
    let twice = flat
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0]);
    0.5 * twice.sum::<f64>()
}

#[test]
fn p66_on_a_cylinder_a_fire_meets_itself_and_stops_there() {
    let (text, radius) = tube(96);
    let spread = even(0.02, "separation = 0.08");
    let ignition = format!("position = [{radius}, 0.01, 0]\npoints = 32");
    let scene = scene_on(&text, "", &spread, &[&ignition]);
    let mut run = run(&scene);
    for (r, wanted) in [(3.0, PI * 9.0), (4.0, 44.4638), (6.0, 71.7953)] {
        run.seek((r / 0.02f64).round() as u32).expect("it runs");
        let points = run.control_points().expect("they are read");
        let area = tube_area(&points);
        assert_close(area / wanted, 1.0, 0.01);
    }
    // Those that met rest where they met, opposite to where it began.
    let points = run.control_points().expect("they are read");
    let blocked: Vec<_> = points.iter().filter(|point| point.inert == 2).collect();
    assert!(blocked.len() > 20, "{}", blocked.len());
    for point in blocked {
        let [x, y, _] = place(point.position);
        let around = y.atan2(x) - 0.01;
        assert!(PI - around.abs() < 0.05, "{around}");
    }
}

#[test]
fn p67_a_map_of_when_what_was_reached_has_the_area_of_the_front() {
    // Places of the tube, each with the first frame in which a control point or the line between two was
    // there: a second account of what has burnt, which knows of no crossings.
    const ACROSS: usize = 160;
    let texel = TAU / ACROSS as f64;
    let (text, radius) = tube(96);
    let spread = even(0.02, "separation = 0.03\nmax_points = 60000");
    let ignition = format!("position = [{radius}, 0.01, 0]\npoints = 64");
    let mut run = run(&scene_on(&text, "", &spread, &[&ignition]));
    let down = (20.0 / texel) as usize;
    let mut reached = vec![u32::MAX; ACROSS * down];
    let exact = [(150, PI * 9.0), (200, 44.4638), (300, 71.7953)];
    let mut wanted = exact.iter();
    for frame in 0..=300 {
        run.seek(frame).expect("it runs");
        let points = run.control_points().expect("they are read");
        for (at, a) in points.iter().enumerate() {
            let b = &points[(at + 1) % points.len()];
            let ([ax, ay, az], [bx, by, bz]) = (place(a.position), place(b.position));
            let from = ay.atan2(ax);
            let around = by.atan2(bx) - from;
            let around = around - TAU * (around / TAU).round();
            let steps = (around.hypot(bz - az) / (0.4 * texel)).ceil().max(1.0);
            for part in 0..steps as usize {
                let share = part as f64 / steps;
                let column = (from + share * around).rem_euclid(TAU) / texel;
                let row = (az + share * (bz - az) + 10.0) / texel;
                let place = row as usize * ACROSS + column as usize % ACROSS;
                reached[place] = reached[place].min(frame);
            }
        }
        if exact.iter().any(|(at, _)| *at == frame) {
            let (_, area) = wanted.next().expect("as many as asked for");
            let burnt = reached.iter().filter(|first| **first <= frame).count() as f64;
            // A band of one place along the front, which is no longer than a circle of that radius.
            let r = 0.02 * f64::from(frame);
            let band = TAU * r * texel;
            assert_close(burnt * texel * texel, *area, band);
        }
    }
    // What is farther was reached later, and nothing before the front could be there.
    for (at, first) in reached
        .iter()
        .enumerate()
        .filter(|(_, first)| **first < u32::MAX)
    {
        let around = (at % ACROSS) as f64 + 0.5;
        let around = around * texel - 0.01;
        let around = around.min(TAU - around);
        let up = (at / ACROSS) as f64 + 0.5;
        let far = around.hypot(up * texel - 10.0);
        assert!(
            (0.02 * f64::from(*first) - far).abs() < 2.0 * texel + 0.02,
            "{far} at frame {first}"
        );
    }
}

/// The area that fronts sweep over, frame by frame, summed up to each of these frames; no point is
/// counted that has stopped.
fn swept(scene: &Scene, frames: &[u32]) -> Vec<f64> {
    let last = *frames.last().expect("there is a frame");
    let plan = Plan::new(scene, last + 1).expect("it can be planned");
    let mut cpu = common::on_cpu(&plan);
    let mut sum = 0.0;
    let mut sums = Vec::new();
    for frame in 0..=last {
        let inputs = plan.inputs(frame);
        let mut run = |stage| cpu.run_stage(stage, &inputs).expect("it runs");
        run(Stage::Front);
        run(Stage::Block);
        let before = points_of(&mut cpu, "control_points");
        let moved = points_of(&mut cpu, "moved_points");
        cpu.run_stage(Stage::Insert, &inputs).expect("it runs");
        let after = points_of(&mut cpu, "control_points");
        let count = moved.len();
        let next = |at: usize| (at + 1) % count;
        for at in 0..count {
            let [a, b] = [at, next(at)].map(|at| place(before[at].position()));
            let [c, d] = [at, next(at)].map(|at| place(moved[at].position()));
            sum += triangle(a, c, b) + triangle(b, c, d);
        }
        let mut at = 0;
        for pair in after.windows(2) {
            if at < count && pair[0].course[2] == moved[at].course[2] {
                let to = place(moved[next(at)].position());
                if moved[next(at)].course[2] != pair[1].course[2] {
                    let from = place(pair[0].position());
                    sum += triangle(from, place(pair[1].position()), to);
                }
                at += 1;
            }
        }
        if frames.contains(&frame) {
            sums.push(sum);
        }
    }
    sums
}

fn points_of(cpu: &mut motes::cpu::CpuBackend, name: &str) -> Vec<SpreadPoint> {
    bytemuck::pod_collect_to_vec(&cpu.read(name).expect("it is read"))
}

fn triangle(a: Place, b: Place, c: Place) -> f64 {
    let (u, v) = (minus(b, a), minus(c, a));
    let cross = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ];
    0.5 * length(cross)
}

#[test]
fn p70_a_cube_burns_from_the_middle_of_a_face_until_nothing_is_left() {
    let lines = "mesh = \"cube\"\nscale = 0.5\nseparation = 0.01\nmax_points = 50_000";
    let scene = scene(
        "",
        &even(0.005, lines),
        &["position = [0.001, 0.002, 0.5]\npoints = 32"],
        "",
    );
    let exact = [(140, 1.5394), (200, 2.827), (300, 4.887), (400, 6.0)];
    let frames: Vec<u32> = exact.iter().map(|(frame, _)| *frame).collect();
    for ((frame, wanted), area) in exact.iter().zip(swept(&scene, &frames)) {
        assert!(
            (area / wanted - 1.0).abs() < 0.01,
            "{area} instead of {wanted} at frame {frame}"
        );
    }
    let live = points_at(&scene, 440)
        .iter()
        .filter(|point| point.inert == 0)
        .count();
    assert_eq!(live, 0);
}

#[test]
fn p66_two_fires_that_meet_burn_what_both_reach_once() {
    let lines = "mesh = \"plane\"\nscale = 5\nseparation = 0.05";
    let ignitions = [
        "position = [-0.5, 0, 0]\npoints = 24",
        "position = [0.5, 0, 0]\npoints = 24",
    ];
    let scene = scene("", &even(0.01, lines), &ignitions, "");
    let points = points_at(&scene, 130);
    let rings: Vec<_> = points.chunk_by(|a, b| a.ring == b.ring).collect();
    let (r, h) = (1.3f64, 0.5);
    // Each circle less what is beyond the line between the two.
    let segment = r * r * (h / r).acos() - h * (r * r - h * h).sqrt();
    for ring in rings {
        assert_close(flat_area(ring) / (PI * r * r - segment), 1.0, 0.01);
    }
    for point in &points {
        let [x, _, _] = place(point.position);
        assert!(
            if point.ring == 0 {
                x < 0.015
            } else {
                x > -0.015
            },
            "{point:?}"
        );
    }
}

#[test]
fn p68_on_a_plane_the_test_changes_nothing() {
    let of = |switch: &str| {
        let lines = format!(
            "mesh = \"plane\"\nscale = 3\nseparation = 0.05\ndouble_burning = \"{switch}\"\ntime_scale = 0.2"
        );
        let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [0.7, 0, 0]\n";
        points_at(&scene("", &lines, &["position = [0.3, 0, 0]"], wind), 120)
    };
    let (with, without) = (of("prevented"), of("ignored"));
    assert!(with.len() > 100);
    assert_eq!(with, without);
}
