//! How far the exact functions are from `f64`: each within the error that its documentation states. Run with
//! `--nocapture` for the table.

use glam::Vec3;
use motes::exact::*;
use motes::transcendental::*;

const STRATA: u32 = 1_000_000;

/// |got - want| in units in the last place of the `f32` nearest to `want`.
fn ulp_error(got: f32, want: f64) -> f64 {
    if want == 0.0 {
        return if got == 0.0 { 0.0 } else { f64::INFINITY };
    }
    let exponent = ((want.abs().to_bits() >> 52) as i32) - 1023;
    let error = (f64::from(got) - want).abs() / 2f64.powi(exponent - 23);
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Some 1,000,000 positive floats of `low ..= high`: one at random from each of as many equal ranges of bit patterns (so
/// every binade has its share), every power of two, and the five floats on either side of it and of both ends.
fn samples(low: f32, high: f32) -> impl Iterator<Item = f32> {
    let (first, last) = (low.to_bits(), high.to_bits());
    let width = (last - first) / STRATA + 1;
    let strata = (0..STRATA).map(move |i| {
        first
            .saturating_add(i.saturating_mul(width))
            .saturating_add(hash(i) % width)
    });
    let powers = (first >> 23..=(last >> 23) + 1).map(|exponent| exponent << 23);
    let corners = powers.chain([first, last]);
    let around = corners.flat_map(|bits| bits.saturating_sub(5)..=bits + 5);
    strata
        .chain(around)
        .filter(move |bits| (first..=last).contains(bits))
        .map(f32::from_bits)
}

/// A random word by another generator than the one under test (splitmix of Steele et al. 2014).
fn hash(index: u32) -> u32 {
    let mut z = (u64::from(index) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 32) as u32
}

/// Prints a row of the table, and fails where the largest error is above the documented `limit` in ULP.
fn measure(
    name: &str,
    limit: f64,
    range: &str,
    inputs: impl Iterator<Item = f32>,
    got: fn(f32) -> f32,
    want: fn(f64) -> f64,
) {
    let (mut worst, mut at, mut count) = (0.0, 0.0, 0);
    for x in inputs {
        let error = ulp_error(got(x), want(f64::from(x)));
        count += 1;
        if error > worst {
            (worst, at) = (error, x);
        }
    }
    report(name, limit, range, worst, &format!("{at:e}"), count);
}

fn report(name: &str, limit: f64, range: &str, worst: f64, at: &str, count: u32) {
    println!("{name:<20} {range:<30} {worst:6.3} ULP at {at:<14} of {count} samples");
    assert!(count > STRATA / 2, "{name}: only {count} samples");
    assert!(worst <= limit, "{name}({at}) is {worst} ULP off");
}

fn both_signs(inputs: impl Iterator<Item = f32>) -> impl Iterator<Item = f32> {
    inputs.flat_map(|x| [x, -x])
}

/// 2^n.
fn power(n: i32) -> f32 {
    2f32.powi(n)
}

/// sin(2π(t + quarters/4)) in f64, the argument reduced exactly before π comes in.
fn sine_f64(t: f64, quarters: i64) -> f64 {
    let nearest = (4.0 * t).round();
    let angle = std::f64::consts::TAU * (t - nearest / 4.0);
    match (nearest as i64 + quarters).rem_euclid(4) {
        0 => angle.sin(),
        1 => angle.cos(),
        2 => -angle.sin(),
        _ => -angle.cos(),
    }
}

#[test]
fn every_function_is_within_its_documented_error() {
    let all = || samples(SMALLEST, power(40));
    measure(
        "reciprocal",
        1.5,
        "2^-40 <= |x| <= 2^40",
        both_signs(all()),
        reciprocal,
        |x| 1.0 / x,
    );
    let squares = || samples(SMALLEST, power(80));
    measure(
        "inverse_square_root",
        1.5,
        "2^-40 <= x <= 2^80",
        squares(),
        inverse_square_root,
        |x| 1.0 / x.sqrt(),
    );
    measure(
        "square_root",
        2.0,
        "2^-40 <= x <= 2^80",
        squares(),
        square_root,
        f64::sqrt,
    );
    measure(
        "cube_root",
        1.5,
        "2^-40 <= x <= 2^40",
        all(),
        cube_root,
        f64::cbrt,
    );
    let angles = || both_signs(samples(SMALLEST, power(20)));
    measure(
        "sin_turns",
        2.0,
        "2^-40 <= |t| <= 2^20",
        angles(),
        sin_turns,
        |t| sine_f64(t, 0),
    );
    measure("cos_turns", 2.0, "|t| <= 2^20", angles(), cos_turns, |t| {
        sine_f64(t, 1)
    });
    let one_turn = || both_signs(samples(power(-4), 1.0));
    measure(
        "sin_turns",
        2.0,
        "1/16 <= |t| <= 1",
        one_turn(),
        sin_turns,
        |t| sine_f64(t, 0),
    );
    measure(
        "cos_turns",
        2.0,
        "1/16 <= |t| <= 1",
        one_turn(),
        cos_turns,
        |t| sine_f64(t, 1),
    );
    let exponents = samples(SMALLEST, 60.0)
        .chain(samples(SMALLEST, 40.0).map(|x| -x))
        .chain(samples(0.25, 40.0).map(|x| -x))
        .chain(samples(0.25, 60.0));
    measure(
        "exp2_exact",
        1.5,
        "-40 <= x <= 60",
        exponents,
        exp2_exact,
        |x| x.exp2(),
    );
    measure(
        "log2_exact",
        2.0,
        "2^-40 <= x <= 2^60",
        samples(SMALLEST, power(60)),
        log2_exact,
        f64::log2,
    );
    measure(
        "log2_exact",
        2.0,
        "1/2 <= x <= 2",
        samples(0.5, 2.0),
        log2_exact,
        f64::log2,
    );
}

/// Vectors whose components lie in 2^-40 .. 2^40, in the same binade, in neighbouring ones or anywhere.
fn vectors() -> impl Iterator<Item = Vec3> {
    (0..STRATA).map(|i| {
        let spread = [1, 3, 12, 80][(i % 4) as usize];
        let base = hash(4 * i) % (81 - spread);
        let component = |k: u32| {
            let exponent = 87 + base + hash(4 * i + k) % spread;
            let word = hash(!(4 * i + k));
            f32::from_bits((exponent << 23) | (word & 0x807f_ffff))
        };
        Vec3::new(component(1), component(2), component(3))
    })
}

#[test]
fn lengths_and_directions_are_within_3_ulp() {
    let (mut length_worst, mut length_at) = (0.0, Vec3::ZERO);
    let (mut unit_worst, mut unit_at) = (0.0, Vec3::ZERO);
    for v in vectors() {
        let [x, y, z] = v.to_array().map(f64::from);
        let length = (x * x + y * y + z * z).sqrt();
        let error = ulp_error(length3(v), length);
        if error > length_worst {
            (length_worst, length_at) = (error, v);
        }
        let unit = normalize_exact(v).to_array();
        for (got, component) in unit.into_iter().zip([x, y, z]) {
            let want = component / length;
            let error = if want.abs() < f64::from(SMALLEST) * 0.999_999 {
                ulp_error(got, 0.0)
            } else if want.abs() < f64::from(SMALLEST) * 1.000_001 {
                0.0 // on the edge of what is snapped to zero
            } else {
                ulp_error(got, want)
            };
            if error > unit_worst {
                (unit_worst, unit_at) = (error, v);
            }
        }
    }
    let range = "components 2^-40 .. 2^40";
    report(
        "length3",
        3.0,
        range,
        length_worst,
        &length_at.to_string(),
        STRATA,
    );
    report(
        "normalize_exact",
        3.0,
        range,
        unit_worst,
        &unit_at.to_string(),
        STRATA,
    );
}
