//! Who a particle is decides all of its chances: Reeves (1983), section 3, and RA9.

use std::collections::BTreeMap;

use motes::layout::Particle;
use motes::scene::Scene;

use crate::common::{everything, set_lifetime};
use crate::support::{Run, on_every_backend};

/// Who a particle is, by its system's name, birth frame and index.
type Who = (String, u32, u32);

/// State of the living after `frame`, without what depends on where their system stands in the
/// file.
fn states(on: &str, scene: &Scene, frame: u32) -> BTreeMap<Who, [u32; 6]> {
    let mut run = Run::new(on, scene, frame + 1);
    run.step_to(frame);
    assert!(run.statistics().iter().all(|line| line.dropped == 0));
    let members = run.members();
    let count = members.len();
    let states: BTreeMap<Who, [u32; 6]> = members
        .into_iter()
        .map(|member| {
            let name = scene.systems[member.state.system as usize].name.clone();
            let Particle {
                position_and_index: [x, y, z, _],
                velocity_and_birth: [u, v, w, _],
            } = member.raw;
            (
                (name, member.who.birth_frame, member.who.index),
                [x, y, z, u, v, w],
            )
        })
        .collect();
    assert_eq!(states.len(), count, "two particles are one");
    states
}

/// Fails unless all of `some` are among `all` with the same states.
fn assert_among(some: &BTreeMap<Who, [u32; 6]>, all: &BTreeMap<Who, [u32; 6]>) {
    for (who, state) in some {
        assert_eq!(all.get(who), Some(state), "{who:?}");
    }
}

fn without_thresholds(mut scene: Scene) -> Scene {
    scene
        .systems
        .iter_mut()
        .for_each(|system| system.intensity_threshold = None);
    scene
}

#[test]
fn r74_killing_does_not_change_the_survivors() {
    const FRAME: u32 = 13;
    on_every_backend(|on| {
        let all = states(on, &without_thresholds(everything()), FRAME);
        let some = states(on, &everything(), FRAME);
        println!("{} of {} survive", some.len(), all.len());
        assert!(some.len() + 100 < all.len() && some.len() > 1000);
        assert_among(&some, &all);
        // And nobody else is missing: the dead are those that were to be killed.
        let killed: Vec<&Who> = all.keys().filter(|who| !some.contains_key(*who)).collect();
        assert!(
            killed.iter().all(|who| who.0 == "jet" || who.0 == "dust"),
            "{killed:?}"
        );
    });
}

#[test]
fn r74_lifetimes_and_births_do_not_change_the_others() {
    const FRAME: u32 = 13;
    let long = everything();
    let mut short = everything();
    for system in &mut short.systems {
        set_lifetime(system, 3.0, 0.0);
        system.births.initial_mean_parts *= 0.5;
        (system.births.delta_mean_parts, system.births.var_parts) = (0.0, 0.0);
    }
    let long = {
        let mut scene = without_thresholds(long);
        scene
            .systems
            .iter_mut()
            .for_each(|s| set_lifetime(s, 9.0, 0.0));
        scene
    };
    let (short, long) = (
        states("cpu", &without_thresholds(short), FRAME),
        states("cpu", &long, FRAME),
    );
    // Those that both runs have are the same.
    let common = short.iter().filter(|(who, _)| long.contains_key(*who));
    let same = common
        .clone()
        .filter(|(who, state)| long[*who] == **state)
        .count();
    assert!(same > 300 && same == common.count(), "{same} are the same");
}

#[test]
fn r74_what_is_off_screen_lives_on() {
    let scene = everything();
    let mut away = everything();
    // The other way, and a camera that sees a hundredth of it.
    away.camera.target = [2.7, 2.1, 8.8];
    away.camera.vertical_fov_degrees = 3.0;
    on_every_backend(|on| {
        // Systems with births by screen area do depend on the camera.
        let by_area = |(name, ..): &Who| name == "passing-cloud";
        let mut seen = states(on, &scene, 13);
        let mut unseen = states(on, &away, 13);
        seen.retain(|who, _| !by_area(who));
        unseen.retain(|who, _| !by_area(who));
        assert!(seen.len() > 1000 && seen == unseen);
    });
}

/// The system of the scene that bears hundreds a frame.
fn dust(scene: &Scene) -> motes::scene::System {
    let named = |system: &&motes::scene::System| system.name == "dust";
    scene
        .systems
        .iter()
        .find(named)
        .expect("a system of that name")
        .clone()
}

#[test]
fn r75_another_system_changes_nobody() {
    let scene = everything();
    let mut more = everything();
    let newcomer = dust(&scene);
    more.systems.insert(
        0,
        motes::scene::System {
            name: "newcomer".into(),
            ..newcomer
        },
    );
    let fewer = Scene {
        systems: scene.systems[2..].to_vec(),
        ..scene.clone()
    };
    let reversed = Scene {
        systems: scene.systems.iter().rev().cloned().collect(),
        ..scene.clone()
    };
    on_every_backend(|on| {
        let [scene, more, fewer, reversed] =
            [&scene, &more, &fewer, &reversed].map(|scene| states(on, scene, 11));
        assert_among(&scene, &more);
        assert!(more.len() > scene.len() + 300);
        assert_among(&fewer, &scene);
        assert!(fewer.len() > 1000 && fewer.len() < scene.len());
        assert_eq!(reversed, scene);
    });
}

#[test]
fn r75_the_key_is_seed_system_birth_frame_and_index() {
    // Two systems that are alike but for their names bear other particles, as other seeds do; and
    // so do two frames and two indices.
    let mut scene = everything();
    let twin = motes::scene::System {
        name: "twin".into(),
        ..dust(&scene)
    };
    scene.systems = vec![dust(&scene), twin];
    let other = Scene {
        seed: scene.seed + (1 << 32),
        ..scene.clone()
    };
    let (states, others) = (states("cpu", &scene, 0), states("cpu", &other, 0));
    let values: std::collections::BTreeSet<[u32; 6]> =
        states.values().chain(others.values()).copied().collect();
    assert!(states.len() > 300);
    assert_eq!(
        values.len(),
        states.len() + others.len(),
        "the upper half of the seed counts, too"
    );
}
