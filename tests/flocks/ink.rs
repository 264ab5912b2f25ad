//! How much of the ink of the Rorschach sketch is outside of its box: the sketch itself, in double
//! precision and in its own order, one boid after the other and each in place; and the library's
//! flocks, of which all move at once.

use rayon::prelude::*;

use crate::common::full;
use crate::sketch::{Body, draw_ink};
use crate::support::*;

/// Part of the places that are outside of the box, and how far the farthest is from its middle, along an
/// axis.
fn spilled(places: impl Iterator<Item = [f64; 2]>) -> (f64, f64) {
    let (mut beyond, mut count, mut reach) = (0.0, 0.0, 0.0f64);
    for [x, y] in places {
        let out = x.abs().max(y.abs());
        count += 1.0;
        beyond += f64::from(u8::from(out > 50.0));
        reach = reach.max(out);
    }
    (beyond / count, reach)
}

/// Where runs are held against the row, and what is told of them around it.
const AT: usize = 400;
const AROUND: std::ops::Range<usize> = 350..450;

/// The ink beyond the box on average around frame 400, of 16 runs, and its deviation from run to run: the
/// same in both orders of updating, from frame 150 on.
const MEAN: f64 = 0.036;
const DEVIATION: f64 = 0.019;

/// What is told of a run, frame by frame: of the ink, its part beyond the box and its reach; the reach of
/// the attractors.
type Told = Vec<(f64, f64, f64)>;

fn told(
    ink: impl Iterator<Item = [f64; 2]>,
    attractors: impl Iterator<Item = [f64; 2]>,
) -> (f64, f64, f64) {
    let (beyond, reach) = spilled(ink);
    (beyond, reach, spilled(attractors).1)
}

/// The library's run of that seed, on the processor, whose bits are everybody's; and how it begins.
fn at_once(seed: u64) -> (Told, Vec<State>) {
    let plan = plan(&shipped_of("rorschach", seed));
    let mut cpu = motes::cpu::CpuBackend::new(&plan, Some(1)).expect("there is room");
    let (mut all, mut begun) = (Told::new(), Vec::new());
    for frame in 0..AROUND.end as u32 {
        step(&mut cpu, &plan.inputs(frame));
        let states = states_of(&boids(&mut cpu));
        let places = |states: &[State]| -> Vec<[f64; 2]> {
            states
                .iter()
                .map(|state| Body::of(state).position)
                .collect()
        };
        let (ink, attractors) = states.split_at(1000);
        all.push(told(
            places(ink).into_iter(),
            places(attractors).into_iter(),
        ));
        if frame == 0 {
            begun = states;
        }
    }
    (all, begun)
}

/// The sketch's own run from the same beginning.
fn in_place(begun: &[State]) -> Told {
    let mut ink: Vec<Body> = begun[..1000].iter().map(Body::of).collect();
    let mut attractors: Vec<Body> = begun[1000..].iter().map(Body::of).collect();
    let mut all = Told::new();
    for frame in 0..AROUND.end {
        if frame > 0 {
            draw_ink(&mut ink, &mut attractors);
        }
        let places = |bodies: &[Body]| -> Vec<[f64; 2]> {
            bodies.iter().map(|body| body.position).collect()
        };
        all.push(told(
            places(&ink).into_iter(),
            places(&attractors).into_iter(),
        ));
    }
    all
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

fn around(told: &Told) -> f64 {
    mean(told[AROUND].iter().map(|it| it.0))
}

#[track_caller]
fn assert_in_its_box(what: &str, runs: &[Told]) {
    let share = mean(runs.iter().map(around));
    println!("{what}: {share:.4} beyond the box");
    for run in runs {
        let farthest = run.iter().map(|it| it.2).fold(0.0, f64::max);
        println!("  {:.4}, the attractors at most {farthest:.4}", around(run));
        // They never enter an edge by more than a step.
        assert!(farthest <= 52.0, "{what}: {farthest}");
    }
    let off = 3.0 * DEVIATION / (runs.len() as f64).sqrt();
    assert!(
        (share - MEAN).abs() <= off,
        "{what}: {share} beyond, not {MEAN} within {off}"
    );
}

/// Runs differ: around frame 400 they have 1 to 9 per cent of their ink beyond the box, and one frame of one
/// run anything up to an eighth. What the row says holds for the mean of runs.
#[test]
fn f35_rorschach_stays_in_its_box() {
    let seeds = if full() { 16u64 } else { 2 };
    let both = |seed: u64| {
        let (ours, begun) = at_once(seed);
        (ours, full().then(|| in_place(&begun)))
    };
    let both: Vec<_> = (1..=seeds).into_par_iter().map(both).collect();
    let (ours, others): (Vec<Told>, Vec<Option<Told>>) = both.into_iter().unzip();
    assert_in_its_box("at once", &ours);
    let others: Vec<Told> = others.into_iter().flatten().collect();
    if others.is_empty() {
        return;
    }
    assert_in_its_box("in place", &others);
    for (what, runs) in [("at once", &ours), ("in place", &others)] {
        let share = mean(runs.iter().map(|run| run[AT].0));
        let kept = runs.iter().filter(|run| run[AT].1 <= 54.0).count();
        println!("{what}: {share:.4} beyond at frame {AT}; in {kept} runs all within 54");
        assert!(share <= 0.06, "{what}: {share}");
        assert!(4 * kept >= 3 * runs.len(), "{what}: {kept}");
    }
}
