//! What flocks come to, in numbers that were measured on another implementation of the article,
//! all boids moving at once.

use motes::scene::Scene;
use rayon::prelude::*;

use crate::support::*;

/// What a flock has come to.
#[derive(Clone, Copy, Debug)]
struct Measured {
    polarisation: f64,
    speed: f64,
    neighbours: f64,
    /// Mean distance to the nearest.
    nearest: f64,
}

fn measured(states: &[State]) -> Measured {
    let n = states.len() as f64;
    let flat = |v: &[f32; 3]| [f64::from(v[0]), f64::from(v[1])];
    let (mut heading, mut speed, mut neighbours, mut nearest) = ([0.0; 2], 0.0, 0.0, 0.0);
    for (place, velocity) in states {
        let v = flat(velocity);
        let length = v[0].hypot(v[1]);
        speed += length;
        if length > 0.0 {
            heading = [heading[0] + v[0] / length, heading[1] + v[1] / length];
        }
        let own = flat(place);
        let distances = states
            .iter()
            .filter(|(other, _)| !std::ptr::eq(other, place));
        let distances = distances.map(|(other, _)| {
            let other = flat(other);
            (own[0] - other[0]).hypot(own[1] - other[1])
        });
        let distances: Vec<f64> = distances.collect();
        neighbours += distances
            .iter()
            .filter(|distance| **distance < 60.0)
            .count() as f64;
        nearest += distances.into_iter().fold(f64::INFINITY, f64::min);
    }
    Measured {
        polarisation: heading[0].hypot(heading[1]) / n,
        speed: speed / n,
        neighbours: neighbours / n,
        nearest: nearest / n,
    }
}

/// Runs that each band is held against: as many as it was measured on.
const SEEDS: u64 = 16;

/// The scene's flock after `frames` frames, of each of `seeds` seeds.
fn seeds(scene: &Scene, frames: u32, seeds: u64) -> Vec<Measured> {
    let run = |seed: u64| {
        let mut scene = scene.clone();
        scene.seed = seed;
        let plan = plan(&scene);
        let mut cpu = motes::cpu::CpuBackend::new(&plan, Some(1)).expect("there is room");
        for frame in 0..frames {
            step(&mut cpu, &plan.inputs(frame));
        }
        measured(&states_of(&boids(&mut cpu)))
    };
    (1..=seeds).into_par_iter().map(run).collect()
}

fn mean(all: &[Measured], of: impl Fn(&Measured) -> f64) -> f64 {
    all.iter().map(of).sum::<f64>() / all.len() as f64
}

fn median(all: &[Measured], of: impl Fn(&Measured) -> f64) -> f64 {
    let mut values: Vec<f64> = all.iter().map(of).collect();
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    0.5 * (values[half] + values[values.len().div_ceil(2) - 1])
}

#[track_caller]
fn assert_band(what: &str, got: f64, low: f64, high: f64) {
    println!("{what}: {got:.3}, in {low} ..= {high}");
    assert!(
        (low..=high).contains(&got),
        "{what}: {got}, not in {low} ..= {high}"
    );
}

#[test]
fn f22_separation_alone() {
    let all = seeds(&shipped("boids-separation"), 300, SEEDS);
    assert_band("neighbours", mean(&all, |it| it.neighbours), 22.0, 25.0);
    assert_band("speed", mean(&all, |it| it.speed), 0.51, 0.60);
    assert_band("nearest", mean(&all, |it| it.nearest), 2.4, 3.1);
    for one in &all {
        assert_band("polarisation", one.polarisation, 0.0, 0.1);
    }
    let begun = seeds(&shipped("boids-separation"), 1, SEEDS);
    let neighbours = mean(&begun, |it| it.neighbours);
    assert_band("neighbours at first", neighbours, 31.5, 33.5);
}

#[test]
fn f23_alignment_alone() {
    let all = seeds(&shipped("boids-alignment"), 300, SEEDS);
    assert_band(
        "median polarisation",
        median(&all, |it| it.polarisation),
        0.9,
        1.0,
    );
    for one in &all {
        assert_band("polarisation", one.polarisation, 0.6, 1.0);
    }
    assert_band("speed", mean(&all, |it| it.speed), 1.995, 2.001);
}

#[test]
fn f24_cohesion_alone() {
    let all = seeds(&shipped("boids-cohesion"), 100, SEEDS);
    assert_band("nearest", mean(&all, |it| it.nearest), 0.8, 1.0);
    assert_band("neighbours", mean(&all, |it| it.neighbours), 70.0, 96.0);
    assert_band("polarisation", mean(&all, |it| it.polarisation), 0.0, 0.1);
    let begun = seeds(&shipped("boids-cohesion"), 1, SEEDS);
    assert_band("nearest at first", mean(&begun, |it| it.nearest), 8.4, 9.0);
}

#[test]
fn f25_all_rules() {
    let all = seeds(&shipped("flock"), 600, SEEDS);
    assert_band("polarisation", mean(&all, |it| it.polarisation), 0.77, 0.95);
    assert_band("speed", mean(&all, |it| it.speed), 1.94, 1.97);
    assert_band("nearest", mean(&all, |it| it.nearest), 10.1, 11.5);
    assert_band("neighbours", mean(&all, |it| it.neighbours), 32.0, 35.0);
    for one in &all {
        println!("{one:.3?}");
    }
}

/// Where near ones count more, boids do keep apart.
#[test]
fn fa2_inverse_distance_separates() {
    let lines = one_rule("separation") + "separation = \"inverse_distance\"\n";
    let scene = scene(&[&lines]);
    let before = seeds(&scene, 1, 4);
    let after = seeds(&scene, 300, 4);
    assert_band("nearest at first", mean(&before, |it| it.nearest), 8.2, 9.2);
    assert_band("nearest", mean(&after, |it| it.nearest), 9.0, 25.0);
}
