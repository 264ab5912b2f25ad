//! The built-in scenes of flames.

use motes::scene::{BUILTIN, Scene, load};

use crate::support::*;

fn shipped() -> Vec<Scene> {
    let scenes = BUILTIN
        .iter()
        .map(|scene| load(scene.name).expect("it is right"));
    let fires: Vec<Scene> = scenes.filter(|scene| !scene.fires.is_empty()).collect();
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
