//! Trajectories of chaotic systems, which particles can be born on (Reeves 1983, 2.2, names
//! attractors as further work).

use crate::scene::{Attractor, GenerationShape, Scene};

/// Points of each trajectory.
pub(super) const CURVE_LEN: u32 = 8192;

/// Steps before the first point, by when the trajectory has come to the attractor.
const SETTLING_STEPS: u32 = 2000;

/// The attractors that have a place in the stored points, in this order.
const STORED: [Attractor; 3] = [Attractor::Lorenz, Attractor::Rossler, Attractor::Halvorsen];

/// The index of the attractor's first point.
pub(super) fn first_point(attractor: Attractor) -> u32 {
    let at = STORED.iter().position(|stored| *stored == attractor);
    at.unwrap_or(0) as u32 * (CURVE_LEN + 1)
}

/// The points of all attractors, if any scene is born on one; else a single unused one.
pub(super) fn curve_points(scenes: &[&Scene]) -> Vec<[f32; 4]> {
    let is_curve = |shape: &GenerationShape| matches!(shape, GenerationShape::Attractor { .. });
    let systems = scenes.iter().flat_map(|scene| &scene.systems);
    if !systems
        .into_iter()
        .any(|system| is_curve(&system.generation_shape))
    {
        return vec![[0.0; 4]];
    }
    STORED.into_iter().flat_map(points_of).collect()
}

/// The trajectory by fourth-order Runge and Kutta, centred, its farthest point at distance 1, and
/// one point more, so that the last has a next. The same on every processor: only `+ - * /`.
fn points_of(attractor: Attractor) -> Vec<[f32; 4]> {
    let step = match attractor {
        Attractor::Lorenz => 0.005,
        Attractor::Rossler => 0.014,
        Attractor::Halvorsen => 0.006,
    };
    let mut at = [1.0, 1.2, 0.9];
    for _ in 0..SETTLING_STEPS {
        at = runge_kutta(attractor, at, step);
    }
    let mut points = Vec::new();
    for _ in 0..=CURVE_LEN {
        points.push(at);
        at = runge_kutta(attractor, at, step);
    }
    let range = |i: usize| {
        let low = points.iter().map(|p| p[i]).fold(f64::MAX, f64::min);
        let high = points.iter().map(|p| p[i]).fold(f64::MIN, f64::max);
        0.5 * (low + high)
    };
    let center = [range(0), range(1), range(2)];
    let away = |p: &[f64; 3]| [0, 1, 2].map(|i| p[i] - center[i]);
    let squared = |p: [f64; 3]| p.iter().map(|x| x * x).sum::<f64>();
    let farthest = points.iter().map(|p| squared(away(p))).fold(0.0, f64::max);
    let scale = 1.0 / farthest.sqrt();
    points
        .iter()
        .map(|p| {
            let [x, y, z] = away(p).map(|x| crate::exact::snap((x * scale) as f32));
            [x, y, z, 0.0]
        })
        .collect()
}

fn runge_kutta(attractor: Attractor, at: [f64; 3], step: f64) -> [f64; 3] {
    let moved = |slope: [f64; 3], by: f64| [0, 1, 2].map(|i| at[i] + slope[i] * by);
    let a = slope(attractor, at);
    let b = slope(attractor, moved(a, 0.5 * step));
    let c = slope(attractor, moved(b, 0.5 * step));
    let d = slope(attractor, moved(c, step));
    [0, 1, 2].map(|i| at[i] + step / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
}

/// The time derivative at a place.
fn slope(attractor: Attractor, [x, y, z]: [f64; 3]) -> [f64; 3] {
    match attractor {
        Attractor::Lorenz => [10.0 * (y - x), x * (28.0 - z) - y, x * y - 8.0 / 3.0 * z],
        Attractor::Rossler => [-y - z, x + 0.2 * y, 0.2 + z * (x - 5.7)],
        Attractor::Halvorsen => {
            let turn = |x: f64, y: f64, z: f64| -1.89 * x - 4.0 * (y + z) - y * y;
            [turn(x, y, z), turn(y, z, x), turn(z, x, y)]
        }
    }
}
