//! Numbers of flocks in the statistics, against counting pair by pair and against hand-made states.

use motes::layout::{Boid, FlockFrame};
use motes::simulation::FlockMetrics;
use motes::{AdapterChoice, Options, Simulation};

use crate::common;
use crate::support::*;

fn boids_at(states: &[State]) -> Vec<Boid> {
    let boid = |(index, (place, velocity)): (u32, &State)| {
        let [x, y, z] = place.map(f32::to_bits);
        let [vx, vy, vz] = velocity.map(f32::to_bits);
        Boid {
            position_and_flock: [x, y, z, 0],
            velocity_and_index: [vx, vy, vz, index],
        }
    };
    (0..).zip(states).map(boid).collect()
}

/// A flock that sees as far as `radius`, on a torus of these extents.
fn flock(radius: f32, [x, y, z]: [f32; 3]) -> FlockFrame {
    FlockFrame {
        edges_max: [0.0, 0.0, 0.0, radius],
        torus: [x, y, z, 0.0],
        ..FlockFrame::default()
    }
}

fn metrics(flock: &FlockFrame, states: &[State]) -> FlockMetrics {
    FlockMetrics::of(flock, &boids_at(states))
}

/// Each pair on its own: the median distance to the nearest, and the mean number within `radius`.
fn pair_by_pair(flock: &FlockFrame, states: &[State]) -> (f64, f64) {
    let radius = f64::from(flock.edges_max[3]);
    let distance = |a: usize, b: usize| {
        let along = |axis: usize| {
            let straight = f64::from(states[a].0[axis]) - f64::from(states[b].0[axis]);
            let extent = f64::from(flock.torus[axis]);
            [straight, straight - extent, straight + extent]
                .map(f64::abs)
                .into_iter()
                .fold(f64::INFINITY, f64::min)
        };
        along(0).hypot(along(1)).hypot(along(2))
    };
    let mut nearest = Vec::new();
    let mut neighbours = 0;
    for a in 0..states.len() {
        let others = (0..states.len()).filter(|b| *b != a);
        let distances: Vec<f64> = others.map(|b| distance(a, b)).collect();
        neighbours += distances.iter().filter(|d| **d < radius).count();
        nearest.push(distances.into_iter().fold(f64::INFINITY, f64::min));
    }
    nearest.sort_by(f64::total_cmp);
    let (half, odd) = (nearest.len() / 2, nearest.len() % 2 == 1);
    let median = if odd {
        nearest[half]
    } else {
        0.5 * (nearest[half - 1] + nearest[half])
    };
    (median, neighbours as f64 / states.len() as f64)
}

#[track_caller]
fn assert_as_pair_by_pair(flock: &FlockFrame, states: &[State]) {
    let got = metrics(flock, states);
    let (nearest, neighbours) = pair_by_pair(flock, states);
    let got_nearest = got.median_nearest_distance.expect("there are others");
    assert!(
        (got_nearest - nearest).abs() <= 1e-12 * (1.0 + nearest),
        "{got_nearest} against {nearest}"
    );
    assert_eq!(got.mean_neighbours, neighbours);
}

/// A number in 0 ..= 1 that looks random.
fn unit(index: u32, salt: u32) -> f32 {
    (common::hash(index.wrapping_mul(8).wrapping_add(salt)) >> 8) as f32 / 16_777_216.0
}

/// Places in a box of these extents; crowded towards its corner for powers above 1.
fn places(count: u32, extents: [f32; 3], power: i32) -> Vec<State> {
    let place = |index| {
        let along = |axis: usize| extents[axis] * unit(index, axis as u32).powi(power);
        ([0, 1, 2].map(along), [1.0, 0.0, 0.0])
    };
    (0..count).map(place).collect()
}

#[test]
fn neighbours_are_those_of_counting_pair_by_pair() {
    let (flat, deep) = ([300.0, 200.0, 0.0], [300.0, 200.0, 100.0]);
    for count in [2, 3, 8, 9, 17, 500, 1001] {
        for extents in [flat, deep] {
            for power in [1, 6] {
                let states = places(count, extents, power);
                for radius in [5.0, 30.0, 99.0] {
                    assert_as_pair_by_pair(&flock(radius, [0.0; 3]), &states);
                    assert_as_pair_by_pair(&flock(radius, [extents[0], 0.0, 0.0]), &states);
                    assert_as_pair_by_pair(&flock(radius.min(50.0), extents), &states);
                }
            }
        }
    }
    // All at two places, a radius apart to the bit: who is as far as that is no neighbour.
    let two: Vec<State> = (0..100)
        .map(|index| ([(index % 2) as f32 * 3.0, 0.0, 0.0], [0.0; 3]))
        .collect();
    assert_as_pair_by_pair(&flock(3.0, [0.0; 3]), &two);
    assert_as_pair_by_pair(&flock(3.5, [0.0; 3]), &two);
}

#[test]
fn hand_made_states_have_the_numbers_of_a_pencil() {
    // Two fly along x and one along -x; their gaps are 3, 3 and 4.
    let states = [
        ([0.0, 0.0, 0.0], [2.0, 0.0, 0.0]),
        ([3.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([7.0, 0.0, 0.0], [-3.0, 0.0, 0.0]),
    ];
    let got = metrics(&flock(3.5, [0.0; 3]), &states);
    assert_eq!(got.count, 3);
    assert_eq!(got.polarisation, 1.0 / 3.0);
    assert_eq!(got.mean_speed, 2.0);
    assert_eq!(got.median_nearest_distance, Some(3.0));
    assert_eq!(got.mean_neighbours, 2.0 / 3.0);
    // Around a torus of 10, the outer ones are 3 apart, too.
    let around = metrics(&flock(3.5, [10.0, 0.0, 0.0]), &states);
    assert_eq!(around.mean_neighbours, 4.0 / 3.0);
    // Headings across each other, and one who stands.
    let across = [
        ([0.0; 3], [5.0, 0.0, 0.0]),
        ([1.0, 0.0, 0.0], [0.0, 0.0, 0.5]),
        ([0.0, 2.0, 0.0], [0.0; 3]),
    ];
    let got = metrics(&flock(1.0, [0.0; 3]), &across);
    assert!((got.polarisation - 2.0_f64.sqrt() / 3.0).abs() < 1e-15);
    assert_eq!(got.mean_speed, 5.5 / 3.0);
    assert_eq!(got.median_nearest_distance, Some(1.0));
    // A gap of 1 is not below 1.
    assert_eq!(got.mean_neighbours, 0.0);
    // Of an even number, the mean of those in the middle: gaps of 1, 1, 3 and 3.
    let pairs = [0.0, 1.0, 10.0, 13.0].map(|x| ([x, 0.0, 0.0], [1.0, 0.0, 0.0]));
    let got = metrics(&flock(60.0, [0.0; 3]), &pairs);
    assert_eq!(got.median_nearest_distance, Some(2.0));
    assert_eq!((got.polarisation, got.mean_neighbours), (1.0, 3.0));
    let alone = metrics(&flock(60.0, [0.0; 3]), &across[..1]);
    assert_eq!(alone.median_nearest_distance, None);
    assert_eq!(alone.mean_neighbours, 0.0);
}

#[test]
fn every_adapter_tells_the_same_of_each_flock() {
    let scene = common::all_kinds_of_flocks();
    let mut all = Vec::new();
    let adapters = common::adapters().into_iter().map(AdapterChoice::Named);
    for adapter in adapters.chain([AdapterChoice::Cpu]) {
        let options = Options {
            adapter,
            ..Options::default()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("it runs");
        assert_eq!(simulation.flock_metrics().expect("it reads"), []);
        for _ in 0..5 {
            simulation.step().expect("it steps");
        }
        all.push(simulation.flock_metrics().expect("it reads"));
        let boids = simulation.boids().expect("it reads");
        for (slot, metrics) in all[0].iter().enumerate() {
            let own = boids.iter().filter(|boid| boid.flock as usize == slot);
            let states: Vec<State> = own.map(|boid| (boid.position, boid.velocity)).collect();
            let mut flock = flock(scene.flocks[slot].perception_radius, [0.0; 3]);
            if let motes::scene::Edges::Torus(corners) = scene.flocks[slot].edges {
                let deep = scene.flocks[slot].dimensions == motes::scene::Dimensions::Three;
                let extent = |axis: usize| corners.max[axis] - corners.min[axis];
                flock.torus = [
                    extent(0),
                    extent(1),
                    if deep { extent(2) } else { 0.0 },
                    0.0,
                ];
            }
            let (_, neighbours) = pair_by_pair(&flock, &states);
            assert_eq!(metrics.mean_neighbours, neighbours, "flock {slot}");
        }
    }
    assert_eq!(all[0].len(), scene.flocks.len());
    for other in &all[1..] {
        assert_eq!(*other, all[0]);
    }
}
