//! How the small-scale pattern moves and scales: Perry (1994), 3.2.3 and 3.4, PA9.

use std::collections::BTreeSet;

use glam::Vec3;

use crate::flow::{Winds, correlation, direction, dyadic_place, field, place};

fn noise(rest: &str) -> Winds {
    Winds::new(&[&format!("{{ kind = \"noise\", strength = 1, {rest} }}")])
}

fn bits(v: Vec3) -> [u32; 3] {
    v.to_array().map(f32::to_bits)
}

#[test]
fn p40_the_pattern_moves_down_through_itself_exactly() {
    // N(p, T + dT) = N(p - k_s dT j, T): all of it in dyadic numbers, which sums keep.
    for (scale, drift, octaves) in [
        (1.0, [0.0, 0.25, 0.0], 1),
        (1.0, [0.5, -0.125, 1.0], 3),
        (2.0, [0.0, 0.75, 0.25], 2),
    ] {
        for kind in ["noise", "curl"] {
            let winds = Winds::new(&[&format!(
                "{{ kind = \"{kind}\", strength = 0.5, scale = [{scale}, {scale}, {scale}], \
                 drift = {drift:?}, octaves = {octaves} }}"
            )]);
            for at in 0..2000 {
                let (p, time, later) = (dyadic_place(at, 20.0), at % 90, 1 + at % 37);
                let moved = Vec3::from(drift) * later as f32 / scale;
                assert_eq!(
                    bits(winds.flow(time + later, p)),
                    bits(winds.flow(time, p - moved)),
                    "at {p}, {later} frames after {time}"
                );
            }
            let p = Vec3::new(0.3, 0.4, 0.5);
            assert_ne!(bits(winds.flow(0, p)), bits(winds.flow(1, p)));
        }
    }
}

#[test]
fn p40_without_drift_the_pattern_stands() {
    let winds = noise("octaves = 2");
    for frame in [0, 1, 100, 999_999] {
        assert_eq!(winds.at(frame), winds.at(5));
    }
}

#[test]
fn p40_the_pattern_moves_on_for_as_long_as_a_run_is() {
    // 0.75 cells a frame pass the noise's period after 32,768 frames.
    let winds = noise("drift = [0.75, 0, 0]");
    for at in 0..500 {
        let (p, frame) = (dyadic_place(at, 20.0), 900_000 + at);
        let now = winds.flow(frame, p);
        let before = winds.flow(frame - 1, p - Vec3::X * 0.75);
        assert!(
            (now - before).length() < 0.05,
            "{now} and {before} at {frame}"
        );
    }
}

/// Correlation of the wind at places so far apart, any way.
fn correlation_at(winds: &Winds, distance: f64) -> f64 {
    let flow = field(winds, 4);
    correlation(40_000, |at| {
        let here = place(at, 400.0);
        let there = here.as_dvec3() + distance * direction(at);
        (flow(here), flow(there.as_vec3()))
    })
}

#[test]
fn p41_k_p_decides_how_far_apart_winds_are_alike() {
    for k_p in [0.25, 1.0, 4.0] {
        let winds = noise(&format!(
            "scale = [{k_p}, {k_p}, {k_p}], drift = [0, 0.5, 0]"
        ));
        let near = correlation_at(&winds, 0.1 / k_p);
        let far = [2.0, 3.0, 7.0].map(|cells| correlation_at(&winds, cells / k_p));
        println!("k_p = {k_p}: {near:.4} at 0.1 cells, {far:.4?} at 2, 3 and 7");
        assert!(near > 0.95, "{near}");
        assert!(far.iter().all(|one| one.abs() < 0.15), "{far:?}");
    }
}

#[test]
fn p41_without_k_p_the_wind_is_the_same_everywhere_and_changes() {
    let winds = noise("scale = [0, 0, 0], drift = [0, 0.3, 0]");
    let mut seen = BTreeSet::new();
    for frame in 0..40 {
        let here = winds.flow(frame, Vec3::ZERO);
        for at in 0..50 {
            assert_eq!(bits(winds.flow(frame, place(at, 1e4))), bits(here));
        }
        seen.insert(bits(here));
    }
    assert!(seen.len() > 35, "{} winds in 40 frames", seen.len());
}
