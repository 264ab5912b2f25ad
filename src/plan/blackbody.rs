//! The colour of what glows because it is hot, as a picture shows it.
//!
//! Planck's law, seen by the standard observer (CIE 1931, in the analytic form of Wyman, Sloan and
//! Shirley, JCGT 2(2), 2013), in the primaries and on the curve of sRGB. All of it is computed with
//! exact math, so that it is the same on every machine.

use crate::exact::reciprocal;
use crate::transcendental::{exp2_exact, log2_exact};

/// h c / k in nanometres times kelvin, times log2(e).
const SECOND_RADIATION: f32 = 14_387_769.0 * std::f32::consts::LOG2_E;
/// The light that is looked at, in nanometres, and how finely.
const SHORTEST_NM: u32 = 380;
const LONGEST_NM: u32 = 780;
const STEP_NM: usize = 10;

/// e to the power of -t^2 / 2, of a bell with other widths on both sides.
fn bell(nm: f32, middle: f32, below: f32, above: f32) -> f32 {
    let width = if nm < middle { below } else { above };
    let t = (nm - middle) * reciprocal(width);
    exp2_exact(-0.5 * std::f32::consts::LOG2_E * t * t)
}

/// What the standard observer's x, y and z make of a wavelength.
fn observed(nm: f32) -> [f32; 3] {
    [
        1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7)
            - 0.065 * bell(nm, 501.1, 20.4, 26.2),
        0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1),
        1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8),
    ]
}

/// Linear light to a display's values, by the sRGB curve; 0 ..= 1.
fn displayed(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * exp2_exact(log2_exact(linear) * (1.0 / 2.4)) - 0.055
    }
}

/// Red, green and blue of a black body of so many kelvin, 1,000 ..= 20,000, display-referred; the
/// greatest of them is 1.
pub(super) fn blackbody(kelvin: f32) -> [f32; 3] {
    let per_kelvin = reciprocal(kelvin);
    let exponent = |nm: f32| SECOND_RADIATION * reciprocal(nm) * per_kelvin;
    let least = exponent(LONGEST_NM as f32);
    let mut sum = [0.0; 3];
    for nm in (SHORTEST_NM..=LONGEST_NM).step_by(STEP_NM) {
        let nm = nm as f32;
        let power = exponent(nm);
        let short = 560.0 * reciprocal(nm);
        let emitted = short * short * short * short * short * exp2_exact(least - power)
            / (1.0 - exp2_exact(-power));
        for (sum, seen) in sum.iter_mut().zip(observed(nm)) {
            *sum += seen * emitted;
        }
    }
    let [x, y, z] = sum;
    let linear = [
        3.240_97 * x - 1.537_383 * y - 0.498_611 * z,
        -0.969_244 * x + 1.875_968 * y + 0.041_555 * z,
        0.055_63 * x - 0.203_977 * y + 1.056_972 * z,
    ];
    let most = linear.into_iter().fold(0.0, f32::max);
    linear.map(|channel| displayed((channel / most).max(0.0)))
}

#[cfg(test)]
mod tests {
    use super::blackbody;

    /// Chromaticities of the Planckian locus as tables have them: kelvin, x, y.
    const LOCUS: [(f32, f64, f64); 4] = [
        (1500.0, 0.5857, 0.3931),
        (2000.0, 0.5267, 0.4133),
        (2856.0, 0.4476, 0.4074),
        (6500.0, 0.3135, 0.3237),
    ];

    #[test]
    fn p79_black_bodies_have_the_colours_of_the_locus() {
        for (kelvin, x, y) in LOCUS {
            let [big_x, big_z] = [x / y, (1.0 - x - y) / y];
            let linear = [
                3.2406 * big_x - 1.5372 - 0.4986 * big_z,
                -0.9689 * big_x + 1.8758 + 0.0415 * big_z,
                0.0557 * big_x - 0.2040 + 1.0570 * big_z,
            ];
            let most = linear.into_iter().fold(0.0, f64::max);
            let shown = |linear: f64| {
                if linear <= 0.003_130_8 {
                    12.92 * linear.max(0.0)
                } else {
                    1.055 * linear.powf(1.0 / 2.4) - 0.055
                }
            };
            for (got, linear) in blackbody(kelvin).into_iter().zip(linear) {
                let wanted = shown(linear / most);
                assert!(
                    (f64::from(got) - wanted).abs() < 0.03,
                    "{got}, not {wanted} at {kelvin} K"
                );
            }
        }
    }

    #[test]
    fn hotter_is_less_red() {
        let colors: Vec<_> = (2..=40).map(|at| blackbody(500.0 * at as f32)).collect();
        for two in colors.windows(2) {
            let [[r0, g0, b0], [r1, g1, b1]] = [two[0], two[1]];
            assert!(b1 * r0 >= b0 * r1 && g1 * r0 >= g0 * r1, "{two:?}");
        }
        assert!(
            colors
                .iter()
                .flatten()
                .all(|value| (0.0..=1.0).contains(value))
        );
    }
}
