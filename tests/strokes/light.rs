//! How strokes are lit: against Lambert's law, summed over a thin cylinder.

use std::f64::consts::PI;

use motes::scene::Scene;

use crate::support::{BLADES, Vector, cross, dot, drawn, particles, plus, records, scene, unit};

/// The mean of what the visible half of a thin cylinder sends back of a light, by its width.
fn lambert(along: Vector, light: Vector, to_eye: Vector) -> f64 {
    let front = unit(plus(to_eye, along, -dot(along, to_eye)));
    let side = cross(along, front);
    let steps = 2000;
    let (mut sum, mut width) = (0.0, 0.0);
    for at in 0..steps {
        let angle = PI * ((f64::from(at) + 0.5) / f64::from(steps) - 0.5);
        let normal = plus(front.map(|x| x * angle.cos()), side, angle.sin());
        sum += angle.cos() * dot(normal, light).max(0.0);
        width += angle.cos();
    }
    sum / width
}

const COLOR: Vector = [0.5, 0.6, 0.4];

/// The colours of all pieces in the middle of strokes, and what they should be.
fn colors(
    scene: &Scene,
    falls: impl Fn(Vector, Vector, Vector) -> Vector,
) -> Vec<(Vector, Vector)> {
    let (plan, mut backend) = drawn(scene, 0);
    let eye = scene.camera.position.map(f64::from);
    let bend = scene.systems[0].acceleration.map(f64::from);
    let all = records(&plan, &mut backend);
    let mut pairs = Vec::new();
    for ([_, pieces], state) in all.iter().zip(particles(scene, 0)) {
        // All of them are seen, so that it is known which is the middle one.
        let count = pieces.len();
        assert_eq!(count, 7);
        let piece = pieces[count / 2];
        let frames = f64::from(state.lifetime) / 2.0;
        let velocity = state.velocity.map(f64::from);
        let birth = state.position.map(f64::from);
        let bent = 0.5 * frames * frames;
        let place = plus(plus(birth, velocity, frames), bend, bent);
        let along = unit(plus(velocity, bend, frames));
        let to_eye = unit(plus(eye, place, -1.0));
        let light = falls(place, along, to_eye);
        let got = [0, 1, 2].map(|i| f64::from(f32::from_bits(piece.color[i])));
        pairs.push((got, [0, 1, 2].map(|i| COLOR[i] * light[i])));
    }
    pairs
}

fn assert_near(pairs: &[(Vector, Vector)], what: &str) -> f64 {
    let mut sum = 0.0;
    for (got, wanted) in pairs {
        for (got, wanted) in got.iter().zip(wanted) {
            assert!((got - wanted).abs() < 0.005, "{what}: {got} and {wanted}");
            sum += got;
        }
    }
    sum / pairs.len() as f64
}

/// From far away, so that all of every stroke is in the picture; seven pieces each.
fn lit(light: &str) -> Scene {
    let seven = BLADES.replace("stroke_pieces = 48", "stroke_pieces = 7");
    let near = seven.replace("[0.0005, -0.002, 0.0003]", "[0.0008, -0.0045, 0.0003]");
    let near = near.replace("mean = 40, var = 15", "mean = 30, var = 6");
    let picture = "camera.position = [0.4, 0.9, 11]\n camera.target = [0.2, 0, 0]
        camera.vertical_fov_degrees = 70\n image.width = 1280\n image.height = 1280";
    scene(&format!("{picture}\n{light}"), &[&near])
}

#[test]
fn r81_strokes_reflect_the_light_as_lambert_has_it() {
    let mut means = Vec::new();
    for from in [
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
        [0.6, 0.8, 0.0],
        [-3.0, 0.5, 1.0],
    ] {
        let lines = format!(
            "light.direction = {from:?}\n light.color = [0.9, 0.5, 0.2]\n light.ambient = [0.1, 0.2, 0.3]"
        );
        let pairs = colors(&lit(&lines), |_, along, to_eye| {
            let seen = lambert(along, unit(from), to_eye);
            plus([0.1, 0.2, 0.3], [0.9, 0.5, 0.2], seen)
        });
        means.push(assert_near(&pairs, &format!("{from:?}")));
    }
    // The light's direction is seen: from before them they are brightest, from behind dark.
    assert!(means[0] > 1.8 * means[1], "{means:?}");
    assert!(means[0] > means[2] && means[2] > means[1], "{means:?}");
}

#[test]
fn r81_lamps_light_strokes_by_their_distance() {
    let lines = "light.color = [0, 0, 0]\n light.ambient = [0, 0, 0]
        lamp = [{ position = [-1.5, 1, 2], color = [0.9, 0.7, 0.5], distance = 1.7 }, { position = [9, 3, -1], distance = 3 }]";
    let pairs = colors(&lit(lines), |place, along, to_eye| {
        let lamps = [
            ([-1.5, 1.0, 2.0], [0.9, 0.7, 0.5], 1.7f64),
            ([9.0, 3.0, -1.0], [1.0; 3], 3.0),
        ];
        lamps.iter().fold([0.0; 3], |sum, (lamp, color, distance)| {
            let away = plus(*lamp, place, -1.0);
            let share = distance * distance / dot(away, away);
            plus(sum, *color, share * lambert(along, unit(away), to_eye))
        })
    });
    let mean = assert_near(&pairs, "lamps");
    assert!(mean > 0.03, "{mean}");
}
