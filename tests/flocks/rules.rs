//! The rules by hand.

use crate::support::*;

/// Velocities that `count` boids of a flock of one rule have a frame after these states.
fn after(rule: &str, states: &[State]) -> Vec<[f32; 3]> {
    let count = states.len().to_string();
    let lines = with(&one_rule(rule), &[("count", &count)]);
    let plan = plan(&scene(&[&lines]));
    stepped(&plan, states).iter().map(|(_, v)| *v).collect()
}

#[track_caller]
fn assert_near(got: [f32; 3], expected: [f32; 3]) {
    let off = (0..3)
        .map(|at| (got[at] - expected[at]).abs())
        .fold(0.0, f32::max);
    assert!(off < 2e-6, "{got:?}, not {expected:?}");
}

const STILL: [f32; 3] = [0.0; 3];

fn at(x: f32) -> State {
    ([x, 100.0, 0.0], STILL)
}

#[test]
fn f17_whoever_is_at_the_radius_is_no_neighbour() {
    let moves = |distance: f32| after("cohesion", &[at(100.0), at(100.0 + distance)])[0] != STILL;
    assert!(moves(59.999));
    assert!(!moves(60.0));
    assert!(!moves(60.001));
    // Nobody sees across edges that merely wrap.
    assert_eq!(after("cohesion", &[at(1.0), at(499.0)])[0], STILL);
}

#[test]
fn f18_separation() {
    assert_near(
        after("separation", &[at(100.0), at(110.0)])[0],
        [-0.3, 0.0, 0.0],
    );
    assert_eq!(
        after("separation", &[at(100.0), at(200.0)])[0],
        STILL,
        "nobody is near"
    );
    // Two that cancel: the way is zero, and it brakes.
    let moving = ([100.0, 100.0, 0.0], [1.0, 0.0, 0.0]);
    let three = after("separation", &[moving, at(90.0), at(110.0)]);
    assert_near(three[0], [0.7, 0.0, 0.0]);
    // Unit vectors, not offsets: one far and one near on the two axes count alike.
    let corner = [at(100.0), at(150.0), ([100.0, 110.0, 0.0], STILL)];
    let share = -0.3 * std::f32::consts::FRAC_1_SQRT_2;
    assert_near(after("separation", &corner)[0], [share, share, 0.0]);
}

#[test]
fn f19_alignment() {
    let moving = |x: f32, v: [f32; 3]| ([x, 100.0, 0.0], v);
    assert_near(
        after("alignment", &[at(100.0), moving(110.0, [0.0, 1.5, 0.0])])[0],
        [0.0, 0.2, 0.0],
    );
    assert_eq!(after("alignment", &[at(100.0), at(200.0)])[0], STILL);
    // The wanted velocity, 4 along +y, less the own.
    let own = [1.0, 0.0, 0.0];
    let two = after(
        "alignment",
        &[moving(100.0, own), moving(110.0, [0.0, 0.5, 0.0])],
    );
    let length = 17f32.sqrt();
    assert_near(two[0], [1.0 - 0.2 / length, 0.2 * 4.0 / length, 0.0]);
    // Velocities that cancel: it brakes.
    let three = [
        moving(100.0, own),
        moving(110.0, own),
        moving(90.0, [-1.0, 0.0, 0.0]),
    ];
    assert_near(after("alignment", &three)[0], [0.8, 0.0, 0.0]);
}

#[test]
fn f20_cohesion() {
    assert_near(
        after("cohesion", &[at(100.0), at(110.0)])[0],
        [0.2, 0.0, 0.0],
    );
    // The middle of two, one of them near: offsets count, not unit vectors.
    let three = after("cohesion", &[at(100.0), at(130.0), at(90.0)]);
    assert_near(three[0], [0.2, 0.0, 0.0]);
    let own = ([100.0, 100.0, 0.0], [0.5, 0.0, 0.0]);
    let two = after("cohesion", &[own, ([100.0, 110.0, 0.0], STILL)]);
    let length = (0.25f32 + 4.5 * 4.5).sqrt();
    assert_near(two[0], [0.5 - 0.2 * 0.5 / length, 0.2 * 4.5 / length, 0.0]);
}

#[test]
fn f18_those_at_the_same_place_are_no_reason_to_go_anywhere() {
    let same = after("separation", &[at(100.0), at(100.0)]);
    assert_eq!(same, [STILL; 2], "no way to want, and nothing to brake");
    let three = after("separation", &[at(100.0), at(100.0), at(110.0)]);
    assert_near(three[0], [-0.3, 0.0, 0.0]);
    assert_near(three[1], [-0.3, 0.0, 0.0]);
}

/// One boid and one other flock of one, that it has a relation to.
fn related(kind: &str, distance: f32, velocity: [f32; 3], mass: &str) -> [f32; 3] {
    let own = with(FREE, &[("count", "1"), ("mass", mass)])
        + &format!("[[flock.relation]]\n{kind}\nother = \"predators\"\n");
    let plan = plan(&scene(&[&own, &with(PREDATORS, &[("count", "1")])]));
    let states = [([100.0, 100.0, 0.0], velocity), at(100.0 + distance)];
    let after = stepped(&plan, &states);
    assert_eq!(after[1].1, STILL, "whom it sees does not see it");
    after[0].1
}

#[test]
fn f28_predators_count_within_40_px() {
    let avoid = |distance: f32| related("kind = \"avoid\"", distance, STILL, "1");
    assert_near(avoid(39.99), [-1.0, 0.0, 0.0]);
    assert_eq!(avoid(40.0), STILL);
    // Less than the limit: the offset itself, less the velocity; whatever the mass.
    for mass in ["1", "4"] {
        let own = [0.25, 0.0, 0.0];
        assert_near(
            related("kind = \"avoid\"", 0.5, own, mass),
            [-0.5, 0.0, 0.0],
        );
    }
}

#[test]
fn f33_attractors_pull_within_60_px() {
    let approach = |distance, mass| related("kind = \"approach\"", distance, STILL, mass);
    assert_near(approach(59.9, "1"), [0.4, 0.0, 0.0]);
    assert_eq!(approach(60.0, "1"), STILL);
    assert_near(approach(0.25, "1"), [0.25, 0.0, 0.0]);
    assert_near(approach(20.0, "2"), [0.2, 0.0, 0.0]);
}

#[test]
fn f32_attractors_begin_with_a_step_of_10() {
    let lines =
        "name = \"a\"\ncount = 4\nregion = { min = [0, 0, 0], max = [0, 0, 0] }\nstart_speed = 10";
    let plan = plan(&scene(&[lines]));
    let mut cpu = crate::common::on_cpu(&plan);
    step(&mut cpu, &plan.inputs(0));
    let first = boids(&mut cpu);
    step(&mut cpu, &plan.inputs(1));
    for (before, after) in first.iter().zip(boids(&mut cpu)) {
        let length = |v: [f32; 3]| v[0].hypot(v[1]);
        let [from, to] = [before, &after].map(|boid| boid.position());
        assert!((length(from) - 10.0).abs() < 1e-4, "{from:?}");
        assert!((length([to[0] - from[0], to[1] - from[1], 0.0]) - 2.0).abs() < 1e-4);
    }
}

/// Steering is the desired velocity less the current one: what is not limited is desired, whatever was.
#[test]
fn f13_steering_is_desired_less_current() {
    let share = std::f32::consts::FRAC_1_SQRT_2;
    let other = ([110.0, 110.0, 0.0], [0.0, -0.5, 0.0]);
    for (rule, desired) in [
        ("separation", [-4.0 * share, -4.0 * share, 0.0]),
        ("alignment", [0.0, -4.0, 0.0]),
        ("cohesion", [4.5 * share, 4.5 * share, 0.0]),
    ] {
        let limit = format!("{rule}_limit = 50\n");
        let lines = with(&one_rule(rule), &[("count", "2"), ("max_speed", "100")]) + &limit;
        let plan = plan(&scene(&[&lines]));
        for velocity in [STILL, [1.0, 0.0, 0.0], [-0.3, 1.7, 0.0]] {
            let own = ([100.0, 100.0, 0.0], velocity);
            let got = stepped(&plan, &[own, other])[0].1;
            let off = (0..3).map(|at| (got[at] - desired[at]).abs());
            assert!(
                off.fold(0.0, f32::max) < 5e-6,
                "{rule}: {got:?}, not {desired:?}"
            );
        }
    }
}

/// As the built-in scene has them: they pull within 60 px and are fled from within 40.
#[test]
fn f37_attractors_are_avoided_within_40_px() {
    let mut scene = motes::scene::load("rorschach").expect("it is built in");
    scene.flocks[0].count = 1;
    scene.flocks[1].count = 1;
    let plan = plan(&scene);
    let pushed = |distance: f32| {
        let own = ([-20.0, 0.0, 0.0], STILL);
        let attractor = ([distance - 20.0, 0.0, 0.0], STILL);
        stepped(&plan, &[own, attractor])[0].1
    };
    assert_near(pushed(39.99), [0.4 - 1.0, 0.0, 0.0]);
    assert_near(pushed(40.0), [0.4, 0.0, 0.0]);
    assert_near(pushed(59.99), [0.4, 0.0, 0.0]);
    assert_eq!(pushed(60.0), STILL);
    // Nearer than a unit, each of both is as long as the way.
    assert_near(pushed(0.25), [0.25 - 0.25, 0.0, 0.0]);
    assert_near(pushed(0.75), [0.4 - 0.75, 0.0, 0.0]);
}
