//! What is written from the tables of the schema is up to date, and its examples are right.

use motes::scene::BUILTIN;
use motes::scene::schema::{json_schema, reference_page};

use crate::text::{MINIMAL, accepted};

const PAGE: &str = include_str!("../../scenes/REFERENCE.md");
const SCHEMA: &str = include_str!("../../scenes/motes.schema.json");

/// Compares by lines, for a message that can be read.
#[track_caller]
fn assert_up_to_date(file: &str, is: &str, wanted: &str, command: &str) {
    let stale = is
        .lines()
        .zip(wanted.lines())
        .position(|(is, wanted)| is != wanted);
    assert!(
        is == wanted,
        "{file} is out of date from line {} on; `cargo run -- {command} -o {file}` renews it",
        stale.unwrap_or(is.lines().count().min(wanted.lines().count())) + 1
    );
}

#[test]
fn the_reference_page_is_up_to_date() {
    let command = "schema --markdown";
    assert_up_to_date("scenes/REFERENCE.md", PAGE, &reference_page(), command);
}

#[test]
fn the_schema_file_is_up_to_date() {
    assert_up_to_date("scenes/motes.schema.json", SCHEMA, &json_schema(), "schema");
}

#[test]
fn every_scene_names_the_schema_in_its_first_line() {
    for scene in BUILTIN {
        assert_eq!(
            scene.text.lines().next(),
            Some("#:schema motes.schema.json"),
            "{}",
            scene.name
        );
    }
}

/// The least scene with these lines in place of those of its system that have the same keys.
fn minimal_with(lines: &str) -> String {
    let key = |line: &str| line.split(" = ").next().unwrap_or_default().to_owned();
    let keys: Vec<String> = lines.lines().map(key).collect();
    let (head, system) = MINIMAL.split_once("[[system]]").expect("it has one");
    let kept = system.lines().filter(|line| !keys.contains(&key(line)));
    let kept: Vec<&str> = kept.collect();
    format!("{head}[[system]]{}\n{lines}", kept.join("\n"))
}

/// A flock, for what stands in one.
const FLOCK: &str = "[[flock]]\nname = \"flock\"\ncount = 2\n\
                     region = { min = [0, 0, 0], max = [1, 1, 0] }\n";

#[test]
fn the_examples_of_the_reference_page_are_right() {
    let blocks: Vec<&str> = PAGE
        .split("```toml\n")
        .skip(1)
        .map(|rest| rest.split_once("```").expect("the block ends").0)
        .collect();
    assert!(blocks.len() > 20, "{}", blocks.len());
    let mut kinds = 0;
    for block in blocks {
        let scene = match block {
            whole if whole.contains("[camera]") => accepted(whole),
            // Of a flock: some edges, a relation, an obstacle.
            lines if lines.starts_with("edges") => accepted(&format!("{MINIMAL}{FLOCK}{lines}")),
            // Of a fire: where its flames stand.
            lines if lines.starts_with("roots") => {
                let one = "[[fire.flame]]\nposition = [0, 0, 0]\n";
                accepted(&format!("{MINIMAL}[[fire]]\nname = \"fire\"\n{lines}{one}"))
            }
            table if table.starts_with("[[flock.") => accepted(&format!("{MINIMAL}{FLOCK}{table}")),
            // A table of the file, or one of the only system.
            table if table.starts_with('[') => accepted(&format!("{MINIMAL}{table}")),
            lines => accepted(&minimal_with(lines)),
        };
        let system = &scene.systems[0];
        kinds += scene.winds.len() + system.extinctions.len();
        kinds += usize::from(block.starts_with("generation_shape"));
        let flocks = scene.flocks.iter();
        kinds += flocks
            .map(|flock| flock.relations.len() + flock.obstacles.len())
            .sum::<usize>();
        kinds += usize::from(block.starts_with("edges"));
        kinds += usize::from(block.starts_with("roots"));
    }
    assert_eq!(
        kinds,
        9 + 4 + 10 + 3 + 4 + 5 + 5,
        "each kind has an example"
    );
}

#[test]
fn the_page_is_a_table_without_holes() {
    let mut columns = 0;
    for line in PAGE.lines() {
        if !line.starts_with('|') {
            columns = 0;
            continue;
        }
        let cells = line.matches('|').count() - 1;
        assert!(columns == 0 || columns == cells, "{line}");
        columns = cells;
    }
    // Links lead to headings.
    let anchor = |heading: &str| heading.to_lowercase().replace(['`', '[', ']', '.'], "");
    let anchors: Vec<String> = PAGE
        .lines()
        .filter_map(|line| line.strip_prefix("## "))
        .map(anchor)
        .collect();
    let links = PAGE.split("](#").skip(1).map(|rest| rest.split(')').next());
    for link in links.flatten() {
        assert!(
            anchors.iter().any(|anchor| anchor == link),
            "{link} in {anchors:?}"
        );
    }
}
