//! What the README shows is what the program does: its scene, its commands, its digests, its error.

use crate::Workshop;

const README: &str = include_str!("../../README.md");

/// The scene in the README's TOML block.
fn scene() -> &'static str {
    let (_, rest) = README
        .split_once("```toml\n")
        .expect("the README shows a scene");
    rest.split_once("```").expect("the block ends").0
}

#[test]
fn the_readmes_scene_has_the_readmes_digests() {
    let here = Workshop::new();
    here.write("sparks.toml", scene());
    // The table shows frame 90, the check the last one, 95.
    here.render(&["-o", "all", "--frames", "90..96", "--stats", "s.csv"]);
    let statistics = String::from_utf8(here.read("s.csv")).expect("statistics are text");
    let digest = |frame: u32, population: &str| {
        let start = format!("{frame},{population},");
        let row = statistics
            .lines()
            .find(|line| line.starts_with(&start))
            .expect("a row a frame");
        row.split(',').nth(8).expect("a row has cells")
    };
    let (state, image) = (digest(90, "particles"), digest(90, "image"));
    for adapter in ["cpu", "llvmpipe (Mesa 22.3.6)", "SwiftShader"] {
        let row = format!("| {adapter} | `{state}` | `{image}` |");
        assert!(
            README.lines().any(|line| line == row),
            "the README does not say {row}"
        );
    }
    let (state, image) = (digest(95, "particles"), digest(95, "image"));
    let checked = format!("state {state}  image {image}  equal");
    assert!(
        README.contains(&checked),
        "the README does not say {checked}"
    );
}

#[test]
fn the_readmes_error_is_the_programs() {
    let here = Workshop::new();
    here.write("sparks.toml", scene());
    let ended = here.run(&["render", "sparks.toml", "--set", "system.sparks.sped=0.2"]);
    assert_eq!(ended.code, 2);
    let (_, shown) = README
        .split_once("    error: ")
        .expect("the README shows an error");
    let (shown, _) = shown.split_once("\n\n").expect("it ends");
    let shown = format!("error: {}\n", shown.replace("\n    ", "\n"));
    assert!(
        ended.stderr == shown,
        "shown:\n{shown}\nis:\n{}",
        ended.stderr
    );
}

#[test]
fn the_readmes_commands_work() {
    let here = Workshop::new();
    let commands: Vec<_> = README
        .lines()
        .filter_map(|line| line.strip_prefix("    motes render fountain"))
        .collect();
    assert!(commands.len() >= 5, "the README shows {commands:?}");
    let names = here.run(&["scenes", "--show", "fountain"]).stdout;
    let names = names
        .lines()
        .filter_map(|line| line.strip_prefix("name = \""));
    let names: Vec<_> = names.map(|rest| rest.trim_end_matches('"')).collect();
    assert!(!names.is_empty(), "the fountain has systems");
    let mut said = String::new();
    for command in commands {
        let command = command
            .split_once('#')
            .map_or(command, |(command, _)| command);
        let mut arguments = vec!["render".to_owned(), "fountain".to_owned()];
        arguments.extend(
            command
                .split_whitespace()
                .map(|word| word.trim_matches('\'').to_owned()),
        );
        // Few particles on few pixels: this is about the command line.
        let mut sets = vec!["image.width=32".to_owned(), "image.height=18".to_owned()];
        sets.extend(
            names
                .iter()
                .map(|name| format!("system.{name}.initial_mean_parts=1")),
        );
        sets.extend(
            names
                .iter()
                .map(|name| format!("system.{name}.var_parts=0")),
        );
        arguments.extend(sets.into_iter().flat_map(|set| ["--set".to_owned(), set]));
        arguments.extend(["--adapter".to_owned(), "cpu".to_owned()]);
        let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
        let ended = here.run(&arguments);
        assert_eq!(
            ended.code,
            0,
            "motes {}\n{}",
            arguments.join(" "),
            ended.stderr
        );
        said += &ended.stderr;
    }
    let (_, closing) = README
        .split_once("\n    motes: wrote jet.png")
        .expect("the README shows a closing line");
    let (closing, _) = closing.split_once(" in ").expect("it ends in seconds");
    let closing = format!("motes: wrote jet.png{closing} in ");
    assert!(said.contains(&closing), "{closing} is not in\n{said}");
    let written = [
        "jet-0060.png",
        "jet-0089.png",
        "jet-particles.exr",
        "jet.csv",
        "jet.exr",
        "jet.gif",
        "jet.png",
    ];
    let also = ["jet/particles-0100.ply", "out/fountain/frame-0000.png"];
    for name in written.iter().chain(&also) {
        assert!(
            here.path(name).is_file(),
            "no {name} among {:?}",
            here.files()
        );
    }
}

#[test]
fn the_readmes_line_drawing_works() {
    let here = Workshop::new();
    let command = README
        .lines()
        .find_map(|line| line.strip_prefix("    motes render explosion-lines"))
        .expect("the README draws lines");
    let (arguments, _) = command.split_once('#').expect("it says what for");
    let mut words = vec!["render", "explosion-lines"];
    words.extend(arguments.split_whitespace());
    words.extend(["--adapter", "cpu"]);
    let ended = here.run(&words);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let drawing = String::from_utf8(here.read("lines.svg")).expect("an SVG is text");
    let lines = drawing.matches("<line").count() + drawing.matches("<path").count();
    assert!(lines > 100, "{lines} lines in {} bytes", drawing.len());
}

#[test]
fn the_way_from_a_slip_to_a_film_is_as_the_page_says() {
    const PAGE: &str = include_str!("../../scenes/README.md");
    let (_, section) = PAGE
        .split_once("## From a slip to a film\n")
        .expect("the page has this section");
    let (section, _) = section.split_once("\n## ").expect("another follows");
    // Runs of indented lines, with what is empty among them.
    let mut blocks = vec![String::new()];
    for line in section.lines() {
        match line.strip_prefix("    ") {
            Some(line) => blocks
                .last_mut()
                .expect("there is one")
                .push_str(&format!("{line}\n")),
            None if line.is_empty() => blocks.last_mut().expect("there is one").push('\n'),
            None => blocks.push(String::new()),
        }
    }
    let blocks: Vec<&str> = blocks
        .iter()
        .map(|it| it.trim())
        .filter(|it| !it.is_empty())
        .collect();
    let &[scene, refused, mended, film] = &blocks[..] else {
        panic!("{blocks:#?}");
    };
    let here = Workshop::new();
    here.write("spray.toml", scene);
    let (command, told) = refused.split_once('\n').expect("a command and an answer");
    let words: Vec<&str> = command.split(' ').skip(2).collect();
    let ended = here.run(&words);
    assert_eq!(ended.code, 2, "{}", ended.stderr);
    assert_eq!(ended.stderr.trim_end(), told);
    let slip = scene
        .lines()
        .find(|line| line.contains("angel"))
        .expect("a slip");
    here.write("spray.toml", scene.replace(slip, mended));
    let (again, told) = film.split_once('\n').expect("a command and an answer");
    assert_eq!(again, command);
    let (_, wrote) = told.split_once('\n').expect("two lines");
    // A film needs ffmpeg, which not every machine has; a GIF has the same frames.
    let words: Vec<&str> = words
        .iter()
        .map(|it| match *it {
            "spray.mp4" => "spray.gif",
            word => word,
        })
        .collect();
    let ended = here.run(&words);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let (wrote, _) = wrote.rsplit_once(" in ").expect("it says how long it took");
    let wrote = wrote.replace(".mp4", ".gif");
    assert!(
        ended.stderr.contains(&wrote),
        "{} has no {wrote}",
        ended.stderr
    );
}
