//! Particles as lights on pixels: Reeves (1983), sections 2.2 and 2.5.

use std::f64::consts::PI;

use crate::light::{Light, coverage, light_of};
use crate::support::{Run, assert_within, on_every_backend, sample, scene};

#[test]
fn r22_each_shape_covers_its_area() {
    on_every_backend(|on| {
        for &size in sample(on, &[0.3, 3.0, 0.5, 1.0, 1.7, 6.0, 12.5]) {
            let lines = format!("size = {size}\n position = [1.3, -2.6, 0]");
            let disc = coverage(&light_of(on, "", &lines));
            assert_within(
                &format!("disc of radius {size}"),
                disc,
                PI * size * size,
                0.02,
            );
            let lines = format!("{lines}\n particle_shape = \"rectangle\"");
            let square = coverage(&light_of(on, "", &lines));
            assert_within(
                &format!("square of half-width {size}"),
                square,
                4.0 * size * size,
                0.02,
            );
        }
        // A streak is half a frame's motion long; every covered pixel full.
        let streaks = [
            (1.0, 40.0),
            (3.0, 20.0),
            (0.5, 30.0),
            (1.5, 30.0),
            (2.0, 36.0),
            (5.0, 10.0),
        ];
        for &(size, speed) in sample(on, &streaks) {
            for &rotation in sample(on, &["[0, 90]", "[-30, 90]", "[-90, 0]"]) {
                let lines = format!(
                    "size = {size}\n speed = {speed}\n particle_shape = \"streak\"
                    streak_light = \"constant\"\n rotation_degrees = {rotation}
                    generation_shape = {{ kind = \"circle\", radius = 0 }}"
                );
                // About x first, then about y: [-30, 90] leaves along cos 30 x + sin 30 y.
                let (x, y) = match rotation {
                    "[0, 90]" => (1.0, 0.0),
                    "[-90, 0]" => (0.0, 1.0),
                    _ => (0.75f64.sqrt(), 0.5),
                };
                let lines = format!(
                    "{lines}\n position = [{}, {}, 0]",
                    -1.25 * speed * x,
                    -1.25 * speed * y
                );
                let streak = coverage(&light_of(on, "", &lines));
                let expected = 2.0 * size * 0.5 * speed + PI * size * size;
                let what = format!("streak of radius {size}, {speed} a frame, {rotation}");
                assert_within(&what, streak, expected, 0.02);
            }
        }
    });
}

#[test]
fn r22_shapes_have_their_outlines() {
    on_every_backend(|on| {
        let [disc, square] = ["sphere", "rectangle"].map(|shape| {
            light_of(
                on,
                "",
                &format!("size = 9\n position = [0.25, 0.5, 0]\n particle_shape = \"{shape}\""),
            )
        });
        let check = |light: &Light, distance: &dyn Fn(f64, f64) -> f64| {
            for (x, y, light) in light.pixels(0) {
                let distance = distance(x - 32.25, y - 31.5);
                if distance < 9.0 - 1.0 {
                    assert_eq!(light, 64.0, "pixel at {x}, {y} is inside");
                } else if distance > 9.0 + 1.0 {
                    assert_eq!(light, 0.0, "pixel at {x}, {y} is outside");
                }
            }
        };
        check(&disc, &|dx, dy| dx.hypot(dy));
        check(&square, &|dx, dy| dx.abs().max(dy.abs()));
    });
}

#[test]
fn r34_equal_particles_on_a_pixel_add_up_and_clamp() {
    // Squares of just one pixel.
    let lines = "size = 0.5\n position = [0.5, 0.5, 0]\n particle_shape = \"rectangle\"
        color = [0.07, 0.21, 0.0305]";
    on_every_backend(|on| {
        for &count in sample(on, &[3, 33, 1, 2, 5, 14, 15, 100]) {
            let lines = format!("{lines}\n initial_mean_parts = {count}");
            let mut run = Run::new(on, &scene("", &[&lines]), 1);
            run.step_to(0);
            let image = run.image();
            let at = (31 * 64 + 32) * 4;
            for (channel, color) in [0.07, 0.21, 0.0305].into_iter().enumerate() {
                let expected = (f64::from(count) * color).min(1.0);
                let byte = (expected * 255.0 + 0.5).floor() as u8;
                assert_eq!(
                    image[at + channel],
                    byte,
                    "{count} particles, channel {channel}"
                );
                let light = run.light().at(32, 31, channel);
                let rounding = f64::from(count) / f64::from(1 << 20);
                assert!(
                    (light - f64::from(count) * color).abs() <= rounding,
                    "{light}"
                );
            }
            // And on no other pixel.
            let others = image.chunks(4).filter(|pixel| pixel[..3] != [0; 3]).count();
            assert_eq!(others, 1, "{count} particles");
        }
    });
}

#[test]
fn r34_a_particle_behind_another_is_not_hidden() {
    // A large near disc and a small far one in the same direction.
    let near = "name = \"near\"\n end_frame = 1\n size = 2\n position = [0, 0, 16]";
    let far = "name = \"far\"\n end_frame = 1\n size = 2\n position = [0, 0, -32]";
    on_every_backend(|on| {
        let light = |systems: &[&str]| {
            let mut run = Run::new(on, &scene("", systems), 1);
            run.step_to(0);
            run.light()
        };
        let (both, near_alone, far_alone) = (light(&[near, far]), light(&[near]), light(&[far]));
        assert!(near_alone.total(0) > far_alone.total(0) && far_alone.total(0) > 0.0);
        let sum = near_alone
            .steps
            .iter()
            .zip(&far_alone.steps)
            .map(|(a, b)| a + b);
        assert!(both.steps.iter().copied().eq(sum), "light does not add up");
    });
}

#[test]
fn r35_light_does_not_depend_on_distance() {
    on_every_backend(|on| {
        for shape in ["sphere", "rectangle", "streak"] {
            // Twice as far, twice as large, twice as fast and to the side: the same on the screen.
            let at_depth = |depth: f64| {
                let scale = depth / 32.0;
                let lines = format!(
                    "position = [{}, {}, {}]\n size = {}\n speed = {}\n rotation_degrees = [0, 90]
                    generation_shape = {{ kind = \"circle\", radius = 0 }}
                    particle_shape = \"{shape}\"",
                    -6.5 * scale,
                    3.25 * scale,
                    32.0 - depth,
                    2.5 * scale,
                    8.0 * scale
                );
                light_of(on, "", &lines)
            };
            let near = at_depth(8.0);
            assert!(near.total(0) > 1000.0);
            for &depth in sample(on, &[16.0, 256.0, 32.0]) {
                assert!(
                    at_depth(depth) == near,
                    "{shape}: another picture from {depth} away"
                );
            }
            assert_within(shape, at_depth(91.7).total(0), near.total(0), 1e-4);
        }
    });
}

#[test]
fn r37_the_projected_size_decides_the_pixels() {
    on_every_backend(|on| {
        // 90 degrees over 96 pixels, and 40 degrees.
        for (fov, focal) in [(40.0, 48.0 / 20.0f64.to_radians().tan()), (90.0, 48.0)] {
            let picture = format!(
                "image.width = 160\n image.height = 96\n camera.vertical_fov_degrees = {fov}"
            );
            let sizes = [
                (0.5, 20.0),
                (2.0, 40.0),
                (0.5, 5.0),
                (1.0, 9.0),
                (0.05, 1.0),
            ];
            for &(size, depth) in sample(on, &sizes) {
                let radius = size * focal / depth;
                for (x, y) in [(0.0, 0.0), (0.3 * depth, -0.1 * depth)] {
                    let lines = format!("size = {size}\n position = [{x}, {y}, {}]", 32.0 - depth);
                    let disc = light_of(on, &picture, &lines);
                    let what = format!("disc of {size} at {depth}, {fov} degrees");
                    assert_within(&what, coverage(&disc), PI * radius * radius, 0.02);
                    let center = disc.pixels(0).fold([0.0; 3], |sum, (x, y, light)| {
                        [sum[0] + light, sum[1] + light * x, sum[2] + light * y]
                    });
                    let off_x = center[1] / center[0] - (80.0 + x * focal / depth);
                    let off_y = center[2] / center[0] - (48.0 - y * focal / depth);
                    assert!(off_x.hypot(off_y) < 0.05, "{what}: off by {off_x}, {off_y}");
                    let lines = format!("{lines}\n particle_shape = \"rectangle\"");
                    let square = light_of(on, &picture, &lines);
                    assert_within(&what, coverage(&square), 4.0 * radius * radius, 0.02);
                }
            }
        }
        // Nothing is drawn nearer than `near`, nor behind the camera.
        for z in [31.95, 32.0, 40.0] {
            assert!(
                light_of(on, "", &format!("position = [0, 0, {z}]")).is_dark(),
                "at {z}"
            );
        }
    });
}

#[test]
fn r39_sums_clamp_and_never_wrap() {
    on_every_backend(|on| {
        let pixel = |count: u32, color: f64| {
            let lines = format!(
                "size = 0.5\n position = [0.5, 0.5, 0]\n particle_shape = \"rectangle\"
                end_frame = 1\n initial_mean_parts = {count}\n color = [{color}, 0, {color}]"
            );
            let mut run = Run::new(on, &scene("", &[&lines]), 1);
            run.step_to(0);
            let image = run.image();
            let at = (31 * 64 + 32) * 4;
            (
                [image[at], image[at + 1], image[at + 2]],
                run.light().at(32, 31, 0),
            )
        };
        assert_eq!(pixel(1, 1.0 / 255.0).0, [1, 0, 1]);
        assert_eq!(pixel(254, 1.0 / 255.0).0, [254, 0, 254]);
        assert_eq!(pixel(300, 1.0 / 255.0).0, [255, 0, 255]);
        // 2^32 steps of light are 4,096: well past what 32 bits hold.
        assert_eq!(pixel(20_000, 1000.0), ([255, 0, 255], 2e7));
    });
}
