//! Boids that see but the nearest (Ballerini et al. 2008).

use crate::common::on_cpu;
use crate::grid::without_grid;
use crate::support::*;

/// The article's flock in a box of its own, on a torus or not, whose boids are drawn to so many.
fn drawn_to(nearest: u32, edges: &str) -> String {
    let edges = format!("{{ kind = \"{edges}\", min = [0, 0, 0], max = [500, 300, 0] }}");
    with(&one_rule("cohesion"), &[("edges", &edges)]) + &format!("nearest = {nearest}\n")
}

#[test]
fn as_many_count_as_are_asked_for_and_those_the_nearest() {
    for (nearest, torus) in [
        (1, false),
        (7, false),
        (8, true),
        (9, false),
        (13, true),
        (16, true),
    ] {
        let edges = if torus { "torus" } else { "wrap" };
        let plan = plan(&scene(&[&drawn_to(nearest, edges)]));
        let mut cpu = on_cpu(&plan);
        step(&mut cpu, &plan.inputs(0));
        let before = states_of(&boids(&mut cpu));
        step(&mut cpu, &plan.inputs(1));
        let mut crowded = 0;
        for (own, (place, velocity)) in before.iter().enumerate() {
            let way = |other: &State| -> [f64; 2] {
                std::array::from_fn(|at| {
                    let straight = f64::from(other.0[at]) - f64::from(place[at]);
                    let extent = [500.0, 300.0][at];
                    let turns = if torus {
                        (straight / extent).round()
                    } else {
                        0.0
                    };
                    straight - extent * turns
                })
            };
            let others = (0..).zip(&before).filter(|(at, _)| *at != own);
            let mut ways: Vec<[f64; 2]> = others.map(|(_, other)| way(other)).collect();
            ways.retain(|[x, y]| x.hypot(*y) < 60.0);
            ways.sort_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
            crowded += usize::from(ways.len() > nearest as usize);
            ways.truncate(nearest as usize);
            let sum = ways
                .iter()
                .fold([0.0; 2], |sum, way| [sum[0] + way[0], sum[1] + way[1]]);
            let length = sum[0].hypot(sum[1]);
            let wanted: [f64; 2] =
                std::array::from_fn(|at| 4.5 * sum[at] / length - f64::from(velocity[at]));
            let factor = (0.2 / wanted[0].hypot(wanted[1])).min(1.0);
            let got = boids(&mut cpu)[own].velocity();
            for at in 0..2 {
                let expected = f64::from(velocity[at]) + wanted[at] * factor;
                let off = (f64::from(got[at]) - expected).abs();
                assert!(off < 1e-4, "{nearest}, boid {own}: {off}");
            }
        }
        assert!(crowded > 300, "{crowded} boids see more than {nearest}");
    }
}

/// Of those that are as far, the first of their flock count.
#[test]
fn ties_are_told_by_who_they_are() {
    let offsets = [
        [3.0, 4.0],
        [-5.0, 0.0],
        [4.0, -3.0],
        [0.0, 5.0],
        [-3.0, -4.0],
    ];
    for nearest in 1..=5u32 {
        for turned in 0..5 {
            let lines = with(&drawn_to(nearest, "wrap"), &[("count", "6")]);
            let place = |[x, y]: [f32; 2]| ([200.0 + x, 100.0 + y, 0.0], [0.0; 3]);
            let mut around = offsets;
            around.rotate_left(turned);
            // Who looks stands among them by its index.
            let mut states: Vec<State> = around.map(place).to_vec();
            states.insert(turned, place([0.0; 2]));
            let (_, velocity) = stepped(&plan(&scene(&[&lines])), &states)[turned];
            let chosen = &around[..nearest as usize];
            let sum = chosen
                .iter()
                .fold([0.0f32; 2], |sum, o| [sum[0] + o[0], sum[1] + o[1]]);
            let length = sum[0].hypot(sum[1]).max(1e-9);
            for at in 0..2 {
                let expected = 0.2 * sum[at] / length;
                let off = (velocity[at] - expected).abs();
                assert!(off < 1e-5, "{nearest} of {around:?}: {velocity:?}");
            }
        }
    }
}

#[test]
fn the_nearest_do_not_depend_on_the_grid() {
    let plan = plan(&scene(&[&drawn_to(6, "torus")]));
    let (mut by_grid, mut by_force) = (on_cpu(&plan), on_cpu(&plan));
    for frame in 0..20 {
        let inputs = plan.inputs(frame);
        step(&mut by_grid, &inputs);
        step(&mut by_force, &without_grid(&inputs));
    }
    assert_eq!(
        states_of(&boids(&mut by_grid)),
        states_of(&boids(&mut by_force))
    );
}

/// Whom they do not see is none of the nearest.
#[test]
fn the_nearest_are_those_in_view() {
    let lines = with(&drawn_to(1, "wrap"), &[("count", "3")]) + "view_angle_degrees = 180\n";
    let own = ([200.0, 100.0, 0.0], [1.0, 0.0, 0.0]);
    let states = [
        own,
        ([195.0, 100.0, 0.0], [0.0; 3]),
        ([200.5, 120.0, 0.0], [0.0; 3]),
    ];
    let (_, velocity) = stepped(&plan(&scene(&[&lines])), &states)[0];
    assert!(velocity[1] > 0.1, "{velocity:?}");
}
