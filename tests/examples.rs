//! Every example of `examples/` runs, on the processor and on each adapter, and prints what is true.

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use motes::{AdapterChoice, Options, Simulation, scene};

/// Where cargo puts examples: it builds them for `cargo test`, beside the folder of test programs.
fn built(name: &str) -> PathBuf {
    let test = std::env::current_exe().expect("a program knows where it is");
    let folder = test.parent().and_then(Path::parent).expect("under target");
    let path = folder
        .join("examples")
        .join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(
        path.exists(),
        "{name} is not built: `cargo test` builds it, `cargo test --test` does not; \
         `cargo build --examples` does"
    );
    path
}

/// What the example prints where `on` says.
fn printed(name: &str, on: &str, arguments: &[&Path]) -> String {
    let output = Command::new(built(name))
        .args(arguments)
        .env("MOTES_ADAPTER", on)
        .output()
        .expect("the example starts");
    let [out, err] = [output.stdout, output.stderr]
        .map(|bytes| String::from_utf8(bytes).expect("examples print text"));
    assert!(output.status.success(), "{name} on {on}:\n{out}{err}");
    assert!(!err.contains("panicked"), "{name} on {on}:\n{err}");
    out
}

fn everywhere() -> impl Iterator<Item = String> {
    std::iter::once("cpu".to_owned()).chain(common::adapters())
}

/// Whether the first line names where it ran.
fn names_the_adapter(text: &str, on: &str) -> bool {
    let first = text.lines().next().unwrap_or_default().to_lowercase();
    first.contains(on)
}

fn on_processor(scene: &scene::Scene) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("the processor has room")
}

#[test]
fn no_example_is_without_a_test() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let files = std::fs::read_dir(folder).expect("there are examples");
    let mut names: Vec<_> = files
        .map(|file| file.expect("it can be listed").file_name())
        .map(|name| name.to_string_lossy().replace(".rs", ""))
        .collect();
    names.sort();
    assert_eq!(
        names,
        [
            "compare_backends",
            "edit_while_running",
            "flame_profile",
            "own_device",
            "step_and_read"
        ]
    );
}

#[test]
fn p31_flame_profile_plots_the_picture_of_a_candle() {
    let folder = tempfile::tempdir().expect("there is room");
    let mut plots = Vec::new();
    for on in everywhere() {
        let path = folder.path().join(format!("{on}.svg"));
        let text = printed("flame_profile", &on, &[&path]);
        assert!(names_the_adapter(&text, &on), "{text}");
        plots.push(std::fs::read_to_string(path).expect("it is written"));
    }
    assert!(plots.iter().all(|plot| *plot == plots[0]));
    // How high each curve is above the foot, where 255 is 1.
    let curve = |color: &str| -> Vec<f64> {
        let (_, rest) = plots[0]
            .split_once(&format!("id=\"{color}\" points=\""))
            .expect("it is there");
        let (points, _) = rest.split_once('"').expect("it ends");
        let heights = points
            .split(' ')
            .map(|point| point.split_once(',').expect("a pair").1);
        heights
            .map(|y| (280.0 - y.parse::<f64>().expect("a number")) / 240.0)
            .collect()
    };
    let [red, green, blue] = ["red", "green", "blue"].map(curve);
    assert!(red.len() > 40 && red.len() == green.len() && red.len() == blue.len());
    for at in 0..red.len() {
        assert!(red[at] >= green[at] && green[at] >= blue[at], "at {at}");
    }
    // At the edges the three are far apart; the core is as bright as a picture can be, red wider than green.
    let saturated = |curve: &[f64]| curve.iter().filter(|y| **y > 0.999).count();
    assert!(saturated(&red) > saturated(&green) + 4 && saturated(&green) > 0);
    let quarter = red.len() / 4;
    assert!(red[quarter] > green[quarter] + 0.1 && green[quarter] > blue[quarter] + 0.05);
    let dark = |curve: &[f64]| curve[0].max(curve[curve.len() - 1]);
    assert!(dark(&red) < 0.05, "{}", dark(&red));
}

#[test]
fn step_and_read_prints_the_processors_table() {
    let sets = ["system.jet.initial_mean_parts=60".to_owned()];
    let fountain = scene::load_with("fountain", &sets).expect("it is built in");
    let mut processor = on_processor(&fountain);
    let mut expected = Vec::new();
    for frame in [7, 15, 23, 31, 39] {
        processor.seek_from(0, frame).expect("it steps");
        let lines = processor.take_statistics().expect("it counts");
        let born: u32 = lines.iter().map(|line| line.born).sum();
        let died: u32 = lines.iter().map(|line| line.died).sum();
        let live = lines.last().expect("a line a frame").live;
        let highest = processor
            .particles()
            .expect("it reads")
            .iter()
            .map(|particle| particle.position[1])
            .fold(0.0, f32::max);
        expected.push(format!("{frame} {born} {died} {live} {highest:.3}"));
    }
    for on in everywhere() {
        let text = printed("step_and_read", &on, &[]);
        assert!(names_the_adapter(&text, &on), "{text}");
        let rows: Vec<String> = text
            .lines()
            .skip(2)
            .map(|line| {
                line.split_whitespace()
                    .take(5)
                    .collect::<Vec<_>>()
                    .join(" ")
            })
            .collect();
        assert_eq!(rows, expected, "{on}");
    }
}

#[test]
fn own_device_writes_the_processors_picture() {
    let sets = ["image.width=320".to_owned(), "image.height=180".to_owned()];
    let fountain = scene::load_with("fountain", &sets).expect("it is built in");
    let mut processor = on_processor(&fountain);
    processor.seek(60).expect("it steps");
    processor.draw().expect("it draws");
    let image = processor.image().expect("it reads");
    let bright = image.chunks(4).filter(|pixel| pixel[0] > 100).count();
    assert!(bright > 50, "there is something to see: {bright}");
    let rgb: Vec<u8> = image.chunks(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    for on in common::adapters() {
        let folder = tempfile::tempdir().expect("there is room");
        let path = folder.path().join("picture.png");
        let text = printed("own_device", &on, &[&path]);
        assert!(
            names_the_adapter(&text, &on) && text.contains("exact: yes"),
            "{text}"
        );
        assert!(
            text.contains(&format!("\n{bright} of 57600 pixels")),
            "{text}"
        );
        let file = std::io::BufReader::new(std::fs::File::open(&path).expect("it was written"));
        let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
        reader.next_frame(&mut pixels).expect("a picture");
        assert!(pixels == rgb, "{on}");
    }
}

#[test]
fn edit_while_running_replays_what_was_done() {
    let mut texts: Vec<String> = Vec::new();
    for on in everywhere() {
        let text = printed("edit_while_running", &on, &[]);
        assert!(names_the_adapter(&text, &on), "{text}");
        assert!(text.trim_end().ends_with(": equal"), "{text}");
        assert!(
            text.contains("\n6 system.dust.initial_mean_parts=900\n"),
            "{text}"
        );
        let live = |frame: u32| -> u32 {
            let start = format!("frame {frame}: ");
            let words = text
                .lines()
                .find_map(|line| line.strip_prefix(&start)?.strip_suffix(" particles"));
            words.and_then(|count| count.parse().ok()).expect("a count")
        };
        // Six frames of 800 more births each, of which few have died.
        assert!(live(11) > live(5) + 3600, "{text}");
        texts.push(text.lines().skip(1).collect::<Vec<_>>().join("\n"));
    }
    assert!(texts.iter().all(|text| *text == texts[0]), "{texts:#?}");
}

#[test]
fn compare_backends_finds_them_equal() {
    let mut lines: Vec<String> = Vec::new();
    for on in everywhere() {
        let text = printed("compare_backends", &on, &[]);
        assert!(names_the_adapter(&text, &on), "{text}");
        let line = text.lines().nth(1).expect("a verdict").to_owned();
        assert!(
            line.starts_with("16 frames, up to ") && line.ends_with(": equal"),
            "{text}"
        );
        lines.push(line);
    }
    assert!(lines.iter().all(|line| *line == lines[0]), "{lines:#?}");
}
