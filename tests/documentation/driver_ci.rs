//! The page and the workflow on testing drivers.

use std::process::Command;

use motes::backend::Backend;
use motes::check::{CompareOptions, compare, default_frames, shrunk};
use motes::cpu::CpuBackend;
use motes::plan::Plan;
use saphyr::{LoadableYamlNode, Yaml};

use crate::{assert_is_a_command, words};

const PAGE: &str = include_str!("../driver-ci/README.md");
const WORKFLOW: &str = include_str!("../driver-ci/lavapipe.yml");

/// The scripts of the workflow's steps, with the steps' names.
fn scripts() -> Vec<(String, String)> {
    let files = Yaml::load_from_str(WORKFLOW).expect("it is YAML");
    let [workflow] = &files[..] else {
        panic!("one file")
    };
    assert!(
        workflow["on"]
            .as_sequence()
            .is_some_and(|on| !on.is_empty())
    );
    let job = &workflow["jobs"]["check"];
    assert_eq!(job["runs-on"].as_str(), Some("ubuntu-latest"));
    let mut scripts = Vec::new();
    for step in job["steps"].as_sequence().expect("steps") {
        let text = |key: &str| step.as_mapping_get(key).and_then(|it| it.as_str());
        let name = text("name").expect("a name").to_owned();
        // Each step does one of the two.
        assert!(text("run").is_some() ^ text("uses").is_some(), "{name}");
        if let Some(script) = text("run") {
            scripts.push((name, script.to_owned()));
        } else {
            let action = text("uses").expect("one of the two");
            assert!(action.contains("@v"), "{name} has no version: {action}");
        }
    }
    scripts
}

#[test]
fn bash_takes_the_workflows_scripts() {
    let scripts = scripts();
    assert!(scripts.len() >= 4, "{scripts:?}");
    for (name, script) in scripts {
        let ended = Command::new("bash").args(["-n", "-c", &script]).output();
        let ended = ended.expect("there is a bash");
        assert!(ended.status.success(), "{name}: {ended:?}");
    }
}

#[test]
fn the_workflows_commands_are_commands_and_keep_what_is_uploaded() {
    let mut checks = 0;
    for (_, script) in scripts() {
        for line in script.lines().filter(|line| line.starts_with("motes ")) {
            assert_is_a_command(line);
            let words = words(line);
            if words[1] != "check" {
                continue;
            }
            checks += 1;
            let after = |flag: &str| {
                let at = words.iter().position(|word| word == flag);
                &words[at.unwrap_or_else(|| panic!("no {flag} in {line}")) + 1]
            };
            assert_eq!(after("--adapter"), "llvmpipe");
            for flag in ["--junit", "--save"] {
                assert!(after(flag).starts_with("report/"), "{line}");
            }
        }
    }
    assert_eq!(checks, 1);
    assert!(WORKFLOW.contains("path: report\n"));
}

#[test]
fn the_pages_lines_are_those_of_a_check() {
    // Each is as the program prints it: a scene, its frames, particles and digests.
    let lines: Vec<&str> = PAGE
        .lines()
        .filter(|line| line.starts_with("    ") && line.ends_with("  equal"))
        .collect();
    assert_eq!(lines.len(), 2, "{lines:?}");
    for line in lines {
        let name = line.split_whitespace().next().expect("a name");
        let scene = motes::scene::load(name).expect("it is built in");
        let frames = default_frames(&scene);
        let scene = shrunk(&scene, frames).expect("it can be shrunk");
        let plan = Plan::new(&scene, frames).expect("it can be planned");
        let start =
            || -> Result<Box<dyn Backend>, _> { Ok(Box::new(CpuBackend::new(&plan, None)?)) };
        let options = CompareOptions {
            frames,
            record: false,
        };
        let outcome = compare(
            &plan,
            &mut || start(),
            &mut || start(),
            &options,
            &mut |_| {},
        );
        let is = outcome.expect("the processor has room");
        let wanted = format!(
            "{name} {frames} frames {} particles state {:016x} image {:016x} equal",
            is.most_particles, is.state_digest, is.image_digest
        );
        let said: Vec<&str> = line.split_whitespace().collect();
        assert_eq!(said.join(" "), wanted);
    }
}
