//! The built-in scenes of fires that spread.

use motes::scene::{BUILTIN, Scene, load};

use crate::support::*;

fn shipped() -> Vec<Scene> {
    let scenes = BUILTIN
        .iter()
        .map(|scene| load(scene.name).expect("it is right"));
    let spreads = |scene: &Scene| scene.fires.iter().any(|fire| fire.spread.is_some());
    let fires: Vec<Scene> = scenes.filter(spreads).collect();
    assert!(fires.len() >= 10);
    fires
}

#[test]
fn p48_no_dropped_flame_is_a_string_of_beads() {
    for scene in shipped() {
        for fire in scene.fires.iter().filter(|fire| fire.spread.is_some()) {
            assert!(fire.normalised);
            let step = (fire.height.mean + fire.height.var) / 24.0;
            let disc = (fire.width.mean - fire.width.var) * fire.profile.base_width;
            assert!(step <= 0.5 * disc, "{}: {step} of {disc}", scene.name);
        }
    }
}

#[test]
fn p31_dropped_flames_are_red_before_green_before_blue() {
    for scene in shipped() {
        for stop in scene.fires.iter().flat_map(|fire| &fire.ramp) {
            for [red, green, blue] in [stop.center, stop.rim] {
                assert!(red > green && green > blue, "{}: {stop:?}", scene.name);
            }
        }
    }
}

#[test]
fn p70_shipped_fires_burn_and_nothing_is_lost() {
    for mut scene in shipped() {
        // Room for more flames than burn by then would take time alone.
        for spread in scene
            .fires
            .iter_mut()
            .filter_map(|fire| fire.spread.as_mut())
        {
            spread.max_flames = spread.max_flames.min(4000);
        }
        let mut run = run(&scene);
        let mut most = 0;
        for frame in (0..=80).step_by(20) {
            run.seek(frame).expect("it runs");
            for line in run.take_statistics().expect("they are read") {
                assert_eq!(line.flames_requested, line.flames_born, "{}", scene.name);
                assert_eq!(line.points_requested, line.points_born, "{}", scene.name);
                assert_eq!(line.marks_died, 0, "{}", scene.name);
                most = most.max(line.flames_live);
            }
        }
        let points = run.control_points().expect("they are read");
        assert!(points.iter().all(|point| point.inert < 3));
        assert!(most > 100, "{}: {most} flames", scene.name);
    }
}
