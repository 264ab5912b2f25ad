//! The wind of two noises' gradients neither begins nor ends anywhere.

use glam::{DVec3, Vec3};

use crate::flow::{Winds, dyadic_place, field};

/// Root mean square of the divergence over that of all slopes, by differences.
fn divergence(part: &str) -> f64 {
    const STEP: f32 = 1.0 / 256.0;
    let winds = Winds::new(&[part]);
    let flow = field(&winds, 2);
    let (mut divergence, mut slopes) = (0.0, 0.0);
    for at in 0..20_000 {
        let p = dyadic_place(at, 50.0);
        let along =
            |axis: Vec3| (flow(p + axis * STEP) - flow(p - axis * STEP)) / f64::from(2.0 * STEP);
        let [x, y, z]: [DVec3; 3] = [Vec3::X, Vec3::Y, Vec3::Z].map(along);
        divergence += (x.x + y.y + z.z).powi(2);
        slopes += x.length_squared() + y.length_squared() + z.length_squared();
    }
    f64::sqrt(divergence / slopes)
}

#[test]
fn curl_winds_have_no_divergence_and_noise_has() {
    for (octaves, scale) in [(1, 1.0), (3, 0.5), (2, 2.0)] {
        let part = |kind: &str| {
            format!(
                "{{ kind = \"{kind}\", strength = 0.3, octaves = {octaves}, \
                 scale = [{scale}, {scale}, {scale}] }}"
            )
        };
        let (curl, noise) = (divergence(&part("curl")), divergence(&part("noise")));
        println!("{octaves} octaves, scale {scale}: curl {curl:.5}, noise {noise:.5}");
        assert!(curl < 0.01, "{curl}");
        assert!(noise > 0.5, "{noise}");
    }
}

#[test]
fn curl_winds_have_none_either_with_a_scale_for_each_axis() {
    let curl = divergence("{ kind = \"curl\", strength = 0.3, scale = [1, 0.25, 2] }");
    println!("curl {curl:.5}");
    assert!(curl < 0.01, "{curl}");
}

#[test]
fn curl_winds_have_the_strength_of_noise() {
    // C is the root mean square of one octave's speed, whatever the kind.
    for kind in ["noise", "curl"] {
        let winds = Winds::new(&[&format!("{{ kind = \"{kind}\", strength = 0.5 }}")]);
        let flow = field(&winds, 0);
        let square: f64 = (0..100_000)
            .map(|at| flow(dyadic_place(at, 200.0)).length_squared())
            .sum();
        let root_mean_square = (square / 1e5).sqrt();
        println!("{kind}: {root_mean_square:.4}");
        assert!(
            (root_mean_square / 0.5 - 1.0).abs() < 0.02,
            "{kind}: {root_mean_square}"
        );
    }
}
