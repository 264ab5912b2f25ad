//! Antialiasing: what moves by a fraction of a pixel changes by a fraction (Reeves 1983, 2.5).

use crate::light::{Light, light_of};
use crate::support::{assert_within, on_every_backend, sample};

/// Full colour of a particle of these tests, in red.
const FULL: f64 = 64.0;

/// Pictures of one particle, each `shift_px` further along (x, y), from a start that is on no
/// pixel's middle or edge.
fn pictures(on: &str, lines: &str, (x, y): (f64, f64), shift_px: f64) -> Vec<Light> {
    let count = if on == "cpu" { 9 } else { 3 };
    (0..count)
        .map(|step| {
            let along = shift_px * f64::from(step);
            let place = format!(
                "position = [{}, {}, 0]",
                0.03 + along * x,
                -0.41 + along * y
            );
            light_of(on, "", &format!("{place}\n{lines}"))
        })
        .collect()
}

/// The largest change of a pixel from one picture to the next.
fn most_change(pictures: &[Light]) -> f64 {
    let changes = pictures.windows(2).flat_map(|pair| {
        pair[0]
            .pixels(0)
            .zip(pair[1].pixels(0))
            .map(|(before, after)| (after.2 - before.2).abs())
    });
    changes.fold(0.0, f64::max)
}

/// What is wrong with the pictures of a moving particle: its light is constant within 1 %, and a
/// shift of a pixel changes no pixel by more than `slope` of the full colour.
fn faults(on: &str, lines: &str, slope: f64) -> Vec<String> {
    let mut faults = Vec::new();
    for &(x, y) in sample(on, &[(1.0, 0.0), (0.0, 1.0), (1.0, -1.0)]) {
        // An eighth of a pixel; and so little that a jump would show.
        for &shift_px in sample(on, &[0.125, 1.0 / 128.0]) {
            let pictures = pictures(on, lines, (x, y), shift_px);
            let first = pictures[0].total(0);
            let offs = pictures
                .iter()
                .map(|picture| (picture.total(0) / first - 1.0).abs());
            let off = offs.fold(0.0, f64::max);
            let change = most_change(&pictures) / FULL / (shift_px * (x + y.abs()));
            let moved = pictures.first() != pictures.last();
            let what = format!(
                "along ({x}, {y}), {shift_px} px a frame: light off by {:.3} %, a pixel changes \
                 by {change:.3} of the full colour a pixel, moved: {moved}",
                100.0 * off
            );
            // Steps of light are rounded, which shows in the smallest changes.
            if off > 0.01 || change > slope + 1e-4 || !(moved || shift_px < 0.1) {
                faults.push(format!("{lines}\n{what}\n"));
            }
        }
    }
    faults
}

fn assert_none(faults: &[String]) {
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

/// A disc's edge falls off over one pixel, and a gain keeps its light constant. Together their
/// slope is at most 1.57 (at radius 0.68, by a scan over radii and places); an exact area's is 1.
const DISC_SLOPE: f64 = 1.6;

#[test]
fn r38_discs_are_steady() {
    on_every_backend(|on| {
        let sizes = [
            0.68, 0.2, 0.05, 0.4, 0.5, 0.57, 0.6, 0.65, 0.8, 1.0, 1.1, 1.12, 1.13, 1.5, 2.0, 2.5,
            3.0, 3.7, 3.99, 4.01, 6.3, 11.0,
        ];
        let discs = sample(on, &sizes)
            .iter()
            .map(|size| format!("size = {size}"));
        assert_none(
            &discs
                .flat_map(|lines| faults(on, &lines, DISC_SLOPE))
                .collect::<Vec<_>>(),
        );
    });
}

#[test]
fn r38_squares_are_steady() {
    on_every_backend(|on| {
        let sizes = [0.3, 2.2, 0.05, 0.5, 0.8, 1.0, 7.0];
        let square = |size: &f64| format!("size = {size}\n particle_shape = \"rectangle\"");
        let squares = sample(on, &sizes).iter().map(square);
        assert_none(
            &squares
                .flat_map(|lines| faults(on, &lines, 1.0))
                .collect::<Vec<_>>(),
        );
    });
}

#[test]
fn r38_streaks_are_steady() {
    on_every_backend(|on| {
        let mut found = Vec::new();
        let motions = [
            ("[-45, 90]", 12.0),
            ("[0, 90]", 8.0),
            ("[-90, 0]", 3.0),
            ("[-17, 90]", 14.0),
            ("[-61, 90]", 0.4),
        ];
        for &size in &[0.1, 1.0, 0.6, 4.5][..if on == "cpu" { 4 } else { 1 }] {
            for &(rotation, speed) in sample(on, &motions) {
                for light in ["conserved", "constant"] {
                    found.extend(faults(
                        on,
                        &format!(
                            "size = {size}\n speed = {speed}\n rotation_degrees = {rotation}
                            generation_shape = {{ kind = \"circle\", radius = 0 }}
                            particle_shape = \"streak\"\n streak_light = \"{light}\""
                        ),
                        DISC_SLOPE,
                    ));
                }
            }
        }
        assert_none(&found);
    });
}

#[test]
fn r38_what_grows_does_not_pop() {
    // Across every limit in the drawing of discs, a hundredth of a pixel a frame.
    let light = |size: f64| {
        light_of(
            "cpu",
            "",
            &format!("size = {size}\n position = [0.2, 0.37, 0]"),
        )
    };
    let mut before = light(0.02);
    for step in 3..700 {
        let size = f64::from(step) * 0.01;
        let after = light(size);
        let area = std::f64::consts::PI * size * size;
        assert_within("light of a disc", after.total(0) / FULL, area, 0.02);
        let most = most_change(&[before, after.clone()]) / FULL;
        // While a disc is on one pixel, that gets all that the area grows by: 2 pi r dr.
        let bound = 0.01 * (2.0 * std::f64::consts::PI * size.min(0.5)).max(1.0);
        assert!(
            most <= 1.1 * bound,
            "size {size}: a pixel changes by {most}, bound {bound}"
        );
        before = after;
    }
}

#[test]
fn r38_what_speeds_up_does_not_pop() {
    // From rest to two pixels long, a hundredth of a pixel a frame.
    let light = |length: f64| {
        let lines = format!(
            "size = 0.7\n speed = {}\n rotation_degrees = [-30, 90]\n particle_shape = \"streak\"
            generation_shape = {{ kind = \"circle\", radius = 0 }}",
            2.0 * length
        );
        light_of("cpu", "", &lines)
    };
    let mut before = light(0.0);
    for step in 1..200 {
        let after = light(0.01 * f64::from(step));
        // The start moves by 0.02, the end by 0.03.
        let most = most_change(&[before, after.clone()]) / FULL;
        assert!(
            most <= DISC_SLOPE * 0.03,
            "length {step}/100: a pixel changes by {most}"
        );
        before = after;
    }
}
