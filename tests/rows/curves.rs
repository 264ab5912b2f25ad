//! Births on the trajectories of chaotic systems: Reeves (1983), section 2.2, further work.

use glam::DVec3;
use motes::plan::Plan;

use crate::common::statistics::assert_uniform;
use crate::support::{Run, on_every_backend, scene};

const ATTRACTORS: [&str; 3] = ["lorenz", "rossler", "halvorsen"];

/// The time derivative at a place, by the papers' constants.
fn field(attractor: &str, p: DVec3) -> DVec3 {
    let DVec3 { x, y, z } = p;
    match attractor {
        "lorenz" => DVec3::new(10.0 * (y - x), x * (28.0 - z) - y, x * y - 8.0 * z / 3.0),
        "rossler" => DVec3::new(-(y + z), x + y / 5.0, 0.2 + z * (x - 5.7)),
        _ => {
            let a = 1.89;
            DVec3::new(
                -a * x - 4.0 * y - 4.0 * z - y * y,
                -a * y - 4.0 * z - 4.0 * x - z * z,
                -a * z - 4.0 * x - 4.0 * y - x * x,
            )
        }
    }
}

fn lines(attractor: &str) -> String {
    format!(
        "generation_shape = {{ kind = \"attractor\", attractor = \"{attractor}\", radius = 20 }}
        lifetime = 1"
    )
}

/// The plan's points of one attractor, at distances of at most 1. All three are stored alike.
fn points(attractor: &str) -> Vec<DVec3> {
    let plan = Plan::new(&scene("", &[&lines(attractor)]), 1).expect("the scene can be planned");
    let at = ATTRACTORS.iter().position(|name| *name == attractor);
    let each = plan.curve_points.len() / 3;
    let points = &plan.curve_points[at.expect("one of three") * each..][..each];
    let point = |p: &[f32; 4]| DVec3::new(p[0].into(), p[1].into(), p[2].into());
    points.iter().map(point).collect()
}

/// What was done to the trajectory: point = (place - center) / scale, a step apart in time.
type Fit = [f64; 5];

/// Left over of the equation at a point: the derivative by neighbours less the field's, in the
/// scale of the points.
fn left_over(attractor: &str, points: &[DVec3], at: usize, fit: &Fit) -> DVec3 {
    let [scale, x, y, z, step] = *fit;
    let p = |offset: usize| points[at + offset - 2];
    let slope = (p(0) - p(4) + 8.0 * (p(3) - p(1))) / (12.0 * step);
    slope - field(attractor, p(2) * scale + DVec3::new(x, y, z)) / scale
}

/// Root mean square of what is left over, as a share of that of the field.
fn misfit(attractor: &str, points: &[DVec3], fit: &Fit) -> f64 {
    let [scale, x, y, z, _] = *fit;
    let squares = (2..points.len() - 2).map(|at| {
        let whole = field(attractor, points[at] * scale + DVec3::new(x, y, z)) / scale;
        let left = left_over(attractor, points, at, fit);
        (left.length_squared(), whole.length_squared())
    });
    let (left, whole) = squares.fold((0.0, 0.0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
    (left / whole).sqrt()
}

/// One step of Gauss and Newton toward the least squares of what is left over.
fn refined(attractor: &str, points: &[DVec3], fit: &Fit) -> Fit {
    let mut normal = [[0.0; 6]; 5];
    for at in 2..points.len() - 2 {
        let here = left_over(attractor, points, at, fit);
        let slopes: [DVec3; 5] = std::array::from_fn(|i| {
            let by = 1e-6 * fit[i].abs().max(1e-3);
            let mut moved = *fit;
            moved[i] += by;
            (left_over(attractor, points, at, &moved) - here) / by
        });
        for (row, slope) in normal.iter_mut().zip(slopes) {
            for (sum, other) in row.iter_mut().zip(slopes) {
                *sum += slope.dot(other);
            }
            row[5] -= slope.dot(here);
        }
    }
    for i in 0..5 {
        for j in 0..5 {
            if i != j {
                let factor = normal[j][i] / normal[i][i];
                let pivot = normal[i];
                for (value, above) in normal[j].iter_mut().zip(pivot) {
                    *value -= factor * above;
                }
            }
        }
    }
    std::array::from_fn(|i| fit[i] + normal[i][5] / normal[i][i])
}

#[test]
fn r16_the_points_are_a_trajectory_of_their_system() {
    // Guesses of the size and the middle of each.
    let guesses = [
        [30.0, 0.0, 0.0, 25.0],
        [17.0, 1.0, -1.0, 11.0],
        [12.0, -3.0, -3.0, -3.0],
    ];
    for (attractor, [scale, x, y, z]) in ATTRACTORS.into_iter().zip(guesses) {
        let points = points(attractor);
        assert!(points.len() > 4000, "{attractor}");
        let farthest = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        assert!((farthest - 1.0).abs() < 1e-6, "{attractor}: {farthest}");
        // As much time passes in all as the field takes for the whole way.
        let way: f64 = points.windows(2).map(|p| p[0].distance(p[1])).sum();
        let speed = |p: &DVec3| field(attractor, *p * scale + DVec3::new(x, y, z)).length() / scale;
        let speeds: f64 = points.iter().map(speed).sum();
        let mut fit = [scale, x, y, z, way / speeds];
        for _ in 0..20 {
            fit = refined(attractor, &points, &fit);
        }
        let misfit = misfit(attractor, &points, &fit);
        println!("{attractor}: {fit:?}, left over {misfit:.2e}");
        assert!(
            misfit < 1e-3,
            "{attractor}: {misfit} of the field is left over"
        );
    }
}

/// The nearest place of a polyline: its distance, where it is in segments, and the segment.
fn nearest(points: &[DVec3], p: DVec3) -> (f64, f64, DVec3) {
    let mut best = (f64::MAX, 0.0, DVec3::ZERO);
    for (at, pair) in points.windows(2).enumerate() {
        let segment = pair[1] - pair[0];
        let share = ((p - pair[0]).dot(segment) / segment.length_squared()).clamp(0.0, 1.0);
        let distance = (p - pair[0] - segment * share).length_squared();
        if distance < best.0 {
            best = (distance, at as f64 + share, segment);
        }
    }
    (best.0.sqrt(), best.1, best.2)
}

#[test]
fn r16_births_are_on_the_trajectory_and_leave_along_it() {
    for attractor in ATTRACTORS {
        let points = points(attractor);
        let lines = format!("{}\n speed = 0.5", lines(attractor));
        let born = |on: &str, count: u32| {
            let lines = format!("initial_mean_parts = {count}\n{lines}");
            let mut run = Run::new(on, &scene("", &[&lines]), 1);
            run.step_to(0);
            let members = run.members();
            assert_eq!(members.len(), count as usize);
            members
        };
        let vector = |words: [f32; 3]| DVec3::from_array(words.map(f64::from));
        let births: Vec<(f64, f64, f64)> = born("cpu", 20_000)
            .iter()
            .map(|member| {
                let velocity = vector(member.raw.velocity());
                let place = vector(member.raw.position()) - velocity;
                let (distance, along, segment) = nearest(&points, place / 20.0);
                let cosine = segment.normalize().dot(velocity / 0.5);
                (distance, along, cosine)
            })
            .collect();
        let farthest = births.iter().map(|birth| birth.0).fold(0.0, f64::max);
        println!("{attractor}: births at most {farthest:.1e} radii off");
        assert!(farthest <= 1e-3, "{attractor}: {farthest}");
        // Even in time, so denser where the trajectory is slow.
        let along: Vec<f64> = births.iter().map(|birth| birth.1).collect();
        assert_uniform(attractor, &along, 0.0, points.len() as f64 - 2.0);
        let onward = births.iter().filter(|birth| birth.2 >= 1.0 - 1e-4).count();
        assert!(
            onward > 19_900,
            "{attractor}: {onward} of 20,000 leave along it"
        );

        let raw = |on: &str| -> Vec<_> { born(on, 2000).iter().map(|member| member.raw).collect() };
        let expected = raw("cpu");
        on_every_backend(|on| assert!(raw(on) == expected, "{attractor} on {on}"));
    }
}
