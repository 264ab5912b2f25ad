//! What flames look like: shape by age, facing, accumulation, colours.

use motes::layout::AgeLook;
use motes::scene::Camera;

use crate::support::*;

/// A particle that stays where it is: 25 discs in one place.
const STILL: &str = "speed = \"free\"\nstart_speed = 0\nbuoyancy = 0\nwidth = 0.8\n\
                     ramp = [{ age = 0, center = [1, 0.5, 0.25], rim = [1, 0.5, 0.25], alpha = 0.02 }]\n\
                     base_width = 1\nswell = 0\nbase_height = 1\nheight_growth = 0\n\
                     [[fire.flame]]\nposition = [0, 0.5, 0]\n";

fn looks(lines: &str) -> Vec<AgeLook> {
    plan(&flame(lines)).inputs(0).age_looks
}

#[test]
fn p22_light_falls_linearly_to_the_rim() {
    let mut scene = flame(STILL);
    (scene.image.width, scene.image.height) = (401, 401);
    let drawn = drawn(&scene, 0);
    let middle = 200;
    let at = |x: usize| drawn.light[middle * 401 + x][0];
    // Pixels of a world unit, from the camera's angle and distance.
    let radius = 0.4 * 200.5 / (22.5f64.to_radians().tan() * 2.5);
    assert!(
        (at(middle) - 0.5).abs() < 1e-3,
        "25 times 0.02: {}",
        at(middle)
    );
    for x in middle..401 {
        let r = (x - middle) as f64 / radius;
        let wanted = (0.5 * (1.0 - r)).max(0.0);
        assert!(
            (at(x) - wanted).abs() < 0.005,
            "{} instead of {wanted}",
            at(x)
        );
    }
    assert!(at(middle + radius as usize - 1) > 0.0 && at(middle + radius as usize + 2) == 0.0);
}

#[test]
fn p24_particles_face_the_viewer() {
    let seen_from = |position: [f32; 3], up: [f32; 3]| {
        let mut scene = flame(STILL);
        scene.camera = Camera {
            position,
            up,
            target: [0.0, 0.5, 0.0],
            ..scene.camera
        };
        drawn(&scene, 0).light
    };
    let (up, ahead) = ([0.0, 1.0, 0.0], [0.0, 0.0, -1.0]);
    let front = seen_from([0.0, 0.5, 2.0], up);
    assert!(front.iter().filter(|pixel| pixel[0] > 0.0).count() > 1000);
    for (position, up) in [
        ([2.0, 0.5, 0.0], up),
        ([-2.0, 0.5, 0.0], up),
        ([0.0, 0.5, -2.0], up),
        ([0.0, 2.5, 0.0], ahead),
        ([0.0, -1.5, 0.0], ahead),
    ] {
        for (a, b) in seen_from(position, up).iter().zip(&front) {
            assert!(length(minus(*a, *b)) < 1e-4, "{a:?} {b:?}");
        }
    }
}

#[test]
fn p27_the_width_is_half_a_sine_over_the_ages() {
    let looks = looks("");
    for (age, wanted) in [
        (0, 0.67),
        (6, 0.95284),
        (12, 1.07),
        (18, 0.95284),
        (24, 0.67),
    ] {
        let width = looks[age].scale[0];
        assert!((width - wanted).abs() < 1e-5, "{width} at age {age}");
    }
    // It reaches the discs: the widest is in the middle.
    let drawn = drawn(&flame("height = 0.5"), 0);
    let width = |age: usize| 1.0 / f64::from(f32::from_bits(drawn.discs[age].place[2]));
    assert!((width(12) / width(0) - 1.07 / 0.67).abs() < 2e-3);
}

#[test]
fn p28_the_height_grows_by_0_032_a_step() {
    let looks = looks("");
    let rise = looks[24].scale[1] - looks[0].scale[1];
    assert!((rise - 0.768).abs() < 1e-6, "{rise}");
    for pair in looks.windows(2) {
        assert!((pair[1].scale[1] - pair[0].scale[1] - 0.032).abs() < 1e-6);
    }
}

#[test]
fn p29_particles_are_wide_at_the_root_and_high_at_the_tip() {
    let drawn = drawn(&flame("height = 0.5"), 0);
    let ratio = |age: usize| {
        let [_, _, inverse_width, inverse_height] = drawn.discs[age].place.map(f32::from_bits);
        inverse_width / inverse_height
    };
    assert!((ratio(0) - 0.3 / 0.67).abs() < 1e-4, "{}", ratio(0));
    assert!((ratio(24) - 1.068 / 0.67).abs() < 1e-4, "{}", ratio(24));
}

#[test]
fn p30_light_accumulates_to_saturation_in_any_order() {
    let fire = |name: &str, x: &str| {
        format!(
            "name = \"{name}\"\nnoisiness = 0\nbrightness = 1.7\n[[fire.flame]]\nposition = [{x}, 0, 0]"
        )
    };
    let (a, b) = (fire("a", "0"), fire("b", "0.05"));
    let [ab, ba] =
        [[&a, &b], [&b, &a]].map(|two| drawn(&scene_with(&two.map(String::as_str), ""), 0));
    assert_eq!(ab.light, ba.light);
    assert_eq!(ab.image, ba.image);
    let alone = [&a, &b].map(|one| drawn(&scene_with(&[one], ""), 0).light);
    let mut saturated = 0;
    for (at, word) in ab.image.iter().enumerate() {
        let sums = [0, 1, 2].map(|channel| alone[0][at][channel] + alone[1][at][channel]);
        for (channel, (sum, both)) in sums.into_iter().zip(ab.light[at]).enumerate() {
            assert!((sum - both).abs() < 1e-5);
            let byte = f64::from((word >> (8 * channel)) & 255);
            let wanted = sum.min(1.0) * 255.0;
            assert!((byte - wanted).abs() <= 0.51, "{byte} of {sum}");
            saturated += u32::from(sum > 1.0);
        }
    }
    assert!(saturated > 100, "{saturated}");
}

#[test]
fn p31_edges_are_more_red_than_green_and_more_green_than_blue() {
    let scene = scene_with(
        &["name = \"fire\"\n[[fire.flame]]\nposition = [0, 0, 0]"],
        "",
    );
    let (mut edges, mut strict) = (0, 0);
    for light in drawn(&scene, 5).light {
        let [red, green, blue] = light;
        // Where a byte shows it, and nothing is saturated.
        if red > 2.0 / 255.0 && red < 1.0 {
            edges += 1;
            assert!(red >= green && green >= blue, "{light:?}");
            strict += u32::from(red > green && green > blue);
        }
    }
    assert!(
        edges > 300 && f64::from(strict) >= 0.9 * f64::from(edges),
        "{strict} of {edges}"
    );
}

#[test]
fn p32_a_straight_flame_is_its_own_mirror_image() {
    let drawn = drawn(&flame("height = 0.9"), 0);
    let mut lit = 0;
    for line in drawn.image.chunks(160) {
        for x in 0..80 {
            for channel in 0..3 {
                let byte = |x: usize| (line[x] >> (8 * channel)) & 255;
                assert!(byte(x).abs_diff(byte(159 - x)) <= 1);
                lit += u32::from(byte(x) > 0);
            }
        }
    }
    assert!(lit > 500, "{lit}");
}

#[test]
fn p48_what_is_small_is_as_bright_as_it_should_be() {
    // The same flame from farther away: a fourth of the light a factor of two.
    let total = |distance: f32| {
        let mut scene = flame("height = 0.3\nwidth = 0.06\nbrightness = 0.3");
        scene.camera.position = [0.013, 0.15, distance];
        scene.camera.target = [0.0, 0.15, 0.0];
        scene.camera.vertical_fov_degrees = 20.0;
        drawn(&scene, 0)
            .light
            .iter()
            .map(|pixel| pixel[0])
            .sum::<f64>()
    };
    let near = total(2.0);
    for factor in [2.0, 4.0, 8.0, 16.0] {
        let far = total(2.0 * factor) * f64::from(factor * factor);
        assert!((far / near - 1.0).abs() < 0.06, "{far} instead of {near}");
    }
}
