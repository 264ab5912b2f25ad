//! Scenes whose parts name each other: systems that bear systems, flocks that look at flocks.

use crate::refused::refused;
use crate::{SPARKS, Workshop};

/// The sparks, borne by systems of the next name, those by systems of the next; the last one's
/// parent is `root`'s, if any.
fn chain(names: &[&str], root: Option<&str>) -> String {
    let (head, system) = SPARKS.split_once("[[system]]").expect("it has a system");
    let mut text = head.to_owned();
    for (at, name) in names.iter().enumerate() {
        text += "[[system]]";
        text += &system.replace("\"sparks\"", &format!("\"{name}\""));
        if let Some(parent) = names.get(at + 1).copied().or(root) {
            text += &format!("parent = \"{parent}\"\n");
        }
    }
    text
}

#[test]
fn systems_have_no_dumps_that_could_be_in_the_way() {
    let here = Workshop::new();
    let few = chain(&["sparks", "comet"], None).replace("= 20", "= 2");
    here.write("family.toml", few.replace("var_parts = 8", "var_parts = 0"));
    let render = ["render", "family.toml", "--adapter", "cpu", "-o", "all"];
    let dump = ["--dump", "3", "--dump-dir", "d"];
    let stats = ["--stats", "d/systems-0003.ply"];
    let ended = here.run(&[&render[..], &dump, &stats].concat());
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(here.read("d/systems-0003.ply").starts_with(b"frame"));
    assert!(here.read("d/particles-0003.ply").starts_with(b"ply"));
}

#[cfg(unix)]
#[test]
fn frames_with_dumps_of_borne_particles_are_gone_on_from() {
    let here = Workshop::new();
    let few = chain(&["sparks", "comet"], None).replace("= 20", "= 2");
    here.write("family.toml", few.replace("frames = 10", "frames = 200"));
    let render = ["render", "family.toml", "--adapter", "cpu", "-o", "all"];
    let dump = ["--size", "640x360", "--dump", "0,1,2"];
    let arguments = [&render[..], &dump].concat();
    let ended = crate::resume::stop(&here, &arguments, "-INT", Some("all/frame-0003.png"));
    assert_eq!(ended.code, 130, "{}", ended.stderr);
    let said = "motes: stopping after this frame; again to stop at once\n";
    assert_eq!(ended.stderr.matches(said).count(), 1, "{}", ended.stderr);
    let journal = here.read("all/.frame-%04d.png.0-200.resume/journal");
    let journal = String::from_utf8_lossy(&journal).into_owned();
    assert!(journal.contains("\nframe 2 "), "{journal}");
    assert!(!journal.contains("unread"), "{journal}");
}

#[test]
fn a_cycle_of_parents_is_told_from_a_chain_that_is_too_long() {
    let here = Workshop::new();
    let wrong: [(String, &[&str]); 4] = [
        (
            chain(&["one"], Some("one")),
            &["`system.one.parent`", "one -> one"],
        ),
        (
            chain(&["one", "two", "three"], Some("one")),
            &["leads back", "one -> two -> three -> one"],
        ),
        (
            chain(&["a", "b", "c", "d", "e", "f", "g", "h", "i", "j"], None),
            &["`system.a.parent`", "9 levels", "at most 8 levels"],
        ),
        (
            chain(&["one", "two"], Some("tow")),
            &["`system.two.parent`", "names no system", "two"],
        ),
    ];
    for (text, said) in wrong {
        here.write("wrong.toml", text);
        refused(
            &here,
            &["render", "wrong.toml", "--adapter", "cpu"],
            2,
            said,
        );
    }
}

#[test]
fn a_relation_that_wants_a_flock_is_told_which_there_are() {
    let here = Workshop::new();
    let shown = here.run(&["scenes", "--show", "predators"]).stdout;
    let others: Vec<&str> = shown
        .lines()
        .filter(|it| it.starts_with("other = "))
        .collect();
    let first = others.first().expect("it has relations");
    here.write("wrong.toml", shown.replacen(&format!("{first}\n"), "", 1));
    let names: Vec<&str> = shown
        .lines()
        .skip_while(|it| *it != "[[flock]]")
        .filter_map(|line| line.strip_prefix("name = "))
        .collect();
    let there_are = format!("there are {}", names.join(", ").replace('"', ""));
    let said = ["other` is missing", &there_are];
    refused(
        &here,
        &["render", "wrong.toml", "--adapter", "cpu"],
        2,
        &said,
    );
}

#[test]
fn kinds_without_keys_are_listed_without_a_comma() {
    let here = Workshop::new();
    let render = ["render", "predators", "--adapter", "cpu"];
    let set = ["--set", "flock.boids.edges=3"];
    let said = ["one of {", "{ kind = \"none\" }"];
    let ended = refused(&here, &[&render[..], &set].concat(), 2, &said);
    assert!(!ended.stderr.contains(",  }"), "{}", ended.stderr);
}

#[test]
fn an_adapter_without_a_name_is_refused_unless_it_is_a_variable_that_is_not_set() {
    let here = Workshop::new();
    for (command, argument) in [("render", "--adapter"), ("check", "--against")] {
        let arguments = [command, "sparks.toml", argument, " "];
        refused(&here, &arguments, 2, &[argument, "has no name", "cpu"]);
    }
    let bench = ["bench", "sparks.toml", "--adapter", "cpu,"];
    refused(&here, &bench, 2, &["`cpu,`", "missing beside a comma"]);
    let mut unset = here.command(&["render", "sparks.toml", "-o", "a.gif"]);
    let ended = crate::Ended::of(unset.env("MOTES_ADAPTER", "").output());
    assert_eq!(ended.code, 0, "{}", ended.stderr);
}
