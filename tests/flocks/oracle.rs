//! The article's own code in double precision, all boids moving at once: another translation of
//! the text than the library's. Each frame starts from the library's state of the frame before.

use motes::layout::Boid;
use motes::plan::Plan;
use rayon::prelude::*;

use crate::common::*;
use crate::support::*;

pub(crate) type Vector = [f64; 2];

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn times(a: Vector, factor: f64) -> Vector {
    [a[0] * factor, a[1] * factor]
}

pub(crate) fn mag(a: Vector) -> f64 {
    (a[0] * a[0] + a[1] * a[1]).sqrt()
}

pub(crate) fn limit(a: Vector, most: f64) -> Vector {
    if mag(a) > most {
        times(a, most / mag(a))
    } else {
        a
    }
}

pub(crate) fn set_mag(a: Vector, length: f64) -> Vector {
    if mag(a) == 0.0 {
        a
    } else {
        times(a, length / mag(a))
    }
}

/// A boid of the article.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body {
    pub(crate) position: Vector,
    pub(crate) velocity: Vector,
}

impl From<&Boid> for Body {
    fn from(boid: &Boid) -> Self {
        let flat = |[x, y, _]: [f32; 3]| [f64::from(x), f64::from(y)];
        Self {
            position: flat(boid.position()),
            velocity: flat(boid.velocity()),
        }
    }
}

/// What happens at the edges of a box: least and greatest corner.
#[derive(Clone, Copy)]
enum Edge {
    Wrap(Vector, Vector),
    Repel(Vector, Vector),
    /// The same, but never back outward.
    Inward(Vector, Vector),
    Constrain(Vector, Vector),
}

/// A list of boids and what its members do.
#[derive(Clone, Copy)]
struct Group {
    flocks_with: &'static [usize],
    /// Separation, alignment, cohesion.
    rules: [bool; 3],
    avoids: &'static [usize],
    attracted_by: &'static [usize],
    gravity: Vector,
    speed: f64,
    edge: Edge,
}

/// What became of a boid, and whether it is near a decision that single precision may take otherwise.
struct Stepped {
    body: Body,
    undecided: bool,
}

fn step_one(group: &Group, own: usize, of: usize, lists: &[Vec<Body>]) -> Stepped {
    let me = lists[of][own];
    let mut acceleration = group.gravity;
    let mut undecided = false;
    for &other in group.flocks_with {
        let mut nearby = Vec::new();
        for (at, boid) in lists[other].iter().enumerate() {
            let distance = mag(sub(me.position, boid.position));
            undecided |= (distance - 60.0).abs() < 1e-4;
            if (other, at) != (of, own) && distance < 60.0 {
                nearby.push((*boid, distance));
            }
        }
        if nearby.is_empty() {
            continue;
        }
        let n = nearby.len() as f64;
        let mut rule = |on: bool, sum: Vector, way: Vector, length: f64, most: f64| {
            if on {
                undecided |= mag(sum) < 1e-3;
                let force = limit(sub(set_mag(way, length), me.velocity), most);
                acceleration = add(acceleration, force);
            }
        };
        let apart = nearby.iter().filter(|(_, distance)| *distance > 0.0);
        let away = apart.fold([0.0; 2], |sum, (boid, distance)| {
            add(sum, times(sub(me.position, boid.position), 1.0 / distance))
        });
        rule(group.rules[0], away, times(away, 1.0 / n), 4.0, 0.3);
        let along = nearby
            .iter()
            .fold([0.0; 2], |sum, (boid, _)| add(sum, boid.velocity));
        rule(group.rules[1], along, times(along, 1.0 / n), 4.0, 0.2);
        let places = nearby
            .iter()
            .fold([0.0; 2], |sum, (boid, _)| add(sum, boid.position));
        let middle = sub(times(places, 1.0 / n), me.position);
        rule(group.rules[2], times(middle, n), middle, 4.5, 0.2);
    }
    for &other in group.avoids {
        for predator in &lists[other] {
            let distance = mag(sub(me.position, predator.position));
            undecided |= (distance - 40.0).abs() < 1e-4;
            if distance < 40.0 {
                let force = sub(sub(me.position, predator.position), me.velocity);
                acceleration = add(acceleration, limit(force, 1.0));
            }
        }
    }
    for &other in group.attracted_by {
        for attractor in &lists[other] {
            let distance = mag(sub(me.position, attractor.position));
            undecided |= (distance - 60.0).abs() < 1e-4;
            if distance < 60.0 {
                acceleration = add(
                    acceleration,
                    limit(sub(attractor.position, me.position), 0.4),
                );
            }
        }
    }
    let velocity = add(me.velocity, acceleration);
    let mut position = add(me.position, velocity);
    let mut velocity = limit(velocity, group.speed);
    let (low, high) = match group.edge {
        Edge::Wrap(low, high)
        | Edge::Repel(low, high)
        | Edge::Inward(low, high)
        | Edge::Constrain(low, high) => (low, high),
    };
    for axis in 0..2 {
        let nearest = (position[axis] - low[axis])
            .abs()
            .min((position[axis] - high[axis]).abs());
        undecided |= nearest < 1e-4;
        let touches = position[axis] <= low[axis] || position[axis] >= high[axis];
        match group.edge {
            Edge::Wrap(..) if position[axis] < low[axis] => position[axis] = high[axis],
            Edge::Wrap(..) if position[axis] > high[axis] => position[axis] = low[axis],
            Edge::Wrap(..) => {}
            Edge::Inward(..) if position[axis] >= high[axis] => {
                velocity[axis] = -velocity[axis].abs()
            }
            Edge::Inward(..) if touches => velocity[axis] = velocity[axis].abs(),
            Edge::Repel(..) if touches => velocity[axis] *= -1.0,
            Edge::Constrain(..) if touches => velocity[axis] *= -4.0,
            _ => {}
        }
    }
    Stepped {
        body: Body { position, velocity },
        undecided,
    }
}

/// Boids of a state, list by list.
fn lists_of(boids: &[Boid], groups: usize) -> Vec<Vec<Body>> {
    let list = |slot: usize| {
        boids
            .iter()
            .filter(move |boid| boid.flock() as usize == slot)
    };
    (0..groups)
        .map(|slot| list(slot).map(Body::from).collect())
        .collect()
}

/// Steps the plan on the processor, whose bits are everybody's, and each frame by the article.
fn assert_as_the_article(what: &str, plan: &Plan, groups: &[Group], frames: u32) {
    let mut cpu = on_cpu(plan);
    let (mut worst, mut left_out, mut all) = (0.0f64, 0u32, 0u32);
    step(&mut cpu, &plan.inputs(0));
    for frame in 1..frames {
        let before = lists_of(&boids(&mut cpu), groups.len());
        step(&mut cpu, &plan.inputs(frame));
        let after = lists_of(&boids(&mut cpu), groups.len());
        for (of, group) in groups.iter().enumerate() {
            let step = |own: usize| step_one(group, own, of, &before);
            let expected: Vec<Stepped> = (0..after[of].len()).into_par_iter().map(step).collect();
            for (own, (got, expected)) in after[of].iter().zip(expected).enumerate() {
                all += 1;
                let Stepped { body, undecided } = expected;
                if undecided {
                    left_out += 1;
                    continue;
                }
                let error = mag(sub(got.position, body.position))
                    .max(mag(sub(got.velocity, body.velocity)));
                assert!(
                    error <= 1e-4,
                    "{what}, frame {frame}, boid {own} of {of}: {got:?}, the article has {body:?}"
                );
                worst = worst.max(error);
            }
        }
    }
    println!("{what}: at most {worst:e} px off; {left_out} of {all} left out");
    assert!(
        f64::from(left_out) < 0.01 * f64::from(all),
        "{left_out} of {all} left out"
    );
}

const WRAP: Edge = Edge::Wrap([0.0, 0.0], [500.0, 300.0]);

const ALONE: Group = Group {
    flocks_with: &[],
    rules: [true; 3],
    avoids: &[],
    attracted_by: &[],
    gravity: [0.0; 2],
    speed: 2.0,
    edge: WRAP,
};

const FLOCKING: Group = Group {
    flocks_with: &[0],
    ..ALONE
};

#[test]
fn f21_rules_are_those_of_the_article() {
    let single = |at: usize| Group {
        rules: std::array::from_fn(|rule| rule == at),
        ..FLOCKING
    };
    for (at, rule) in ["separation", "alignment", "cohesion"]
        .into_iter()
        .enumerate()
    {
        assert_scene_as_the_article(&format!("boids-{rule}"), &[single(at)]);
    }
    assert_scene_as_the_article("boids-free", &[ALONE]);
}

/// Frames of a built-in scene, each from the one before; in the full run all of them.
fn assert_scene_as_the_article(name: &str, groups: &[Group]) {
    let scene = shipped(name);
    let frames = if full() { scene.frames } else { 150 };
    assert_as_the_article(name, &plan(&scene), groups, frames);
}

#[test]
fn f25_the_flock_is_the_article_s_in_every_frame() {
    assert_scene_as_the_article("flock", &[FLOCKING]);
}

#[test]
fn f28_predators_are_avoided_as_in_the_article() {
    let avoiding = Group {
        avoids: &[1],
        ..FLOCKING
    };
    assert_scene_as_the_article("predators", &[avoiding, ALONE]);
}

#[test]
fn f31_crossed_flocks_are_those_of_the_article() {
    let crossed = Group {
        flocks_with: &[1, 0],
        ..ALONE
    };
    assert_scene_as_the_article("crossed-flocks", &[FLOCKING, crossed]);
}

#[test]
fn f30_two_flocks_are_those_of_the_article() {
    let second = Group {
        flocks_with: &[1],
        ..ALONE
    };
    assert_scene_as_the_article("two-flocks", &[FLOCKING, second]);
    let avoiding = |group: Group| Group {
        avoids: &[2],
        ..group
    };
    let groups = [avoiding(FLOCKING), avoiding(second), ALONE];
    assert_scene_as_the_article("two-flocks-predators", &groups);
}

#[test]
fn f33_attractors_pull_as_in_the_article() {
    let edge = Edge::Constrain([-50.0; 2], [50.0; 2]);
    let pulled = Group {
        avoids: &[1],
        attracted_by: &[1],
        edge,
        ..FLOCKING
    };
    let attractors = Group { edge, ..ALONE };
    assert_scene_as_the_article("rorschach", &[pulled, attractors]);
    assert_scene_as_the_article("rorschach-inverted", &[pulled, attractors]);
}

#[test]
fn f11_free_particles_are_those_of_the_article() {
    let (low, high) = ([0.0, 0.0], [300.0, 200.0]);
    let cases = [
        ("bounce-wrap", Edge::Wrap(low, high)),
        ("bounce-repel", Edge::Inward(low, high)),
        (
            "bounce-constrain",
            Edge::Constrain([100.0, 50.0], [200.0, 150.0]),
        ),
    ];
    for (name, edge) in cases {
        let falling = Group {
            gravity: [0.0, 0.2],
            speed: 4.0,
            edge,
            ..ALONE
        };
        // More of them than the sketch's one, so that there is more to see.
        let mut scene = shipped(name);
        scene.flocks[0].count = 20;
        let mut sketches = vec![(edge, scene.clone())];
        if let Edge::Inward(..) = edge {
            // As the article has it, where it sticks.
            let repel = &mut scene.flocks[0].edges;
            let motes::scene::Edges::Repel { inward, .. } = repel else {
                panic!("{repel:?}");
            };
            *inward = false;
            sketches.push((Edge::Repel(low, high), scene));
        }
        for (edge, scene) in sketches {
            let group = Group { edge, ..falling };
            assert_as_the_article(name, &plan(&scene), &[group], scene.frames);
        }
    }
}
