//! `motes check`: that it finds a defect put into one kernel, names the stage, the buffer and an
//! element, saves what a driver's writers need, and says so to whoever called it.

mod common;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use motes::backend::Backend;
use motes::check::{
    CompareOptions, Outcome, Place, SavedFor, compare, default_frames, save, shrunk,
};
use motes::gpu::shader::{self, CompileOptions};
use motes::gpu::{GpuOptions, Mutation, STAGE_KERNELS};
use motes::plan::{Plan, STAGES, Stage};
use motes::scene::{BUILTIN, load};
use naga::{BinaryOperator, Expression, Literal, Module};

/// Changes every expression of the module that `change` finds to its liking; how many those are
/// must be `expected`, so that a mutant is never the original.
fn mutate(module: &mut Module, expected: usize, change: impl Fn(&mut Expression) -> bool) {
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entry_points = module.entry_points.iter_mut().map(|entry| &mut entry.function);
    let changed = functions
        .chain(entry_points)
        .flat_map(|function| function.expressions.iter_mut())
        .map(|(_, expression)| change(expression))
        .filter(|&changed| changed)
        .count();
    assert_eq!(changed, expected, "the kernel has changed: choose the mutation anew");
}

fn swap(expression: &mut Expression, from: BinaryOperator, to: BinaryOperator) -> bool {
    match expression {
        Expression::Binary { op, .. } if *op == from => {
            *op = to;
            true
        }
        _ => false,
    }
}

fn replace(expression: &mut Expression, from: f32, to: f32) -> bool {
    match expression {
        Expression::Literal(Literal::F32(value)) if *value == from => {
            *value = to;
            true
        }
        _ => false,
    }
}

/// Makes the last addition of the kernel's entry point a subtraction.
fn subtract_last(module: &mut Module) {
    let expressions = &mut module.entry_points[0].function.expressions;
    let last = expressions
        .iter_mut()
        .filter(|(_, e)| matches!(e, Expression::Binary { op: BinaryOperator::Add, .. }))
        .last();
    let (_, expression) = last.expect("the kernel adds");
    assert!(swap(expression, BinaryOperator::Add, BinaryOperator::Subtract));
}

fn compare_with_mutant(
    plan: &Plan,
    kernel: &str,
    change: &dyn Fn(&mut Module),
    frames: u32,
) -> Outcome {
    let adapter = common::adapters().remove(0);
    let device = common::open(&adapter);
    let mut seen = Vec::new();
    let outcome = compare(
        plan,
        &mut || Ok(Box::new(common::on_cpu(plan))),
        &mut || {
            let mutation = Some(Mutation { kernel, change });
            let options = GpuOptions { mutation, ..GpuOptions::default() };
            Ok(Box::new(common::on_gpu(&device, plan, &options)))
        },
        &CompareOptions { frames, record: true },
        &mut |frame| seen.push(frame),
    )
    .expect("the machine does not fail");
    assert_eq!(seen, (0..outcome.frames).collect::<Vec<_>>(), "progress");
    outcome
}

fn plan_of_everything() -> Plan {
    let scene = common::everything();
    Plan::new(&scene, scene.frames).expect("the scene can be planned")
}

/// The place that check names for a mutant, and the first frame that differs.
fn place_of_mutant(kernel: &str, change: &dyn Fn(&mut Module)) -> (u32, Place) {
    let outcome = compare_with_mutant(&plan_of_everything(), kernel, change, 16);
    let difference = outcome.difference.unwrap_or_else(|| panic!("{kernel}: nothing was found"));
    let place = difference.place.unwrap_or_else(|| panic!("{kernel}: it was not located"));
    assert!(place.differing_words > 0, "{kernel}");
    let at = place.element.word;
    assert_eq!(place.expected.get(at).copied(), place.element.expected, "{kernel}");
    assert_eq!(place.got.get(at).copied(), place.element.got, "{kernel}");
    assert_ne!(place.element.expected, place.element.got, "{kernel}");
    assert_eq!(place.expected[..at], place.got[..at], "{kernel}: it is not the first");
    assert_eq!(difference.frame + 1, outcome.frames, "{kernel}: it went on");
    (difference.frame, place)
}

#[test]
fn without_a_defect_nothing_is_found() {
    let plan = plan_of_everything();
    let outcome = compare_with_mutant(&plan, "particles/advance", &|_| {}, 16);
    assert_eq!(outcome.difference, None);
    assert_eq!(outcome.frames, 16);
    assert!(outcome.most_particles > 1000, "{outcome:?}");
}

#[test]
fn a_defect_of_births_is_found_there() {
    let (frame, place) = place_of_mutant("systems/births", &|module| {
        mutate(module, 1, |e| replace(e, 0.5, 1.5));
    });
    assert_eq!((place.stage, place.buffer), ("births", "birth_counts"));
    assert_eq!(frame, 0, "system 0 rounds to the nearest, and bears one more");
    assert_eq!(place.element.record, 0);
    let (expected, got) = (place.element.expected, place.element.got);
    assert_eq!(expected.map(|count| count + 1), got);
    assert_eq!(place.other_buffers, ["birth_offsets", "counts"]);
}

#[test]
fn a_defect_of_emit_is_found_there() {
    // Speed is the mean less what is random of it.
    let (frame, place) = place_of_mutant("particles/emit", &subtract_last);
    assert_eq!((place.stage, place.buffer, frame), ("emit", "particles", 0));
    assert!(place.element.field.starts_with("velocity"), "{}", place.element);
    assert!(place.element.is_float);
}

#[test]
fn a_defect_of_cull_is_found_there() {
    let (_, place) = place_of_mutant("particles/cull", &|module| {
        // age >= lifetime becomes age > lifetime, in `survives`.
        let survives = module
            .functions
            .iter_mut()
            .find(|(_, function)| {
                function.name.as_deref().is_some_and(|name| name.contains("survives"))
            })
            .expect("the kernel has it");
        let changed = survives
            .1
            .expressions
            .iter_mut()
            .filter_map(|(_, e)| {
                swap(e, BinaryOperator::GreaterEqual, BinaryOperator::Greater).then_some(())
            })
            .count();
        assert_eq!(changed, 1);
    });
    assert_eq!((place.stage, place.buffer), ("cull", "alive_bits"));
    let (expected, got) = (place.element.expected, place.element.got);
    let spared = expected.zip(got).map(|(expected, got)| got & !expected);
    assert!(spared.is_some_and(|bits| bits != 0), "the mutant spares who has had its time");
}

#[test]
fn a_defect_of_advance_is_found_there() {
    // The velocity less the acceleration.
    let (frame, place) = place_of_mutant("particles/advance", &subtract_last);
    assert_eq!((place.stage, place.buffer, frame), ("advance", "particles", 0));
    assert_eq!((place.element.record, place.element.field), (0, "velocity.x"));
    let text = place.element.to_string();
    let bits = place.element.got.expect("there is such a particle");
    assert!(text.contains(&format!("{bits:#010x} ({:e})", f32::from_bits(bits))), "{text}");
}

#[test]
fn a_defect_of_the_scan_is_found_in_the_stage_that_it_serves() {
    let (_, place) = place_of_mutant("scan/survivors", &|module| {
        mutate(module, 1, |e| swap(e, BinaryOperator::Subtract, BinaryOperator::Add));
    });
    assert_eq!((place.stage, place.buffer), ("advance", "counts"));
    assert_eq!(place.element.field, "died");
}

#[test]
fn a_defect_of_splat_is_found_there() {
    let (frame, place) = place_of_mutant("draw/splat", &|module| {
        mutate(module, 1, |e| replace(e, 0.083_333_336, 0.5));
    });
    assert_eq!((place.stage, place.buffer, frame), ("splat", "light_low", 0));
    let (x, y) = place.element.pixel.expect("it is a picture");
    assert!(x < 160 && y < 90);
    assert_eq!(place.element.record, (y * 160 + x) as usize);
    assert_eq!(place.element.field, ["red", "green", "blue"][place.element.word % 3]);
}

#[test]
fn a_defect_of_resolve_is_found_there() {
    let (frame, place) = place_of_mutant("draw/resolve", &|module| {
        mutate(module, 1, |e| replace(e, 255.0, 254.0));
    });
    assert_eq!((place.stage, place.buffer, frame), ("resolve", "image", 0));
}

#[test]
fn a_defect_of_the_digest_is_told_from_one_of_the_state() {
    let (frame, place) = place_of_mutant("digest/digest", &|module| {
        let expressions = &mut module.entry_points[0].function.expressions;
        let changed = expressions.iter_mut().filter_map(|(_, e)| {
            swap(e, BinaryOperator::ExclusiveOr, BinaryOperator::InclusiveOr).then_some(())
        });
        assert_eq!(changed.count(), 1, "the kernel mixes words in by exclusive or");
    });
    assert_eq!((place.stage, place.buffer, frame), ("digest", "digest", 0));
}

#[test]
fn a_difference_that_happens_once_is_still_told() {
    let plan = plan_of_everything();
    let device = common::open(&common::adapters()[0]);
    let mut starts = 0;
    let outcome = compare(
        &plan,
        &mut || Ok(Box::new(common::on_cpu(&plan))),
        &mut || {
            starts += 1;
            let mutation = Mutation { kernel: "particles/advance", change: &subtract_last };
            let mutation = (starts == 1).then_some(mutation);
            let options = GpuOptions { mutation, ..GpuOptions::default() };
            Ok(Box::new(common::on_gpu(&device, &plan, &options)))
        },
        &CompareOptions { frames: 3, record: true },
        &mut |_| {},
    )
    .expect("the machine does not fail");
    let difference = outcome.difference.expect("it was there");
    assert_eq!((difference.frame, difference.place.is_none()), (0, true));
    assert!(difference.to_string().contains("on timing or on chance"), "{difference}");
}

/// Words of a saved file.
fn words(path: &Path) -> Vec<u32> {
    let bytes = fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    assert!(bytes.len().is_multiple_of(4), "{}", path.display());
    bytes.chunks(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
}

fn names(folder: &Path) -> BTreeSet<String> {
    fs::read_dir(folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|entry| entry.expect("readable").file_name().into_string().expect("UTF-8"))
        .collect()
}

#[test]
fn what_is_saved_is_complete() {
    let plan = plan_of_everything();
    let outcome = compare_with_mutant(&plan, "particles/advance", &subtract_last, 16);
    let difference = outcome.difference.expect("it is found");
    let parent = tempfile::tempdir().expect("writable");
    let context = SavedFor {
        scene: "every/thing",
        tested: "an adapter",
        against: "the processor",
        command: "motes check 'every/thing' --frames 16",
    };
    let folder = save(parent.path(), &difference, &context).expect("writable");
    let again = save(parent.path(), &difference, &context).expect("writable");
    let expected = ["every-thing-frame-0000-advance", "every-thing-frame-0000-advance-2"];
    assert_eq!(names(parent.path()), expected.map(str::to_owned).into(), "and nothing hidden");
    assert_eq!((folder.clone(), again), (
        parent.path().join(expected[0]),
        parent.path().join(expected[1]),
    ));

    let readme = fs::read_to_string(folder.join("README.txt")).expect("it is there");
    for told in [
        "an adapter",
        "the processor",
        "motes check 'every/thing' --frames 16",
        "stage:   advance",
        "buffer:  particles",
        "record 0, velocity.x",
        env!("CARGO_PKG_VERSION"),
    ] {
        assert!(readme.contains(told), "no `{told}` in\n{readme}");
    }

    // expected is the processor's, got is not.
    let inputs = plan.inputs(0);
    let mut cpu = common::on_cpu(&plan);
    for info in STAGES.iter().take_while(|info| info.stage != Stage::Advance) {
        cpu.run_stage(info.stage, &inputs).expect("it runs");
    }
    let before = cpu.read("particles").expect("it is there");
    cpu.run_stage(Stage::Advance, &inputs).expect("it runs");
    let after = cpu.read("particles").expect("it is there");
    assert_eq!(words(&folder.join("expected/particles.bin")), after);
    let got = words(&folder.join("got/particles.bin"));
    assert_eq!(got.len(), after.len());
    assert_ne!(got, after);

    // Inputs are those before the stage, and all that any dispatch binds.
    assert_eq!(words(&folder.join("inputs/particles-0.bin"))[..before.len()], before);
    let dispatches = fs::read_to_string(folder.join("dispatches.txt")).expect("it is there");
    let bound: BTreeSet<String> = dispatches
        .split_whitespace()
        .filter_map(|word| word.strip_prefix("inputs/"))
        .filter(|name| !name.ends_with("dispatches.bin"))
        .map(str::to_owned)
        .collect();
    for name in ["frame.bin", "system_frames.bin", "counts.bin", "survivors-0.bin"] {
        assert!(bound.contains(name), "{bound:?}");
    }
    let mut saved = names(&folder.join("inputs"));
    assert!(saved.remove("dispatches.bin"));
    assert_eq!(saved, bound);

    // Each kernel as it ran, the mutant as a mutant.
    let mut kernels = BTreeSet::new();
    for kernel_use in STAGE_KERNELS.iter().filter(|kernel| kernel.stage == Stage::Advance) {
        let name = kernel_use.kernel;
        let file = name.replace('/', "-");
        kernels.extend([format!("{file}.spv"), format!("{file}.wgsl")]);
        let spirv = words(&folder.join(format!("kernels/{file}.spv")));
        assert_eq!(spirv[0], 0x0723_0203, "SPIR-V's magic number");
        let compiled = shader::compile(name, &CompileOptions::default()).expect("it compiles");
        assert_eq!(spirv == compiled.spirv, name != "particles/advance", "{name}");
        let wgsl = fs::read_to_string(folder.join(format!("kernels/{file}.wgsl"))).expect("there");
        assert!(wgsl.contains(&format!("fn {}", compiled.entry_point)), "{wgsl}");
        assert!(dispatches.contains(&format!("kernel {file}.spv")), "{dispatches}");
    }
    assert_eq!(names(&folder.join("kernels")), kernels);
    let ran: Vec<&str> = dispatches.lines().filter(|line| line.contains("workgroups ")).collect();
    assert_eq!(ran.len(), kernels.len() / 2, "one page, so a dispatch each\n{dispatches}");
    assert!(ran.iter().all(|line| !line.contains("workgroups 0 ")), "{dispatches}");
}

#[test]
fn shrunk_scenes_are_small_and_still_alive() {
    for builtin in BUILTIN {
        let scene = load(builtin.name).expect("it is built in");
        let frames = default_frames(&scene);
        let small = shrunk(&scene, frames).expect("it can be planned");
        assert!(small.image.width <= 320 && small.image.height <= 180, "{}", scene.name);
        let plan = Plan::new(&small, frames).expect("it can be planned");
        assert!(plan.capacity <= 20_000, "{}: {}", scene.name, plan.capacity);
        assert_eq!(shrunk(&scene, frames).as_ref(), Ok(&small), "the same every time");
        let lifetime = scene.systems.iter().map(|s| s.lifetime.mean as u32).min();
        assert!(frames == scene.frames || lifetime.is_some_and(|l| l < frames), "{}", scene.name);
    }
    let small = common::everything();
    let kept = shrunk(&small, small.frames).expect("it can be planned");
    assert_eq!(kept, small, "what is small stays as it is");
    let scene = load("million").expect("it is built in");
    let scene = motes::scene::Scene { capacity: Some(500_000), ..scene };
    let capacity = shrunk(&scene, 100).expect("it can be planned").capacity;
    assert!(capacity.is_some_and(|most| (5_000..=10_000).contains(&most)), "{capacity:?}");
}

fn motes(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_motes"))
        .args(arguments)
        .env_remove("MOTES_ADAPTER")
        .output()
        .expect("the program runs")
}

/// A scene of a few frames in a file.
fn small_scene(folder: &Path) -> String {
    let path = folder.join("one & two.toml");
    let text = r#"
frames = 6
[image]
width = 32
height = 18
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "ball"
initial_mean_parts = 40
generation_shape = { kind = "sphere", radius = 1 }
speed = 0.1
lifetime = 3
color = [0.2, 0.3, 0.4]
size = 0.2
"#;
    fs::write(&path, text).expect("writable");
    path.to_str().expect("UTF-8").to_owned()
}

#[test]
fn the_command_says_equal_and_writes_its_reports() {
    let folder = tempfile::tempdir().expect("writable");
    let scene = small_scene(folder.path());
    let (json, junit) = (folder.path().join("r/c.json"), folder.path().join("r/c.xml"));
    let saved = folder.path().join("saved");
    let adapter = &common::adapters()[0];
    let path = |path: &Path| path.to_str().expect("UTF-8").to_owned();
    let output = motes(&[
        "check",
        &scene,
        "--full",
        "--adapter",
        adapter,
        "--json",
        &path(&json),
        "--junit",
        &path(&junit),
        "--save",
        &path(&saved),
    ]);
    let stdout = String::from_utf8_lossy(&output.stdout);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{stdout}{stderr}");
    assert_eq!(stdout.lines().count(), 1, "{stdout}");
    let fields: Vec<&str> = stdout.split_whitespace().collect();
    assert!(stdout.starts_with("one & two "), "{stdout}");
    assert_eq!(fields[3..5], ["6", "frames"], "{stdout}");
    assert_eq!(fields[5..7], ["120", "particles"], "{stdout}");
    assert_eq!(fields.last(), Some(&"equal"), "{stdout}");
    assert!(stderr.to_lowercase().contains(adapter.as_str()), "{stderr}");
    assert!(stderr.contains("against cpu"), "{stderr}");
    let json = fs::read_to_string(json).expect("it is there");
    for told in ["\"equal\": true", "\"scene\": \"one & two\"", fields[8], fields[10]] {
        assert!(json.contains(told), "no `{told}` in {json}");
    }
    let junit = fs::read_to_string(junit).expect("it is there");
    assert!(junit.contains("name=\"one &amp; two\"") && junit.contains("failures=\"0\""), "{junit}");
    assert!(!saved.exists(), "there is nothing to save");
}

#[test]
fn the_command_tells_whose_fault_it_is() {
    let adapter = &common::adapters()[0];
    for (arguments, told) in [
        (vec!["check", "fountin", "--adapter", adapter], "did you mean fountain?"),
        (vec!["check", "fountain", "--adapter", "no such thing"], "no such thing"),
        (vec!["check", "fountain", "--against", "no such thing"], "no such thing"),
        (vec!["check", "fountain", "--adapter", "cpu"], "compared with itself"),
        (vec!["check", "fountain", "--frames", "0"], "--frames"),
    ] {
        let output = motes(&arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
        assert!(stderr.contains(told), "{arguments:?}: {stderr}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}
