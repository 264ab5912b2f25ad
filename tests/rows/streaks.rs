//! Motion blur: Reeves (1983), section 3.

use std::f64::consts::PI;

use glam::DVec2;

use crate::light::{coverage, light_of};
use crate::support::{assert_within, on_every_backend, sample, scene as scene_of};

/// A streak that flies along cos a x + sin a y, `speed` a frame; its first frame is drawn.
fn streak(size: f64, speed: f64, degrees: f64, (x, y): (f64, f64)) -> String {
    format!(
        "size = {size}\n speed = {speed}\n rotation_degrees = [{}, 90]\n position = [{x}, {y}, 0]
        generation_shape = {{ kind = \"circle\", radius = 0 }}\n particle_shape = \"streak\"",
        -degrees
    )
}

/// Total light, its centre, and its second moment along its main axis, with that axis.
struct Moments {
    total: f64,
    center: DVec2,
    along: f64,
    axis: DVec2,
}

/// Column, row and light.
type Sample = (f64, f64, f64);

/// The light of one particle, sampled at quarters of pixels: from pictures with the particle
/// shifted by so much, pixels alone being too few across a thin streak. `lines` are of the
/// particle shifted to the right and downward.
fn samples(on: &str, picture: &str, lines: impl Fn(f64, f64) -> String) -> Vec<Sample> {
    let mut samples = Vec::new();
    for step in 0..16 {
        let (right, down) = (f64::from(step % 4) / 4.0, f64::from(step / 4) / 4.0);
        let light = light_of(on, picture, &lines(right, down));
        samples.extend(
            light
                .pixels(0)
                .map(|(x, y, light)| (x - right, y - down, light / 16.0)),
        );
    }
    samples
}

fn moments(samples: &[Sample]) -> Moments {
    let sums = samples
        .iter()
        .fold((0.0, DVec2::ZERO), |(total, first), &(x, y, light)| {
            (total + light, first + light * DVec2::new(x, y))
        });
    let (total, center) = (sums.0, sums.1 / sums.0);
    let second = samples
        .iter()
        .fold([0.0; 3], |[xx, xy, yy], &(x, y, light)| {
            let d = DVec2::new(x, y) - center;
            [
                xx + light * d.x * d.x,
                xy + light * d.x * d.y,
                yy + light * d.y * d.y,
            ]
        });
    let angle = 0.5 * (2.0 * second[1]).atan2(second[0] - second[2]);
    let axis = DVec2::new(angle.cos(), angle.sin());
    let along = axis.x * axis.x * second[0]
        + 2.0 * axis.x * axis.y * second[1]
        + axis.y * axis.y * second[2];
    Moments {
        total,
        center,
        along,
        axis,
    }
}

/// Where a streak begins and ends, in pixels, by its light alone.
///
/// The streak is even between its ends, w light a pixel: total T = w L + 2 c and second moment
/// S = w L^3 / 12 + 2 (c L^2 / 4 + L c1 + c2), where c, c1 and c2 are an end's moments beyond its
/// point. An end is half of the streak's own profile k(d) across, turned about the point, so these
/// are integrals of k(d) d, k(d) d^2 and k(d) d^3, measured around the middle. With w gone, S rises
/// with L, and is solved for it.
fn ends(samples: &[Sample]) -> [DVec2; 2] {
    let of = moments(samples);
    // Well within the ends, and smooth, so that places of pixels average out.
    let window = 0.3 * (12.0 * of.along / of.total).sqrt();
    let across = |power: i32| {
        let sum: f64 = samples
            .iter()
            .map(|&(x, y, light)| {
                let from_center = DVec2::new(x, y) - of.center;
                let (u, d) = (
                    from_center.dot(of.axis),
                    from_center.perp_dot(of.axis).abs(),
                );
                let share = (0.5 * PI * u / window).cos().powi(2);
                if u.abs() < window {
                    light * share * d.powi(power)
                } else {
                    0.0
                }
            })
            .sum();
        sum / window
    };
    let (c, c1, c2) = (PI / 2.0 * across(1), across(2), PI / 4.0 * across(3));
    let second = |length: f64| {
        (of.total - 2.0 * c) * length * length / 12.0
            + 2.0 * (c * length * length / 4.0 + length * c1 + c2)
    };
    let (mut low, mut high) = (0.0, 1000.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if second(middle) < of.along {
            low = middle
        } else {
            high = middle
        }
    }
    let half = 0.5 * low * of.axis;
    [of.center - half, of.center + half]
}

/// Fails unless the streak's ends are these, in either order, to 0.1 pixels.
fn assert_ends(what: &str, got: [DVec2; 2], expected: [DVec2; 2]) {
    let off = |a: usize, b: usize| {
        got[a]
            .distance(expected[0])
            .max(got[b].distance(expected[1]))
    };
    let off = off(0, 1).min(off(1, 0));
    println!("{what}: ends off by {off:.3} px");
    assert!(
        off <= 0.1,
        "{what}: ends at {got:?}, expected {expected:?}, off by {off} px"
    );
}

const CONSTANT: &str = "streak_light = \"constant\"";

#[test]
fn r59_streaks_span_from_the_frames_start_to_when_the_shutter_closes() {
    on_every_backend(|on| {
        for &(size, speed, degrees) in sample(
            on,
            &[
                (1.5, 24.0, 0.0),
                (0.5, 30.0, 31.0),
                (0.5, 24.0, 90.0),
                (2.0, 30.0, -58.0),
                (1.0, 20.0, 45.0),
            ],
        ) {
            let direction = DVec2::new(
                f64::to_radians(degrees).cos(),
                -f64::to_radians(degrees).sin(),
            );
            // Born so far back that the streak is around the middle of the picture.
            let at = (-1.2 * speed * direction.x, 1.2 * speed * direction.y);
            // Rows count down. After its first frame: p = p0 + v.
            let start = DVec2::new(32.0 + at.0, 32.0 - at.1) + speed * direction;
            let what = format!("radius {size}, {speed} a frame at {degrees} degrees");
            for share in [CONSTANT, ""] {
                let samples = samples(on, "", |right, down| {
                    let at = (at.0 + right, at.1 - down);
                    format!("{}\n{share}", streak(size, speed, degrees, at))
                });
                assert_ends(
                    &what,
                    ends(&samples),
                    [start, start + 0.5 * speed * direction],
                );
            }
        }
    });
}

#[test]
fn r59_ends_are_projected_each_at_its_own_depth() {
    // The camera stands at z = 32 with a focal length of 32 pixels.
    let projected = |[x, y, z]: [f64; 3]| {
        DVec2::new(32.0 + 32.0 * x / (32.0 - z), 32.0 - 32.0 * y / (32.0 - z))
    };
    on_every_backend(|on| {
        for &z_speed in sample(on, &[14.0, -20.0, 6.0]) {
            // Local +z about x by a, then about y by b, of length `speed`: to the right and nearer.
            let (a, b) = (-0.3f64, f64::atan2(24.0, z_speed));
            let speed = f64::hypot(24.0, z_speed) / a.cos();
            let v = [24.0, -speed * a.sin(), z_speed];
            let lines = format!(
                "size = 1.2\n speed = {speed}\n rotation_degrees = [{}, {}]\n position = [-30, -6, 0]
                generation_shape = {{ kind = \"circle\", radius = 0 }}
                particle_shape = \"streak\"\n {CONSTANT}",
                a.to_degrees(),
                b.to_degrees()
            );
            // Askew, so that its pixels are at many distances from its middle already.
            let samples: Vec<Sample> = light_of(on, "", &lines).pixels(0).collect();
            let after = |frames: f64| [-30.0 + frames * v[0], -6.0 + frames * v[1], frames * v[2]];
            let expected = [projected(after(1.0)), projected(after(1.5))];
            assert_ends(
                &format!("{z_speed} nearer a frame"),
                ends(&samples),
                expected,
            );
        }
    });
}

#[test]
fn r59_a_streaks_light_does_not_depend_on_its_length() {
    // RA8.
    on_every_backend(|on| {
        for &size in sample(on, &[0.7, 2.5, 0.1, 0.3, 1.2, 4.0, 5.5]) {
            for &degrees in sample(on, &[0.0, 37.0, 45.0, 90.0]) {
                for &speed in sample(on, &[40.0, 0.01, 0.05, 0.5, 3.0, 12.0]) {
                    let a = f64::to_radians(degrees);
                    let at = (-1.25 * speed * a.cos(), -1.25 * speed * a.sin());
                    let light = light_of(on, "", &streak(size, speed, degrees, at));
                    let what = format!("radius {size}, {speed} a frame at {degrees} degrees");
                    assert_within(&what, coverage(&light), PI * size * size, 0.01);
                }
            }
        }
        // Also of one that leaves the picture on both sides: what is inside is the even share.
        let long = light_of(on, "", &streak(1.0, 400.0, 0.0, (-500.0, 0.0)));
        let expected = PI * 64.0 / (200.0 + PI / 2.0);
        assert_within(
            "what is seen of a long streak",
            coverage(&long),
            expected,
            0.01,
        );
    });
}

#[test]
fn r59_conserved_and_constant_streaks_have_one_shape() {
    let of = |share: &str| {
        samples("cpu", "", |right, down| {
            let streak = streak(2.0, 20.0, 20.0, (-20.0 + right, -8.0 - down));
            format!("{streak}\n{share}")
        })
    };
    let (conserved, constant) = (of(""), of(CONSTANT));
    let (a, b) = (moments(&conserved), moments(&constant));
    assert!(
        b.total > 3.0 * a.total,
        "a constant streak is as bright as it is long"
    );
    assert!(a.center.distance(b.center) < 0.02);
    assert_within(
        "length",
        (a.along / a.total).sqrt(),
        (b.along / b.total).sqrt(),
        0.01,
    );
}

#[test]
fn r58_the_shutter_is_open_for_half_a_frame_or_as_the_scene_says() {
    on_every_backend(|on| {
        let lines = |right: f64, down: f64| {
            format!(
                "{}\n{CONSTANT}",
                streak(1.5, 40.0, 0.0, (-50.0 + right, 0.3 - down))
            )
        };
        let span = |picture: &str| {
            let [a, b] = ends(&samples(on, picture, lines));
            a.distance(b)
        };
        let (default, half, shorter) = (
            span(""),
            span("image.shutter = 0.5"),
            span("image.shutter = 0.48"),
        );
        println!("default {default:.3} px, 0.5 {half:.3} px, 0.48 {shorter:.3} px");
        assert_eq!(default, half);
        assert!((half - 20.0).abs() <= 0.1, "{half}");
        assert!((shorter - 19.2).abs() <= 0.1, "{shorter}");
        assert!(light_of(on, "image.shutter = 0", &lines(0.0, 0.0)).total(0) > 0.0);
    });
    assert_eq!(scene_of("", &[""]).image.shutter, 0.5);
}
