//! What a scene is made into so that it is checked in seconds.

use motes::check::{default_frames, shrunk};
use motes::plan::Plan;
use motes::scene::{BUILTIN, Scene, load};
use motes::simulation::{AdapterChoice, Options, Simulation};

use crate::common;

#[test]
fn shrunk_scenes_are_small_and_last_until_deaths() {
    for builtin in BUILTIN {
        let scene = load(builtin.name).expect("it is built in");
        let frames = default_frames(&scene);
        let small = shrunk(&scene, frames).expect("it can be planned");
        assert!(
            small.image.width <= 320 && small.image.height <= 180,
            "{}",
            scene.name
        );
        let plan = Plan::new(&small, frames).expect("it can be planned");
        assert!(plan.capacity <= 20_000, "{}: {}", scene.name, plan.capacity);
        assert_eq!(
            shrunk(&scene, frames).as_ref(),
            Ok(&small),
            "the same every time"
        );
        let lifetime = scene
            .systems
            .iter()
            .map(|system| system.lifetime.map_or(0, |life| life.mean as u32))
            .min();
        assert!(
            frames == scene.frames || lifetime.is_none_or(|l| l < frames),
            "{}",
            scene.name
        );
    }
}

#[test]
fn what_is_small_stays_as_it_is() {
    let small = common::everything();
    assert_eq!(shrunk(&small, small.frames), Ok(small));
}

#[test]
fn a_scenes_own_capacity_shrinks_in_proportion() {
    let scene = load("million").expect("it is built in");
    let factor = |small: &Scene| {
        let births = |scene: &Scene| scene.systems[0].births.initial_mean_parts;
        f64::from(births(small)) / f64::from(births(&scene))
    };
    let bounded = Scene {
        capacity: Some(500_000),
        ..scene.clone()
    };
    let small = shrunk(&bounded, 100).expect("it can be planned");
    let expected = (500_000.0 * factor(&small)) as u32;
    let capacity = small.capacity.expect("it has one");
    assert!(
        factor(&small) < 0.5 && capacity.abs_diff(expected) <= 1,
        "{capacity} {expected}"
    );
}

#[test]
fn shrunk_scenes_of_systems_that_bear_systems_drop_nobody() {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    let mut seen = 0;
    for builtin in BUILTIN {
        let scene = load(builtin.name).expect("it is built in");
        if scene.systems.iter().all(|system| system.parent.is_none()) {
            continue;
        }
        let frames = default_frames(&scene);
        let small = shrunk(&scene, frames).expect("it can be planned");
        let mut run = Simulation::new(&small, &options).expect("it can be planned");
        run.seek(frames - 1).expect("it steps");
        let lines = run.take_statistics().expect("they can be read");
        let dropped: u32 = lines.iter().map(|line| line.dropped).sum();
        let most = lines.iter().map(|line| line.live).max().unwrap_or(0);
        println!("{}: at most {most} live, {dropped} are dropped", scene.name);
        assert_eq!(dropped, 0, "{}", scene.name);
        // And enough are left to be checked.
        assert!(most > 1000, "{}: {most}", scene.name);
        seen += 1;
    }
    assert!(seen >= 8, "{seen}");
}
