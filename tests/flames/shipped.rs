//! The built-in scenes of flames.

use motes::scene::{BUILTIN, Scene, load};

use crate::support::*;

/// The built-in scenes with flames of their own.
pub(crate) fn shipped() -> Vec<Scene> {
    let scenes = BUILTIN
        .iter()
        .map(|scene| load(scene.name).expect("it is right"));
    // Flames that fronts drop are not there before fronts have come somewhere.
    let has_own = |scene: &Scene| scene.fires.iter().any(|fire| fire.count() > 0);
    let fires: Vec<Scene> = scenes.filter(has_own).collect();
    assert!(!fires.is_empty());
    fires
}

#[test]
fn p48_no_shipped_flame_is_a_string_of_beads() {
    for scene in shipped() {
        for frame in [0, 13, 47] {
            let plan = plan(&scene);
            let looks = plan.inputs(frame).age_looks;
            for (flame, way) in flames(&scene, frame).iter().zip(ways(&scene, frame)) {
                let width = f64::from(f32::from_bits(flame.look[1]));
                let first = 25 * flame.fire() as usize;
                for age in (0..24).filter(|_| flame.burns()) {
                    let apart = length(minus(way[age + 1], way[age]));
                    let disc = width * f64::from(looks[first + age].scale[0]);
                    assert!(
                        apart <= 0.5 * disc,
                        "{}: {apart} of {disc} at age {age}",
                        scene.name
                    );
                }
            }
        }
    }
}

#[test]
fn p31_the_edges_of_shipped_flames_go_from_red_over_yellow_to_white() {
    for mut scene in shipped() {
        (scene.image.width, scene.image.height) = (320, 180);
        let (mut edges, mut strict) = (0, 0);
        for light in drawn(&scene, 30).light {
            let [red, green, blue] = light;
            if red > 2.0 / 255.0 && red < 1.0 {
                edges += 1;
                assert!(red >= green && green >= blue, "{}: {light:?}", scene.name);
                strict += u32::from(red > green && green > blue);
            }
        }
        let is_strict = f64::from(strict) >= 0.9 * f64::from(edges);
        assert!(
            edges > 50 && is_strict,
            "{}: {strict} of {edges}",
            scene.name
        );
    }
}

/// Red, green and blue across a candle's flame, from its left outline to its middle, where it is
/// widest, as they come to the picture.
fn profile() -> Vec<[f64; 3]> {
    let mut candle = load("candle").expect("it is built in");
    // The flame alone, upright.
    candle.fires[0].noisiness = 0.0;
    candle.fires.truncate(1);
    let light = drawn(&candle, 30).light;
    let width = candle.image.width as usize;
    let lit = |line: &&[[f64; 3]]| line.iter().filter(|pixel| pixel[0] > 0.01).count();
    let widest = light.chunks(width).max_by_key(lit).expect("it has lines");
    let first = widest.iter().position(|pixel| pixel[0] > 0.0);
    let clamped = |pixel: &[f64; 3]| pixel.map(|value| value.min(1.0));
    widest[first.expect("it is lit")..width / 2]
        .iter()
        .map(clamped)
        .collect()
}

#[test]
fn p31_the_colour_profile_of_a_candle_is_that_of_figure_3_4() {
    let profile = profile();
    assert!(profile.len() > 40, "{}", profile.len());
    // Red before green before blue, each rising to the middle, up to saturation.
    for two in profile.windows(2) {
        let [red, green, blue] = two[0];
        assert!(red >= green && green >= blue, "{:?}", two[0]);
        assert!((0..3).all(|i| two[1][i] >= two[0][i] - 1e-3), "{two:?}");
    }
    let saturated = |channel: usize| profile.iter().position(|pixel| pixel[channel] >= 1.0);
    let [red, green] = [0, 1].map(|channel| saturated(channel).expect("it saturates"));
    assert!(red + 3 < green, "{red} and {green}");
    assert!(saturated(2).is_none_or(|blue| green + 3 < blue));
    // All three ramps begin at the same place (P32).
    let begins = |channel: usize| profile.iter().position(|pixel| pixel[channel] > 0.0);
    let begin = [0, 1, 2].map(|channel| begins(channel).expect("it is lit"));
    assert!(
        begin.iter().all(|at| at.abs_diff(begin[0]) <= 3),
        "{begin:?}"
    );
}

#[test]
fn p20_fires_alone_are_a_scene_and_burn() {
    for scene in shipped().iter().filter(|scene| scene.systems.is_empty()) {
        let burning = flames(scene, 20)
            .iter()
            .filter(|flame| flame.burns())
            .count();
        assert!(burning > 0, "{}", scene.name);
    }
}
