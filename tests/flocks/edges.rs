//! Free particles and the edges of their world.

use motes::scene::{Edges, Scene};

use crate::common::*;
use crate::support::*;

/// One boid in the article's 500 x 300, with these edges.
fn alone(edges: &str) -> String {
    with(FREE, &[("count", "1"), ("edges", edges)])
}

const CORNERS: &str = "min = [0, 0, 0], max = [500, 300, 0]";

fn one(lines: &str, state: State) -> State {
    stepped(&plan(&scene(&[lines])), &[state])[0]
}

#[test]
fn f6_forces_are_divided_by_the_mass() {
    for (mass, expected) in [("1", 0.2f32), ("2", 0.1)] {
        let lines = with(
            FREE,
            &[("count", "1"), ("force", "[0, 0.2, 0]"), ("mass", mass)],
        );
        let (place, velocity) = one(&lines, ([100.0, 100.0, 0.0], [0.0; 3]));
        assert_eq!(velocity, [0.0, expected, 0.0]);
        assert_eq!(place, [100.0, 100.0 + expected, 0.0]);
    }
}

#[test]
fn f7_the_limit_comes_after_the_move() {
    let lines = with(FREE, &[("count", "1"), ("force", "[1, 0, 0]")]);
    let (place, velocity) = one(&lines, ([100.0, 100.0, 0.0], [2.0, 0.0, 0.0]));
    assert_eq!(place, [103.0, 100.0, 0.0]);
    assert!(
        (velocity[0] - 2.0).abs() < 1e-6 && velocity[1] == 0.0,
        "{velocity:?}"
    );
}

#[test]
fn f8_wrap_puts_on_the_opposite_edge() {
    let wrap = alone(&format!("{{ kind = \"wrap\", {CORNERS} }}"));
    let x = |x: f32, v: f32| one(&wrap, ([x, 100.0, 0.0], [v, 0.0, 0.0])).0[0];
    assert_eq!(x(-1.7, -2.0), 500.0);
    assert_eq!(x(501.7, 2.0), 0.0);
    assert_eq!(x(1.0, -1.0), 0.0, "an edge is inside");
    assert_eq!(x(499.0, 1.0), 500.0);
    let y = |y: f32, v: f32| one(&wrap, ([100.0, y, 0.0], [0.0, v, 0.0])).0[1];
    assert_eq!((y(-1.0, -1.0), y(300.0, 1.0)), (300.0, 0.0));
}

#[test]
fn f9_repel_reverses_and_sticks_unless_it_is_inward() {
    let literal = alone(&format!("{{ kind = \"repel\", {CORNERS} }}"));
    let inward = alone(&format!("{{ kind = \"repel\", inward = true, {CORNERS} }}"));
    for (lines, stuck) in [(&literal, true), (&inward, false)] {
        let (place, velocity) = one(lines, ([499.0, 100.0, 0.0], [2.0, 0.0, 0.0]));
        assert_eq!((place[0], velocity[0]), (501.0, -2.0));
        // Slowed down beyond the edge, it does not come back in one frame.
        let (place, velocity) = one(lines, ([502.0, 100.0, 0.0], [-1.0, 0.0, 0.0]));
        assert_eq!(place[0], 501.0);
        assert_eq!(velocity[0], if stuck { 1.0 } else { -1.0 });
        let (_, velocity) = one(lines, ([-3.0, 100.0, 0.0], [-1.0, 0.5, 0.0]));
        assert_eq!(velocity, [1.0, 0.5, 0.0]);
    }
}

#[test]
fn f10_constrain_throws_back_four_times_as_fast() {
    let edges = "{ kind = \"constrain\", min = [100, 50, 0], max = [200, 150, 0] }";
    let lines = alone(edges);
    let (place, velocity) = one(&lines, ([199.0, 100.0, 0.0], [1.0, 0.0, 0.0]));
    assert_eq!((place, velocity), ([200.0, 100.0, 0.0], [-4.0, 0.0, 0.0]));
    let (place, velocity) = one(&lines, (place, velocity));
    assert_eq!(place, [196.0, 100.0, 0.0]);
    assert!((velocity[0] + 2.0).abs() < 1e-6, "{velocity:?}");
    let (_, velocity) = one(&lines, ([150.0, 51.0, 0.0], [0.0, -1.5, 0.0]));
    assert_eq!(velocity, [0.0, 6.0, 0.0]);
}

/// One of the article's first sketches, of 16 particles instead of one, so that there is more to see.
fn falling(name: &str) -> Scene {
    let mut scene = shipped(name);
    let flock = &mut scene.flocks[0];
    assert_eq!((flock.count, flock.mass, flock.size), (1, 1.0, 5.0));
    assert_eq!((flock.max_speed, flock.force), (4.0, [0.0, 0.2, 0.0]));
    assert_eq!(flock.region.min, [150.0, 100.0, 0.0]);
    assert_eq!(flock.region.max, flock.region.min);
    flock.count = 16;
    scene
}

#[test]
fn f11_gravity_adds_up_until_the_limit() {
    let scene = falling("bounce-wrap");
    // The sketch's grey, 55 of 255.
    assert!((scene.image.background[0] * 255.0 - 55.0).abs() < 0.01);
    let plan = plan(&scene);
    let mut cpu = on_cpu(&plan);
    step(&mut cpu, &plan.inputs(0));
    let first = boids(&mut cpu);
    for frame in 1..scene.frames {
        step(&mut cpu, &plan.inputs(frame));
        for (boid, begun) in boids(&mut cpu).iter().zip(&first) {
            let [vx, vy, _] = boid.velocity();
            assert!(vx.hypot(vy) <= 4.0 + 1e-5, "frame {frame}: {vx}, {vy}");
            let [_, vy0, _] = begun.velocity();
            // At most 1 + 0.2 (n + 1) fast: the limit has not acted before frame 13.
            if frame < 13 {
                let sum = (0..frame).fold(vy0, |v, _| v + 0.2);
                assert_eq!(vy, sum, "frame {frame}");
            }
        }
    }
}

/// How far beyond the edges particles get in the scene's time: at the left, the right, the top, the bottom.
fn beyond(scene: &Scene, [left, right, top, bottom]: [f32; 4]) -> [f32; 4] {
    let plan = plan(scene);
    let mut cpu = on_cpu(&plan);
    let mut most = [0.0f32; 4];
    for frame in 0..scene.frames {
        step(&mut cpu, &plan.inputs(frame));
        for boid in boids(&mut cpu) {
            let [x, y, _] = boid.position();
            let here = [left - x, x - right, top - y, y - bottom];
            most = std::array::from_fn(|at| most[at].max(here[at]));
        }
    }
    println!("beyond by {most:?}");
    most
}

/// A step of 4 and one of gravity, and what rounding adds.
const STEP: f32 = 4.2 + 1e-4;

#[test]
fn f12_repelled_and_constrained_particles_stay() {
    let canvas = [0.0, 300.0, 0.0, 200.0];
    let mut repelled = falling("bounce-repel");
    let most = beyond(&repelled, canvas);
    assert!(most.iter().all(|it| *it <= STEP), "{most:?}");
    // Literally, velocities are turned again beyond an edge, and gravity sinks whoever has lost its speed
    // beyond the bottom.
    let Edges::Repel { inward, .. } = &mut repelled.flocks[0].edges else {
        panic!("{:?}", repelled.flocks[0].edges);
    };
    *inward = false;
    let [left, right, top, bottom] = beyond(&repelled, canvas);
    assert!(left.max(right).max(top) <= STEP && bottom > STEP);
    // Four times the speed outward takes it as far once more, and a limited step back in: still on the canvas.
    let most = beyond(&falling("bounce-constrain"), [100.0, 200.0, 50.0, 150.0]);
    assert!(most.iter().all(|it| *it <= 16.0), "{most:?}");
    assert!(most[3] > 0.0, "it is thrown back at the bottom");
}

#[test]
fn f8_a_torus_counts_modulo_its_box() {
    let torus = alone(&format!("{{ kind = \"torus\", {CORNERS} }}"));
    let torus = with(&torus, &[("perception_radius", "60")]);
    let (place, velocity) = one(&torus, ([499.5, 0.25, 0.0], [1.0, -1.0, 0.0]));
    assert_eq!((place, velocity), ([0.5, 299.25, 0.0], [1.0, -1.0, 0.0]));
}
