//! Runs that are stopped or killed and go on: the files are those of a run that was not.

use std::collections::BTreeMap;
use std::process::{Child, Stdio};
use std::time::Duration;

use crate::{Ended, Workshop};

/// Bytes of every file of the folder but the scene, hidden ones too, by path.
type Files = BTreeMap<String, Vec<u8>>;

/// A scene that takes long enough to be stopped in the middle. Its particles live without limit,
/// and most births find no room: nothing but its whole past tells its state.
pub(crate) const CROWDED: &str = r#"frames = 40
seed = 3
capacity = 9000
[image]
width = 96
height = 54
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "crowd"
initial_mean_parts = 1000
var_parts = 600
generation_shape = { kind = "sphere", radius = 0.5 }
speed = { mean = 0.02, var = 0.02 }
color = { mean = [0.1, 0.05, 0.02], var = [0.1, 0.05, 0.02], rate = [-0.002, -0.001, -0.0004] }
intensity_threshold = 0.02
size = { mean = 0.02, var = 0.01 }
"#;

fn files_of(here: &Workshop) -> Files {
    let of_run = |name: &String| !name.ends_with(".toml");
    here.files()
        .into_iter()
        .filter(of_run)
        .map(|name| (name.clone(), here.read(&name)))
        .collect()
}

fn workshop() -> Workshop {
    let here = Workshop::new();
    here.write("crowded.toml", CROWDED);
    here
}

fn render<'a>(output: &[&'a str]) -> Vec<&'a str> {
    [&["render", "crowded.toml", "--adapter", "cpu"], output].concat()
}

/// The files of a run that nothing stops.
fn whole(output: &[&str]) -> Files {
    let here = workshop();
    let ended = here.run(&render(output));
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(ended.stderr.contains("were dropped"), "{}", ended.stderr);
    files_of(&here)
}

fn start(here: &Workshop, arguments: &[&str]) -> Child {
    here.command(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program can be started")
}

/// Kills a run at moments that are spread over its course, and lets it go on, until it is done.
fn kill_until_done(output: &[&str], kills: u32) {
    let expected = whole(output);
    let mut arguments = render(output);
    arguments.extend(["--resume", "--snapshot-every", "0"]);
    let (mut killed, mut round) = (0, 0_u32);
    while killed < kills {
        let here = workshop();
        // Longer and longer, or it would be killed before anything is done for ever.
        let mut patience = Duration::from_millis(30);
        loop {
            let mut run = start(&here, &arguments);
            round += 1;
            let share = f64::from(u32::wrapping_mul(round, 2_654_435_769)) / f64::from(u32::MAX);
            std::thread::sleep(patience.mul_f64(0.2 + share));
            patience = patience.mul_f64(1.3);
            run.kill().expect("it is ours");
            let ended = run.wait_with_output().expect("it has ended");
            if ended.status.success() {
                break;
            }
            killed += 1;
            // What has a final name is whole.
            for (name, bytes) in files_of(&here) {
                if let Some(expected) = expected.get(&name) {
                    assert!(bytes == *expected, "{name} after {killed} kills");
                } else {
                    let hidden = name.split('/').any(|part| part.starts_with('.'));
                    assert!(hidden, "{name} after {killed} kills");
                }
            }
        }
        let found = files_of(&here);
        let names = |files: &Files| files.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&found), names(&expected), "after {killed} kills");
        assert!(found == expected, "after {killed} kills");
    }
}

/// How often runs are killed: `MOTES_FULL=1` for more.
fn kills() -> u32 {
    if std::env::var("MOTES_FULL").is_ok_and(|value| !value.is_empty() && value != "0") {
        50
    } else {
        8
    }
}

#[test]
fn killed_runs_go_on_to_the_same_pictures_statistics_and_dumps() {
    let output = [
        "-o", "all", "--stats", "s.csv", "--dump", "7,30", "--layers",
    ];
    kill_until_done(&output, kills());
}

#[test]
fn killed_runs_of_light_go_on_to_the_same_files() {
    kill_until_done(&["-o", "all/%d.exr"], kills() / 2);
}

#[test]
fn killed_films_go_on_to_the_same_file() {
    let has_ffmpeg = std::process::Command::new("ffmpeg")
        .arg("-version")
        .output()
        .is_ok();
    let is_required = std::env::var_os("MOTES_REQUIRE_FFMPEG").is_some_and(|it| !it.is_empty());
    assert!(has_ffmpeg || !is_required, "there is no ffmpeg");
    if has_ffmpeg {
        kill_until_done(&["-o", "a.mp4"], kills() / 2);
    }
}

#[test]
fn killed_animations_go_on_to_the_same_file() {
    kill_until_done(&["-o", "a.gif", "--stats", "s.csv"], kills());
}

/// Stops a run by a signal once a file is there, or after a moment; how it ended.
#[cfg(unix)]
pub(crate) fn stop(
    here: &Workshop,
    arguments: &[&str],
    signal: &str,
    watched: Option<&str>,
) -> Ended {
    let mut run = start(here, arguments);
    let patience = if watched.is_some() { 2000 } else { 12 };
    for _ in 0..patience {
        if watched.is_some_and(|file| here.path(file).exists()) {
            break;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    if run.try_wait().expect("it is ours").is_none() {
        let sent = std::process::Command::new("kill")
            .args([signal, &run.id().to_string()])
            .status();
        assert!(sent.is_ok_and(|status| status.success()));
    }
    Ended::of(run.wait_with_output())
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_cleanly_and_says_how_to_go_on() {
    let output = ["-o", "all", "--stats", "s.csv"];
    let expected = whole(&output);
    for (signal, code) in [("-INT", 130), ("-TERM", 143), ("-HUP", 129)] {
        let here = workshop();
        let ended = stop(&here, &render(&output), signal, Some("all/frame-0003.png"));
        assert_eq!(ended.code, code, "{}", ended.stderr);
        assert!(
            ended.stderr.contains("motes: stopped before frame "),
            "{}",
            ended.stderr
        );
        assert!(ended.stderr.contains("of 0..40"), "{}", ended.stderr);
        assert!(
            ended.stderr.contains("--resume goes on"),
            "{}",
            ended.stderr
        );
        let found = files_of(&here);
        assert!(!found.contains_key("s.csv"), "statistics of a part");
        assert!(
            found.len() > 4 && found.len() < expected.len() + 2,
            "{}",
            found.len()
        );
        let mut again = render(&output);
        again.push("--resume");
        let ended = here.run(&again);
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        assert!(
            ended.stderr.contains("motes: going on after "),
            "{}",
            ended.stderr
        );
        assert!(files_of(&here) == expected);
    }
}

#[cfg(unix)]
#[test]
fn an_animation_that_was_not_begun_to_be_resumed_leaves_nothing() {
    let here = workshop();
    let arguments = render(&["-o", "a.gif"]);
    let ended = stop(&here, &arguments, "-INT", None);
    // On a fast machine it may be done before it is stopped.
    if ended.code != 0 {
        assert_eq!(ended.code, 130, "{}", ended.stderr);
        assert!(ended.stderr.contains("nothing is kept"), "{}", ended.stderr);
        assert!(files_of(&here).is_empty(), "{:?}", here.files());
    }
}

#[test]
fn two_processes_that_share_the_frames_make_the_files_of_one() {
    let here = Workshop::new();
    let render = |arguments: &[&str]| {
        let scene = ["render", "fireworks", "--adapter", "cpu", "--size", "64x36"];
        start(&here, &[&scene[..], arguments].concat())
    };
    let runs = [
        render(&["-o", "whole"]),
        render(&["-o", "halves", "--frames", "0..90"]),
        render(&["-o", "halves", "--frames", "90..168"]),
    ];
    for run in runs {
        let ended = Ended::of(run.wait_with_output());
        assert_eq!(ended.code, 0, "{}", ended.stderr);
    }
    let files = files_of(&here);
    assert_eq!(files.len(), 2 * 168, "{:?}", here.files());
    for (name, bytes) in files.iter().filter(|(name, _)| name.starts_with("whole")) {
        let other = name.replace("whole", "halves");
        assert!(files.get(&other) == Some(bytes), "{name} and {other}");
    }
}

#[cfg(unix)]
#[test]
fn another_run_is_not_gone_on_with() {
    let here = workshop();
    let arguments = render(&["-o", "all"]);
    let ended = stop(&here, &arguments, "-INT", Some("all/frame-0003.png"));
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    for change in [
        &["--seed", "4"][..],
        &["--set", "system.crowd.size=0.1"],
        &["--size", "97x54"],
        &["--layers"],
        &["--stats", "s.csv"],
    ] {
        let ended = here.run(&[&arguments[..], &["--resume"], change].concat());
        assert_eq!(ended.code, 2, "{change:?}: {}", ended.stderr);
        assert!(
            ended.stderr.contains("is of another run"),
            "{}",
            ended.stderr
        );
        assert!(
            ended.stderr.contains("leave out --resume"),
            "{}",
            ended.stderr
        );
    }
    // Without it, all begins anew.
    let ended = here.run(&arguments);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(files_of(&here) == whole(&["-o", "all"]));
}

#[cfg(unix)]
#[test]
fn a_run_with_another_mesh_is_another_run() {
    let here = workshop();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    here.write("t.obj", triangle);
    let set = "system.crowd.generation_shape={ kind = \"mesh\", mesh = \"t.obj\" }";
    let arguments = render(&["-o", "all", "--set", set]);
    let ended = stop(&here, &arguments, "-INT", Some("all/frame-0003.png"));
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    let resumed = [&arguments[..], &["--resume"]].concat();
    here.write("t.obj", triangle.replace("v 1 0 0", "v 1 0 0.001"));
    let ended = here.run(&resumed);
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert!(
        ended.stderr.contains("is of another run"),
        "{}",
        ended.stderr
    );
    here.write("t.obj", triangle);
    let ended = here.run(&resumed);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(ended.stderr.contains("going on after"), "{}", ended.stderr);
}

#[cfg(unix)]
#[test]
fn frames_that_have_been_lost_or_changed_meanwhile_are_made_again() {
    let output = ["-o", "all", "--stats", "s.csv"];
    let expected = whole(&output);
    for damage in ["removed", "emptied", "changed"] {
        let here = workshop();
        let mut arguments = render(&output);
        let ended = stop(&here, &arguments, "-INT", Some("all/frame-0006.png"));
        assert_eq!(ended.code, 130, "{}", ended.stderr);
        let frame = here.path("all/frame-0002.png");
        match damage {
            "removed" => std::fs::remove_file(frame).expect("it was there"),
            "emptied" => here.write("all/frame-0002.png", ""),
            _ => here.write("all/frame-0002.png", here.read("all/frame-0003.png")),
        }
        arguments.push("--resume");
        let ended = here.run(&arguments);
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        assert!(files_of(&here) == expected, "{damage}");
    }
}

#[cfg(unix)]
#[test]
fn a_late_frame_is_gone_on_to_from_the_state_that_was_kept() {
    let output = ["-o", "late.png", "--frame", "3000", "--stats", "s.csv"];
    let here = workshop();
    let mut arguments = render(&output);
    arguments.extend(["--resume", "--snapshot-every", "0"]);
    let watched = ".late.png.3000-3001.resume/state";
    let ended = stop(&here, &arguments, "-INT", Some(watched));
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    assert!(
        ended.stderr.contains("--resume goes on"),
        "{}",
        ended.stderr
    );
    let ended = here.run(&arguments);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let from = "motes: going on from the state after frame ";
    assert!(ended.stderr.contains(from), "{}", ended.stderr);
    assert!(files_of(&here) == whole(&output));
}

#[cfg(unix)]
#[test]
fn a_run_is_worked_on_by_one_process_at_a_time() {
    let here = workshop();
    let long = ["-o", "late.png", "--frame", "60000", "--resume"];
    let mut first = start(&here, &render(&long));
    let journal = here.path(".late.png.60000-60001.resume/journal");
    for _ in 0..2000 {
        if journal.exists() {
            break;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    // Locked a moment after it is there.
    std::thread::sleep(Duration::from_millis(200));
    let ended = here.run(&render(&long));
    first.kill().expect("it is ours");
    first.wait().expect("it has ended");
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert!(
        ended.stderr.contains("another process is at work"),
        "{}",
        ended.stderr
    );
}

#[test]
fn what_a_killed_run_left_goes_when_it_is_begun_anew() {
    let here = workshop();
    let arguments = render(&["-o", "all"]);
    let mut run = start(&here, &arguments);
    for _ in 0..2000 {
        if here.path("all/frame-0003.png").exists() {
            break;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    run.kill().expect("it is ours");
    // It is over, and a zombie: its number is still its own.
    let mut told = String::new();
    let stderr = run.stderr.take().expect("it is a pipe");
    std::io::Read::read_to_string(&mut { stderr }, &mut told).expect("the program writes UTF-8");
    let journal = here.read("all/.frame-%04d.png.0-40.resume/journal");
    let journal = String::from_utf8_lossy(&journal).into_owned();
    let token = journal.lines().find_map(|line| line.strip_prefix("token "));
    let token = token.unwrap_or_else(|| panic!("no token in {journal}"));
    // As one that was killed while it wrote; and as one of another machine that writes.
    here.write(&format!("all/.motes-{token}-7"), "half");
    let others = [
        format!("all/.motes-{}-7", run.id()),
        "all/.motes-0123456789abcdef-7".to_owned(),
    ];
    for other in &others {
        here.write(other, "half");
    }
    let ended = here.run(&arguments);
    run.wait().expect("it has ended");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let mut files = files_of(&here);
    for other in &others {
        assert!(files.remove(other).is_some(), "{other} is another's");
    }
    assert!(files == whole(&["-o", "all"]));
}

#[test]
fn resume_needs_a_file_and_begins_where_nothing_was_begun() {
    let here = Workshop::new();
    let ended = here.render(&["-o", "a.gif", "--resume"]);
    assert!(!ended.stderr.contains("going on"), "{}", ended.stderr);
    assert_eq!(here.files(), ["a.gif", "sparks.toml"]);
    #[cfg(target_os = "linux")]
    {
        let ended = here.run(&["render", "sparks.toml", "-o", "/dev/null", "--resume"]);
        assert_eq!(ended.code, 2, "{}", ended.stderr);
    }
}

#[test]
fn files_are_replaced_unless_they_are_not_to_be() {
    let here = Workshop::new();
    here.write("a.gif", "precious");
    let ended = here.run(&["render", "sparks.toml", "-o", "a.gif", "--no-clobber"]);
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert!(
        ended.stderr.contains("a.gif is there already"),
        "{}",
        ended.stderr
    );
    assert_eq!(here.read("a.gif"), b"precious");
    here.render(&["-o", "a.gif"]);
    assert_ne!(here.read("a.gif"), b"precious");
    here.render(&["-o", "all", "--frames", "3..5", "-n"]);
    let ended = here.run(&[
        "render",
        "sparks.toml",
        "-o",
        "all",
        "--frames",
        "0..9",
        "-n",
    ]);
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert!(
        ended.stderr.contains("all/frame-0003.png"),
        "{}",
        ended.stderr
    );
}
