//! The spectrum of many octaves, and scales along each axis: Perry (1994), 2.1.2.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::flow::{Winds, correlation, field, place, unit};
use crate::transform::power;

/// Samples a unit and units along a line: the finest of eight octaves has 2 x 2^7 cycles a unit.
const RATE: usize = 512;
const LENGTH: usize = 64;
const LINES: u32 = 16;

/// Mean power of one component of a wind along lines of the x axis, by waves a line.
fn power_along_x(winds: &Winds, component: usize, rate: usize) -> Vec<f64> {
    let flow = field(winds, 0);
    let spectra: Vec<Vec<f64>> = (0..LINES)
        .into_par_iter()
        .map(|line| {
            let (y, z) = (32.0 * unit(line, 0) - 16.0, 32.0 * unit(line, 1) - 16.0);
            let sample = |at: usize| {
                let x = at as f64 / rate as f64 - 0.5 * LENGTH as f64 + unit(line, 2);
                flow(DVec3::new(x, y, z).as_vec3())[component]
            };
            power(&(0..LENGTH * rate).map(sample).collect::<Vec<_>>())
        })
        .collect();
    let mean = |at: usize| spectra.iter().map(|one| one[at]).sum::<f64>() / f64::from(LINES);
    (0..spectra[0].len()).map(mean).collect()
}

/// Slope of the noise's own power over frequency, log over log, from 1 to 32 cycles a unit.
///
/// The wind along x is the noise's slope along x: at frequency f, its power is (2 pi f)^2 times the
/// noise's.
fn measured_slope(beta: f64, absolute: bool) -> f64 {
    let winds = Winds::new(&[&format!(
        "{{ kind = \"noise\", strength = 1, octaves = 8, spectrum_exponent = {beta}, \
         absolute = {absolute} }}"
    )]);
    let power = power_along_x(&winds, 0, RATE);
    let of_noise = |at: usize| {
        let frequency = at as f64 / LENGTH as f64;
        power[at] / (TAU * frequency).powi(2)
    };
    // Quarters of octaves, each by its mean.
    let points: Vec<(f64, f64)> = (0..20)
        .map(|bin| {
            let edge = |bin: i32| (LENGTH as f64 * 2f64.powf(f64::from(bin) / 4.0)) as usize;
            let bin_range = edge(bin)..edge(bin + 1);
            let count = bin_range.len() as f64;
            let mean = bin_range.map(of_noise).sum::<f64>() / count;
            ((f64::from(bin) + 0.5) / 4.0, mean.log2())
        })
        .collect();
    let count = points.len() as f64;
    let middle = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (middle(|p| p.0), middle(|p| p.1));
    let rise: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let run: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    rise / run
}

#[test]
fn p13_octaves_of_noise_have_the_spectrum_asked_for() {
    for beta in [1.0, 5.0 / 3.0, 2.0, 3.0, 11.0 / 3.0, 5.0] {
        let slope = measured_slope(beta, false);
        println!("1/f^{beta:.3}: slope {slope:.3}");
        assert!((slope + beta).abs() <= 0.2, "1/f^{beta}: slope {slope}");
    }
}

/// The same of folded octaves, sum of |noise| (Perlin's turbulence). A fold has a spectrum of its own,
/// 1/f^4, which none can be steeper than; and folding moves power downward, to twice the size of
/// the eddies, which makes flat spectra steeper. From 5/3 to 11/3 it makes no difference.
#[test]
fn p13_folded_octaves_have_it_between_white_and_that_of_a_fold() {
    for beta in [5.0 / 3.0, 2.0, 3.0, 11.0 / 3.0] {
        let slope = measured_slope(beta, true);
        println!("folded, 1/f^{beta:.3}: slope {slope:.3}");
        assert!((slope + beta).abs() <= 0.2, "1/f^{beta}: slope {slope}");
    }
    let (flat, steep) = (measured_slope(1.0, true), measured_slope(6.0, true));
    println!("folded, 1/f: slope {flat:.3}; 1/f^6: {steep:.3}");
    assert!((-1.5..-1.0).contains(&flat), "{flat}");
    assert!((-4.5..-3.8).contains(&steep), "{steep}");
}

/// How far along an axis the wind is half as it was.
fn half_length(flow: &(dyn Fn(Vec3) -> DVec3 + Sync), axis: Vec3) -> f64 {
    let (mut low, mut high) = (0.0f32, 20.0f32);
    for _ in 0..16 {
        let middle = 0.5 * (low + high);
        let pair = |at| {
            let here = place(at, 200.0);
            (flow(here), flow(here + middle * axis))
        };
        if correlation(20_000, pair) > 0.5 {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::from(low)
}

#[test]
fn p15_eddies_are_as_long_along_each_axis_as_its_scale_says() {
    for (octaves, scale) in [(1, [0.25, 1.0, 2.0]), (3, [3.0, 0.5, 1.0])] {
        let winds = Winds::new(&[&format!(
            "{{ kind = \"noise\", strength = 1, octaves = {octaves}, scale = {scale:?} }}"
        )]);
        let flow = field(&winds, 0);
        let lengths = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| half_length(&flow, axis));
        let cells = [0, 1, 2].map(|at| lengths[at] * scale[at]);
        println!("scales {scale:?}: lengths {lengths:.3?}, in cells {cells:.3?}");
        for at in [1, 2] {
            assert!((cells[at] / cells[0] - 1.0).abs() < 0.05, "{cells:?}");
        }
    }
}

#[test]
fn p15_octaves_bound_the_smallest_eddies() {
    // All octaves of one power, so that the last one is seen.
    let share_above = |octaves: u32, frequency: usize| {
        let winds = Winds::new(&[&format!(
            "{{ kind = \"noise\", strength = 1, octaves = {octaves}, spectrum_exponent = 3 }}"
        )]);
        let power = power_along_x(&winds, 1, 64);
        let above: f64 = power[LENGTH * frequency..].iter().sum();
        above / power.iter().sum::<f64>()
    };
    for octaves in 1..=4 {
        // Along a line, one octave has next to nothing above 1 cycle a unit; the next doubles that.
        let limit = 1 << (octaves - 1);
        let (above, with_one_more) = (share_above(octaves, limit), share_above(octaves + 1, limit));
        println!("{octaves} octaves: {above:.5} above {limit}, with one more {with_one_more:.5}");
        assert!(above < 0.002, "{above}");
        assert!(with_one_more > 0.02, "{with_one_more}");
    }
}
