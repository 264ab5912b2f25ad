//! How many are born: Reeves (1983), sections 2 and 2.1.

use motes::backend::Backend;
use motes::plan::{Plan, Stage};
use motes::scene::Scene;

use crate::common;
use crate::common::statistics::{ks_p_value, mean, standard_deviation};
use crate::support::{Run, on_every_backend, scene};

/// Births by frame and system, from the stage of births alone.
fn births_of(scene: &Scene, frames: impl Iterator<Item = u32>) -> Vec<Vec<u32>> {
    let plan = Plan::new(scene, 1).expect("the scene can be planned");
    let mut backend = common::on_cpu(&plan);
    let births = |frame| {
        backend
            .run_stage(Stage::Births, &plan.inputs(frame))
            .expect("births can be found");
        backend.read("birth_counts").expect("births can be read")
    };
    frames.map(births).collect()
}

/// Births asked for in each frame below `frame_end` of a whole run.
fn births_of_run(on: &str, scene: &Scene, frame_end: u32) -> Vec<u32> {
    let mut run = Run::new(on, scene, frame_end);
    run.step_to(frame_end - 1);
    let lines = run.statistics();
    assert!(
        lines
            .iter()
            .all(|line| line.born == line.requested && line.dropped == 0)
    );
    assert_eq!(lines.len(), frame_end as usize);
    lines.iter().map(|line| line.requested).collect()
}

fn floats(counts: &[u32]) -> Vec<f64> {
    counts.iter().copied().map(f64::from).collect()
}

const VARYING: &str = "initial_mean_parts = 1000\n var_parts = 300\n lifetime = 1
    birth_rounding = \"stochastic\"";

#[test]
fn r1_one_seed_one_run_and_two_seeds_two_runs_of_one_mean() {
    const FRAMES: u32 = 400;
    let system = "initial_mean_parts = 20\n var_parts = 10\n lifetime = { mean = 8, var = 3 }
        birth_rounding = \"stochastic\"\n speed = 0.3\n particle_shape = \"streak\"";
    on_every_backend(|on| {
        let result = |seed: u32, frame_end: u32| {
            let scene = scene(&format!("seed = {seed}"), &[system]);
            let mut run = Run::new(on, &scene, frame_end);
            run.step_to(frame_end - 1);
            let image = run.image();
            let counts: Vec<u32> = run.statistics().iter().map(|line| line.born).collect();
            let words: Vec<_> = run.members().iter().map(|member| member.raw).collect();
            (words, image, counts)
        };
        let (first, again, other) = (result(1, FRAMES), result(1, FRAMES), result(2, FRAMES));
        assert!(first.0.len() > 100);
        assert!(first == again, "one seed gave two runs");
        assert_ne!(first.0, other.0, "two seeds gave one state");
        assert_ne!(first.1, other.1, "two seeds gave one image");
        assert_ne!(first.2, other.2, "two seeds gave the same births");
        let (a, b) = (floats(&first.2), floats(&other.2));
        let sigma = (standard_deviation(&a).powi(2) + standard_deviation(&b).powi(2)).sqrt()
            / f64::from(FRAMES).sqrt();
        let off = (mean(&a) - mean(&b)).abs();
        assert!(off <= 3.0 * sigma, "means are {off} apart, sigma {sigma}");
    });
}

#[test]
fn r5_births_are_uniform_about_their_mean() {
    let scene = scene("", &[VARYING]);
    let counts = births_of(&scene, 0..10_000).concat();
    assert_eq!(counts.len(), 10_000);
    let (center, spread) = (mean(&floats(&counts)), standard_deviation(&floats(&counts)));
    println!("10,000 frames: mean {center:.2}, standard deviation {spread:.2}");
    assert!((center - 1000.0).abs() <= 5.2, "{center}");
    assert!((spread / 173.2 - 1.0).abs() <= 0.02, "{spread}");
    assert!(counts.iter().all(|count| (700..=1300).contains(count)));
    on_every_backend(|on| {
        assert!(
            births_of_run(on, &scene, 300) == counts[..300],
            "other births on {on}"
        );
    });
}

#[test]
fn r5_rounding_keeps_the_mean_and_nearest_does_not_draw() {
    let counts = |rounding: &str, mean: f64, var: f64| {
        let lines = format!(
            "initial_mean_parts = {mean}\n var_parts = {var}\n birth_rounding = \"{rounding}\""
        );
        births_of(&scene("capacity = 1", &[&lines]), 0..100_000).concat()
    };
    // RA1: floor(x + u) keeps 0.3 a frame; its standard deviation is that of a coin of 0.3.
    let few = counts("stochastic", 0.3, 0.0);
    assert!(few.iter().all(|&count| count <= 1));
    let three_sigma = 3.0 * (0.3f64 * 0.7 / 100_000.0).sqrt();
    assert!(
        (mean(&floats(&few)) - 0.3).abs() <= three_sigma,
        "{}",
        mean(&floats(&few))
    );
    assert!(counts("nearest", 0.3, 0.0).iter().all(|&count| count == 0));
    assert!(counts("nearest", 0.7, 0.0).iter().all(|&count| count == 1));
    // A draw below zero is no births: uniform in -20 .. 40 is at or below 0 a third of the time.
    let halved = counts("stochastic", 10.0, 30.0);
    let none = halved.iter().filter(|&&count| count == 0).count() as f64 / 100_000.0;
    // Rounding up from between -1 and 0 gives 0 too, and from 0 .. 1 gives 0 half the time.
    let expected = (20.0 + 0.5) / 60.0;
    assert!((none - expected).abs() <= 3.0 * (expected * (1.0 - expected) / 1e5f64).sqrt());
    assert!(halved.iter().all(|&count| count <= 40));
}

#[test]
fn r7_the_mean_changes_linearly_and_stays_at_zero() {
    let linear = scene(
        "",
        &["initial_mean_parts = 100\n delta_mean_parts = 10\n first_frame = 3\n lifetime = 2"],
    );
    let shrinking = |var: u32| {
        let lines = format!(
            "initial_mean_parts = 100\n delta_mean_parts = -10\n var_parts = {var}\n lifetime = 2"
        );
        scene("", &[&lines])
    };
    on_every_backend(|on| {
        let births = births_of_run(on, &linear, 25);
        assert_eq!(births[..3], [0, 0, 0]);
        let expected: Vec<u32> = (0..22).map(|elapsed| 100 + 10 * elapsed).collect();
        assert_eq!(births[3..], expected);
        assert_eq!(births[3 + 20], 300);

        let births = births_of_run(on, &shrinking(0), 30);
        assert_eq!(births[..11], [100, 90, 80, 70, 60, 50, 40, 30, 20, 10, 0]);
        assert!(births[10..].iter().all(|&count| count == 0), "{births:?}");
        // A half-width alone bears none, either.
        let births = births_of_run(on, &shrinking(50), 30);
        assert!(births[..6].iter().all(|&count| count > 0));
        assert!(births[10..].iter().all(|&count| count == 0), "{births:?}");
    });
}

#[test]
fn r7_the_mean_an_area_changes_linearly() {
    // The bounding sphere has a radius of 10 pixels.
    let by_area = |delta: f64| {
        let lines = format!(
            "initial_mean_parts_per_area = 0.5\n delta_mean_parts_per_area = {delta}\n lifetime = 2
            generation_shape = {{ kind = \"sphere\", radius = 10 }}"
        );
        scene("", &[&lines])
    };
    let area = std::f64::consts::PI * 100.0;
    on_every_backend(|on| {
        let births = births_of_run(on, &by_area(0.05), 21);
        for (elapsed, &count) in births.iter().enumerate() {
            let expected = (0.5 + 0.05 * elapsed as f64) * area;
            // Rounding to the nearest is all that may come between.
            assert!(
                (f64::from(count) - expected).abs() <= 0.6,
                "{elapsed}: {count}, {expected}"
            );
        }
        let births = births_of_run(on, &by_area(-0.1), 12);
        assert!(
            births[4] > 0 && births[5..].iter().all(|&count| count == 0),
            "{births:?}"
        );
    });
}

#[test]
fn r8_the_half_width_is_constant_over_frames() {
    // 1,000 systems and 100 seeds draw 100,000 births in each of two frames.
    let systems: Vec<String> = (0..1000)
        .map(|number| {
            format!("name = \"s{number}\"\n first_frame = 5\n delta_mean_parts = 7\n {VARYING}")
        })
        .collect();
    let systems: Vec<&str> = systems.iter().map(String::as_str).collect();
    let mut scene = scene("capacity = 1", &systems);
    let (mut first, mut later) = (Vec::new(), Vec::new());
    for seed in 0..100 {
        scene.seed = seed;
        let births = births_of(&scene, [5, 105].into_iter());
        first.extend(floats(&births[0]));
        later.extend(floats(&births[1]));
    }
    let (a, b) = (standard_deviation(&first), standard_deviation(&later));
    println!("standard deviation at f0 {a:.2}, at f0 + 100 {b:.2}");
    assert!((a / b - 1.0).abs() <= 0.02, "{a} and {b}");
    assert!(
        (mean(&later) - mean(&first) - 700.0).abs() < 4.0,
        "the mean has moved"
    );
}

#[test]
fn r10_births_begin_at_the_first_frame_and_end_at_the_last() {
    let scene = scene(
        "",
        &[
            "first_frame = 6\n end_frame = 9\n initial_mean_parts = 5\n var_parts = 2\n lifetime = 2",
        ],
    );
    on_every_backend(|on| {
        let births = births_of_run(on, &scene, 14);
        for (frame, &count) in births.iter().enumerate() {
            assert_eq!(count > 0, (6..9).contains(&frame), "frame {frame}: {count}");
        }
    });
}

#[test]
fn the_test_of_distributions_finds_a_wrong_one() {
    // Even steps, and the same bent by a hundredth: 100,000 samples tell.
    let even: Vec<f64> = (0..100_000).map(|at| (f64::from(at) + 0.5) / 1e5).collect();
    let uniform = |x: f64| x.clamp(0.0, 1.0);
    assert!(ks_p_value(&even, uniform) > 0.99);
    let bent: Vec<f64> = even.iter().map(|x| x + 0.04 * x * (1.0 - x)).collect();
    assert!(ks_p_value(&bent, uniform) < 0.001);
    let few: Vec<f64> = bent.iter().step_by(1000).copied().collect();
    assert!(
        ks_p_value(&few, uniform) > 0.01,
        "a hundred samples do not tell"
    );
}
