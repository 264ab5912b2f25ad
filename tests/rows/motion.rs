//! The frame's order, motion and change: Reeves (1983), sections 2 and 2.3.

use glam::DVec3;
use motes::gpu::{GpuBackend, GpuOptions, STAGE_KERNELS};
use motes::plan::{Plan, STAGES};
use motes::simulation::Simulation;

use crate::common;
use crate::light::Light;
use crate::support::{Member, Run, backends, on_every_backend, scene};

fn vector(words: [f32; 3]) -> DVec3 {
    DVec3::from_array(words.map(f64::from))
}

#[test]
fn r2_stages_stand_in_the_order_of_the_paper() {
    let glowing = Plan::new(&scene("", &["lifetime = 2"]), 4).expect("the scene can be planned");
    // Those of flocks and of what covers stand aside.
    let used = STAGES.iter().filter(|info| glowing.has(info.stage));
    let names: Vec<&str> = used.map(|info| info.name).collect();
    assert_eq!(
        names,
        ["births", "emit", "cull", "advance", "splat", "resolve"]
    );
    // The kernels that devices report, by their own clocks.
    for on in backends().iter().filter(|name| *name != "cpu") {
        let scene = scene("", &["lifetime = 2"]);
        let plan = Plan::new(&scene, 4).expect("the scene can be planned");
        let options = GpuOptions {
            timed: true,
            ..GpuOptions::default()
        };
        let mut backend: GpuBackend = common::on_gpu(&common::open(on), &plan, &options);
        for frame in 0..4 {
            use motes::backend::Backend;
            let inputs = plan.inputs(frame);
            backend.step(&inputs).expect("the backend steps");
            backend.draw(&inputs).expect("the backend draws");
        }
        let times = backend.take_times().expect("times can be read");
        assert_eq!(
            times.len(),
            8,
            "{on} keeps no log of four steps and four drawings"
        );
        for frame in times.chunks(2) {
            // Light is cleared by a command between kernels.
            let named = || frame.iter().flatten().map(|(kernel, _)| *kernel);
            let kernels = || named().filter(|kernel| *kernel != "draw/clear_light");
            let mut stages: Vec<&str> = kernels()
                .map(|kernel| {
                    // Those of planets, which there is none of, come first.
                    let of = STAGE_KERNELS.iter().rfind(|of| of.kernel == kernel);
                    of.expect("a kernel of a stage").stage.info().name
                })
                .collect();
            stages.dedup();
            assert_eq!(stages, names, "{on}: {:?}", kernels().collect::<Vec<_>>());
        }
    }
}

#[test]
fn r2_a_lifetime_of_one_is_drawn_in_one_frame_after_its_first_step() {
    let scene = scene(
        "",
        &["lifetime = 1\n first_frame = 3\n end_frame = 4\n speed = 5\n rotation_degrees = [0, 90]
        generation_shape = { kind = \"circle\", radius = 0 }"],
    );
    on_every_backend(|on| {
        let mut run = Run::new(on, &scene, 7);
        for frame in 0..7 {
            run.step_to(frame);
            let light = run.light();
            assert_eq!(light.is_dark(), frame != 3, "frame {frame}");
            if frame == 3 {
                // RA4: born at column 32, moved by 5 before it is drawn.
                let (sum, at) = light
                    .pixels(0)
                    .fold((0.0, 0.0), |(sum, at), (x, _, light)| {
                        (sum + light, at + x * light)
                    });
                assert!(
                    (at / sum - 37.0).abs() < 0.01,
                    "drawn at column {}",
                    at / sum
                );
            }
        }
    });
}

const SPRAY: &str = "position = [1, 2, -3]\n rotation_degrees = [20, -35]
    generation_shape = { kind = \"circle\", radius = 0 }\n ejection_angle_degrees = 180
    speed = { mean = 0.05, var = 0.02 }\n initial_mean_parts = 400\n end_frame = 1";

/// A run's particles after frame 0, and 100 frames of motion after birth: frame 99.
fn spray(on: &str, lines: &str) -> (Vec<Member>, Vec<Member>) {
    let mut run = Run::new(on, &scene("", &[&format!("{SPRAY}\n{lines}")]), 100);
    run.step_to(0);
    let first = run.members();
    run.step_to(99);
    let last = run.members();
    assert_eq!((first.len(), last.len()), (400, 400));
    assert!(
        first
            .iter()
            .zip(&last)
            .all(|(first, last)| first.who == last.who)
    );
    (first, last)
}

#[test]
fn r23_without_acceleration_particles_move_by_their_velocity() {
    let origin = DVec3::new(1.0, 2.0, -3.0);
    on_every_backend(|on| {
        let (first, last) = spray(on, "");
        for (first, last) in first.iter().zip(&last) {
            let velocity = vector(first.state.velocity);
            assert!(velocity.length() > 0.02);
            let expected = origin + 100.0 * velocity;
            let off = (vector(last.state.position) - expected).length();
            assert!(off <= 1e-5 * expected.length(), "{last:?}: off by {off:e}");
            assert_eq!(first.raw.velocity(), last.raw.velocity());
        }
    });
}

#[test]
fn r24_acceleration_follows_the_text_position_first() {
    let origin = DVec3::new(1.0, 2.0, -3.0);
    let acceleration = DVec3::new(0.001, -0.004, 0.0005);
    on_every_backend(|on| {
        let (first, last) = spray(on, "acceleration = [0.001, -0.004, 0.0005]");
        for (first, last) in first.iter().zip(&last) {
            // After frame 0 the velocity has changed once.
            let velocity = vector(first.state.velocity) - acceleration;
            let expected = origin + 100.0 * velocity + acceleration * (100.0 * 99.0 / 2.0);
            let off = (vector(last.state.position) - expected).length();
            assert!(off <= 1e-5 * expected.length(), "{last:?}: off by {off:e}");
            let expected = velocity + 100.0 * acceleration;
            let off = (vector(last.state.velocity) - expected).length();
            assert!(off <= 1e-5 * expected.length(), "{last:?}: off by {off:e}");
        }
    });
}

/// The light of the left and of the right of two square particles of one system, frame by frame.
fn light_of_two(on: &str, lines: &str, frames: u32) -> Vec<[[f64; 3]; 2]> {
    let two = "initial_mean_parts = 2\n end_frame = 1\n particle_shape = \"rectangle\"
        generation_shape = { kind = \"rectangle\", length = 50, width = 0 }";
    let mut run = Run::new(
        on,
        &scene("seed = 3", &[&format!("{two}\n{lines}")]),
        frames,
    );
    let mut drawn = Vec::new();
    for frame in 0..frames {
        run.step_to(frame);
        let mut columns: Vec<f64> = run
            .members()
            .iter()
            .map(|member| 32.0 + f64::from(member.state.position[0]))
            .collect();
        columns.sort_by(f64::total_cmp);
        assert!(
            columns.len() == 2 && columns[1] - columns[0] > 12.0,
            "another seed: {columns:?}"
        );
        let middle = 0.5 * (columns[0] + columns[1]);
        let light: Light = run.light();
        let side = |left: bool| {
            [0, 1, 2].map(|channel| {
                let here = light
                    .pixels(channel)
                    .filter(|(x, ..)| (*x < middle) == left);
                here.map(|(_, _, light)| light).sum::<f64>()
            })
        };
        drawn.push([side(true), side(false)]);
    }
    drawn
}

/// Asserts that value(n) of both is start + (n + 1) rate, clamped, and that they start apart.
fn assert_change(what: &str, values: &[[f64; 2]], rate: f64, low: f64, high: f64, close: f64) {
    let start = values[0].map(|value| value - rate);
    assert!(
        (start[0] - start[1]).abs() > 10.0 * close,
        "{what}: both start at {start:?}"
    );
    for (frame, values) in values.iter().enumerate() {
        for (start, value) in start.iter().zip(values) {
            let expected = (start + (frame as f64 + 1.0) * rate).clamp(low, high);
            assert!(
                (value - expected).abs() <= close,
                "{what} in frame {frame}: {value}, expected {expected}"
            );
        }
    }
    let last = values[values.len() - 1];
    assert!(last == [low; 2] || last == [high; 2] || rate == 0.0 || high == f64::MAX);
}

#[test]
fn r25_color_transparency_and_size_change_at_their_systems_rate() {
    on_every_backend(|on| {
        // Squares of 4 pixels: red falls to nothing, green rises without bound, blue stays.
        let color = light_of_two(
            on,
            "color = { mean = [0.5, 0.25, 0.5], var = [0.25, 0.25, 0.25], rate = [-0.0625, 0.125, 0] }",
            16,
        );
        let channel = |at: usize| -> Vec<[f64; 2]> {
            color
                .iter()
                .map(|sides| sides.map(|light| light[at] / 4.0))
                .collect()
        };
        assert_change("red", &channel(0), -0.0625, 0.0, f64::MAX, 1e-5);
        assert!(channel(0)[15] == [0.0; 2], "red ends at nothing");
        assert_change("green", &channel(1), 0.125, 0.0, f64::MAX, 1e-5);
        assert_change("blue", &channel(2), 0.0, 0.0, f64::MAX, 1e-5);

        for (rate, end) in [(0.0625, 1.0), (-0.0625, 0.0)] {
            let lines = format!("transparency = {{ mean = 0.5, var = 0.25, rate = {rate} }}");
            let clear: Vec<[f64; 2]> = light_of_two(on, &lines, 16)
                .iter()
                .map(|sides| sides.map(|light| 1.0 - light[0] / (4.0 * 0.5)))
                .collect();
            assert_change("transparency", &clear, rate, 0.0, 1.0, 1e-5);
            assert_eq!(clear[15], [end; 2]);
        }

        for (rate, end) in [(0.125, f64::MAX), (-0.25, 0.0)] {
            let lines = format!("size = {{ mean = 2, var = 1, rate = {rate} }}");
            let sizes: Vec<[f64; 2]> = light_of_two(on, &lines, 16)
                .iter()
                .map(|sides| sides.map(|light| (light[0] / (4.0 * 0.5)).sqrt()))
                .collect();
            assert_change("size", &sizes, rate, 0.0, f64::MAX, 1e-4);
            assert!(end > 0.0 || sizes[15] == [0.0; 2]);
        }
    });
}

#[test]
fn r24_a_library_user_gets_the_same_through_the_front_door() {
    // The whole way: options, adapter by name, world space.
    let scene = scene("", &[&format!("{SPRAY}\n acceleration = [0, -0.004, 0]")]);
    let digest = |on: &str| {
        let adapter = motes::simulation::AdapterChoice::parse(on);
        let options = motes::simulation::Options {
            adapter,
            ..Default::default()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("the adapter is there");
        simulation.seek(99).expect("the backend steps");
        simulation.state_digest().expect("the backend digests")
    };
    let mut run = Run::new("cpu", &scene, 100);
    run.step_to(99);
    let expected = run.simulation.state_digest().expect("the backend digests");
    on_every_backend(|on| assert_eq!(digest(on), expected, "{on}"));
}
