//! The page on writing scenes: each of its steps is a scene that renders, and its pictures are theirs.

use std::io::BufReader;
use std::path::Path;

use motes::plan::Plan;
use motes::scene::{Scene, load_with};
use motes::{AdapterChoice, Options, Simulation};

use crate::motes;

const PAGE: &str = include_str!("../../scenes/README.md");

/// The scene as it is after each block of the page, with the step that the block belongs to.
fn states() -> Vec<(u32, String)> {
    let mut states = Vec::new();
    let (mut text, mut step) = (String::new(), 0);
    let mut lines = PAGE.lines();
    while let Some(line) = lines.next() {
        if let Some(heading) = line.strip_prefix("## ") {
            let number = heading.split('.').next().expect("a first part");
            step = number.parse().unwrap_or(step);
        }
        let Some(kind) = line.strip_prefix("```") else {
            continue;
        };
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        match kind {
            "toml" => text += &(block.join("\n") + "\n"),
            "diff" => text = patched(&text, &block),
            other => panic!("a block of {other}"),
        }
        states.push((step, text.clone()));
    }
    states
}

/// The text with the changes of a block, whose lines must be there once, in a row.
fn patched(text: &str, block: &[&str]) -> String {
    let lines_with = |sign: char| -> String {
        let lines = block.iter().filter_map(|line| {
            let rest = line.strip_prefix([' ', sign])?;
            Some(format!("{rest}\n"))
        });
        lines.collect()
    };
    let (old, new) = (lines_with('-'), lines_with('+'));
    assert_ne!(old, new);
    assert_eq!(text.matches(&old).count(), 1, "once in the file:\n{old}");
    text.replace(&old, &new)
}

fn scene(text: &str, sets: &[&str]) -> Scene {
    let folder = tempfile::tempdir().expect("there is room");
    let path = folder.path().join("campfire.toml");
    std::fs::write(&path, text).expect("there is room");
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    load_with(&path.to_string_lossy(), &sets).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn on_processor(scene: &Scene) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("the processor has room")
}

/// The picture of frame 60, which the page shows.
fn image(scene: &Scene) -> Vec<u8> {
    let mut simulation = on_processor(scene);
    simulation.seek(60).expect("it steps");
    simulation.draw().expect("it draws");
    simulation.image().expect("it reads")
}

#[test]
fn every_scene_of_the_page_renders() {
    let states = states();
    assert!(states.len() > 9, "{}", states.len());
    let mut before = Vec::new();
    for (step, text) in &states {
        let image = image(&scene(text, &["image.width=64", "image.height=36"]));
        assert_eq!(image.len(), 64 * 36 * 4);
        let lit = image.chunks(4).filter(|pixel| pixel[0] > 60).count();
        assert!(lit > 20, "step {step}: {lit} pixels are lit");
        // A step that changes nothing to be seen would be none; layers are the exception.
        assert_eq!(*step == 7, image == before, "step {step}");
        before = image;
    }
    let steps: Vec<u32> = states.iter().map(|(step, _)| *step).collect();
    assert_eq!([steps[0], *steps.last().expect("a step")], [1, 8]);
    let layers = scene(&states.last().expect("a step").1, &[]).layer_names();
    assert_eq!(layers, ["far", "rest"], "the page names the files");
}

#[test]
fn the_pages_pictures_are_the_programs() {
    let command = "    motes render campfire.toml -o campfire.png --frame 60";
    assert!(PAGE.lines().any(|line| line == command));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/pictures");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("there are pictures") {
        let path = entry.expect("readable").path();
        let name = path
            .file_stem()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        let Some(step) = name.strip_prefix("campfire-") else {
            continue;
        };
        let step: u32 = step.parse().expect("the number of its step");
        assert!(PAGE.contains(&format!("(pictures/{name}.png)")), "{name}");
        let size = std::fs::metadata(&path).expect("it is there").len();
        assert!(size < 150_000, "{name}: {size} bytes");
        let states = states();
        let (_, text) = states.iter().rfind(|(of, _)| *of == step).expect("a step");
        let rgba = image(&scene(text, &[]));
        let rgb: Vec<u8> = rgba.chunks(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
        let file = BufReader::new(std::fs::File::open(&path).expect("it is there"));
        let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
        reader.next_frame(&mut pixels).expect("a picture");
        assert!(pixels == rgb, "{name} is not what step {step} makes");
        count += 1;
    }
    assert_eq!(count, PAGE.matches("](pictures/").count());
}

#[test]
fn an_empty_file_is_answered_as_the_page_says() {
    let folder = tempfile::tempdir().expect("there is room");
    let path = folder.path().join("campfire.toml");
    std::fs::write(&path, "").expect("there is room");
    let ended = motes(&["render", &path.to_string_lossy()]);
    assert_eq!(ended.status.code(), Some(2));
    let said = String::from_utf8(ended.stderr).expect("text");
    let said = said.replace(&*path.to_string_lossy(), "campfire.toml");
    let said: String = said.lines().map(|line| format!("    {line}\n")).collect();
    let page: Vec<&str> = PAGE.lines().map(str::trim_end).collect();
    let said: Vec<&str> = said.lines().map(str::trim_end).collect();
    assert!(
        page.windows(said.len()).any(|lines| lines == said),
        "{said:#?}"
    );
}

#[test]
fn the_pages_capacity_is_enough_and_much_less() {
    let (_, set) = PAGE.split_once("`capacity = ").expect("it names one");
    let set: u32 = set
        .split('`')
        .next()
        .and_then(|n| n.parse().ok())
        .expect("a number");
    let states = states();
    let text = &states.last().expect("a step").1;
    let tiny = ["image.width=16", "image.height=9"];
    let whole = scene(text, &tiny);
    let computed = Plan::new(&whole, whole.frames)
        .expect("it can be planned")
        .capacity;
    assert!(computed > 2 * set, "{computed}");
    let capacity = format!("capacity={set}");
    let mut simulation = on_processor(&scene(text, &[tiny[0], tiny[1], &capacity]));
    simulation
        .seek_from(-90, whole.frames - 1)
        .expect("it steps");
    let statistics = simulation.take_statistics().expect("it counts");
    assert!(statistics.len() > 100, "{}", statistics.len());
    let most = statistics.iter().map(|line| line.live).max();
    assert!(most > Some(set / 2), "{most:?}");
    assert!(statistics.iter().all(|line| line.dropped == 0));
}
