//! Antialiasing: what moves by a fraction of a pixel changes by a fraction (Reeves 1983, 2.5).

use crate::raster::light_of;
use crate::support::{Light, assert_within, on_every_backend};

const SHIFT_PX: f64 = 0.125;

/// Pictures of one particle, each an eighth of a pixel further along (x, y), from a start that is
/// on no pixel's middle or edge.
fn pictures(on: &str, lines: &str, (x, y): (f64, f64), count: u32) -> Vec<Light> {
    (0..count)
        .map(|step| {
            let along = SHIFT_PX * f64::from(step);
            let place = format!("position = [{}, {}, 0]", 0.03 + along * x, -0.41 + along * y);
            light_of(on, "", &format!("{place}\n{lines}"))
        })
        .collect()
}

/// Asserts constant light and bounded change: a shift by s pixels changes no pixel by more than s
/// of the full colour along an axis, and by more than the sum of its two parts across.
fn assert_steady(what: &str, pictures: &[Light], (x, y): (f64, f64)) {
    let total = pictures[0].total(0);
    assert!(total > 0.0);
    for picture in pictures {
        assert_within(&format!("{what}: light"), picture.total(0), total, 0.01);
    }
    let bound = SHIFT_PX * (x.abs() + y.abs()) * 64.0;
    let mut most = 0.0f64;
    for pair in pictures.windows(2) {
        for ((_, _, before), (_, _, after)) in pair[0].pixels(0).zip(pair[1].pixels(0)) {
            most = most.max((after - before).abs());
        }
    }
    println!("{what}: a pixel changes by {:.3} of the bound", most / bound);
    assert!(most <= bound + 1e-4, "{what}: a pixel changes by {most}, more than {bound}");
    assert!(most > 0.0, "{what}: nothing moves");
}

const DIRECTIONS: [(f64, f64); 3] = [(1.0, 0.0), (0.0, 1.0), (1.0, -1.0)];

#[test]
fn r38_discs_are_steady() {
    on_every_backend(|on| {
        let (sizes, count): (&[f64], _) = if on == "cpu" {
            (&[0.05, 0.2, 0.4, 0.5, 0.57, 0.6, 0.8, 1.0, 1.5, 2.0, 2.5, 3.0, 3.7, 3.99, 4.01, 6.3, 11.0], 17)
        } else {
            (&[0.2, 1.0], 9)
        };
        for size in sizes {
            for direction in DIRECTIONS {
                let lines = format!("size = {size}");
                let what = format!("disc of {size} px along {direction:?}");
                assert_steady(&what, &pictures(on, &lines, direction, count), direction);
            }
        }
    });
}

#[test]
fn r38_squares_are_steady() {
    on_every_backend(|on| {
        let (sizes, count): (&[f64], _) =
            if on == "cpu" { (&[0.05, 0.3, 0.5, 0.8, 1.0, 2.2, 7.0], 17) } else { (&[0.3, 2.2], 9) };
        for size in sizes {
            for direction in DIRECTIONS {
                let lines = format!("size = {size}\n particle_shape = \"rectangle\"");
                let what = format!("square of {size} px along {direction:?}");
                assert_steady(&what, &pictures(on, &lines, direction, count), direction);
            }
        }
    });
}

#[test]
fn r38_streaks_are_steady() {
    on_every_backend(|on| {
        let (sizes, count): (&[f64], _) =
            if on == "cpu" { (&[0.1, 0.5, 1.0, 2.0, 4.5], 17) } else { (&[0.5], 9) };
        for size in sizes {
            for (rotation, speed) in
                [("[0, 90]", 8.0), ("[-90, 0]", 3.0), ("[-45, 90]", 12.0), ("[-17, 90]", 20.0), ("[-61, 90]", 0.4)]
            {
                for light in ["conserved", "constant"] {
                    for direction in DIRECTIONS {
                        let lines = format!(
                            "size = {size}\n speed = {speed}\n rotation_degrees = {rotation}
                            generation_shape = {{ kind = \"circle\", radius = 0 }}
                            particle_shape = \"streak\"\n streak_light = \"{light}\""
                        );
                        let what =
                            format!("{light} streak of {size} px, {speed} a frame, {rotation}, {direction:?}");
                        assert_steady(&what, &pictures(on, &lines, direction, count), direction);
                    }
                }
            }
        }
    });
}

#[test]
fn r38_what_grows_or_speeds_up_does_not_pop() {
    // Growing across every limit in the drawing of discs, a hundredth of a pixel a frame: a disc's
    // pixel changes by at most that much colour times the slope of its edge, and of its gain.
    let light = |size: f64| light_of("cpu", "", &format!("size = {size}\n position = [0.2, 0.37, 0]"));
    let mut before = light(0.02);
    for step in 3..700 {
        let size = f64::from(step) * 0.01;
        let after = light(size);
        let expected = std::f64::consts::PI * size * size;
        assert_within("light of a disc", after.total(0) / 64.0, expected, 0.02);
        let pairs = before.pixels(0).zip(after.pixels(0));
        let most = pairs.map(|(a, b)| (b.2 - a.2).abs()).fold(0.0, f64::max);
        // 2 pi r dr of light in all while it is on one pixel.
        let bound = 64.0 * 0.01 * (2.0 * std::f64::consts::PI * size.min(0.5)).max(1.0);
        assert!(most <= 1.1 * bound, "size {size}: a pixel changes by {most}, bound {bound}");
        before = after;
    }
}
