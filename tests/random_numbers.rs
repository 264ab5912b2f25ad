//! The hash that every particle's attributes come from, and its bits as floats.

use glam::UVec4;
use motes::rng::{pcg4d, signed_float, signed4, unit_float, unit4};

/// 99.9 % quantile of the chi-square distribution with `degrees` of freedom (Wilson and Hilferty 1931; good to 0.1 % here).
fn chi_square_limit(degrees: f64) -> f64 {
    let normal_quantile = 3.090_232_306_167_813_5;
    let step = 2.0 / (9.0 * degrees);
    degrees * (1.0 - step + normal_quantile * step.sqrt()).powi(3)
}

/// Sum of (observed - expected)²/expected over equally likely cells.
fn chi_square(counts: &[u32]) -> f64 {
    let draws: u32 = counts.iter().sum();
    let expected = f64::from(draws) / counts.len() as f64;
    let square = |&count: &u32| (f64::from(count) - expected).powi(2) / expected;
    counts.iter().map(square).sum()
}

#[test]
fn r71_uniform_draws_pass_chi_square() {
    // 1,000,000 draws as emission makes them: system key, birth frame, index in frame, stream number.
    const KEYS: u32 = 250_000;
    let words: Vec<UVec4> = (0..KEYS)
        .map(|i| pcg4d(UVec4::new(0x5eed, i / 5_000, i % 5_000, 3)))
        .collect();
    let draws: Vec<[f32; 4]> = words.iter().map(|&w| unit4(w).to_array()).collect();

    let mut cells = vec![0; 1024];
    let mut fine_cells = vec![0; 1024];
    for &u in draws.iter().flatten() {
        cells[(u * 1024.0) as usize] += 1;
        // The last 10 of the 24 bits: no bit of a draw is worse than the others.
        fine_cells[(u * 16_777_216.0) as usize % 1024] += 1;
    }
    let limit = chi_square_limit(1023.0);
    for (name, counts) in [("upper bits", &cells), ("lower bits", &fine_cells)] {
        let got = chi_square(counts);
        println!("1,000,000 draws, {name}, 1023 degrees: {got:.1}, limit {limit:.1}");
        assert!(got < limit, "{name}: {got} is above {limit}");
        assert!(got > 800.0, "{name}: {got}, too even to be random");
    }

    // Pairs: the four words of one hash among themselves, and each word with that of the next index.
    let pairs_of_words = (0..4).flat_map(|a| (a + 1..4).map(move |b| (a, b)));
    for (a, b) in pairs_of_words {
        let pairs = draws.iter().map(|u| (u[a], u[b]));
        assert_pairs_are_uniform(&format!("words {a} and {b}"), pairs);
    }
    for word in 0..4 {
        let pairs = draws.windows(2).map(|u| (u[0][word], u[1][word]));
        assert_pairs_are_uniform(&format!("word {word} of neighbours"), pairs);
    }
}

fn assert_pairs_are_uniform(name: &str, pairs: impl Iterator<Item = (f32, f32)>) {
    let mut counts = vec![0; 32 * 32];
    for (a, b) in pairs {
        counts[(a * 32.0) as usize * 32 + (b * 32.0) as usize] += 1;
    }
    let (got, limit) = (chi_square(&counts), chi_square_limit(1023.0));
    println!("pairs, {name}, 1023 degrees: {got:.1}, limit {limit:.1}");
    assert!(got < limit, "{name}: {got} is above {limit}");
}

#[test]
fn chi_square_finds_a_biased_generator() {
    // One draw in thirty forced into the lower half must show.
    let mut cells = vec![0; 1024];
    for i in 0..250_000 {
        for u in unit4(pcg4d(UVec4::new(1, 2, i, 3))).to_array() {
            let biased = if i % 30 == 0 { 0.5 * u } else { u };
            cells[(biased * 1024.0) as usize] += 1;
        }
    }
    assert!(chi_square(&cells) > chi_square_limit(1023.0));
}

#[test]
fn r71_floats_span_their_half_open_ranges() {
    assert_eq!(unit_float(0), 0.0);
    assert_eq!(unit_float(0xff), 0.0);
    assert_eq!(unit_float(0x100), 2f32.powi(-24));
    assert_eq!(unit_float(0x8000_0000), 0.5);
    assert_eq!(unit_float(u32::MAX), 1.0 - 2f32.powi(-24));
    assert_eq!(signed_float(0), -1.0);
    assert_eq!(signed_float(0x8000_0000), 0.0);
    assert_eq!(signed_float(u32::MAX), 1.0 - 2f32.powi(-23));
    let words = UVec4::new(0, 0x4000_0000, 0x8000_0000, 0xc000_0000);
    assert_eq!(unit4(words).to_array(), [0.0, 0.25, 0.5, 0.75]);
    assert_eq!(signed4(words).to_array(), [-1.0, -0.5, 0.0, 0.5]);
}

#[test]
fn pcg4d_gives_the_values_of_the_published_listing() {
    // Computed from the paper's listing with Python's unbounded integers, reduced modulo 2^32.
    let known: [([u32; 4], [u32; 4]); 5] = [
        (
            [0x0000_0000, 0x0000_0000, 0x0000_0000, 0x0000_0000],
            [0x0f02_f829, 0x2d56_8769, 0x32b0_c43b, 0xd325_48ea],
        ),
        (
            [0x0000_0001, 0x0000_0002, 0x0000_0003, 0x0000_0004],
            [0x3622_cd16, 0xf114_71d8, 0xe110_9b3f, 0x02b9_4c2f],
        ),
        (
            [0xffff_ffff, 0xffff_ffff, 0xffff_ffff, 0xffff_ffff],
            [0x974e_d892, 0xc015_dc67, 0x9f95_5760, 0xa1bb_a208],
        ),
        (
            [0x8000_0000, 0x0000_0000, 0x7fff_ffff, 0x0000_0001],
            [0xb380_9ddb, 0x4981_5560, 0x783a_ba3b, 0xb954_a51f],
        ),
        (
            [0xdead_beef, 0x1234_5678, 0x0000_002a, 0x9e37_79b9],
            [0x1a72_b0b6, 0x5fa4_ce5f, 0x0cbc_719f, 0xda8e_bcd2],
        ),
    ];
    for (key, want) in known {
        assert_eq!(pcg4d(UVec4::from_array(key)).to_array(), want, "{key:?}");
    }
}
