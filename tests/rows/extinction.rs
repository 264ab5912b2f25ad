//! Deaths: Reeves (1983), section 2.4.

use std::collections::BTreeMap;

use motes::layout::FrameStats;

use crate::support::{Run, on_every_backend, sample, scene};

#[test]
fn r27_a_lifetime_is_a_number_of_frames_seen() {
    for lifetime in [1, 5] {
        let lines = format!("lifetime = {lifetime}\n first_frame = 2\n end_frame = 3");
        let scene = scene("", &[&lines]);
        on_every_backend(|on| {
            let mut run = Run::new(on, &scene, 10);
            let lit: Vec<u32> = (0..10)
                .filter(|&frame| {
                    run.step_to(frame);
                    !run.light().is_dark()
                })
                .collect();
            assert_eq!(lit, (2..2 + lifetime).collect::<Vec<u32>>());
        });
    }
}

#[test]
fn r27_constant_births_fill_up_to_births_times_lifetime() {
    let filled = |on: &str, births: u32, lifetime: u32| {
        let lines = format!("initial_mean_parts = {births}\n lifetime = {lifetime}\n speed = 0.1");
        let mut run = Run::new(on, &scene("", &[&lines]), 2 * lifetime);
        run.step_to(2 * lifetime - 1);
        for line in run.statistics() {
            let frames = (line.frame + 1).min(lifetime);
            let died = if line.frame < lifetime { 0 } else { births };
            let expected = FrameStats {
                frame: line.frame,
                requested: births,
                born: births,
                died,
                live: births * frames,
                ..FrameStats::default()
            };
            assert_eq!(line, expected, "{on}");
        }
        assert_eq!(run.members().len() as u32, births * lifetime);
    };
    // The row's own numbers: 25,000.
    filled("cpu", 1000, 25);
    on_every_backend(|on| filled(on, 700, 25));
}

#[test]
fn r27_every_particle_is_there_for_its_own_lifetime() {
    let scene = scene(
        "",
        &[
            "initial_mean_parts = 40\n end_frame = 10\n lifetime = { mean = 6, var = 5.5 }
        generation_shape = { kind = \"sphere\", radius = 3 }",
        ],
    );
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene, 24);
        // First and last frame, and number of frames, by who it is.
        let mut seen = BTreeMap::new();
        for frame in 0..24 {
            run.step_to(frame);
            for member in run.members() {
                let key = (member.who.birth_frame, member.who.index);
                let entry = seen
                    .entry(key)
                    .or_insert((frame, frame, 0, member.state.lifetime));
                assert_eq!(member.state.age, frame - member.who.birth_frame);
                entry.1 = frame;
                entry.2 += 1;
            }
        }
        assert_eq!(seen.len(), 400);
        for ((birth_frame, index), (first, last, count, lifetime)) in seen {
            let expected = (birth_frame, birth_frame + lifetime - 1, lifetime);
            assert_eq!(
                (first, last, count),
                expected,
                "particle {index} of {birth_frame}"
            );
            assert!((1..=12).contains(&lifetime));
        }
        let lines = run.statistics();
        let died: u32 = lines.iter().map(|line| line.died).sum();
        assert_eq!((died, lines[23].live), (400, 0));
    });
}

/// The frames in which the particle of these lines, born in frame 0, is alive.
fn alive(on: &str, lines: &str) -> Vec<u32> {
    let mut run = Run::new(on, &scene("", &[&format!("{lines}\n end_frame = 1")]), 40);
    (0..40)
        .filter(|&frame| {
            run.step_to(frame);
            !run.members().is_empty()
        })
        .collect()
}

#[test]
fn r28_what_fades_below_the_threshold_is_gone() {
    // In frame g the newborn of frame 0 is drawn after n = g + 1 steps of change. Powers of two:
    // nothing is rounded. Light is 0.5 - n/64: at n = 16 equal to the threshold, below it at 17.
    let fading = "intensity_threshold = 0.25";
    let cases = [
        // RA7: the brightest of the three counts.
        (
            "green fades to below red",
            "color = { mean = [0.375, 1, 0], rate = [-0.0078125, -0.125, 0] }",
            16,
        ),
        (
            "transparency grows",
            "color = [0.5, 0.25, 0.125]\n transparency = { mean = 0, rate = 0.03125 }",
            16,
        ),
        (
            "red fades",
            "color = { mean = [0.5, 0, 0], rate = [-0.015625, 0, 0] }",
            16,
        ),
        (
            "blue fades",
            "color = { mean = [0, 0, 0.5], rate = [0, 0, -0.015625] }",
            16,
        ),
        // Born below it: never drawn.
        ("born dim", "color = [0.125, 0.125, 0.125]", 0),
        (
            "born clear",
            "color = [0.5, 0.5, 0.5]\n transparency = 0.75",
            0,
        ),
        // At the threshold for good.
        ("level", "color = [0.25, 0, 0]", 40),
        (
            "growing",
            "color = { mean = [0.25, 0, 0], rate = [0.015625, 0, 0] }",
            40,
        ),
    ];
    on_every_backend(|on| {
        for &(what, lines, frames) in sample(on, &cases) {
            let killed = alive(on, &format!("{lines}\n{fading}"));
            assert_eq!(killed, (0..frames).collect::<Vec<u32>>(), "{what}");
        }
    });
    for (what, lines, _) in cases {
        let kept = alive("cpu", lines);
        assert_eq!(kept, (0..40).collect::<Vec<u32>>(), "{what}, no threshold");
    }
}

#[test]
fn r31_each_extinction_works_alone_together_and_not_at_all() {
    // Faded at frame 16, old at frame 10 or at frame 30: each on and off.
    let faded = "color = { mean = [0.5, 0, 0], rate = [-0.015625, 0, 0] }";
    let combinations = [
        ("lifetime = 30", "intensity_threshold = 0.25", 16),
        ("lifetime = 30", "", 30),
        ("lifetime = 1000", "", 40),
        ("lifetime = 1000", "intensity_threshold = 0.25", 16),
        ("lifetime = 10", "intensity_threshold = 0.25", 10),
        // A threshold of nothing kills nothing: no light is below it.
        ("lifetime = 30", "intensity_threshold = 0", 30),
    ];
    on_every_backend(|on| {
        for &(old, dim, frames) in sample(on, &combinations) {
            let seen = alive(on, &format!("{faded}\n{old}\n{dim}"));
            assert_eq!(seen, (0..frames).collect::<Vec<u32>>(), "{old}, {dim}");
        }
    });
}
