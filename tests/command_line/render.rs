//! What `motes render` writes, read back with other readers than Motes' own.

use std::fs::File;
use std::io::BufReader;

use crate::{FRAMES, Workshop};

/// Width, height and RGB or RGBA bytes of a PNG.
fn png_of(here: &Workshop, name: &str) -> (u32, u32, Vec<u8>) {
    let file = File::open(here.path(name)).expect("the picture was written");
    let mut reader = png::Decoder::new(BufReader::new(file))
        .read_info()
        .expect("it is a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a small picture")];
    let info = reader.next_frame(&mut pixels).expect("it is whole");
    pixels.truncate(info.buffer_size());
    (info.width, info.height, pixels)
}

/// Rows of a CSV file as cells; the header first.
fn rows_of(here: &Workshop, name: &str) -> Vec<Vec<String>> {
    let text = String::from_utf8(here.read(name)).expect("statistics are text");
    text.lines()
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

/// The row of a frame and population.
fn row<'a>(rows: &'a [Vec<String>], frame: u32, population: &str) -> &'a [String] {
    let frame = frame.to_string();
    rows.iter()
        .find(|row| row[0] == frame && row[1] == population)
        .unwrap_or_else(|| panic!("no row of {population} at frame {frame} in {rows:?}"))
}

fn frame_name(frame: u32) -> String {
    format!("all/frame-{frame:04}.png")
}

#[test]
fn a_folder_gets_a_png_a_frame_and_nothing_else() {
    let here = Workshop::new();
    here.render(&["-o", "all"]);
    let mut expected: Vec<_> = (0..FRAMES).map(frame_name).collect();
    expected.push("sparks.toml".into());
    assert_eq!(here.files(), expected);
    let pictures: Vec<_> = (0..FRAMES)
        .map(|frame| png_of(&here, &frame_name(frame)))
        .collect();
    assert!(
        pictures
            .iter()
            .all(|(width, height, _)| (*width, *height) == (32, 18))
    );
    assert!(
        pictures.windows(2).all(|two| two[0] != two[1]),
        "two frames in turn are the same"
    );
}

#[test]
fn without_an_output_the_pictures_lie_under_out_and_the_scenes_name() {
    let here = Workshop::new();
    here.render(&["--frames", "3..5"]);
    let expected = [
        "out/sparks/frame-0003.png",
        "out/sparks/frame-0004.png",
        "sparks.toml",
    ];
    assert_eq!(here.files(), expected);
}

#[test]
fn a_pattern_names_the_frames() {
    let here = Workshop::new();
    let ended = here.render(&["-o", "new/s-%02d.png", "--frames", "8..10"]);
    assert!(
        ended
            .stderr
            .contains("motes: wrote new/s-%02d.png: 2 frames of 32x18 pixels in "),
        "{}",
        ended.stderr
    );
    assert_eq!(
        here.files(),
        ["new/s-08.png", "new/s-09.png", "sparks.toml"]
    );
}

#[test]
fn a_gif_holds_every_frame_at_the_scenes_rate() {
    let here = Workshop::new();
    here.render(&["-o", "a.gif"]);
    let file = File::open(here.path("a.gif")).expect("the animation was written");
    let mut reader = gif::DecodeOptions::new()
        .read_info(BufReader::new(file))
        .expect("it is a GIF");
    assert_eq!((reader.width(), reader.height()), (32, 18));
    let (mut frames, mut hundredths) = (0, 0);
    while let Some(frame) = reader.read_next_frame().expect("it is whole") {
        frames += 1;
        hundredths += u32::from(frame.delay);
    }
    assert_eq!(frames, FRAMES);
    // 10 frames at 24 a second are 41.67 hundredths of a second.
    assert!(
        (41..=42).contains(&hundredths),
        "it plays {hundredths} hundredths of a second"
    );
}

#[test]
fn one_frame_alone_is_the_frame_of_the_whole_run() {
    let here = Workshop::new();
    here.render(&["-o", "all", "--stats", "all.csv"]);
    let all = rows_of(&here, "all.csv");
    for frame in 0..FRAMES {
        let number = frame.to_string();
        here.render(&["-o", "one.png", "--frame", &number, "--stats", "one.csv"]);
        assert_eq!(
            here.read("one.png"),
            here.read(&frame_name(frame)),
            "frame {frame}"
        );
        let one = rows_of(&here, "one.csv");
        assert_eq!(one.len(), 3, "the header and two rows: {one:?}");
        for population in ["particles", "image"] {
            assert_eq!(row(&one, frame, population), row(&all, frame, population));
        }
    }
}

/// A burst takes all the room until its particles die, and the steady stream's are dropped.
const CROWDED: &str = r#"
frames = 31
capacity = 1000
image = { width = 32, height = 18 }
camera = { position = [0, 0, 5], target = [0, 0, 0] }

[[system]]
name = "burst"
initial_mean_parts = 1000
end_frame = 1
generation_shape = { kind = "sphere", radius = 0.5 }
speed = 0.02
lifetime = 20
color = [0.1, 0.1, 0.1]
size = 0.05

[[system]]
name = "steady"
initial_mean_parts = 10
generation_shape = { kind = "sphere", radius = 0.5 }
speed = 0.02
lifetime = 20
color = [0.3, 0.2, 0.1]
size = 0.05
"#;

#[test]
fn one_frame_alone_knows_of_births_dropped_long_before() {
    let here = Workshop::new();
    here.write("sparks.toml", CROWDED);
    here.render(&["-o", "all", "--stats", "all.csv"]);
    let all = rows_of(&here, "all.csv");
    assert_eq!(row(&all, 5, "particles")[7], "10", "births are dropped");
    for frame in [25, 30] {
        let number = frame.to_string();
        here.render(&["-o", "one.png", "--frame", &number, "--stats", "one.csv"]);
        assert_eq!(here.read("one.png"), here.read(&frame_name(frame)));
        let one = rows_of(&here, "one.csv");
        for population in ["particles", "image"] {
            assert_eq!(row(&one, frame, population), row(&all, frame, population));
        }
    }
}

#[test]
fn statistics_balance_and_name_every_frame() {
    let here = Workshop::new();
    here.render(&["-o", "a.gif", "--stats", "a.csv"]);
    let rows = rows_of(&here, "a.csv");
    assert_eq!(
        rows[0].join(","),
        "frame,population,kind,requested,born,died,live,dropped,digest,\
         died_of_age,died_of_intensity,died_of_bounds,\
         polarisation,mean_speed,median_nearest_distance,mean_neighbours"
    );
    assert_eq!(rows.len() as u32, 1 + 2 * FRAMES);
    let mut live_before = 0;
    for frame in 0..FRAMES {
        let particles = row(&rows, frame, "particles");
        let count = |at: usize| particles[at].parse::<i64>().expect("a count");
        let [requested, born, died, live, dropped] = [3, 4, 5, 6, 7].map(count);
        assert!(
            (12..=28).contains(&requested),
            "20 ± 8 are asked for, not {requested}"
        );
        assert_eq!(requested, born + dropped, "frame {frame}");
        assert_eq!(live, live_before + born - died, "frame {frame}");
        assert_eq!(
            died,
            [9, 10, 11].map(count).iter().sum::<i64>(),
            "frame {frame}"
        );
        live_before = live;
        for population in ["particles", "image"] {
            let digest = &row(&rows, frame, population)[8];
            assert!(
                digest.len() == 16 && u64::from_str_radix(digest, 16).is_ok(),
                "{digest}"
            );
        }
    }
    // No particle dies before its third frame, and some have by the end.
    assert_eq!(row(&rows, 1, "particles")[5], "0");
    assert_ne!(row(&rows, FRAMES - 1, "particles")[5], "0");
}

#[test]
fn dumps_hold_the_living_of_their_frame() {
    let here = Workshop::new();
    let arguments = [
        "-o",
        "a.gif",
        "--stats",
        "a.csv",
        "--dump",
        "0,9",
        "--dump-dir",
        "dumps",
    ];
    here.render(&arguments);
    let rows = rows_of(&here, "a.csv");
    for (frame, name) in [
        (0, "dumps/particles-0000.ply"),
        (9, "dumps/particles-0009.ply"),
    ] {
        let bytes = here.read(name);
        let end = b"end_header\n";
        let at = bytes
            .windows(end.len())
            .position(|window| window == end)
            .expect("a PLY header");
        let header = String::from_utf8_lossy(&bytes[..at]);
        assert!(
            header.starts_with("ply\nformat binary_little_endian 1.0\n"),
            "{header}"
        );
        let live: usize = row(&rows, frame, "particles")[6].parse().expect("a count");
        assert!(
            header.contains(&format!("element vertex {live}\n")),
            "{live} live, {header}"
        );
        // Ten properties of four bytes: x y z vx vy vz age lifetime system id.
        assert_eq!(bytes.len() - at - end.len(), live * 40, "{header}");
    }
}

#[test]
fn size_seed_and_set_change_the_scene_and_inputs_change_it_from_their_frame_on() {
    let here = Workshop::new();
    here.render(&["-o", "all"]);
    let of = |more: &[&str]| {
        here.render(&[&["-o", "one.png", "--frame", "5"], more].concat());
        png_of(&here, "one.png")
    };
    let plain = png_of(&here, &frame_name(5));
    assert_eq!(of(&["--seed", "7"]), plain, "7 is the scene's own seed");
    assert_ne!(of(&["--seed", "8"]), plain);
    assert_ne!(of(&["--set", "system.0.speed.mean=0.3"]), plain);
    let wide = of(&["--size", "48x16"]);
    assert_eq!((wide.0, wide.1), (48, 16));
    assert_eq!(
        of(&["--set", "image.width=48", "--set", "image.height=16"]),
        wide
    );

    here.write(
        "changes.txt",
        "# quicker sparks\n4 system.0.speed.mean=0.3\n",
    );
    here.render(&["-o", "changed-%04d.png", "--inputs", "changes.txt"]);
    for frame in 0..FRAMES {
        let changed = here.read(&format!("changed-{frame:04}.png"));
        let same = changed == here.read(&frame_name(frame));
        assert_eq!(same, frame < 4, "frame {frame}");
    }
}

#[test]
fn where_there_is_nothing_to_see_it_says_what_was_alive() {
    let here = Workshop::new();
    here.write(
        "far.toml",
        r#"frames = 2

[image]
width = 32
height = 18
[camera]
position = [0, 0, 900]
target = [0, 0, 1000]
[[flock]]
name = "starlings"
count = 7
region = { min = [0, 0, 0], max = [5, 3, 0] }
"#,
    );
    let nothing = "nothing to see in these pictures: ";
    let told: &[(&str, &[&str], &str)] = &[
        (
            "sparks.toml",
            &[
                "--set",
                "system.sparks.initial_mean_parts=0",
                "--set",
                "system.sparks.var_parts=0",
            ],
            "nothing was alive",
        ),
        (
            "sparks.toml",
            &["--set", "system.sparks.color=[0,0,0]"],
            " particles were alive, but dark",
        ),
        ("far.toml", &[], "up to 7 boids were alive, but dark"),
    ];
    let run = |scene: &str, more: &[&str]| {
        let ended = here.run(&[&["render", scene, "--adapter", "cpu", "-o", "all"], more].concat());
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        ended.stderr
    };
    for (scene, more, who) in told {
        let stderr = run(scene, more);
        assert!(stderr.contains(nothing) && stderr.contains(who), "{stderr}");
    }
    // Of one pixel nobody knows.
    let stderr = run("sparks.toml", &["--size", "1x1"]);
    assert!(!stderr.contains(nothing), "{stderr}");
    let stderr = run("sparks.toml", &[]);
    assert!(!stderr.contains(nothing), "{stderr}");
}

/// What there is no room for is told by its kind, with the key that gives it room.
#[test]
fn what_finds_no_room_is_told_with_the_key_that_helps() {
    let here = Workshop::new();
    let scene = |more: &str| {
        format!(
            r#"frames = 6
{more}
[image]
width = 32
height = 18
[camera]
position = [0, 0, 9]
target = [0, 0, 0]
[[system]]
name = "parent"
initial_mean_parts = 3
generation_shape = {{ kind = "sphere", radius = 1 }}
speed = 0.1
lifetime = 20
color = [0, 0, 0]
size = 1
[[system]]
name = "child"
parent = "parent"
initial_mean_parts = 5
generation_shape = {{ kind = "sphere", radius = 0.1 }}
speed = 0.1
lifetime = 20
color = [1, 1, 1]
size = 0.1
"#
        )
    };
    let said = |more: &str| {
        here.write("tree.toml", scene(more));
        let ended = here.run(&["render", "tree.toml", "--adapter", "cpu", "-o", "all"]);
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        ended.stderr
    };
    let (systems, particles) = ("systems found no room", "births were dropped");
    let text = said("max_systems = 4");
    assert!(
        text.contains(systems) && text.contains("`max_systems` (4)"),
        "{text}"
    );
    assert!(!text.contains(particles), "{text}");
    let text = said("capacity = 30");
    assert!(
        text.contains(particles) && text.contains("`capacity` ("),
        "{text}"
    );
    assert!(!text.contains(systems), "{text}");
    let text = said("");
    assert!(
        !text.contains(systems) && !text.contains(particles),
        "{text}"
    );
}

#[test]
fn flames_that_find_no_room_are_told_unless_there_are_to_be_none() {
    let here = Workshop::new();
    let told = |most: &str| {
        let most = format!("fire.fire.spread.max_flames={most}");
        let sets = [
            "image.width=64",
            "image.height=36",
            "fire.fire.spread.drop_distance=0.2",
            &most,
        ];
        let mut arguments = vec![
            "render",
            "burning-cube",
            "--adapter",
            "cpu",
            "--frames",
            "0..40",
        ];
        arguments.extend(sets.iter().flat_map(|set| ["--set", set]));
        arguments.extend(["-o", "a.gif"]);
        let ended = here.run(&arguments);
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        ended
            .stderr
            .contains("flames found no room; raise `max_flames`")
    };
    assert!(told("2"));
    assert!(!told("0"));
    assert!(!told("4000"));
}
