//! What particles die of: Reeves (1983), section 2.4.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use motes::layout::FrameStats;

use crate::support::{Member, Run, Who, living, on_every_backend, sample, scene};

fn vector(words: [f32; 3]) -> DVec3 {
    DVec3::from_array(words.map(f64::from))
}

#[test]
fn r31_all_eight_combinations_of_extinctions_run() {
    // Of old age after `old` frames, dim after 16, and beyond a distance after `far`.
    let faded = "generation_shape = { kind = \"circle\", radius = 0 }\n speed = 0.5\n end_frame = 1
        color = { mean = [0.5, 0, 0], rate = [-0.015625, 0, 0] }";
    let times = [(30, 16, 8), (8, 16, 30), (30, 16, 24), (10, 16, 12)];
    on_every_backend(|on| {
        for &(old, dim, far) in sample(on, &times) {
            // A system for each choice: bit 0 for age, 1 for light, 2 for place.
            let lines = (0..8).map(|choice| {
                let mut lines = format!("name = \"s{choice}\"\n{faded}\n lifetime = {old}");
                if choice & 2 != 0 {
                    lines += "\n intensity_threshold = 0.25";
                }
                if choice & 4 != 0 {
                    let end = 0.5 * f64::from(far) + 0.25;
                    lines += &format!(
                        "\n extinction = [{{ kind = \"distance\", direction = [0, 0, 1], distance = {end} }}]"
                    );
                }
                lines
            });
            let lines: Vec<String> = lines.collect();
            let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
            let mut scene = scene("", &lines);
            for system in scene.systems.iter_mut().step_by(2) {
                system.lifetime = None;
            }
            // When it dies, and of which bit.
            let death = |choice: u32| {
                let causes = [(old, 0), (dim, 1), (far, 2)];
                causes
                    .into_iter()
                    .filter(|(_, bit)| choice & (1 << bit) != 0)
                    .min()
            };
            let mut run = Run::new(on, &scene, 40);
            for frame in 0..40 {
                let alive: BTreeSet<u32> =
                    living(&mut run, frame).keys().map(|who| who.0).collect();
                let lives = |choice: &u32| death(*choice).is_none_or(|(when, _)| frame < when);
                let expected: BTreeSet<u32> = (0..8).filter(lives).collect();
                assert_eq!(alive, expected, "{on}, frame {frame}: {old}, {dim}, {far}");
                let died_of = |bits: &[u32]| {
                    let of =
                        |bit: &u32| (0..8).filter(|c| death(*c) == Some((frame, *bit))).count();
                    bits.iter().map(of).sum::<usize>()
                };
                let line = run.statistics()[0];
                let counts = [line.died, line.died_of_intensity, line.died_of_bounds];
                let expected = [died_of(&[0, 1, 2]), died_of(&[1]), died_of(&[2])];
                assert_eq!(
                    counts.map(|count| count as usize),
                    expected,
                    "{on}, {frame}"
                );
            }
        }
    });
}

#[test]
fn r31_deaths_are_counted_by_their_cause() {
    const FRAMES: u32 = 40;
    let lines = "initial_mean_parts = 60\n var_parts = 20\n birth_rounding = \"stochastic\"
        generation_shape = { kind = \"sphere\", radius = 2 }\n speed = { mean = 0.2, var = 0.15 }
        acceleration = [0, -0.01, 0]\n transparency = { mean = 0, rate = 0.01, rate_var = 0.005 }
        color = { mean = [0.9, 0.5, 0.3], var = [0.3, 0.2, 0.1], rate = [-0.03, -0.02, 0], rate_var = [0.02, 0.02, 0.01] }";
    let deadly = "intensity_threshold = 0.3\n lifetime = { mean = 14, var = 8 }
        extinction = [{ kind = \"plane\", point = [0, -2, 0], normal = [0, 1, 0] }, { kind = \"sphere\", center = [0, 0, 0], radius = 4, kills = \"outside\" }]";
    let mortal = scene("", &[&format!("{lines}\n{deadly}")]);
    let mut immortal = scene("", &[lines]);
    immortal.systems[0].lifetime = None;
    on_every_backend(|on| {
        let mut free = Run::new("cpu", &immortal, FRAMES);
        let mut run = Run::new(on, &mortal, FRAMES);
        let mut before: BTreeMap<Who, Member> = BTreeMap::new();
        let mut totals = [0; 3];
        for frame in 0..FRAMES {
            let all = living(&mut free, frame);
            let after = living(&mut run, frame);
            let lines = run.statistics();
            let mut causes = [0u32; 3];
            let mut expected = BTreeSet::new();
            let newborn = |who: &&Who| who.1 == frame;
            for who in before.keys().chain(all.keys().filter(newborn)) {
                // What it would be in this frame, if it lived.
                let would_be = &all[who];
                let old = before
                    .get(who)
                    .is_some_and(|m| m.state.lifetime <= frame - who.1);
                let [red, green, blue] = would_be.drawn.color.to_array().map(f64::from);
                let light = red.max(green).max(blue);
                let intensity = (1.0 - f64::from(would_be.drawn.transparency)) * light;
                let place = vector(would_be.state.position);
                let out = place.y < -2.0 || place.length() > 4.0;
                match (old, intensity < 0.3, out) {
                    (true, ..) => causes[0] += 1,
                    (_, true, _) => causes[1] += 1,
                    (.., true) => causes[2] += 1,
                    _ => {
                        expected.insert(*who);
                    }
                }
            }
            assert!(after.keys().eq(expected.iter()), "frame {frame} on {on}");
            let born = all.keys().filter(newborn).count() as u32;
            let line = FrameStats {
                frame,
                requested: born,
                born,
                died: causes.iter().sum(),
                live: after.len() as u32,
                dropped: 0,
                died_of_intensity: causes[1],
                died_of_bounds: causes[2],
                ..FrameStats::default()
            };
            assert_eq!(lines, [line], "{on}");
            assert_eq!(line.live, before.len() as u32 + line.born - line.died);
            (0..3).for_each(|cause| totals[cause] += causes[cause]);
            before = after;
        }
        println!("{on}: of age, of intensity, of bounds: {totals:?}");
        assert!(totals.iter().all(|&count| count > 100), "{totals:?}");
    });
}

#[test]
fn r31_without_a_lifetime_particles_live_on() {
    let mut scene = scene("", &["initial_mean_parts = 2\n speed = 0.01"]);
    scene.systems[0].lifetime = None;
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene, 600);
        run.step_to(599);
        let lines = run.statistics();
        for line in &lines {
            assert_eq!((line.died, line.live), (0, 2 * (line.frame + 1)));
        }
        let members = run.members();
        let oldest = members.iter().map(|member| member.state.age).max();
        assert_eq!((members.len(), oldest), (1200, Some(599)));
        assert_eq!(lines.len(), 600);
    });
    // Ages have 16 bits, so it is for runs of so many frames.
    assert!(motes::plan::Plan::new(&scene, 65_001).is_err());
}
