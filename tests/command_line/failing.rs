//! A machine that fails under way: a full disk, no memory. Exit code 3, one message, what was
//! finished stays whole, and the run can go on.
#![cfg(target_os = "linux")]

use std::process::Command;

use crate::{Ended, Workshop};

/// Runs a shell script in the workshop, with the program as `$MOTES`.
fn shell(here: &Workshop, wrapped: &[&str], script: &str) -> std::process::Output {
    let all = [wrapped, &["sh", "-c", script]].concat();
    let mut command = Command::new(all[0]);
    command
        .args(&all[1..])
        .current_dir(here.path(""))
        .env("MOTES", env!("CARGO_BIN_EXE_motes"))
        .env_remove("MOTES_ADAPTER")
        .env("NODEVICE_SELECT", "1");
    command.output().expect("there is a shell")
}

/// What gives a process mounts of its own: as root, or as one who may become root to itself.
fn own_mounts(here: &Workshop) -> Option<&'static [&'static str]> {
    let ways: [&[&str]; 2] = [&["unshare", "-m"], &["unshare", "-Urm"]];
    here.write("disk/.keep", "");
    ways.into_iter().find(|way| {
        let mount = "mount -t tmpfs -o size=64k none disk";
        let found = Command::new(way[0]).arg("--version").output().is_ok();
        found && shell(here, way, mount).status.success()
    })
}

#[test]
fn a_full_disk_ends_the_run_and_leaves_the_earlier_frames_to_go_on_from() {
    let here = Workshop::new();
    std::fs::create_dir(here.path("disk")).expect("a temporary folder can be written");
    std::fs::create_dir(here.path("seen")).expect("a temporary folder can be written");
    let size = ["--size", "320x180"];
    here.render(&[&["-o", "whole", "--stats", "whole.csv"], &size[..]].concat());
    let run =
        "$MOTES render sparks.toml --adapter cpu --size 320x180 -o disk/all --stats disk/s.csv";
    // Where nobody may mount a disk, files may not grow instead: the same error by another cause.
    let (wrapped, fill, free): (&[&str], _, _) = match own_mounts(&here) {
        Some(way) => (
            way,
            "mount -t tmpfs -o size=60k none disk",
            "mount -o remount,size=9m disk",
        ),
        None => (&[], "trap '' XFSZ; ulimit -f 4", "ulimit -f unlimited"),
    };
    let script = format!(
        "({fill}; {run}; echo code $? >&2; cp -r disk/. seen; {free} && {run} --resume; \
         echo code $? >&2; cp -r disk/. .)"
    );
    let script = match wrapped {
        // A limit cannot be raised again by whom it binds.
        [] => format!(
            "({fill}; {run}; echo code $? >&2; cp -r disk/. seen); {run} --resume; echo code $? >&2; cp -r disk/. ."
        ),
        _ => script,
    };
    let output = shell(&here, wrapped, &script);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(stderr.contains("code 3\n"), "{stderr}");
    assert!(
        stderr.contains("make room, or choose another disk"),
        "{stderr}"
    );
    assert!(stderr.ends_with("code 0\n"), "{stderr}");
    let files = here.files();
    let seen: Vec<_> = files
        .iter()
        .filter(|it| it.starts_with("seen/all/"))
        .collect();
    for name in &seen {
        if name.ends_with(".png") {
            let whole = name.replace("seen/all", "whole");
            assert!(here.read(name) == here.read(&whole), "{name} is not whole");
        } else {
            assert!(name.contains(".resume/"), "{name} is left behind");
        }
    }
    assert!(!files.contains(&"seen/s.csv".to_owned()), "{files:?}");
    for name in files.iter().filter(|it| it.starts_with("whole/")) {
        let again = name.replace("whole", "all");
        assert!(here.read(name) == here.read(&again), "{again}");
    }
    assert!(here.read("whole.csv") == here.read("s.csv"));
    if !wrapped.is_empty() {
        assert!(stderr.contains("--resume goes on after them"), "{stderr}");
        assert!(seen.len() > 2, "{files:?}");
    }
}

#[test]
fn a_limit_of_files_is_an_error_and_leaves_nothing_half_written() {
    let here = Workshop::new();
    let run = "$MOTES render sparks.toml --adapter cpu --size 320x180 -o all --stats s.csv 2>&1";
    let ended = Ended::of(Ok(shell(&here, &[], &format!("ulimit -f 4; {run}"))));
    assert_eq!(ended.code, 3, "{}", ended.stdout);
    assert!(ended.stdout.contains("make room"), "{}", ended.stdout);
    let hidden = |name: &String| name.contains(".motes-");
    assert!(!here.files().iter().any(hidden), "{:?}", here.files());
}

#[test]
fn folders_made_for_what_does_not_come_go_again() {
    let here = Workshop::new();
    let outputs = [
        "-o new/a/x.png --frame 3",
        "-o new/a/b",
        "-o new/a/x-%d.png --frames 2..5",
        "-o new/a/x.gif",
        "-o new/a/x.svg --frame 3",
        "-o kept.png --frame 3 --stats new/s/t.csv --dump 3 --dump-dir new/dumps",
    ];
    std::fs::create_dir(here.path("own")).expect("a temporary folder can be written");
    for output in outputs {
        for output in [output.to_owned(), output.replace("new", "own/new")] {
            let run = format!("$MOTES render sparks.toml --adapter cpu --size 320x180 {output}");
            let script = format!("trap '' XFSZ; ulimit -f 0; {run} 2>&1");
            let ended = Ended::of(Ok(shell(&here, &[], &script)));
            assert_eq!(ended.code, 3, "{output}: {}", ended.stdout);
            assert!(!here.path("new").exists(), "{output}: {:?}", here.files());
            assert!(here.path("own").exists(), "{output}");
            assert!(
                !here.path("own/new").exists(),
                "{output}: {:?}",
                here.files()
            );
        }
    }
}

#[test]
fn a_film_that_does_not_fit_on_the_disk_is_no_film() {
    let here = Workshop::new();
    let has_ffmpeg = Command::new("ffmpeg").arg("-version").output().is_ok();
    let is_required = std::env::var_os("MOTES_REQUIRE_FFMPEG").is_some_and(|it| !it.is_empty());
    assert!(has_ffmpeg || !is_required, "there is no ffmpeg");
    std::fs::create_dir(here.path("disk")).expect("a temporary folder can be written");
    let (true, Some(way)) = (has_ffmpeg, own_mounts(&here)) else {
        return;
    };
    here.render(&["-o", "whole.mp4", "--size", "640x360"]);
    let pages = here.read("whole.mp4").len() / 4096;
    assert!(pages >= 2, "{pages}");
    // From the middle of its frames to its very end.
    for kib in [pages * 2, pages * 3, pages * 4] {
        let script = format!(
            "mount -t tmpfs -o size={kib}k none disk; echo old >disk/a.mp4; \
             $MOTES render sparks.toml --adapter cpu --size 640x360 -o disk/a.mp4; \
             echo code $? >&2; ls -A disk >&2; cat disk/a.mp4 >&2"
        );
        let output = shell(&here, way, &script);
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            stderr.ends_with("code 3\na.mp4\nold\n"),
            "{kib} KiB: {stderr}"
        );
    }
}

/// A wavy sheet of `2 * (side - 1)^2` triangles.
fn sheet(side: usize) -> String {
    let mut text = String::new();
    for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
        text += &format!("v {x} {y} {}\n", (x + y) % 7);
    }
    for (y, x) in (1..side).flat_map(|y| (1..side).map(move |x| (y, x))) {
        let [a, b] = [(y - 1) * side + x, y * side + x];
        text += &format!("f {a} {} {b}\nf {} {} {b}\n", a + 1, a + 1, b + 1);
    }
    text
}

#[test]
fn want_of_memory_for_meshes_is_told_and_not_a_crash() {
    let here = Workshop::new();
    here.write("sheet.obj", sheet(250));
    let scene = |rest: &str| {
        format!(
            r#"
frames = 2
[image]
width = 64
height = 36
[camera]
position = [0, 0, 900]
target = [125, 125, 0]
{rest}"#
        )
    };
    let fire = "[[fire]]\nname = \"straw\"\n[fire.spread]\nmesh = \"sheet.obj\"\n\
                ignition = [{ position = [125, 125, 0] }]\n";
    let surface = "[[system]]\nname = \"dust\"\ninitial_mean_parts = 5\n\
                   generation_shape = { kind = \"mesh\", mesh = \"sheet.obj\" }\n\
                   speed = 0.1\nlifetime = 9\ncolor = [1, 1, 1]\nsize = 1\n\
                   [[surface]]\nmesh = \"sheet.obj\"\n";
    for (name, rest) in [("fire.toml", fire), ("surface.toml", surface)] {
        here.write(name, scene(rest));
        // From what is not enough to read the file to what is enough for all.
        let (mut wanted, mut sufficed) = (0, false);
        for kib in (40_000..1_000_000).step_by(20_000) {
            let run = format!("$MOTES render {name} --adapter cpu -o all.gif 2>&1");
            let output = shell(&here, &[], &format!("ulimit -v {kib}; {run}"));
            let ended = Ended::of(Ok(output));
            let told = &ended.stdout;
            match ended.code {
                0 => {
                    sufficed = true;
                    break;
                }
                3 if told.contains("memory") => wanted += 1,
                // Not even the program starts, or its threads.
                code if wanted == 0 && kib < 100_000 => {
                    println!("{name} in {kib} KiB: {code}, {told}");
                }
                code => panic!("{name} in {kib} KiB: {code}, {told}"),
            }
        }
        assert!(sufficed && wanted > 0, "{name}: {wanted}");
    }
}

#[test]
fn want_of_memory_is_told_and_not_a_crash() {
    let here = Workshop::new();
    here.write(
        "crowd.toml",
        r#"
frames = 60
capacity = 100_000_000
[image]
width = 64
height = 36
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "crowd"
initial_mean_parts = 400_000
generation_shape = { kind = "sphere", radius = 0.5 }
speed = { mean = 0.02, var = 0.02 }
lifetime = 60
color = [0.1, 0.05, 0.02]
size = 0.01
"#,
    );
    // Address space for a few frames of it, and at some of these sizes for one copy too few.
    for kib in [250_000, 360_000] {
        let run = "$MOTES render crowd.toml --adapter cpu -o all --snapshot-every 0 --dump 2 2>&1";
        let output = shell(&here, &[], &format!("ulimit -v {kib}; {run}"));
        let ended = Ended::of(Ok(output));
        assert_eq!(ended.code, 3, "{kib}: {}", ended.stdout);
        let told = &ended.stdout;
        assert!(told.contains("error: out of memory: "), "{kib}: {told}");
        assert!(told.contains("take a smaller capacity"), "{kib}: {told}");
        let hidden = |name: &String| name.contains("/.motes-");
        assert!(!here.files().iter().any(hidden), "{:?}", here.files());
    }
}
