//! Checkpoints and restarts: Reeves (1983), section 3, RA9 and RA12.

use motes::plan::{Plan, Turn};
use motes::recording::{Change, Checkpoint, Recording};
use motes::scene::{self, Scene};
use motes::simulation::{AdapterChoice, Options, Simulation};

use crate::common::{everything, everything_turning, set_lifetime};
use crate::support::{Run, on_every_backend};

/// Digests of state and image after `frame`, with everything drawn on the way.
fn whole_run(on: &str, plan: &Plan, frame: u32) -> (u64, Vec<u8>) {
    let mut run = Run::of_plan(on, plan.clone());
    for frame in 0..=frame {
        run.step_to(frame);
        run.simulation.draw().expect("the backend draws");
    }
    result(&mut run)
}

fn result(run: &mut Run) -> (u64, Vec<u8>) {
    let digest = run.simulation.state_digest().expect("the backend digests");
    (digest, run.image())
}

fn plan_of(scene: &Scene) -> Plan {
    Plan::new(scene, 40).expect("the scene can be planned")
}

#[test]
fn r73_a_restart_at_any_frame_equals_the_whole_run() {
    let everything = everything();
    let mut short = everything.clone();
    for system in &mut short.systems {
        set_lifetime(system, 4.0, 3.0);
    }
    for (scene, longest) in [(&everything, 14), (&short, 7)] {
        let plan = plan_of(scene);
        on_every_backend(|on| {
            // L_max = 14 is later than some of these frames, and before others.
            let frames: &[u32] = if on == "cpu" {
                &[0, 1, 5, 13, 14, 15, 22, 37]
            } else {
                &[5, 22]
            };
            for &frame in frames {
                let mut run = Run::of_plan(on, plan.clone());
                run.simulation.seek(frame).expect("the backend steps");
                // Stepped from p = n - L_max on, and nothing drawn.
                let first = frame.saturating_sub(longest);
                let expected: Vec<_> = (first..=frame).map(|frame| (frame, "step")).collect();
                assert_eq!(run.take_calls(), expected, "frame {frame}");
                assert!(
                    result(&mut run) == whole_run(on, &plan, frame),
                    "frame {frame} on {on}"
                );
            }
        });
    }
}

#[test]
fn r73_the_longest_lifetime_is_waited_for_and_no_longer() {
    // One system, every particle as old as can be: a restart a frame later lacks some.
    let scene = crate::support::scene(
        "",
        &["lifetime = 6\n initial_mean_parts = 10\n speed = 0.2\n color = [0.1, 0.1, 0.1]"],
    );
    let plan = plan_of(&scene);
    assert_eq!(plan.restart_frame(20), 14);
    on_every_backend(|on| {
        let whole = whole_run(on, &plan, 20);
        let from = |first: i32| {
            let mut run = Run::of_plan(on, plan.clone());
            run.simulation
                .seek_from(first, 20)
                .expect("the backend steps");
            result(&mut run)
        };
        assert!(from(14) == whole);
        // The particles of frame 20 are born in 15 ..= 20: 14 itself is there for its deaths.
        assert!(from(15) == whole);
        assert!(from(16) != whole);
    });
}

#[test]
fn r73_a_restart_knows_the_parameters_of_each_birth() {
    let plan = everything_turning(&everything());
    on_every_backend(|on| {
        let frames: &[u32] = if on == "cpu" { &[3, 6, 9, 15] } else { &[9] };
        for &frame in frames {
            let mut run = Run::of_plan(on, plan.clone());
            run.simulation.seek(frame).expect("the backend steps");
            assert!(
                result(&mut run) == whole_run(on, &plan, frame),
                "frame {frame} on {on}"
            );
        }
    });
}

const SMALL: &str = r#"
seed = 9
image = { width = 64, height = 36 }
camera = { position = [0, 0, 5], target = [0, 0, 0] }
[[system]]
name = "cloud"
initial_mean_parts = 80
var_parts = 30
generation_shape = { kind = "sphere", radius = 1 }
speed = { mean = 0.02, var = 0.01 }
lifetime = { mean = 9, var = 4 }
color = { mean = [0.3, 0.2, 0.1], var = [0.1, 0.1, 0.1] }
size = 0.05
"#;

/// The run that a checkpoint tells of, not begun.
fn begin(on: &str, checkpoint: &Checkpoint) -> Simulation {
    let seed = format!("seed={}", checkpoint.seed);
    let scene = scene::load_with(&checkpoint.scene, std::slice::from_ref(&seed))
        .expect("the scene is right");
    let turns: Vec<Turn> = checkpoint
        .recording
        .turns(&checkpoint.scene, &[seed])
        .expect("the changes are right");
    let options = Options {
        adapter: AdapterChoice::parse(on),
        frame_end: 40,
        turns,
        ..Options::default()
    };
    Simulation::new(&scene, &options).expect("the adapter is there")
}

/// Digests of state and image, the last frame stepped drawn.
fn digests(simulation: &mut Simulation) -> (u64, u64) {
    simulation.draw().expect("the backend draws");
    let state = simulation.state_digest().expect("the backend digests");
    let image = simulation.image_digest().expect("the backend digests");
    (state, image)
}

#[test]
fn r72_a_checkpoint_is_small_and_goes_on_with_the_same_bits() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("small.toml");
    std::fs::write(&path, SMALL).expect("the scene can be written");
    let path = path.to_str().expect("the path is text").to_owned();
    let change = |frame, set: &str| Change {
        frame,
        set: set.to_owned(),
        line: 0,
    };
    let recording = Recording {
        changes: vec![
            change(4, "system.cloud.speed.mean=0.1"),
            change(11, "system.cloud.acceleration=[0, -0.01, 0]"),
            change(11, "camera.position=[1, 0, 5]"),
            change(25, "system.cloud.size.mean=0.2"),
        ],
    };
    let at = |seed: u64, frame: u32| Checkpoint {
        scene: path.clone(),
        seed,
        frame,
        recording: recording.clone(),
    };
    on_every_backend(|on| {
        let mut whole = begin(on, &at(77, 0));
        for frame in 0..=20u32 {
            assert_eq!(whole.frame(), frame.checked_sub(1));
            whole.step().expect("the backend steps");
        }
        let text = at(77, 20).to_text();
        assert!(text.len() < 4096, "{} bytes", text.len());
        let read = Checkpoint::parse(&text, "checkpoint").expect("it reads what it wrote");
        assert_eq!(read, at(77, 20));

        let mut resumed = begin(on, &read);
        resumed.seek(read.frame).expect("the backend steps");
        assert_eq!(resumed.frame(), Some(20));
        assert_eq!(
            digests(&mut resumed),
            digests(&mut whole),
            "at the checkpoint"
        );
        for frame in 21..34 {
            whole.step().expect("the backend steps");
            resumed.step().expect("the backend steps");
            assert_eq!(digests(&mut resumed), digests(&mut whole), "frame {frame}");
        }
        // Another seed, or no changes, is another run.
        let digests_of = |checkpoint: &Checkpoint| {
            let mut simulation = begin(on, checkpoint);
            simulation.seek(33).expect("the backend steps");
            digests(&mut simulation)
        };
        let expected = digests(&mut whole);
        assert_eq!(digests_of(&at(77, 33)), expected);
        assert_ne!(digests_of(&at(78, 33)), expected);
        let unchanged = Checkpoint {
            recording: Recording::default(),
            ..at(77, 33)
        };
        assert_ne!(digests_of(&unchanged), expected);
    });
}

#[test]
fn r72_the_size_of_a_checkpoint_does_not_depend_on_the_particles() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("cloud.toml");
    // One name for both, so that texts differ in what is in them alone.
    let name = path.to_str().expect("the path is text");
    on_every_backend(|on| {
        let saved = [8, 1600].map(|births| {
            let text = SMALL.replace("= 80", &format!("= {births}"));
            std::fs::write(&path, text).expect("the scene can be written");
            let started = Checkpoint {
                scene: name.into(),
                seed: 77,
                frame: 0,
                recording: Recording::default(),
            };
            let mut whole = begin(on, &started);
            whole.seek_from(0, 25).expect("the backend steps");
            let text = Checkpoint {
                frame: whole.frame().expect("frames were stepped"),
                ..started
            }
            .to_text();
            let read = Checkpoint::parse(&text, "checkpoint").expect("it reads what it wrote");
            let mut resumed = begin(on, &read);
            resumed.seek(read.frame).expect("the backend steps");
            assert_eq!(
                digests(&mut resumed),
                digests(&mut whole),
                "{births} births"
            );
            let particles = whole.particles().expect("the state can be read");
            (text, particles.len())
        });
        let [(few_text, few), (many_text, many)] = saved;
        assert!(few > 20 && many > 50 * few, "{few} and {many} particles");
        assert!(many_text.len() < 4096, "{} bytes", many_text.len());
        assert_eq!(few_text.len(), many_text.len());
    });
}
