//! Rates of change that differ from particle to particle: Reeves (1983), section 2.3, further work.

use crate::common::statistics::{assert_uniform, mean, standard_deviation};
use crate::support::{Member, Run, assert_within, on_every_backend, scene};

/// Red, green, blue, transparency and size, far from where they are clamped.
const SPREAD: &str = "color = { mean = [0.5, 0.75, 1], var = [0.05, 0.05, 0.05], \
        rate = [0.01, -0.01, 0.02], rate_var = [0.005, 0.01, 0.015] }
    transparency = { mean = 0.5, var = 0.1, rate = 0.01, rate_var = 0.004 }
    size = { mean = 2, var = 0.5, rate = 0.05, rate_var = 0.03 }
    end_frame = 1\n generation_shape = { kind = \"circle\", radius = 20 }";
const RATES: [f64; 5] = [0.01, -0.01, 0.02, 0.01, 0.05];
const HALF_WIDTHS: [f64; 5] = [0.005, 0.01, 0.015, 0.004, 0.03];
const NAMES: [&str; 5] = ["red", "green", "blue", "transparency", "size"];

fn looks(members: &[Member]) -> Vec<[f64; 5]> {
    let look = |member: &Member| {
        let look = member.drawn;
        let [red, green, blue] = look.color.to_array().map(f64::from);
        [
            red,
            green,
            blue,
            f64::from(look.transparency),
            f64::from(look.size),
        ]
    };
    members.iter().map(look).collect()
}

/// What particles born in frame 0 look like after frames 0, 7 and 15.
fn changes(count: u32, lines: &str) -> [Vec<[f64; 5]>; 3] {
    let lines = format!("initial_mean_parts = {count}\n{lines}");
    let mut run = Run::new("cpu", &scene("", &[&lines]), 16);
    [0, 7, 15].map(|frame| {
        run.step_to(frame);
        let members = run.members();
        assert_eq!(members.len(), count as usize);
        looks(&members)
    })
}

fn rates_of([first, _, last]: &[Vec<[f64; 5]>; 3]) -> Vec<[f64; 5]> {
    let rate = |(a, b): (&[f64; 5], &[f64; 5])| std::array::from_fn(|i| (b[i] - a[i]) / 15.0);
    first.iter().zip(last).map(rate).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let (a0, b0) = (mean(a), mean(b));
    let sum: f64 = a.iter().zip(b).map(|(a, b)| (a - a0) * (b - b0)).sum();
    sum / (a.len() as f64 * standard_deviation(a) * standard_deviation(b))
}

#[test]
fn r26_rates_are_uniform_about_their_systems() {
    let seen = changes(100_000, SPREAD);
    let rates = rates_of(&seen);
    for i in 0..5 {
        let of: Vec<f64> = rates.iter().map(|rate| rate[i]).collect();
        let [low, high] = [RATES[i] - HALF_WIDTHS[i], RATES[i] + HALF_WIDTHS[i]];
        let slack = 3e-8;
        assert!(
            of.iter()
                .all(|rate| (low - slack..=high + slack).contains(rate)),
            "{}",
            NAMES[i]
        );
        assert_uniform(NAMES[i], &of, low, high);
    }
    // A particle keeps its rate.
    for ((rate, first), later) in rates.iter().zip(&seen[0]).zip(&seen[1]) {
        for i in 0..5 {
            let off = later[i] - first[i] - 7.0 * rate[i];
            assert!(off.abs() < 1e-6, "{}: off by {off}", NAMES[i]);
        }
    }
    // And each of the five, and of the values at birth, is drawn by itself.
    let drawn: Vec<Vec<f64>> = (0..10)
        .map(|i| match i {
            0..5 => rates.iter().map(|rate| rate[i]).collect(),
            // The value before the first step.
            _ => {
                let births = seen[0].iter().zip(&rates);
                births
                    .map(|(first, rate)| first[i - 5] - rate[i - 5])
                    .collect()
            }
        })
        .collect();
    for a in 0..10 {
        for b in 0..a {
            let r = correlation(&drawn[a], &drawn[b]);
            assert!(r.abs() < 4.0 / 1e5f64.sqrt(), "{a} and {b}: {r}");
        }
    }
}

#[test]
fn r25_without_half_widths_all_have_the_systems_rate() {
    let lines =
        "color = { mean = [0.5, 0.75, 1], var = [0.05, 0.05, 0.05], rate = [0.01, -0.01, 0.02] }
        transparency = { mean = 0.5, var = 0.1, rate = 0.01 }
        size = { mean = 2, var = 0.5, rate = 0.05 }\n end_frame = 1";
    for rate in rates_of(&changes(2000, lines)) {
        for i in 0..5 {
            let off = (rate[i] - RATES[i]).abs();
            assert!(off < 1e-7, "{}: {}, off by {off:e}", NAMES[i], rate[i]);
        }
    }
}

#[test]
fn r26_the_picture_shows_each_particles_rate() {
    // Three squares of one system: their light is the sum of 4 size^2 (1 - transparency) colour.
    let lines = format!("{SPREAD}\n initial_mean_parts = 3\n particle_shape = \"rectangle\"");
    let lights: Vec<f64> = {
        // What all would have at the system's rate, which must not do.
        let plain = lines
            .replace("rate_var = [0.005, 0.01, 0.015]", "rate_var = [0, 0, 0]")
            .replace("rate_var = 0.004", "rate_var = 0")
            .replace("rate_var = 0.03", "rate_var = 0");
        let mut run = Run::new("cpu", &scene("", &[&plain]), 16);
        run.step_to(15);
        let light = run.light();
        (0..3).map(|channel| light.total(channel)).collect()
    };
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene("", &[&lines]), 16);
        run.step_to(0);
        let first = looks(&run.members());
        run.step_to(15);
        let last = looks(&run.members());
        assert_eq!((first.len(), last.len()), (3, 3));
        for pair in first.windows(2).zip(last.windows(2)) {
            for (i, name) in NAMES.into_iter().enumerate() {
                let rate = |at: usize| pair.1[at][i] - pair.0[at][i];
                let apart = (rate(0) - rate(1)).abs() / 15.0;
                assert!(apart > 1e-5, "{name}: two particles have one rate");
            }
        }
        let light = run.light();
        for channel in 0..3 {
            let of = |look: &[f64; 5]| 4.0 * look[4] * look[4] * (1.0 - look[3]) * look[channel];
            let expected: f64 = last.iter().map(of).sum();
            assert_within(NAMES[channel], light.total(channel), expected, 1e-4);
            let plain = lights[channel] / expected - 1.0;
            assert!(plain.abs() > 1e-3, "another seed: {plain}");
        }
    });
}
