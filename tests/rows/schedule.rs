//! When births happen, and how many then: Reeves (1983), section 2.1 and its further work.

use motes::plan::{Plan, Stage};
use motes::scene::Scene;

use crate::common;
use crate::common::statistics::{assert_uniform, mean, standard_deviation};
use crate::support::{Run, on_every_backend, scene};

/// Births by frame from the stage of births alone, of every system.
fn births_of(scene: &Scene, frames: impl Iterator<Item = u32>) -> Vec<Vec<u32>> {
    use motes::backend::Backend;
    let plan = Plan::new(scene, 1).expect("the scene can be planned");
    let mut backend = common::on_cpu(&plan);
    let births = |frame| {
        let inputs = plan.inputs(frame);
        let done = backend.run_stage(Stage::Births, &inputs);
        done.expect("births can be found");
        backend.read("birth_counts").expect("births can be read")
    };
    frames.map(births).collect()
}

/// Births in each frame below `frame_end` of one system.
fn births_by_frame(on: &str, lines: &str, frame_end: u32) -> Vec<u32> {
    let scene = scene("", &[&format!("lifetime = 2\n{lines}")]);
    let mut run = Run::new(on, &scene, frame_end);
    run.step_to(frame_end - 1);
    let lines = run.statistics();
    assert!(lines.iter().all(|line| line.dropped == 0));
    lines.iter().map(|line| line.born).collect()
}

#[test]
fn r9_the_mean_is_a_cubic_of_the_frame() {
    let lines = "first_frame = 2\n initial_mean_parts = 40\n delta_mean_parts = 12
        quadratic_mean_parts = -2.25\n cubic_mean_parts = 0.125";
    let by_area = "first_frame = 2\n initial_mean_parts_per_area = 0.5
        delta_mean_parts_per_area = 0.25\n quadratic_mean_parts_per_area = -0.0625
        cubic_mean_parts_per_area = 0.0078125
        generation_shape = { kind = \"circle\", radius = 10 }";
    let polynomial = |[a, b, c, d]: [f64; 4], e: f64| a + b * e + c * e * e + d * e * e * e;
    on_every_backend(|on| {
        let births = births_by_frame(on, lines, 24);
        assert_eq!(births[..2], [0, 0]);
        for (elapsed, &count) in births[2..].iter().enumerate() {
            let expected = polynomial([40.0, 12.0, -2.25, 0.125], elapsed as f64);
            let expected = (expected + 0.5).floor().max(0.0);
            assert_eq!(f64::from(count), expected, "{elapsed} frames on");
        }
        // A disc's middle, 10 pixels in radius.
        let births = births_by_frame(on, by_area, 12);
        let area = 100.0 * std::f64::consts::PI;
        for (elapsed, &count) in births[2..].iter().enumerate() {
            let expected = polynomial([0.5, 0.25, -0.0625, 0.0078125], elapsed as f64) * area;
            assert!(
                (f64::from(count) - expected).abs() <= 0.6 + 1e-4 * expected,
                "{elapsed} frames on: {count}, expected {expected}"
            );
        }
    });
}

#[test]
fn r9_the_half_width_is_a_cubic_of_the_frame() {
    // 1,000 systems and 100 seeds draw 100,000 births in each frame.
    let systems: Vec<String> = (0..1000)
        .map(|number| {
            format!(
                "name = \"s{number}\"\n initial_mean_parts = 4_000_000\n var_parts = 1_000_000
                delta_var_parts = 100_000\n quadratic_var_parts = -40_000
                cubic_var_parts = 1_000"
            )
        })
        .collect();
    let systems: Vec<&str> = systems.iter().map(String::as_str).collect();
    let mut scene = scene("capacity = 1", &systems);
    let frames = [0, 3, 5, 6, 20];
    let mut drawn = vec![Vec::new(); frames.len()];
    for seed in 0..100 {
        scene.seed = seed;
        for (drawn, births) in drawn.iter_mut().zip(births_of(&scene, frames.into_iter())) {
            drawn.extend(births.into_iter().map(f64::from));
        }
    }
    for (drawn, frame) in drawn.iter().zip(frames) {
        let e = f64::from(frame);
        let half_width = 1e6 + 1e5 * e - 4e4 * e * e + 1e3 * e * e * e;
        if half_width <= 0.0 {
            assert!(
                drawn.iter().all(|&count| count == 4e6),
                "no spread in {frame}"
            );
            continue;
        }
        let [low, high] = [4e6 - half_width, 4e6 + half_width];
        assert_uniform(&format!("births in frame {frame}"), drawn, low, high);
        assert!(drawn.iter().all(|count| (low..=high).contains(count)));
    }
}

#[test]
fn r9_the_mean_follows_its_keys() {
    let keys = "[[3, 100], [11, 260], [19, 20]]";
    let keyed = |how: &str| {
        format!(
            "initial_mean_parts = {{ keys = {keys}, interpolation = \"{how}\" }}
            delta_mean_parts = 1"
        )
    };
    let linear = |frame: f64| {
        if frame < 11.0 {
            100.0 + 20.0 * (frame - 3.0).max(0.0)
        } else {
            260.0 - 30.0 * (frame.min(19.0) - 11.0)
        }
    };
    let step = |frame: f64| match frame {
        frame if frame < 11.0 => 100.0,
        frame if frame < 19.0 => 260.0,
        _ => 20.0,
    };
    // Level at all three keys: the slope changes its sign at the middle one.
    let smooth = |frame: f64| {
        let ease = |t: f64| t * t * (3.0 - 2.0 * t);
        let up = ease(((frame - 3.0) / 8.0).clamp(0.0, 1.0));
        let down = ease(((frame - 11.0) / 8.0).clamp(0.0, 1.0));
        100.0 + 160.0 * up - 240.0 * down
    };
    on_every_backend(|on| {
        let ways: [(&str, &dyn Fn(f64) -> f64); 3] =
            [("linear", &linear), ("step", &step), ("smooth", &smooth)];
        for (how, mean) in ways {
            for (frame, &count) in births_by_frame(on, &keyed(how), 24).iter().enumerate() {
                // Each frame adds one besides.
                let expected = (mean(frame as f64) + frame as f64 + 0.5).floor();
                assert_eq!(f64::from(count), expected, "{how}, frame {frame}");
            }
        }
    });
}

#[test]
fn r9_a_wandering_mean_is_smooth_and_bounded_and_keeps_its_mean() {
    const FRAMES: u32 = 60_000;
    let share = 0.5;
    let wandering = |name: &str, frames: u32| -> Vec<f64> {
        let lines = format!(
            "name = \"{name}\"\n initial_mean_parts = 1_000_000\n mean_parts_wander = {share}
            mean_parts_wander_frames = {frames}"
        );
        let births = births_of(&scene("capacity = 1", &[&lines]), 0..FRAMES).concat();
        let strayed = |count: u32| (f64::from(count) / 1e6 - 1.0) / share;
        births.into_iter().map(strayed).collect()
    };
    let changes = |strayed: &[f64]| -> Vec<f64> {
        strayed.windows(2).map(|pair| pair[1] - pair[0]).collect()
    };
    let rms =
        |values: &[f64]| (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt();
    let (quick, slow) = (wandering("one", 24), wandering("one", 240));
    for strayed in [&quick, &slow] {
        assert!(strayed.iter().all(|value| value.abs() <= 1.0 + 2e-6));
        assert!(standard_deviation(strayed) > 0.2, "it hardly wanders");
    }
    // Means of stretches of 50 times as long are independent; 4 sigma.
    let stretches: Vec<f64> = quick.chunks_exact(1200).map(mean).collect();
    let sigma = standard_deviation(&stretches) / (stretches.len() as f64).sqrt();
    let center = mean(&quick);
    println!("mean {center:.4}, sigma {sigma:.4}");
    assert!(sigma < 0.03 && center.abs() <= 4.0 * sigma, "{center}");
    // Smooth: ten times as slow is a tenth of the change, and a hundredth of the change's change.
    let (first, slow_first) = (changes(&quick), changes(&slow));
    let ratio = rms(&first) / rms(&slow_first);
    assert!((8.0..12.5).contains(&ratio), "changes {ratio} times");
    let most = first.iter().map(|change| change.abs()).fold(0.0, f64::max);
    assert!(most < 8.0 / 24.0, "a jump of {most}");
    // And it does forget: far apart there is nothing left in common.
    let pairs: f64 = quick.windows(10 * 24).map(|w| w[0] * w[239]).sum();
    let left = pairs / (rms(&quick).powi(2) * f64::from(FRAMES));
    assert!(left.abs() < 0.15, "correlation {left} ten spans apart");
    // Another system wanders in its own way.
    let other = wandering("other", 24);
    let common: f64 = quick.iter().zip(&other).map(|(a, b)| a * b).sum();
    let common = common / (rms(&quick) * rms(&other) * f64::from(FRAMES));
    assert!(common.abs() < 0.15, "correlation {common} between systems");

    let lines =
        "initial_mean_parts = 1000\n mean_parts_wander = 0.5\n mean_parts_wander_frames = 6";
    let expected = births_of(&scene("", &[lines]), 0..40).concat();
    on_every_backend(|on| assert_eq!(births_by_frame(on, lines, 40), expected, "{on}"));
}

#[test]
fn bursts_are_born_in_one_frame() {
    let bursts =
        "[{ frame = 4, parts = 100 }, { frame = 7, parts = 50 }, { frame = 7, parts = 25 }]";
    let lines = format!("initial_mean_parts = 3\n burst = {bursts}");
    let alone = "initial_mean_parts = 0\n burst = [{ frame = 4, parts = 100 }]";
    // Births by area and a burst: the burst is a number of particles.
    let by_area = "initial_mean_parts_per_area = 0.01\n burst = [{ frame = 1, parts = 500 }]
        generation_shape = { kind = \"sphere\", radius = 8 }";
    on_every_backend(|on| {
        let mut expected = [3; 12];
        (expected[4], expected[7]) = (103, 78);
        assert_eq!(births_by_frame(on, &lines, 12), expected);
        let mut expected = [0; 12];
        expected[4] = 100;
        assert_eq!(births_by_frame(on, alone, 12), expected);
        assert_eq!(births_by_frame(on, by_area, 4), [2, 502, 2, 2]);
    });
    // Outside of first_frame .. end_frame, too.
    let early = "first_frame = 6\n end_frame = 8\n initial_mean_parts = 2
        burst = [{ frame = 3, parts = 9 }, { frame = 10, parts = 8 }]";
    let expected = [0, 0, 0, 9, 0, 0, 2, 2, 0, 0, 8, 0];
    assert_eq!(births_by_frame("cpu", early, 12), expected);
}

#[test]
fn a_bursts_size_is_uniform_about_its_mean() {
    let systems: Vec<String> = (0..1000)
        .map(|number| {
            format!(
                "name = \"s{number}\"\n initial_mean_parts = 0
                burst = [{{ frame = 2, parts = {{ mean = 500_000, var = 300_000 }} }}]"
            )
        })
        .collect();
    let systems: Vec<&str> = systems.iter().map(String::as_str).collect();
    let mut scene = scene("capacity = 1", &systems);
    let mut drawn = Vec::new();
    for seed in 0..100 {
        scene.seed = seed;
        drawn.extend(births_of(&scene, 2..3).concat().into_iter().map(f64::from));
    }
    assert_uniform("burst", &drawn, 200_000.0, 800_000.0);
}

#[test]
fn triggers_begin_a_system_anew() {
    let lines = "trigger_frames = [5, 11, 20]\n first_frame = 2\n end_frame = 8
        initial_mean_parts = 10\n delta_mean_parts = 5\n burst = [{ frame = 0, parts = 100 }]";
    let expected = |frame: u32| {
        // The last trigger at or before the frame counts alone.
        let elapsed = match frame {
            0..5 => return 0,
            5..11 => frame - 5,
            11..20 => frame - 11,
            _ => frame - 20,
        };
        let burst = if elapsed == 0 { 100 } else { 0 };
        let steady = match elapsed {
            2..8 => 10 + 5 * (elapsed - 2),
            _ => 0,
        };
        burst + steady
    };
    let expected: Vec<u32> = (0..32).map(expected).collect();
    on_every_backend(|on| assert_eq!(births_by_frame(on, lines, 32), expected, "{on}"));
}
