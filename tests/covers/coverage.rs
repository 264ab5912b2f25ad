//! How much of the pixels a shape covers: its area, wherever it stands between them.

use std::f64::consts::PI;

use glam::Vec2;
use motes::cpu::cover::coverage_at;
use motes::cpu::shape::{disc_of, segment_of, square_of, triangle_of};
use motes::layout::Cover;

use crate::{Random, drawn, frame_of, white};

/// Places between pixels.
fn shifts() -> impl Iterator<Item = (f32, f32)> {
    (0..8).flat_map(|x| (0..8).map(move |y| (x as f32 * 0.125, y as f32 * 0.125)))
}

/// Pixels that it covers in all, by alpha.
fn covered(record: Cover) -> f64 {
    let pixels = drawn(&[record], &frame_of(64, 64));
    pixels.iter().map(|pixel| 1.0 - f64::from(pixel[3])).sum()
}

fn assert_area(what: &str, got: f64, expected: f64, share: f64) {
    assert!(
        (got / expected - 1.0).abs() <= share,
        "{what}: {got} pixels, and its area is {expected}"
    );
}

#[test]
fn r38_discs_that_cover_have_their_area_wherever_they_stand() {
    // Half clear, for what is denser than a pixel cannot cover more than it.
    for radius in [0.2f32, 0.5, 0.7, 1.0, 1.5, 2.3, 4.0, 6.5, 12.0] {
        let area = PI * f64::from(radius).powi(2) * 0.5;
        for (x, y) in shifts() {
            let got = covered(disc_of(31.0 + x, 31.0 + y, radius, 0.0, &white(0.5, 1.0)));
            assert_area(&format!("disc of {radius} at {x}, {y}"), got, area, 0.02);
        }
    }
}

#[test]
fn r38_squares_that_cover_have_their_area() {
    for half in [0.1f32, 0.5, 1.3, 9.0] {
        let area = 4.0 * f64::from(half).powi(2);
        for (x, y) in shifts() {
            let got = covered(square_of(31.0 + x, 31.0 + y, half, &white(1.0, 1.0)));
            assert_area(&format!("square of {half} at {x}, {y}"), got, area, 1e-4);
        }
    }
}

#[test]
fn r38_segments_that_cover_have_their_area() {
    for (half, length) in [(0.05f32, 30.0f32), (0.5, 24.0), (1.0, 20.0), (3.0, 16.0)] {
        for turn in 0..12 {
            let angle = f64::from(turn) * PI / 12.0 + 0.05;
            let along = Vec2::new(angle.cos() as f32, angle.sin() as f32) * length;
            for (x, y) in shifts().step_by(7) {
                let middle = Vec2::new(32.0 + x, 32.0 + y);
                let (begin, end) = (middle - along * 0.5, middle + along * 0.5);
                let got = covered(segment_of(begin, end, half, &white(1.0, 1.0)));
                // Thin ones keep their pixel's width, and its round ends, but get clearer.
                let (half, length) = (f64::from(half), f64::from(length));
                let drawn = half.max(0.5);
                let share = (2.0 * half).min(1.0);
                let area = (2.0 * drawn * length + PI * (drawn * drawn + 1.0 / 12.0)) * share;
                let what = format!("segment of {half}, angle {angle}");
                assert_area(&what, got, area, 0.02);
            }
        }
    }
}

/// Part of the pixel within the triangle, by a grid of 64 x 64 points in it.
fn sampled(corners: [Vec2; 3], x: i32, y: i32) -> f64 {
    const SIDE: i32 = 64;
    let side = |a: Vec2, b: Vec2, px: f64, py: f64| {
        let (ax, ay, bx, by) = (
            f64::from(a.x),
            f64::from(a.y),
            f64::from(b.x),
            f64::from(b.y),
        );
        (bx - ax) * (py - ay) - (by - ay) * (px - ax) >= 0.0
    };
    let [a, b, c] = corners;
    let inside = |at: &i32| {
        let px = f64::from(x) + (f64::from(at % SIDE) + 0.5) / f64::from(SIDE);
        let py = f64::from(y) + (f64::from(at / SIDE) + 0.5) / f64::from(SIDE);
        let sides = [side(a, b, px, py), side(b, c, px, py), side(c, a, px, py)];
        sides == [true; 3] || sides == [false; 3]
    };
    (0..SIDE * SIDE).filter(inside).count() as f64 / f64::from(SIDE * SIDE)
}

#[test]
fn r38_triangles_cover_each_pixel_by_their_area_in_it() {
    let mut random = Random(77);
    for at in 0..400 {
        // Slivers, upright and level edges, and corners in and around a few pixels.
        let mut corner = || {
            let (x, y) = (random.within(-4.0, 8.0), random.within(-4.0, 8.0));
            match at % 4 {
                0 => Vec2::new(x.floor(), y),
                1 => Vec2::new(x, y.floor()),
                2 => Vec2::new(x, x * 0.7 + y * 0.02),
                _ => Vec2::new(x, y),
            }
        };
        let corners = [corner(), corner(), corner()];
        let record = triangle_of(corners[0], corners[1], corners[2], &white(1.0, 1.0));
        for y in -5..9 {
            for x in -5..9 {
                let got = f64::from(coverage_at(&record, x, y));
                let expected = sampled(corners, x, y);
                assert!(
                    (got - expected).abs() < 0.02,
                    "{corners:?}, pixel {x}, {y}: {got} instead of {expected}"
                );
            }
        }
    }
}

#[test]
fn triangles_that_share_sides_leave_no_gap() {
    // Two halves of a square, and a fan: every pixel inside is covered once.
    let center = Vec2::new(31.3, 32.6);
    let rim = |at: u32| {
        let angle = f64::from(at) * PI / 7.5;
        center + Vec2::new(angle.cos() as f32, angle.sin() as f32) * 20.0
    };
    let fan: Vec<Cover> = (0..15)
        .map(|at| triangle_of(center, rim(at), rim(at + 1), &white(1.0, 1.0)))
        .collect();
    for y in 20..45 {
        for x in 20..43 {
            let sum: f32 = fan.iter().map(|part| coverage_at(part, x, y)).sum();
            assert!((sum - 1.0).abs() < 1e-3, "pixel {x}, {y}: {sum}");
        }
    }
}
