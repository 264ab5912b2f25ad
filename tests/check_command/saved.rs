//! The folder that a difference is saved in.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use motes::backend::Backend;
use motes::check::{SavedFor, save};
use motes::gpu::STAGE_KERNELS;
use motes::gpu::shader::{self, CompileOptions};
use motes::plan::{STAGES, Stage};

use crate::{common, compare_with_mutant, plan_of_everything, subtract_last};

const CONTEXT: SavedFor = SavedFor {
    scene: "every/thing",
    tested: "an adapter",
    against: "the processor",
    command: "motes check 'every/thing' --frames 16",
};

/// Saves what is found when advance has a defect; the folder, and the one that it is in.
fn saved() -> (std::path::PathBuf, tempfile::TempDir) {
    let plan = plan_of_everything();
    let outcome = compare_with_mutant(&plan, "particles/advance", &subtract_last, 16);
    let difference = outcome.difference.expect("it is found");
    let parent = tempfile::tempdir().expect("writable");
    let folder = save(parent.path(), &difference, &CONTEXT).expect("writable");
    let again = save(parent.path(), &difference, &CONTEXT).expect("writable");
    let expected = [
        "every-thing-frame-0000-advance",
        "every-thing-frame-0000-advance-2",
    ];
    assert_eq!(
        names(parent.path()),
        expected.map(str::to_owned).into(),
        "and nothing hidden"
    );
    assert_eq!(
        [&folder, &again],
        [
            &parent.path().join(expected[0]),
            &parent.path().join(expected[1])
        ]
    );
    (folder, parent)
}

/// Words of a saved file.
fn words(path: &Path) -> Vec<u32> {
    let bytes = fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    assert!(bytes.len().is_multiple_of(4), "{}", path.display());
    bytes
        .chunks(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect()
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn names(folder: &Path) -> BTreeSet<String> {
    fs::read_dir(folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|entry| {
            entry
                .expect("readable")
                .file_name()
                .into_string()
                .expect("UTF-8")
        })
        .collect()
}

#[test]
fn the_readme_says_what_differs_and_how_to_see_it_again() {
    let (folder, _parent) = saved();
    let readme = text(&folder.join("README.txt"));
    for told in [
        CONTEXT.tested,
        CONTEXT.against,
        CONTEXT.command,
        "stage:   advance",
        "buffer:  particles",
        "record 0, velocity.x",
        env!("CARGO_PKG_VERSION"),
    ] {
        assert!(readme.contains(told), "no `{told}` in\n{readme}");
    }
}

#[test]
fn expected_is_the_processors_and_inputs_are_those_before_the_stage() {
    let (folder, _parent) = saved();
    let plan = plan_of_everything();
    let inputs = plan.inputs(0);
    let mut cpu = common::on_cpu(&plan);
    for info in STAGES
        .iter()
        .take_while(|info| info.stage != Stage::Advance)
    {
        cpu.run_stage(info.stage, &inputs).expect("it runs");
    }
    let before = cpu.read("particles").expect("it is there");
    cpu.run_stage(Stage::Advance, &inputs).expect("it runs");
    let after = cpu.read("particles").expect("it is there");
    assert_eq!(words(&folder.join("expected/particles.bin")), after);
    let got = words(&folder.join("got/particles.bin"));
    assert_eq!(got.len(), after.len());
    assert_ne!(got, after);
    assert_eq!(
        words(&folder.join("inputs/particles-0.bin"))[..before.len()],
        before
    );

    // All that any dispatch binds, and the list of their sizes.
    let dispatches = text(&folder.join("dispatches.txt"));
    let bound: BTreeSet<String> = dispatches
        .lines()
        .filter(|line| line.trim_start().starts_with("binding "))
        .filter_map(|line| line.split_once("inputs/"))
        .map(|(_, name)| name.to_owned())
        .chain(["dispatches.bin".to_owned()])
        .collect();
    for name in [
        "frame.bin",
        "system_frames.bin",
        "counts.bin",
        "survivors-0.bin",
    ] {
        assert!(bound.contains(name), "{bound:?}");
    }
    assert_eq!(names(&folder.join("inputs")), bound);
}

#[test]
fn kernels_are_those_that_ran_and_dispatches_are_as_large_as_they_were() {
    let (folder, _parent) = saved();
    let dispatches = text(&folder.join("dispatches.txt"));
    let mut kernels = BTreeSet::new();
    for kernel_use in STAGE_KERNELS
        .iter()
        .filter(|kernel| kernel.stage == Stage::Advance)
    {
        let name = kernel_use.kernel;
        let file = name.replace('/', "-");
        kernels.extend([format!("{file}.spv"), format!("{file}.wgsl")]);
        let spirv = words(&folder.join(format!("kernels/{file}.spv")));
        assert_eq!(spirv[0], 0x0723_0203, "SPIR-V's magic number");
        let compiled = shader::compile(name, &CompileOptions::default()).expect("it compiles");
        // The mutant is saved as a mutant.
        assert_eq!(
            spirv == compiled.spirv,
            name != "particles/advance",
            "{name}"
        );
        let wgsl = text(&folder.join(format!("kernels/{file}.wgsl")));
        assert!(
            wgsl.contains(&format!("fn {}", compiled.entry_point)),
            "{wgsl}"
        );
        assert!(
            dispatches.contains(&format!("kernel {file}.spv")),
            "{dispatches}"
        );
    }
    assert_eq!(names(&folder.join("kernels")), kernels);
    let ran: Vec<&str> = dispatches
        .lines()
        .filter(|line| line.contains("workgroups "))
        .collect();
    assert_eq!(
        ran.len(),
        kernels.len() / 2,
        "one page, so a dispatch each\n{dispatches}"
    );
    assert!(
        ran.iter().all(|line| !line.contains("workgroups 0 ")),
        "{dispatches}"
    );
}
