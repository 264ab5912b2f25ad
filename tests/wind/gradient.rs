//! The noise and its gradient: Perry (1994), 3.2.3, footnote 4.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, Vec3};
use motes::noise::{CONSTANTS, PERIOD, noise};
use rayon::prelude::*;

use crate::common::hash;
use crate::flow::{direction, dyadic_place, place};
use crate::transform::{transform, window};

fn gradient_at(p: Vec3, key: u32) -> DVec3 {
    noise(p, key).truncate().as_dvec3()
}

fn value_at(p: Vec3, key: u32) -> f64 {
    f64::from(noise(p, key).w)
}

#[test]
fn p38_the_gradient_is_that_of_the_value() {
    // Steps and places are exact, so that differences have only the value's own rounding.
    const STEP: f32 = 1.0 / 256.0;
    let mut worst: f64 = 0.0;
    for at in 0..100_000 {
        let (p, key) = (dyadic_place(at, 64.0), hash(at / 100));
        let along = |axis: Vec3| {
            let rise = value_at(p + axis * STEP, key) - value_at(p - axis * STEP, key);
            rise / (2.0 * f64::from(STEP))
        };
        let differences = DVec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z));
        let gradient = gradient_at(p, key);
        let off = (gradient - differences).length() / gradient.length().max(0.1);
        worst = worst.max(off);
        assert!(off < 1e-2, "at {p}: {gradient}, differences {differences}");
    }
    println!("off by at most {:.3} %", worst * 100.0);
}

/// E f(r)^2 of a sum of kernels over the corners, two a cell, integrated over a kernel's ball.
fn mean_square(kernel_square: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 100_000;
    let reach = 0.5f64.sqrt();
    let width = reach / f64::from(STEPS);
    let shell = |at: u32| {
        let r = (f64::from(at) + 0.5) * width;
        4.0 * PI * r * r * kernel_square(r) * width
    };
    2.0 * (0..STEPS).map(shell).sum::<f64>()
}

#[test]
fn p38_the_root_mean_square_of_the_gradient_is_1() {
    const COUNT: u32 = 1_000_000;
    let sample = |at: u32| noise(place(at, 1000.0), hash(at / 1000)).as_dvec4();
    let sum = (0..COUNT).into_par_iter().map(|at| {
        let sample = sample(at);
        let g = sample.truncate();
        (
            g * g,
            DVec3::new(g.x * g.y, g.y * g.z, g.z * g.x),
            g,
            sample.w,
            sample.w * sample.w,
        )
    });
    let zero = || (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, 0.0, 0.0);
    let sums = sum.reduce(zero, |a, b| {
        (a.0 + b.0, a.1 + b.1, a.2 + b.2, a.3 + b.3, a.4 + b.4)
    });
    let n = f64::from(COUNT);
    let (squares, products, mean) = (sums.0 / n, sums.1 / n, sums.2 / n);
    let root_mean_square = squares.element_sum().sqrt();
    let deviation = (sums.4 / n - (sums.3 / n).powi(2)).sqrt();
    println!("gradient: rms {root_mean_square:.6}, squares {squares:.5}, products {products:.5}");
    println!("value: mean {:.6}, deviation {deviation:.6}", sums.3 / n);
    assert!((root_mean_square - 1.0).abs() < 0.01);
    assert!(
        (squares * 3.0 - 1.0).abs().max_element() < 0.01,
        "{squares}"
    );
    assert!(products.abs().max_element() < 0.003, "{products}");
    assert!(mean.abs().max_element() < 0.003, "{mean}");

    // Closed forms: t^4 (g . d) with t = 1/2 - r^2 in cells of two units, g in 1024 even steps.
    let component = (1024f64.powi(2) - 1.0) / 12.0 / 1024f64.powi(2);
    let t = |r: f64| 0.5 - r * r;
    let of_value = mean_square(|r| t(r).powi(8) * r * r) * component;
    let of_gradient = mean_square(|r| {
        let t = t(r);
        3.0 * t.powi(8) - 16.0 * t.powi(7) * r.powi(2) + 64.0 * t.powi(6) * r.powi(4)
    }) * component;
    let expected = of_value.sqrt() / (0.5 * of_gradient.sqrt());
    let gain = 2.0 / of_gradient.sqrt();
    println!("closed forms: gain {gain:.5}, deviation {expected:.6}");
    let named =
        |(name, bits): &(&str, u32)| (*name == "GRADIENT_GAIN").then(|| f32::from_bits(*bits));
    let in_code = CONSTANTS
        .iter()
        .find_map(named)
        .expect("the noise has a gain");
    assert!(
        (f64::from(in_code) / gain - 1.0).abs() < 1e-6,
        "{in_code} and {gain}"
    );
    assert!((deviation / expected - 1.0).abs() < 0.005);
}

/// Share of the power of the noise's value between two frequencies, cycles a unit.
fn share_between(low: f64, high: f64) -> f64 {
    const SIDE: usize = 128;
    const RATE: f64 = 8.0;
    let spectra = (0..3u32).into_par_iter().map(|cube| {
        let corner = place(cube, 500.0);
        let sample = |[x, y, z]: [usize; 3]| {
            let at = Vec3::new(x as f32, y as f32, z as f32) / RATE as f32;
            let weight = window(x, SIDE) * window(y, SIDE) * window(z, SIDE);
            weight * value_at(corner + at, hash(cube))
        };
        let places = |at: usize| [at % SIDE, at / SIDE % SIDE, at / SIDE / SIDE];
        let mut waves: Vec<DVec2> = (0..SIDE * SIDE * SIDE)
            .map(|at| DVec2::new(sample(places(at)), 0.0))
            .collect();
        // Along each axis in turn; axes go round, so that the last is the first again.
        for _ in 0..3 {
            let mut turned = vec![DVec2::ZERO; waves.len()];
            for (row, line) in waves.chunks(SIDE).enumerate() {
                for (at, wave) in transform(line).into_iter().enumerate() {
                    turned[at * SIDE * SIDE + row] = wave;
                }
            }
            waves = turned;
        }
        let frequency = |at: usize| (at.min(SIDE - at) as f64) * RATE / SIDE as f64;
        let mut sums = (0.0, 0.0);
        for (at, wave) in waves.iter().enumerate() {
            let [x, y, z] = places(at).map(frequency);
            let radius = DVec3::new(x, y, z).length();
            sums.0 += wave.length_squared();
            if (low..=high).contains(&radius) {
                sums.1 += wave.length_squared();
            }
        }
        sums
    });
    let sums = spectra.reduce(|| (0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
    sums.1 / sums.0
}

#[test]
fn p38_the_power_is_between_a_quarter_and_two_cycles_a_unit() {
    let outside = 1.0 - share_between(0.25, 2.0);
    println!("{:.3} % outside", outside * 100.0);
    assert!(outside < 0.05, "{outside}");
}

#[test]
fn p38_no_direction_is_another() {
    // The value half a unit away, along axes and diagonals of the lattice, and any other way.
    let named = [
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
        DVec3::ONE,
        DVec3::new(1.0, -1.0, 0.0),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(-1.0, 2.0, 0.5),
    ];
    let directions = named
        .into_iter()
        .map(DVec3::normalize)
        .chain((0..5).map(direction));
    let correlations: Vec<f64> = directions
        .map(|direction| {
            let there = (0.5 * direction).as_vec3();
            let (mut product, mut square) = (0.0, 0.0);
            for at in 0..100_000 {
                let (p, key) = (place(at, 500.0), hash(at / 100));
                let (here, there) = (value_at(p, key), value_at(p + there, key));
                product += here * there;
                square += 0.5 * (here * here + there * there);
            }
            product / square
        })
        .collect();
    println!("{correlations:.4?}");
    for correlation in &correlations {
        assert!(
            (correlation - correlations[0]).abs() < 0.01,
            "{correlations:?}"
        );
    }
}

#[test]
fn p38_there_are_no_seams() {
    // A jump at a border would stay as the steps over it become smaller.
    let largest_change = |step: f64| {
        let changes = (0..200u32).into_par_iter().map(|line| {
            let (start, direction) = (place(line, 20.0).as_dvec3(), direction(line));
            let at = |i: u32| noise((start + direction * step * f64::from(i)).as_vec3(), line);
            let change = |i: u32| (at(i + 1) - at(i)).length();
            // About ten cells of a line, each with many borders.
            (0..(20.0 / step) as u32 / 8)
                .map(change)
                .fold(0.0, f32::max)
        });
        f64::from(changes.reduce(|| 0.0, f32::max)) / step
    };
    let (coarse, fine) = (largest_change(1.0 / 64.0), largest_change(1.0 / 2048.0));
    println!("steepest: {coarse:.2} a unit in coarse steps, {fine:.2} in fine ones");
    assert!(coarse > 1.0, "something changes");
    // 20 a unit in steps of 1/2048 is 0.01: no jump is as large as that.
    assert!(fine < 20.0 && fine < 1.5 * coarse, "{fine} and {coarse}");
}

#[test]
fn p38_the_noise_repeats_after_its_period() {
    let period = PERIOD as f32;
    let mut differs = 0;
    for at in 0..20_000 {
        let p = dyadic_place(at, 30.0);
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            let (here, there) = (noise(p, 5), noise(p + axis * period, 5));
            // So far away, corners are known to a thousandth.
            assert!((here - there).abs().max_element() < 0.03, "at {p}, {axis}");
            let sooner = noise(p + axis * (0.5 * period), 5);
            differs += u32::from((here - sooner).abs().max_element() > 0.2);
        }
    }
    assert!(
        differs > 50_000,
        "{differs} of 60,000 differ after half of it"
    );
}

#[test]
fn p38_keys_make_other_noises() {
    for (a, b) in [
        (0, 1),
        (7, 0x8000_0007),
        (1, 0x9e37_79b9),
        (3, 3 + 0x85eb_ca6b),
    ] {
        let (mut product, mut square) = (0.0, 0.0);
        for at in 0..50_000 {
            let p = place(at, 300.0);
            let (one, other) = (gradient_at(p, a), gradient_at(p, b));
            product += one.dot(other);
            square += 0.5 * (one.length_squared() + other.length_squared());
        }
        let correlation: f64 = product / square;
        println!("keys {a} and {b}: {correlation:.4}");
        assert!(correlation.abs() < 0.02);
    }
}
