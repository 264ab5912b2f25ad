//! How wide boids see.

use crate::support::*;

/// Whether the first of two boids sees the second one, and is drawn to it.
fn is_seen(view_angle_degrees: &str, dimensions: &str, states: &[State; 2]) -> bool {
    let rule = one_rule("cohesion") + &format!("view_angle_degrees = {view_angle_degrees}\n");
    let lines = with(&rule, &[("count", "2"), ("dimensions", dimensions)]);
    let plan = plan(&scene(&[&lines]));
    stepped(&plan, states)[0].1 != states[0].1
}

#[test]
fn boids_see_half_the_angle_to_each_side() {
    let seen = |angle: f32, degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let other = [100.0 + 30.0 * cos as f32, 100.0 + 30.0 * sin as f32, 0.0];
        let own = ([100.0, 100.0, 0.0], [1.0, 0.0, 0.0]);
        is_seen(&angle.to_string(), "2", &[own, (other, [0.0; 3])])
    };
    for (angle, half) in [
        (1.0, 0.5),
        (90.0, 45.0),
        (180.0, 90.0),
        (270.0, 135.0),
        (359.0, 179.5),
    ] {
        for side in [-1.0, 1.0] {
            assert!(seen(angle, side * (half - 0.1)), "{angle}, {side}");
            assert!(!seen(angle, side * (half + 0.1)), "{angle}, {side}");
        }
    }
    assert!(seen(360.0, 180.0) && seen(1.0, 0.0));
}

#[test]
fn the_angle_is_one_in_space() {
    let mut random = Random(5);
    let mut counts = [0; 2];
    for _ in 0..200 {
        let mut vector = |most: f32| -> [f32; 3] {
            std::array::from_fn(|_| random.within(-f64::from(most), f64::from(most)) as f32)
        };
        let (heading, offset) = (vector(1.0), vector(30.0));
        let dot = |a: [f32; 3], b: [f32; 3]| -> f64 {
            (0..3).map(|at| f64::from(a[at]) * f64::from(b[at])).sum()
        };
        let lengths = (dot(heading, heading) * dot(offset, offset)).sqrt();
        let degrees = (dot(heading, offset) / lengths).acos().to_degrees();
        if (degrees - 60.0).abs() < 0.1 {
            continue;
        }
        let place = std::array::from_fn(|at| 100.0 + offset[at]);
        let states = [([100.0; 3], heading), (place, [0.0; 3])];
        let seen = is_seen("120", "3", &states);
        assert_eq!(seen, degrees < 60.0, "{degrees} degrees aside");
        counts[usize::from(seen)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
}

#[test]
fn who_stands_sees_all_around() {
    let behind = ([70.0, 100.0, 0.0], [0.0; 3]);
    for (velocity, expected) in [([0.0; 3], true), ([0.25, 0.0, 0.0], false)] {
        let own = ([100.0, 100.0, 0.0], velocity);
        assert_eq!(is_seen("90", "2", &[own, behind]), expected, "{velocity:?}");
    }
}

/// Each relation has an angle of its own.
#[test]
fn predators_are_feared_where_they_are_seen() {
    for (kind, angle, x) in [
        ("avoid", 180, 90.0),
        ("avoid", 180, 110.0),
        ("approach", 180, 90.0),
    ] {
        let own = with(FREE, &[("count", "1")])
            + &format!(
                "[[flock.relation]]\nkind = \"{kind}\"\nother = \"predators\"\n\
                 view_angle_degrees = {angle}\n"
            );
        let plan = plan(&scene(&[&own, &with(PREDATORS, &[("count", "1")])]));
        let velocity = [1.0, 0.0, 0.0];
        let states = [([100.0, 100.0, 0.0], velocity), ([x, 100.0, 0.0], [0.0; 3])];
        let changes = stepped(&plan, &states)[0].1 != velocity;
        assert_eq!(changes, x > 100.0, "{kind} at {x}");
    }
}
