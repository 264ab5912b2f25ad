//! Order: from far to near, of equal depth by identity, whatever the order in memory.

use motes::cpu::shape::{Look, disc_of, square_of};
use motes::layout::Cover;

use glam::{Vec3, Vec4};

use crate::common::hash;
use crate::{Random, anything, drawn, frame_of, white};

/// Squares of whole pixels, so that coverage is 0 or 1: left, top, right, bottom; depth, colour, alpha.
struct Pane {
    sides: [u32; 4],
    look: Look,
}

impl Pane {
    fn random(random: &mut Random, size: u32) -> Self {
        let half = 1 + (random.unit() * 12.0) as u32;
        let place = |x: f32| half + (x * (size - 2 * half) as f32) as u32;
        let (x, y) = (place(random.unit()), place(random.unit()));
        let look = Look {
            // Some are at the same depth.
            depth: (random.within(1.0, 60.0)).floor(),
            color: Vec4::new(random.unit(), random.unit(), random.unit(), random.unit()),
            lit: Vec3::ZERO,
        };
        Self {
            sides: [x - half, y - half, x + half, y + half],
            look,
        }
    }

    fn record(&self) -> Cover {
        let [left, top, right, bottom] = self.sides.map(|side| side as f32);
        square_of(
            0.5 * (left + right),
            0.5 * (top + bottom),
            0.5 * (right - left),
            &self.look,
        )
    }
}

/// The painter: each pane over all that is there, far panes first, in doubles.
fn painted(panes: &[Pane], size: u32) -> Vec<[f64; 4]> {
    let mut far_first: Vec<&Pane> = panes.iter().collect();
    far_first.sort_by(|a, b| b.look.depth.total_cmp(&a.look.depth));
    let mut pixels = vec![[0.0, 0.0, 0.0, 1.0]; (size * size) as usize];
    for pane in far_first {
        let [left, top, right, bottom] = pane.sides;
        let color = pane.look.color.to_array().map(f64::from);
        for y in top..bottom {
            for x in left..right {
                let pixel = &mut pixels[(y * size + x) as usize];
                for channel in 0..3 {
                    pixel[channel] = color[channel] * color[3] + pixel[channel] * (1.0 - color[3]);
                }
                pixel[3] *= 1.0 - color[3];
            }
        }
    }
    pixels
}

#[test]
fn r84_pictures_are_the_painters() {
    let size = 64;
    for (seed, count) in [0, 1, 2, 30, 300, 3000].into_iter().enumerate() {
        let mut random = Random(seed as u32 * 100_000);
        let panes: Vec<Pane> = (0..count)
            .map(|_| Pane::random(&mut random, size))
            .collect();
        let records: Vec<Cover> = panes.iter().map(Pane::record).collect();
        let got = drawn(&records, &frame_of(size, size));
        for (at, (got, expected)) in got.iter().zip(painted(&panes, size)).enumerate() {
            for channel in 0..4 {
                let off = f64::from(got[channel]) - expected[channel];
                // What shows less than 2^-16 of itself is left out.
                assert!(
                    off.abs() < 2e-5,
                    "{count} panes, pixel {at}: {got:?}, {expected:?}"
                );
            }
        }
    }
}

#[test]
fn r84_of_equal_depth_the_later_is_in_front() {
    let pane = |red: f32, depth: f32| {
        let look = Look {
            color: Vec4::new(red, 1.0 - red, 0.0, 1.0),
            ..white(1.0, depth)
        };
        square_of(4.0, 4.0, 4.0, &look)
    };
    let red_at = |records: &[Cover]| drawn(records, &frame_of(8, 8))[0][0];
    assert_eq!(red_at(&[pane(0.25, 5.0), pane(0.75, 5.0)]), 0.75);
    assert_eq!(red_at(&[pane(0.75, 5.0), pane(0.25, 5.0)]), 0.25);
    assert_eq!(red_at(&[pane(0.75, 5.0), pane(0.25, 5.000_001)]), 0.75);
    assert_eq!(red_at(&[pane(0.25, 5.000_001), pane(0.75, 5.0)]), 0.75);
    // Behind a flat camera, too.
    assert_eq!(red_at(&[pane(0.75, -5.0), pane(0.25, -4.0)]), 0.75);
    assert_eq!(red_at(&[pane(0.75, -5.0), pane(0.25, 0.0)]), 0.75);
}

#[test]
fn the_order_in_memory_does_not_matter() {
    let (width, height) = (96, 64);
    let frame = frame_of(width, height);
    let mut records = anything(800, width, height, 9);
    // All at depths of their own.
    for (at, record) in records.iter_mut().enumerate() {
        record.shape[3] = (2.0 + at as f32 * 0.01).to_bits();
    }
    let expected = drawn(&records, &frame);
    for salt in 0..4 {
        records.sort_by_key(|record| hash(salt ^ record.shape[3]));
        assert!(
            drawn(&records, &frame) == expected,
            "another picture, salt {salt}"
        );
    }
}

#[test]
fn nothing_covers_nothing() {
    let frame = frame_of(9, 7);
    let empty = [0.0, 0.0, 0.0, 1.0];
    assert!(drawn(&[], &frame).iter().all(|pixel| *pixel == empty));
    let clear = [
        Cover::default(),
        disc_of(4.0, 4.0, 3.0, 0.0, &white(0.0, 1.0)),
    ];
    assert!(drawn(&clear, &frame).iter().all(|pixel| *pixel == empty));
    let outside = [disc_of(-40.0, 4.0, 30.0, 0.0, &white(1.0, 1.0))];
    assert!(drawn(&outside, &frame).iter().all(|pixel| *pixel == empty));
}
