//! What the pages say is so: their scenes render, their pictures are those that the program makes, their
//! commands are commands, their links lead somewhere, and the manual has every flag.

mod driver_ci;
mod manual;
mod scene_page;

use std::path::Path;
use std::process::{Command, Output};

/// Pages by their path from the top of the repository.
const PAGES: [(&str, &str); 4] = [
    ("README.md", include_str!("../../README.md")),
    ("benches/README.md", include_str!("../../benches/README.md")),
    ("scenes/README.md", include_str!("../../scenes/README.md")),
    (
        "tests/driver-ci/README.md",
        include_str!("../driver-ci/README.md"),
    ),
];

/// Runs the program.
fn motes(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.args(arguments).env_remove("MOTES_ADAPTER");
    command.output().expect("the program starts")
}

/// What it prints, where it must succeed.
#[track_caller]
fn printed(arguments: &[&str]) -> String {
    let ended = motes(arguments);
    assert_eq!(ended.status.code(), Some(0), "{arguments:?}: {ended:?}");
    String::from_utf8(ended.stdout).expect("text")
}

/// Words of a simple shell command: quotes of either kind, and a comment at the end.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![];
    let mut word = None;
    let mut quote = None;
    for letter in command.chars() {
        match (quote, letter) {
            (Some(open), _) if open == letter => quote = None,
            (None, '\'' | '"') => {
                quote = Some(letter);
                word.get_or_insert_with(String::new);
            }
            (None, '#') if word.is_none() => break,
            (None, ' ') => words.extend(word.take()),
            _ => word.get_or_insert_with(String::new).push(letter),
        }
    }
    assert!(quote.is_none(), "an open quote: {command}");
    words.extend(word);
    words
}

/// Fails unless the program's own parser takes the command.
#[track_caller]
fn assert_is_a_command(command: &str) {
    let words = words(command);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    if let Err(error) = motes::cli::parse(&words) {
        assert_eq!(error.code, 0, "{command}\n{}", error.message);
    }
}

/// Commands that stand in lines of their own, after four spaces, and perhaps a prompt or a variable.
fn commands(page: &str) -> Vec<&str> {
    let command = |line| {
        let line: &str = str::strip_prefix(line, "    ")?;
        let line = line.strip_prefix("$ ").unwrap_or(line);
        let line = match line.split_once(' ') {
            Some((variable, rest)) if variable.contains("_FILES=") => rest,
            _ => line,
        };
        // Several processes at once.
        let line = line.strip_suffix(" &").unwrap_or(line);
        // Into a file.
        let line = line.split_once(" > ").map_or(line, |(command, _)| command);
        line.starts_with("motes ").then_some(line)
    };
    page.lines().filter_map(command).collect()
}

#[test]
fn commands_in_lines_of_their_own_are_commands() {
    for (path, page) in PAGES {
        let commands = commands(page);
        assert!(commands.len() > 2, "{path}: {commands:?}");
        for command in commands {
            assert_is_a_command(command);
        }
    }
}

#[test]
fn commands_in_sentences_are_commands() {
    for (path, page) in PAGES {
        let mut is_code = false;
        let mut checked = 0;
        // A span may go over the end of a line; blocks have their own test.
        let text: Vec<&str> = page
            .lines()
            .filter(|line| {
                is_code ^= line.starts_with("```");
                !is_code && !line.starts_with("    ") && !line.starts_with("```")
            })
            .collect();
        for paragraph in text.join("\n").split("\n\n") {
            let spans = paragraph.split('`').skip(1).step_by(2);
            for span in spans.filter(|span| span.starts_with("motes ")) {
                // The name of a subcommand alone stands for all that it does.
                if words(span).len() > 2 {
                    assert_is_a_command(&span.replace('\n', " "));
                } else {
                    assert_is_a_command(&format!("{span} --help"));
                }
                checked += 1;
            }
        }
        assert!(checked > 1, "{path}");
    }
}

#[test]
fn links_lead_to_files() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (path, page) in PAGES {
        let folder = top.join(path);
        let folder = folder.parent().expect("a page is in a folder");
        let links = page.split("](").skip(1).map(|rest| rest.split(')').next());
        let mut followed = 0;
        for link in links.flatten().filter(|link| !link.contains("://")) {
            let file = link.split('#').next().expect("a split has a first part");
            assert!(
                folder.join(file).exists(),
                "{path} links to {link}, which is not there"
            );
            followed += 1;
        }
        assert!(followed > 0, "{path}");
    }
}

#[test]
fn a_wrong_command_is_found() {
    assert_eq!(
        words("motes render 'a b' -o \"c d\"e  # f"),
        ["motes", "render", "a b", "-o", "c de"]
    );
    for wrong in [
        "motes rendre x",
        "motes render",
        "motes render x --frmaes 1..2",
    ] {
        let words = words(wrong);
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let error = motes::cli::parse(&words).expect_err(wrong);
        assert_eq!(error.code, 2, "{wrong}");
    }
}
