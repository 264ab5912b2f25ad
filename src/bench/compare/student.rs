//! Student's distribution, for few records.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// Degrees of freedom above which more make no difference that matters here.
const MOST_FREEDOM: usize = 400;

/// How far from 0, in standard errors, `level` (0 .. 1) of Student's distribution reaches, with at least
/// one degree of freedom.
pub(super) fn reach(level: f64, freedom: usize) -> f64 {
    let freedom = freedom.clamp(1, MOST_FREEDOM);
    // The distribution grows with the angle, so halving finds it.
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match within(middle, freedom) < level {
            true => low = middle,
            false => high = middle,
        }
    }
    low.tan() * (freedom as f64).sqrt()
}

/// Probability of staying within tan(`angle`) times the root of `freedom` of 0: Abramowitz and
/// Stegun, 26.7.3 and 26.7.4.
fn within(angle: f64, freedom: usize) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let is_odd = freedom % 2 == 1;
    let first = if is_odd { 1 } else { 0 };
    // Both series: each term is the one before times cos^2, times (n - 1) / n.
    let mut term = if is_odd { cos } else { 1.0 };
    let mut sum = 0.0;
    let mut n = first + 2;
    while n <= freedom {
        sum += term;
        term *= cos * cos * (n - 1) as f64 / n as f64;
        n += 2;
    }
    match is_odd {
        true => FRAC_2_PI * (angle + sin * sum),
        false => sin * sum,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against printed tables of Student's distribution, two-sided.
    #[test]
    fn reaches_are_those_of_the_tables() {
        let table = [
            (0.95, 1, 12.706),
            (0.95, 2, 4.303),
            (0.95, 3, 3.182),
            (0.95, 4, 2.776),
            (0.95, 30, 2.042),
            (0.99, 1, 63.657),
            (0.99, 4, 4.604),
            (0.99, 9, 3.250),
            (0.99, 120, 2.617),
        ];
        for (level, freedom, expected) in table {
            let got = reach(level, freedom);
            assert!(
                (got - expected).abs() < 6e-4,
                "{level} {freedom}: {got}, not {expected}"
            );
        }
    }
}
