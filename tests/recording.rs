//! Parameters that change while a scene runs: recordings, and what they may not touch.

mod common;

use motes::gpu::GpuOptions;
use motes::plan::{Plan, Turn};
use motes::recording::{Checkpoint, Recording};
use motes::scene::{self, Scene};
use motes::simulation::{
    AdapterChoice, Options, ParticleState, Simulation, SimulationError, Snapshot, SnapshotError,
};

const SCENE: &str = r#"
frames = 30
[image]
width = 64
height = 36
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "only"
initial_mean_parts = 40
generation_shape = { kind = "sphere", radius = 0.5 }
speed = { mean = 0.05, var = 0.02 }
lifetime = { mean = 8, var = 3 }
color = { mean = [0.2, 0.1, 0.05], var = [0.05, 0.05, 0.05] }
size = { mean = 0.05, var = 0.02 }
"#;

fn scene_with(speed: &str, lifetime: &str, size: &str) -> Scene {
    let text = SCENE
        .replace(
            "speed = { mean = 0.05, var = 0.02 }",
            &format!("speed = {speed}"),
        )
        .replace(
            "lifetime = { mean = 8, var = 3 }",
            &format!("lifetime = {lifetime}"),
        )
        .replace(
            "size = { mean = 0.05, var = 0.02 }",
            &format!("size = {size}"),
        );
    scene::parse(&text, "turned.toml", "turned").expect("a good scene")
}

fn base() -> Scene {
    scene::parse(SCENE, "base.toml", "base").expect("a good scene")
}

/// A speed, lifetime and size that no unturned particle has.
fn turned() -> Scene {
    scene_with("{ mean = 0.3 }", "{ mean = 3 }", "{ mean = 0.2 }")
}

fn on_cpu(turns: Vec<Turn>) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        turns,
        ..Options::default()
    };
    Simulation::new(&base(), &options).expect("the plan fits the processor")
}

#[test]
fn a_turned_knob_does_not_change_what_is_already_born() {
    let turn_frame = 12;
    let mut plain = on_cpu(Vec::new());
    let mut changed = on_cpu(vec![Turn {
        frame: turn_frame,
        scene: turned(),
    }]);
    let frame = turn_frame + 4;
    plain.seek_from(0, frame).expect("it runs");
    changed.seek_from(0, frame).expect("it runs");
    let older = |particles: Vec<ParticleState>| -> Vec<ParticleState> {
        particles
            .into_iter()
            .filter(|p| p.age > frame - turn_frame)
            .collect()
    };
    let (plain, changed) = (
        plain.particles().expect("it reads"),
        changed.particles().expect("it reads"),
    );
    let newborn: Vec<_> = changed
        .iter()
        .filter(|p| p.age <= frame - turn_frame)
        .collect();
    assert!(!newborn.is_empty());
    assert!(
        newborn.iter().all(|p| p.lifetime == 3),
        "the turn holds from its frame on"
    );
    let speed = |p: &ParticleState| p.velocity.iter().map(|v| v * v).sum::<f32>().sqrt();
    assert!(newborn.iter().all(|p| (speed(p) - 0.3).abs() < 1e-5));
    let (plain, changed) = (older(plain), older(changed));
    assert!(
        plain.len() > 20,
        "some were born before the turn and still live"
    );
    assert_eq!(plain, changed);
}

#[test]
fn a_recording_replays_exactly_on_every_backend_and_from_any_frame() {
    let turns = vec![
        Turn {
            frame: 7,
            scene: turned(),
        },
        Turn {
            frame: 15,
            scene: scene_with("0.01", "{ mean = 9, var = 4 }", "{ mean = 0.02 }"),
        },
    ];
    let plan = Plan::with_turns(&base(), &turns, 30).expect("a good plan");
    let frames: Vec<_> = (0..26).map(|frame| plan.inputs(frame)).collect();
    common::on_each_adapter(|name, device| {
        let mut gpu = common::on_gpu(device, &plan, &GpuOptions::default());
        let mut cpu = common::on_cpu(&plan);
        common::compare_run(&frames, &mut gpu, &mut cpu)
            .unwrap_or_else(|difference| panic!("{name}: {difference}"));
    });
    let (mut whole, mut entered) = (on_cpu(turns.clone()), on_cpu(turns));
    whole.seek_from(0, 25).expect("it runs");
    entered.seek(25).expect("it runs");
    assert_eq!(whole.state_digest(), entered.state_digest());
    assert_eq!(whole.particles(), entered.particles());
}

/// A run that may drop births, whose particles live without limit, and whose rows change: nothing
/// but its whole past, or a snapshot, tells its state.
fn endless() -> (Scene, Vec<Turn>) {
    let mut scene = base();
    scene.capacity = Some(500);
    scene.systems[0].lifetime = None;
    let mut brighter = scene.clone();
    brighter.systems[0].speed.mean = 0.2;
    brighter.systems[0].color.initial.mean = [0.01, 0.9, 0.2];
    let turns = vec![Turn {
        frame: 5,
        scene: brighter,
    }];
    (scene, turns)
}

fn bytes_of(snapshot: &Snapshot) -> Vec<u8> {
    let mut bytes = Vec::new();
    snapshot
        .write_to(&mut bytes)
        .expect("a list of bytes takes all");
    bytes
}

#[test]
fn a_snapshot_goes_on_with_the_same_bits_on_every_adapter() {
    let (scene, turns) = endless();
    let on = |adapter: AdapterChoice| {
        let gpu = GpuOptions {
            page_bytes: 64 << 10,
            ..GpuOptions::default()
        };
        let turns = turns.clone();
        let options = Options {
            adapter,
            turns,
            gpu,
            ..Options::default()
        };
        Simulation::new(&scene, &options).expect("it fits")
    };
    let end_of = |mut run: Simulation| {
        run.seek_from(0, 20).expect("it runs");
        run.draw().expect("it draws");
        let digests = (run.state_digest(), run.image_digest(), run.particles());
        let last = run.take_statistics().expect("it counts").last().copied();
        (digests, last)
    };
    let expected = end_of(on(AdapterChoice::Cpu));
    let dropped = expected.1.map(|line| line.dropped);
    assert!(dropped.is_some_and(|dropped| dropped > 0), "{expected:?}");
    let adapters = common::adapters().into_iter().map(AdapterChoice::Named);
    let adapters: Vec<_> = adapters.chain([AdapterChoice::Cpu]).collect();
    for from in &adapters {
        let mut run = on(from.clone());
        assert_eq!(run.snapshot().expect("nothing yet"), None);
        run.seek_from(0, 8).expect("it runs");
        let snapshot = run.snapshot().expect("it reads").expect("a frame");
        assert_eq!((snapshot.frame(), snapshot.live()), (8, 360));
        let bytes = bytes_of(&snapshot);
        assert_eq!(bytes.len(), 40 + 32 * 360);
        let read = Snapshot::from_bytes(&bytes).expect("what was written");
        assert_eq!(read, snapshot);
        for to in &adapters {
            let mut entered = on(to.clone());
            // Whatever it did before is forgotten.
            entered.seek_from(0, 3).expect("it runs");
            entered.restore(&read).expect("it fits");
            assert_eq!(end_of(entered), expected, "from {from:?} to {to:?}");
        }
    }
}

#[test]
fn a_damaged_or_foreign_snapshot_is_refused() {
    let (scene, _) = endless();
    let options = |adapter| Options {
        adapter,
        ..Options::default()
    };
    let mut run = Simulation::new(&scene, &options(AdapterChoice::Cpu)).expect("it fits");
    run.seek(11).expect("it runs");
    let snapshot = run.snapshot().expect("it reads").expect("a frame");
    let bytes = bytes_of(&snapshot);
    let read = |bytes: &[u8]| Snapshot::from_bytes(bytes).map(|_| ());
    assert_eq!(read(&bytes), Ok(()));
    for at in [9, 13, 17, 30, bytes.len() / 2, bytes.len() - 1] {
        let mut damaged = bytes.clone();
        damaged[at] ^= 4;
        assert_eq!(read(&damaged), Err(SnapshotError::Damaged), "byte {at}");
    }
    for end in [8, 12, 27, bytes.len() - 32, bytes.len() - 1] {
        assert_eq!(read(&bytes[..end]), Err(SnapshotError::Damaged), "{end}");
    }
    let longer = [&bytes[..], &[0; 4]].concat();
    assert_eq!(read(&longer), Err(SnapshotError::Damaged));
    for other in [&b""[..], &b"motes-s\x05"[..], &[0xff; 99]] {
        assert_eq!(read(other), Err(SnapshotError::NotASnapshot));
    }
    let smaller = Scene {
        capacity: Some(100),
        ..base()
    };
    let mut two = base();
    two.systems.push(two.systems[0].clone());
    two.systems[1].name = "second".into();
    for other in [smaller, two] {
        let mut run = Simulation::new(&other, &options(AdapterChoice::Cpu)).expect("it fits");
        let refused = run.restore(&snapshot);
        assert_eq!(
            refused,
            Err(SimulationError::Snapshot(SnapshotError::OfAnotherRun))
        );
    }
}

#[test]
fn recordings_are_read_and_written_line_by_line() {
    let text = "# faster, then slower\n\n3 system.0.speed.mean=0.2\n9  system.0.speed.mean=0.1\n";
    let recording = Recording::parse(text, "knobs.txt").expect("a good recording");
    let lines: Vec<_> = recording
        .changes
        .iter()
        .map(|c| (c.frame, c.set.as_str()))
        .collect();
    assert_eq!(
        lines,
        [
            (3, "system.0.speed.mean=0.2"),
            (9, "system.0.speed.mean=0.1")
        ]
    );
    assert_eq!(
        Recording::parse(&recording.to_text(), "again").as_ref(),
        Ok(&recording)
    );
    for (text, place) in [
        ("3 speed", "knobs.txt:1: no `=`"),
        ("\nx a=1", "knobs.txt:2: no frame number"),
        ("5 a=1\n4 a=2", "knobs.txt:2: a frame before"),
        ("7", "knobs.txt:1: no change"),
    ] {
        let error = Recording::parse(text, "knobs.txt").expect_err("a bad line");
        assert!(error.to_string().contains(place), "{error}");
    }
}

#[test]
fn changes_and_errors_of_a_checkpoint_know_their_lines() {
    let text = "scene fountain\nseed 1\nframe 9\n# faster\n3 a=1\n9 b=2\n";
    let checkpoint = Checkpoint::parse(text, "saved").expect("a good checkpoint");
    let changes = &checkpoint.recording.changes;
    let lines: Vec<_> = changes.iter().map(|change| change.line).collect();
    assert_eq!(lines, [5, 6]);
    let again = Checkpoint::parse(&checkpoint.to_text(), "again");
    assert_eq!(again.as_ref(), Ok(&checkpoint));
    for (text, place) in [
        ("scene x\nsede 1", "saved:2: a checkpoint has `seed …` here"),
        ("scene x\nseed 1\nframe y", "saved:3: `y` is not a whole"),
        ("scene x\nseed 1\nframe 2\n3 speed", "saved:4: no `=`"),
    ] {
        let error = Checkpoint::parse(text, "saved").expect_err("a bad line");
        assert!(error.to_string().contains(place), "{error}");
    }
}

#[test]
fn a_refused_change_is_told_with_its_line_and_the_reason() {
    for (text, line, reason) in [
        ("1 seed=1\n\n3 system.0.sped=1\n9 nonsense=1", 3, "`sped`"),
        ("# wider\n2 image.width=64", 2, "at frame 2"),
    ] {
        let recording = Recording::parse(text, "knobs.txt").expect("lines of the right form");
        let refused = recording.turns("fountain", &[]).expect_err("refused");
        assert_eq!(refused.change.line, line, "{refused}");
        assert!(refused.to_string().contains(reason), "{refused}");
    }
}

#[test]
fn a_turn_may_not_change_what_holds_for_a_whole_run() {
    let other_seed = Scene { seed: 99, ..base() };
    let renamed = scene::parse(&SCENE.replace("only", "other"), "r.toml", "r").expect("good");
    for scene in [other_seed, renamed] {
        let error = Plan::with_turns(&base(), &[Turn { frame: 3, scene }], 30);
        assert!(error.is_err_and(|e| e.message.contains("frame 3")));
    }
}

#[test]
fn changes_that_no_frame_shows_are_refused() {
    for (set, key) in [
        ("frames=3", "frames"),
        ("title=x", "title"),
        ("description=x", "description"),
        ("frame_rate=12", "frame_rate"),
        ("steady_particles=7", "steady_particles"),
    ] {
        let recording = Recording::parse(&format!("5 {set}\n"), "r").expect("it is a line");
        let refused = recording
            .turns("fountain", &[])
            .expect_err("it changes nothing");
        let told = refused.to_string();
        assert!(told.contains(&format!("`{key}` changes nothing")), "{told}");
        assert!(told.contains("frame 5") || told.contains(":1"), "{told}");
    }
}

#[test]
fn spaces_around_a_change_that_no_text_has_do_no_harm() {
    let with = |set: &str| Recording {
        changes: vec![motes::recording::Change {
            frame: 5,
            set: set.to_owned(),
            line: 0,
        }],
    };
    assert!(with("   ").turns("fountain", &[]).is_err());
    let turns = |set| with(set).turns("fountain", &[]).expect("it is right");
    let spaced = turns("  system.jet.speed.mean=0.2  ");
    assert!(spaced == turns("system.jet.speed.mean=0.2"));
    let told = with("system.jet.sped=0.2  ").turns("fountain", &[]);
    let told = told.expect_err("it is none").to_string();
    let lines: Vec<&str> = told.lines().collect();
    let carets = lines.iter().position(|line| line.contains('^'));
    let carets = carets.unwrap_or_else(|| panic!("no carets in {told}"));
    assert_eq!(
        lines[carets].find('^'),
        lines[carets - 1].find("sped"),
        "{told}"
    );
}

#[test]
fn a_recording_has_an_end() {
    let lines = |count: usize| "5 system.jet.speed.mean=0.2\n".repeat(count);
    let most = Recording::parse(&lines(100_000), "r").expect("as many as there may be");
    assert_eq!(most.changes.len(), 100_000);
    let error = Recording::parse(&lines(100_001), "r").expect_err("one more");
    assert!(error.to_string().contains("r:100001: "), "{error}");
}

#[test]
fn a_long_flight_is_checked_in_bounded_time() {
    let keys = "[[0, [0, 0, 5]], [1000000, [0, 9, 5]]]";
    let text = SCENE.replace(
        "position = [0, 0, 5]",
        &format!("position = {{ keys = {keys} }}"),
    );
    let begun = std::time::Instant::now();
    for _ in 0..200 {
        scene::parse(&text, "f", "f").expect("a right scene");
    }
    // Each frame of it, looked at, would take a minute and more.
    assert!(begun.elapsed().as_secs() < 12, "{:?}", begun.elapsed());
}
