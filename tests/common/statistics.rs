//! Statistics that tests decide by.

/// Arithmetic mean.
pub(crate) fn mean(samples: &[f64]) -> f64 {
    samples.iter().sum::<f64>() / samples.len() as f64
}

/// Standard deviation of the samples about their mean.
pub(crate) fn standard_deviation(samples: &[f64]) -> f64 {
    let center = mean(samples);
    let squares: f64 = samples.iter().map(|x| (x - center).powi(2)).sum();
    (squares / (samples.len() as f64 - 1.0)).sqrt()
}

/// The chance that samples of the distribution `cdf` are as far from it as these, by the
/// Kolmogorov-Smirnov test (asymptotic, with Stephens' 1970 correction; good for 40 samples and
/// more).
pub(crate) fn ks_p_value(samples: &[f64], cdf: impl Fn(f64) -> f64) -> f64 {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let distance = sorted.iter().enumerate().fold(0.0f64, |most, (at, &x)| {
        let (below, above) = (at as f64 / n, (at as f64 + 1.0) / n);
        let expected = cdf(x);
        most.max(expected - below).max(above - expected)
    });
    let lambda = (n.sqrt() + 0.12 + 0.11 / n.sqrt()) * distance;
    // The series alternates slowly here, and the value is 1 to six places.
    if lambda < 0.3 {
        return 1.0;
    }
    let term = |j: i32| {
        let exponential = (-2.0 * f64::from(j * j) * lambda * lambda).exp();
        if j % 2 == 1 {
            2.0 * exponential
        } else {
            -2.0 * exponential
        }
    };
    (1..=100).map(term).sum::<f64>().clamp(0.0, 1.0)
}

/// Fails unless the samples pass for draws of the distribution `cdf`: p > 0.01.
pub(crate) fn assert_distributed(what: &str, samples: &[f64], cdf: impl Fn(f64) -> f64) {
    let p = ks_p_value(samples, cdf);
    println!("{what}: {} samples, KS p = {p:.3}", samples.len());
    assert!(p > 0.01, "{what}: {} samples, KS p = {p:e}", samples.len());
}

/// [`assert_distributed`] for the uniform distribution on `low .. high`.
pub(crate) fn assert_uniform(what: &str, samples: &[f64], low: f64, high: f64) {
    assert_distributed(what, samples, |x| {
        ((x - low) / (high - low)).clamp(0.0, 1.0)
    });
}
