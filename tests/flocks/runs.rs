//! Several flocks at once, and whole runs: what the sketches of the article show.

use motes::plan::Plan;
use motes::scene::Scene;
use motes::{AdapterChoice, Options, Simulation};

use crate::common::*;
use crate::support::*;

/// The states of each flock after `frames` frames.
fn run(plan: &Plan, frames: u32) -> Vec<Vec<State>> {
    let mut cpu = on_cpu(plan);
    for frame in 0..frames {
        step(&mut cpu, &plan.inputs(frame));
    }
    let all = boids(&mut cpu);
    let flock = |slot: u32| all.iter().filter(move |boid| boid.flock() == slot).cloned();
    (0..plan.flock_count)
        .map(|slot| states_of(&flock(slot).collect::<Vec<_>>()))
        .collect()
}

fn second() -> String {
    with(&flocking(), &[("name", "\"second\"")])
}

fn avoiding(lines: &str) -> String {
    format!("{lines}[[flock.relation]]\nkind = \"avoid\"\nother = \"predators\"\n")
}

#[test]
fn f27_who_ignores_predators_flies_as_without() {
    let of = |name: &str| run(&plan(&shipped(name)), 300);
    let alone = of("flock");
    assert_eq!(alone[0], of("predators-ignored")[0]);
    assert_ne!(alone[0], of("predators")[0]);
    // Wherever they stand among the flocks.
    let beside = run(&plan(&scene(&[PREDATORS, &flocking()])), 150);
    assert_eq!(run(&plan(&shipped("flock")), 150)[0], beside[1]);
}

#[test]
fn f29_two_flocks_do_not_know_each_other() {
    let first = run(&plan(&scene(&[&flocking()])), 150);
    let other = with(
        &second(),
        &[("force", "[0.05, 0.02, 0]"), ("max_speed", "3")],
    );
    for second in [&second(), &other] {
        assert_eq!(run(&plan(&scene(&[&flocking(), second])), 150)[0], first[0]);
    }
}

/// Runs that are told of on average.
const SEEDS: u64 = 12;

/// Mean number of boids within 40 px of a predator, over that of places on average.
fn crowding(boids: &[State], predators: &[State]) -> f64 {
    let near = |(p, _): &State| {
        let within = |(q, _): &&State| (p[0] - q[0]).hypot(p[1] - q[1]) < 40.0;
        boids.iter().filter(within).count() as f64
    };
    let area = std::f64::consts::PI * 40.0 * 40.0 / (500.0 * 300.0);
    let expected = boids.len() as f64 * area;
    predators.iter().map(near).sum::<f64>() / predators.len() as f64 / expected
}

#[test]
fn f28_predators_stand_alone() {
    let (mut feared, mut ignored) = (0.0, 0.0);
    for seed in 1..=SEEDS {
        let of = |name: &str| {
            let flocks = run(&plan(&shipped_of(name, seed)), 300);
            crowding(&flocks[0], &flocks[1]) / SEEDS as f64
        };
        feared += of("predators");
        ignored += of("predators-ignored");
    }
    println!("crowding {feared}, and {ignored} where nobody cares");
    assert!(feared < 0.5 && ignored > 0.6);
}

#[test]
fn f30_both_flocks_avoid_and_keep_their_own_ways() {
    let (mut crowds, mut cross) = ([0.0; 2], 0.0);
    for seed in 1..=SEEDS {
        let flocks = run(&plan(&shipped_of("two-flocks-predators", seed)), 300);
        for at in 0..2 {
            crowds[at] += crowding(&flocks[at], &flocks[2]) / SEEDS as f64;
        }
        let heading = |states: &[State]| {
            let sum = states
                .iter()
                .fold([0.0f32; 2], |s, (_, v)| [s[0] + v[0], s[1] + v[1]]);
            let length = sum[0].hypot(sum[1]);
            [sum[0] / length, sum[1] / length]
        };
        let [a, b] = [heading(&flocks[0]), heading(&flocks[1])];
        cross += f64::from(a[0] * b[0] + a[1] * b[1]) / SEEDS as f64;
    }
    println!("crowding {crowds:?}, cosine between the flocks {cross}");
    assert!(crowds[0] < 0.5 && crowds[1] < 0.5);
    // The mean of twelve independent cosines has a deviation of 0.2.
    assert!(cross.abs() < 0.6);
}

/// Mean cosine between each boid of `b` and those of `a` around it.
fn agreement(b: &[State], a: &[State]) -> f64 {
    let mut sum = (0.0, 0);
    for (p, v) in b {
        let near = a
            .iter()
            .filter(|(q, _)| (p[0] - q[0]).hypot(p[1] - q[1]) < 60.0);
        let way = near.fold([0.0f32; 2], |s, (_, w)| [s[0] + w[0], s[1] + w[1]]);
        let lengths = way[0].hypot(way[1]) * v[0].hypot(v[1]);
        if lengths > 0.0 {
            sum = (
                sum.0 + f64::from((way[0] * v[0] + way[1] * v[1]) / lengths),
                sum.1 + 1,
            );
        }
    }
    sum.0 / f64::from(sum.1)
}

#[test]
fn f31_the_second_flock_follows_and_the_first_does_not_know() {
    let alone = run(&plan(&shipped("two-flocks")), 200);
    let following = run(&plan(&shipped("crossed-flocks")), 200);
    assert_eq!(alone[0], following[0]);
    let apart = agreement(&alone[1], &alone[0]);
    let together = agreement(&following[1], &following[0]);
    println!("cosine {together}, and {apart} where they do not know each other");
    assert!(together > apart + 0.1);
}

fn simulation(scene: &Scene, adapter: &str) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::parse(adapter),
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("it begins")
}

#[test]
fn f29_a_run_goes_on_from_a_snapshot_on_another_adapter() {
    let scene = scene(&[&avoiding(&flocking()), PREDATORS]);
    let mut whole = simulation(&scene, "cpu");
    whole.seek(30).expect("it steps");
    let snapshot = whole
        .snapshot()
        .expect("it can be read")
        .expect("it has begun");
    let mut bytes = Vec::new();
    snapshot.write_to(&mut bytes).expect("a vector takes all");
    let snapshot = motes::simulation::Snapshot::from_bytes(&bytes).expect("as written");
    whole.seek(40).expect("it steps");
    for adapter in adapters().into_iter().chain(["cpu".to_owned()]) {
        let mut other = simulation(&scene, &adapter);
        other.restore(&snapshot).expect("of the same run");
        other.seek(40).expect("it steps");
        assert_eq!(other.boids(), whole.boids(), "{adapter}");
        assert_eq!(other.state_digest(), whole.state_digest(), "{adapter}");
    }
    // Whose boids stand elsewhere is of another run.
    let mut fewer = scene.clone();
    fewer.flocks[1].count = 4;
    fewer.flocks[0].count -= 1;
    assert!(simulation(&fewer, "cpu").restore(&snapshot).is_err());
}
