//! Goals, obstacles and wind.

use crate::common::on_cpu;
use crate::support::*;

type Vector = [f64; 3];

fn wide(v: [f32; 3]) -> Vector {
    v.map(f64::from)
}

fn length(v: Vector) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn sub(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|at| a[at] - b[at])
}

fn times(a: Vector, factor: f64) -> Vector {
    a.map(|x| x * factor)
}

/// One boid in space, with these lines of its own.
fn alone(lines: &str) -> String {
    let torus = "{ kind = \"torus\", min = [0, 0, 0], max = [500, 300, 200] }";
    let keys = [("count", "1"), ("dimensions", "3"), ("edges", torus)];
    with(FREE, &keys) + lines
}

fn one(lines: &str, state: State) -> State {
    stepped(&plan(&scene(&[lines])), &[state])[0]
}

#[test]
fn a_goal_is_sought_by_the_nearest_way_and_slowly_at_last() {
    let goal = [40.0, 280.0, 100.0];
    let lines = alone(
        "[flock.goal]\nposition = [40, 280, 100]\nweight = 0.5\nspeed = 3\nlimit = 1.25\n\
         slowing_radius = 80\n",
    );
    let mut random = Random(11);
    for _ in 0..300 {
        let place = [
            random.within(0.0, 500.0) as f32,
            random.within(0.0, 300.0) as f32,
            random.within(0.0, 200.0) as f32,
        ];
        let mut part = || random.within(-0.6, 0.6) as f32;
        let velocity = [part(), part(), part()];
        let extents = [500.0, 300.0, 200.0];
        let mut way = sub(goal, wide(place));
        for (part, extent) in way.iter_mut().zip(extents) {
            *part -= extent * (*part / extent).round();
        }
        let speed = 3.0 * (length(way) / 80.0).min(1.0);
        let wanted = sub(times(way, speed / length(way)), wide(velocity));
        let steered = times(wanted, 0.5 * (1.25 / length(wanted)).min(1.0));
        let got = one(&lines, (place, velocity)).1;
        let off = length(sub(sub(wide(got), wide(velocity)), steered));
        assert!(off < 1e-5, "{place:?}: off by {off}");
    }
    // At the goal itself, it brakes.
    let (_, velocity) = one(&lines, ([40.0, 280.0, 100.0], [0.5, 0.0, 0.0]));
    assert!((velocity[0] - 0.25).abs() < 1e-6, "{velocity:?}");
}

#[test]
fn a_flock_gets_where_its_goal_goes() {
    let goal = "[flock.goal]\nposition = { keys = [[0, [400, 250, 0]], [300, [400, 250, 0]], \
                [301, [60, 60, 0]]] }\nslowing_radius = 40\n";
    let plan = plan(&scene(&[&(FREE.to_owned() + "\n" + goal)]));
    let mut cpu = on_cpu(&plan);
    let mut distances = Vec::new();
    for frame in 0..=600 {
        step(&mut cpu, &plan.inputs(frame));
        let goal = if frame <= 300 {
            [400.0, 250.0, 0.0]
        } else {
            [60.0, 60.0, 0.0]
        };
        let all = states_of(&boids(&mut cpu));
        let sum: f64 = all.iter().map(|(p, _)| length(sub(wide(*p), goal))).sum();
        distances.push(sum / all.len() as f64);
    }
    println!("{} {} {}", distances[0], distances[300], distances[600]);
    assert!(distances[0] > 150.0 && distances[302] > 150.0);
    assert!(distances[300] < 10.0 && distances[600] < 10.0);
}

/// How far a place is beyond what keeps boids out or in, by each kind's plain geometry.
fn beyond(obstacle: &str, p: Vector) -> f64 {
    let from_box = |low: Vector, high: Vector| {
        let inside = (0..3).map(|at| (p[at] - low[at]).min(high[at] - p[at]));
        inside.fold(f64::INFINITY, f64::min)
    };
    match obstacle {
        BALL => 50.0 - length(sub(p, [250.0, 150.0, 100.0])),
        BOWL => length(sub(p, [250.0, 150.0, 100.0])) - 90.0,
        WALL => 40.0 / 5f64.sqrt() - (p[0] + 2.0 * p[1]) / 5f64.sqrt(),
        BLOCK => from_box([200.0, 100.0, 50.0], [300.0, 180.0, 150.0]),
        _ => -from_box([150.0, 80.0, 30.0], [350.0, 220.0, 170.0]),
    }
}

const BALL: &str = "kind = \"sphere\"\ncenter = [250, 150, 100]\nradius = 50\n";
const BOWL: &str = "kind = \"sphere\"\ncenter = [250, 150, 100]\nradius = 90\nstay = \"inside\"\n";
const WALL: &str = "kind = \"plane\"\npoint = [20, 10, 9]\nnormal = [2, 4, 0]\n";
const BLOCK: &str = "kind = \"box\"\nmin = [200, 100, 50]\nmax = [300, 180, 150]\n";
const TANK: &str =
    "kind = \"box\"\nmin = [150, 80, 30]\nmax = [350, 220, 170]\nstay = \"inside\"\n";

#[test]
fn nobody_is_ever_inside_an_obstacle() {
    for obstacle in [BALL, BOWL, WALL, BLOCK, TANK] {
        let corners = "min = [0, 0, 0], max = [500, 300, 200]";
        let goal = "goal = { position = [250, 150, 100], limit = 0.3 }\n";
        let lines = with(
            FREE,
            &[
                ("count", "200"),
                ("dimensions", "3"),
                ("region", &format!("{{ {corners} }}")),
                ("edges", &format!("{{ kind = \"wrap\", {corners} }}")),
            ],
        ) + goal
            + "[[flock.relation]]\nkind = \"flock\"\n[[flock.obstacle]]\n"
            + obstacle;
        let plan = plan(&scene(&[&lines]));
        let mut cpu = on_cpu(&plan);
        let mut nearest = f64::NEG_INFINITY;
        for frame in 0..200 {
            step(&mut cpu, &plan.inputs(frame));
            // They begin anywhere, and are put outside in their first step.
            for (place, _) in states_of(&boids(&mut cpu)) {
                if frame > 0 {
                    nearest = nearest.max(beyond(obstacle, wide(place)));
                }
            }
        }
        println!("{obstacle}at most {nearest} beyond");
        assert!(nearest < 1e-3, "{obstacle}{nearest} beyond");
        assert!(nearest > -5.0, "{obstacle}nobody comes near: {nearest}");
    }
}

/// A boid that flies this way, after a step, in a flock with such an obstacle.
fn past(obstacle: &str, place: [f32; 3], velocity: [f32; 3]) -> (Vector, Vector) {
    let lines = alone("[[flock.obstacle]]\n") + obstacle + "margin = 16\nlimit = 0.5\n";
    let (place, velocity) = one(&lines, (place, velocity));
    (wide(place), wide(velocity))
}

#[track_caller]
fn assert_near(got: Vector, expected: Vector) {
    assert!(
        length(sub(got, expected)) < 1e-5,
        "{got:?}, not {expected:?}"
    );
}

#[test]
fn boids_turn_away_within_the_margin_the_more_the_nearer() {
    let still = [0.0; 3];
    // At 16, 12 and 4 of the surface, and on it: none, a quarter, three quarters and all of the limit.
    for (distance, part) in [(16.0, 0.0), (12.0, 0.25), (4.0, 0.75), (0.0, 1.0)] {
        let push = 0.5 * part;
        let d = distance as f32;
        let cases = [
            (BALL, [250.0, 200.0 + d, 100.0], [0.0, push, 0.0]),
            (BALL, [200.0 - d, 150.0, 100.0], [-push, 0.0, 0.0]),
            (BOWL, [250.0, 150.0, 190.0 - d], [0.0, 0.0, -push]),
            (BLOCK, [300.0 + d, 140.0, 100.0], [push, 0.0, 0.0]),
            (BLOCK, [250.0, 140.0, 50.0 - d], [0.0, 0.0, -push]),
            (TANK, [250.0, 80.0 + d, 100.0], [0.0, push, 0.0]),
        ];
        for (obstacle, place, expected) in cases {
            assert_near(past(obstacle, place, still).1, expected);
        }
        // A corner of the box, seen from aside.
        let aside = d / 2f32.sqrt();
        let share = push / 2f64.sqrt();
        let (_, velocity) = past(BLOCK, [300.0 + aside, 180.0 + aside, 100.0], still);
        if distance > 0.0 {
            assert_near(velocity, [share, share, 0.0]);
        }
    }
    let (_, velocity) = past(WALL, [20.0, 10.0, 0.0], still);
    let share = 0.5 / 5f64.sqrt();
    assert_near(velocity, [share, 2.0 * share, 0.0]);
}

#[test]
fn who_flies_into_an_obstacle_goes_on_along_it() {
    // Two a frame at a wall that pushes by 15 / 16 of its limit of 0.5.
    let (place, velocity) = past(BLOCK, [199.0, 140.0, 100.0], [1.5, 0.25, 0.0]);
    assert_near(place, [200.0, 140.25, 100.0]);
    assert_near(velocity, [0.0, 0.25, 0.0]);
    // From inside: out by the nearest face, and not faster than it was.
    let (place, velocity) = past(BLOCK, [210.0, 140.0, 100.0], [1.0, 0.0, 0.0]);
    assert_near(place, [200.0, 140.0, 100.0]);
    assert_near(velocity, [0.0; 3]);
    // From the very middle of a ball along x.
    let (place, _) = past(BALL, [250.0, 150.0, 100.0], [0.0; 3]);
    assert_near(place, [300.0, 150.0, 100.0]);
}

/// Boids of a plane know no depth: a ball is the circle of its radius, wherever its centre lies.
#[test]
fn obstacles_of_flat_flocks_have_no_depth() {
    let flat = |obstacle: &str, place: [f32; 3]| {
        let lines = with(FREE, &[("count", "1")]) + "[[flock.obstacle]]\n" + obstacle;
        one(&lines, (place, [0.0; 3])).0
    };
    let [x, y, z] = flat(BALL, [260.0, 150.0, 0.0]);
    assert!((x - 300.0).abs() < 1e-4 && y == 150.0 && z == 0.0);
    let [x, y, z] = flat(BLOCK, [290.0, 140.0, 0.0]);
    assert_eq!([x, y, z], [300.0, 140.0, 0.0]);
    let tilted = "kind = \"plane\"\npoint = [100, 0, 50]\nnormal = [1, 0, 5]\n";
    assert_eq!(flat(tilted, [50.0, 20.0, 0.0]), [100.0, 20.0, 0.0]);
}

#[test]
fn drag_makes_boids_follow_the_wind() {
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [1, 0.5, -0.25]\n";
    for (dimensions, depth) in [("3", -0.25), ("2", 0.0)] {
        let keys = [
            ("count", "1"),
            ("dimensions", dimensions),
            ("drag", "0.25"),
            ("edges", "{ kind = \"none\" }"),
        ];
        let plan = plan(&windy(wind, &[&with(FREE, &keys)]));
        let state = ([100.0, 100.0, 0.0], [0.0, 1.0, 0.0]);
        let (place, velocity) = stepped(&plan, &[state])[0];
        assert_eq!(velocity, [0.25, 0.875, 0.25 * depth]);
        assert_eq!(place, [100.25, 100.875, 0.25 * depth]);
        let mut states = vec![state];
        for _ in 0..60 {
            states = stepped(&plan, &states);
        }
        assert_near(wide(states[0].1), [1.0, 0.5, f64::from(depth)]);
    }
    // Nobody who has none.
    let plan = plan(&windy(wind, &[&with(FREE, &[("count", "1")])]));
    let state = ([100.0, 100.0, 0.0], [0.0, 1.0, 0.0]);
    assert_eq!(stepped(&plan, &[state])[0].1, state.1);
}
