//! Power spectra by the Fourier transform.

use std::f64::consts::TAU;

use glam::DVec2;

fn times(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

/// The Fourier transform of a power of two of complex samples.
pub(crate) fn transform(samples: &[DVec2]) -> Vec<DVec2> {
    let half = samples.len() / 2;
    if half == 0 {
        return samples.to_vec();
    }
    let every_other = |from: usize| -> Vec<DVec2> {
        let kept = samples.iter().skip(from).step_by(2);
        transform(&kept.copied().collect::<Vec<_>>())
    };
    let (even, odd) = (every_other(0), every_other(1));
    let turned: Vec<_> = (0..half)
        .map(|at| {
            let angle = -TAU * at as f64 / samples.len() as f64;
            times(DVec2::new(angle.cos(), angle.sin()), odd[at])
        })
        .collect();
    let pairs = || even.iter().zip(&turned);
    let low = pairs().map(|(even, odd)| *even + *odd);
    low.chain(pairs().map(|(even, odd)| *even - *odd)).collect()
}

/// Hann's window, so that steep spectra do not leak.
pub(crate) fn window(at: usize, count: usize) -> f64 {
    0.5 - 0.5 * (TAU * (at as f64 + 0.5) / count as f64).cos()
}

/// Power of real samples at 0, 1, 2, … half their number of waves, through a window.
pub(crate) fn power(samples: &[f64]) -> Vec<f64> {
    let count = samples.len();
    let windowed = samples.iter().enumerate();
    let windowed: Vec<_> = windowed
        .map(|(at, sample)| DVec2::new(sample * window(at, count), 0.0))
        .collect();
    let waves = transform(&windowed);
    let powers = waves[..count / 2].iter();
    powers.map(|wave| wave.length_squared()).collect()
}
