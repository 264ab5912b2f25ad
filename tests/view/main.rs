//! The window of `motes view`, without one: sessions, scripts and what they leave behind.
#![cfg(feature = "view")]

#[path = "../common/mod.rs"]
mod common;

mod detail;
mod files;
mod table;
mod touch;
mod way;
mod widgets;

use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

use motes::gpu::GpuDevice;
use motes::recording::Recording;
use motes::scene::{KnobValue, Loader, Scene};
use motes::view::{self, Session, Source};
use motes::{AdapterChoice, Options, Simulation, wgpu};

/// A scene that takes milliseconds.
const SCENE: &str = "frames = 40\nseed = 7\n[image]\nwidth = 64\nheight = 48\n\
     [camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n\
     [[system]]\nname = \"jet\"\ninitial_mean_parts = 30\nlifetime = 9\n\
     generation_shape = { kind = \"sphere\", radius = 0.4 }\nspeed = { mean = 0.05, var = 0.02 }\n\
     color = [0.9, 0.5, 0.1]\nsize = 0.05\n";

fn source(scene: &Path, sets: &[&str]) -> Source {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let name = &common::adapters()[0];
    let (_, device, queue) = view::device_of(&instance, name, |_| true).expect("it opens");
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let scene = scene.display().to_string();
    let is_timed = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
    let device = GpuDevice::from_wgpu(&device, &queue).expect("it will do");
    Source::new((&scene, &sets, Loader::default()), (device, is_timed))
}

/// A folder with the scene in it, and a session of it.
fn session() -> (tempfile::TempDir, Session) {
    session_in("jet.toml", SCENE)
}

/// A folder with a scene of that text in it, `own.toml`, and a session of it.
fn begun(text: &str) -> (tempfile::TempDir, Session) {
    session_in("own.toml", text)
}

fn session_in(name: &str, text: &str) -> (tempfile::TempDir, Session) {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join(name);
    std::fs::write(&scene, text).expect("it is written");
    let session = Session::new(source(&scene, &[])).expect("it begins");
    (folder, session)
}

fn steps(session: &mut Session, count: u32) {
    for _ in 0..count {
        session.step().expect("it steps");
    }
}

fn value(session: &Session, path: &str) -> KnobValue {
    let mut knobs = session.knobs().iter();
    let knob = knobs.find(|knob| knob.path == path).expect("there is one");
    knob.value.clone()
}

fn digest(session: &mut Session) -> u64 {
    session.simulation().state_digest().expect("it is told")
}

/// A session that was saved, and the same run on the processor, made of what was saved alone.
struct Saved {
    recording: Recording,
    scene: Scene,
    options: Options,
    replay: Simulation,
}

fn saved(folder: &tempfile::TempDir, session: &Session) -> Saved {
    let saved = folder.path().join("mine.toml");
    let inputs = session.save_as(&saved).expect("it is saved");
    let text = std::fs::read_to_string(&inputs).expect("it is there");
    let recording = Recording::parse(&text, "mine.inputs").expect("it is a recording");
    let saved = saved.display().to_string();
    let scene = Loader::default().load(&saved).expect("it is a scene");
    let options = Options {
        adapter: AdapterChoice::Cpu,
        turns: recording.turns(&saved, &[]).expect("they fit"),
        ..Options::default()
    };
    let mut replay = Simulation::new(&scene, &options).expect("it begins");
    replay.seek(session.frame()).expect("it steps");
    Saved {
        recording,
        scene,
        options,
        replay,
    }
}

#[test]
fn what_was_played_is_replayed_bit_for_bit() {
    let (folder, mut session) = session();
    steps(&mut session, 5);
    session
        .turn("system.jet.initial_mean_parts", "90")
        .expect("it turns");
    steps(&mut session, 6);
    session
        .turn("system.jet.color", "[0.1, 0.2, 0.9]")
        .expect("it turns");
    session
        .turn("system.jet.speed.mean", "0.2")
        .expect("it turns");
    steps(&mut session, 9);
    let Saved {
        recording,
        scene,
        options,
        mut replay,
    } = saved(&folder, &session);
    assert_eq!(&recording, session.recording());
    assert_eq!(recording.changes.len(), 3);
    assert_eq!(
        replay.state_digest().expect("it is told"),
        digest(&mut session)
    );
    // The changes made a difference.
    let mut untouched = Simulation::new(
        &scene,
        &Options {
            turns: Vec::new(),
            ..options
        },
    )
    .expect("it begins");
    untouched.seek(session.frame()).expect("it steps");
    assert_ne!(
        untouched.state_digest().expect("it is told"),
        digest(&mut session)
    );
}

#[test]
fn knobs_go_back_one_by_one_and_to_their_defaults() {
    let (_folder, mut session) = session();
    let path = "system.jet.drag";
    let first = value(&session, path);
    assert!(matches!(first, KnobValue::Default(_)), "{first:?}");
    session.turn(path, "0.25").expect("it turns");
    steps(&mut session, 3);
    session
        .turn("seed", "9")
        .expect_err("a seed holds for a whole run");
    session.turn(path, "-3").expect_err("it is out of range");
    session.turn(path, "0.5").expect("it turns");
    steps(&mut session, 3);
    assert_eq!(session.scene().systems[0].drag, 0.5);
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().systems[0].drag, 0.25);
    assert_eq!(session.undo(), Ok(true));
    assert_eq!(session.scene().systems[0].drag, 0.0);
    assert_eq!(session.undo(), Ok(false));
    session.turn(path, "0.5").expect("it turns");
    session.reset(path).expect("it has a default");
    assert_eq!(session.scene().systems[0].drag, 0.0);
}

#[test]
fn a_run_that_is_begun_again_has_what_was_done_up_to_there() {
    let (_folder, mut session) = session();
    steps(&mut session, 4);
    session
        .turn("system.jet.initial_mean_parts", "70")
        .expect("it turns");
    steps(&mut session, 8);
    let (frame, before) = (session.frame(), digest(&mut session));
    steps(&mut session, 5);
    session.restart(frame).expect("it begins");
    assert_eq!((session.frame(), digest(&mut session)), (frame, before));
    session.restart(2).expect("it begins");
    assert_eq!(session.upcoming(), 1);
    assert_eq!(session.scene().systems[0].births.initial_mean_parts, 30.0);
    steps(&mut session, frame - 2);
    assert_eq!(session.upcoming(), 0);
    assert_eq!(session.scene().systems[0].births.initial_mean_parts, 70.0);
    assert_eq!((session.frame(), digest(&mut session)), (frame, before));
}

#[test]
fn a_scene_that_is_written_again_is_read_again_and_a_wrong_one_changes_nothing() {
    let (folder, mut session) = session();
    let file = folder.path().join("jet.toml");
    steps(&mut session, 6);
    let (frame, before) = (session.frame(), digest(&mut session));
    std::fs::write(&file, SCENE.replace("= 30", "= thirty")).expect("it is written");
    let told = session.reload().expect_err("it is no scene");
    assert!(told.contains("jet.toml:11:22"), "{told}");
    assert_eq!((session.frame(), digest(&mut session)), (frame, before));
    std::fs::write(&file, SCENE.replace("= 30", "= 60")).expect("it is written");
    session.reload().expect("it is a scene");
    assert_eq!(session.frame(), frame);
    assert_ne!(digest(&mut session), before);
    assert_eq!(
        value(&session, "system.jet.initial_mean_parts"),
        KnobValue::Written("60".into())
    );
}

#[test]
fn time_makes_frames_at_the_scenes_rate_and_none_in_a_pause() {
    let (_folder, mut session) = session();
    let frame = Duration::from_secs_f64(1.0 / f64::from(session.scene().frame_rate));
    let mut stepped = 0;
    for _ in 0..20 {
        stepped += u32::from(session.advance(frame / 2).expect("it steps"));
    }
    assert!((9..=10).contains(&stepped), "{stepped}");
    session.playing = false;
    assert_eq!(session.advance(frame * 9), Ok(false));
}

/// The program, in that folder, without a display.
fn motes(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_motes"))
        .args(arguments)
        .current_dir(folder)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .env("MOTES_ADAPTER", &common::adapters()[0])
        .output()
        .expect("it starts")
}

#[test]
fn a_script_plays_looks_around_and_takes_pictures_of_the_window() {
    let (folder, _) = session();
    let script = "0 turn system.jet.speed.mean=0.1  # livelier\n\
         20 shot before.png\n20 save mine.toml\n\
         21 key Space\n22 move 800 300\n23 press\n24 move 900 340\n25 release\n\
         30 shot after.png\n30 save paused.toml\n";
    std::fs::write(folder.path().join("play.txt"), script).expect("it is written");
    let arguments = [
        "view", "jet.toml", "--script", "play.txt", "--window", "1000x600",
    ];
    let output = motes(folder.path(), &arguments);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    let [before, after] = ["before.png", "after.png"].map(|name| {
        let file = std::fs::File::open(folder.path().join(name)).expect("it is there");
        let mut reader = png::Decoder::new(std::io::BufReader::new(file))
            .read_info()
            .expect("a PNG");
        assert_eq!((reader.info().width, reader.info().height), (1000, 600));
        let mut pixels = vec![0; reader.output_buffer_size().expect("it is small")];
        reader.next_frame(&mut pixels).expect("it is whole");
        pixels
    });
    // In the middle of the picture, to the right of the knobs, it is orange.
    let is_orange = |pixel: &[u8]| pixel[0] > 100 && pixel[0] > pixel[1] && pixel[1] > pixel[2];
    let right = |pixels: &[u8]| {
        let rows = pixels.chunks(1000 * 4).take(500);
        rows.flat_map(|row| row[400 * 4..].chunks(4))
            .filter(|it| is_orange(it))
            .count()
    };
    assert!(right(&before) > 500, "{}", right(&before));
    assert!(right(&after) > 100, "{}", right(&after));
    assert!(before != after, "it was looked at from elsewhere");
    // Looking around is no change of the run, and a pause makes no frames.
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect("it is there");
    let lines =
        |name: &str| -> Vec<String> { read(name).lines().skip(1).map(str::to_owned).collect() };
    // Frame 0 has been made when the window opens.
    assert_eq!(lines("mine.inputs"), ["1 system.jet.speed.mean=0.1"]);
    assert_eq!(lines("paused.inputs"), lines("mine.inputs"));
    assert_eq!(read("mine.toml"), SCENE);
    let head = read("mine.inputs")
        .lines()
        .next()
        .unwrap_or_default()
        .to_owned();
    let begin = "# motes render mine.toml --set capacity=100000 --inputs mine.inputs --frames 0..";
    assert!(head.starts_with(begin), "{head}");
}

#[test]
fn without_a_display_there_is_an_error_and_no_window() {
    let (folder, _) = session();
    let output = motes(folder.path(), &["view", "jet.toml"]);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{stderr}");
    assert!(stderr.contains("display"), "{stderr}");
    assert!(
        !stderr.contains("panicked") && !stderr.contains(".rs"),
        "{stderr}"
    );
}

#[test]
fn flocks_and_fires_that_spread_can_be_played_with() {
    let folder = tempfile::tempdir().expect("there is room");
    std::fs::write(
        folder.path().join("wall.toml"),
        r#"frames = 20
image = { width = 64, height = 36 }
camera = { position = [0, 0, 3], target = [0, 0, 0] }
[[fire]]
name = "wall"
[fire.spread]
mesh = "cube"
ignition = [{ position = [0, 0, 1] }]
"#,
    )
    .expect("it is written");
    std::fs::write(folder.path().join("play.txt"), "2 shot seen.png\n3 end\n")
        .expect("it is written");
    // A click at the middle of the picture lights the cube there.
    let click =
        "2 move 665 250\n3 press\n4 release\n6 detail 2 lines\n8 save lit.toml\n9 shot lit.png\n";
    std::fs::write(folder.path().join("click.txt"), click).expect("it is written");
    let arguments = [
        "view",
        "wall.toml",
        "--script",
        "click.txt",
        "--window",
        "1000x600",
    ];
    let output = motes(folder.path(), &arguments);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    let inputs = std::fs::read_to_string(folder.path().join("lit.inputs")).expect("it is there");
    let lit: Vec<&str> = inputs.lines().skip(1).collect();
    assert_eq!(lit.len(), 1, "{inputs}");
    assert!(
        lit[0]
            .contains(" fire.wall.spread.ignition=[{ position = [0.0, 0.0, 1.0], first_frame = 0"),
        "{inputs}"
    );
    assert_eq!(lit[0].matches("position").count(), 2, "{inputs}");
    for scene in ["bounce-wrap", "wall.toml"] {
        let output = motes(folder.path(), &["view", scene, "--script", "play.txt"]);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{scene}: {stderr}");
        assert!(folder.path().join("seen.png").is_file(), "{scene}");
    }
}

#[test]
fn wrong_scripts_and_scenes_are_told_with_their_place() {
    let (folder, _) = session();
    for (script, told) in [
        ("0 jump 3\n", "play.txt:1: no action"),
        ("5 press\n4 press\n", "play.txt:2: an earlier pass"),
        ("press\n", "play.txt:1:"),
        ("0 key Spade\n", "play.txt:1:"),
        ("0 shot a.jpg\n", "play.txt:1:"),
        ("0 move 1\n", "play.txt:1:"),
        (
            "\n0 turn system.jat.drag=1\n",
            "play.txt:2: there is no `jat`",
        ),
        ("0 turn seed=4\n", "play.txt:1: "),
        ("0 shot /proc/x.png\n", "error: /proc/x.png: "),
        ("0 frame 9 9\n", "play.txt:1: no action"),
        ("4294967295 end\n", "play.txt:1: a pass after 1,000,000"),
        // It begins no comment.
        ("0 turn title=\"a#b\"\n", "`title` changes nothing in a run"),
    ] {
        std::fs::write(folder.path().join("play.txt"), script).expect("it is written");
        let output = motes(folder.path(), &["view", "jet.toml", "--script", "play.txt"]);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{script}: {stderr}");
        assert!(stderr.contains(told), "{script}: {stderr}");
    }
    for arguments in [
        vec!["view", "jot.toml"],
        vec!["view", "jet.toml", "--script", "none.txt"],
        vec!["view", "jet.toml", "--window", "0x0"],
        vec!["view", "jet.toml", "--set", "frames=x"],
        vec!["view", "jet.toml", "--adapter", "cpu"],
    ] {
        let output = motes(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
}
