//! A test that cannot fail tests nothing: kernels are changed, one literal or operator at a time,
//! and each change must make a comparison with the processor fail, or be in the table of those
//! that make no difference, with the reason.
//!
//! Changes to the shared libraries are tried on the kernels that evaluate every function of them
//! (`common::PROBES`); those to a kernel's own file and to other libraries, on whole runs
//! (`trials`). A sample of each kernel's changes is tried; with `MOTES_FULL=1`, all of them.
//! Changed kernels check their indices, and their loops are bounded (`budget`).
#[path = "../common/mod.rs"]
mod common;

mod budget;
mod explained;
mod printed;
mod sites;
mod trials;

use std::cell::RefCell;

use common::*;
use motes::gpu::shader::sources::KERNELS;
use motes::gpu::shader::{self, CompileOptions, CompiledKernel, ShaderError};
use motes::gpu::{GpuBackend, GpuDevice, KernelForm};
use sites::Site;
use trials::Trial;

/// Changes tried of each kernel, unless all are.
const SAMPLE: usize = 12;

/// Rounds that the loops of a function make at most in one invocation.
const MOST_ROUNDS: u32 = 20_000;

/// Sets of arguments that a probe kernel is tried on.
const PROBE_ARGUMENTS: u32 = 60_000;

/// The adapter that changes are tried on: the first of those to test.
fn device() -> GpuDevice {
    open_anew(&adapters()[0])
}

/// How the changes of one kernel fared.
#[derive(Default)]
struct Tally {
    kernel: String,
    sites: usize,
    invalid: usize,
    caught: usize,
    explained: usize,
    unexplained: Vec<String>,
}

/// Compiles with a look at the module as it is when changes are made.
type Compile<'a> = &'a dyn Fn(&CompileOptions) -> Result<CompiledKernel, ShaderError>;

fn sites_of(compile: Compile, wanted: &dyn Fn(Option<&str>) -> bool) -> Vec<Site> {
    let found = RefCell::new(Vec::new());
    let look = |module: &mut naga::Module| *found.borrow_mut() = sites::sites(module, wanted);
    compile(&CompileOptions { mutate: Some(&look), ..CompileOptions::default() })
        .expect("the kernel compiles");
    found.into_inner()
}

/// Tries the changes of one kernel; `differs` says how a changed kernel is seen to be wrong.
fn try_all(
    kernel: &str,
    sites: Vec<Site>,
    compile: Compile,
    differs: &mut dyn FnMut(&dyn Fn(u32) -> Option<CompiledKernel>) -> Option<String>,
) -> Tally {
    let mut tally = Tally { kernel: kernel.to_owned(), sites: sites.len(), ..Tally::default() };
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_by_key(|at| hash(*at as u32));
    for at in order {
        let site = &sites[at];
        let tried = tally.caught + tally.explained + tally.unexplained.len();
        if !full() && tried == SAMPLE {
            break;
        }
        let changed = |workgroup_size| {
            let mutate = |module: &mut naga::Module| {
                site.apply(module);
                budget::bound_loops(module, MOST_ROUNDS);
            };
            compile(&CompileOptions { workgroup_size, checked: true, mutate: Some(&mutate), ..Default::default() }).ok()
        };
        if changed(64).is_none() {
            tally.invalid += 1;
            continue;
        }
        if std::env::var_os("MOTES_VERBOSE").is_some() {
            println!("{kernel}: {}", site.description);
        }
        match differs(&changed) {
            Some(difference) => {
                tally.caught += 1;
                if std::env::var_os("MOTES_VERBOSE").is_some() {
                    println!("    {difference}");
                }
            }
            None if explained::reason(kernel, &site.description).is_some() => tally.explained += 1,
            None => tally.unexplained.push(format!("{kernel} | {}", site.description)),
        }
    }
    tally
}

/// Prints the table, and fails where a change has gone unseen for no known reason.
fn report(tallies: &[Tally]) {
    println!("{:24} changes  invalid   caught  explained  unexplained", "kernel");
    for tally in tallies {
        println!(
            "{:24} {:7} {:8} {:8} {:10} {:12}",
            tally.kernel,
            tally.sites,
            tally.invalid,
            tally.caught,
            tally.explained,
            tally.unexplained.len()
        );
    }
    let unexplained: Vec<_> = tallies.iter().flat_map(|tally| &tally.unexplained).collect();
    assert!(
        unexplained.is_empty(),
        "changes that no comparison saw:\n{}",
        unexplained.iter().map(|one| format!("  {one}\n")).collect::<String>()
    );
}

/// Whether the variable `MOTES_KERNEL`, if it is set, names this kernel, perhaps among others.
fn is_chosen(kernel: &str) -> bool {
    let chosen = std::env::var("MOTES_KERNEL");
    chosen.map_or(true, |names| names.split(',').any(|name| name == kernel))
}

/// Whether what a library declares is tried on runs: all but what is tried on probes.
fn is_of_kernels(library: Option<&str>) -> bool {
    let is_probed = |library| PROBES.iter().any(|probe| probe.libraries.contains(&library));
    !library.is_some_and(is_probed)
}

#[test]
fn every_change_of_a_kernel_is_seen() {
    let device = device();
    let trials = trials::trials();
    let mut backends: Vec<GpuBackend> = trials.iter().map(|one| one.backend(&device)).collect();
    let mut tallies = Vec::new();
    for kernel in KERNELS.iter().map(|source| source.name).filter(|name| is_chosen(name)) {
        let compile = |options: &CompileOptions| shader::compile(kernel, options);
        let mut differs = |changed: &dyn Fn(u32) -> Option<CompiledKernel>| {
            trials.iter().zip(&mut backends).find_map(|(trial, backend): (&Trial, _)| {
                let kernel = changed(trial.workgroup_size())?;
                trial
                    .difference(backend, &kernel)
                    .map(|difference| format!("{}: {difference}", trial.name))
            })
        };
        // Unchanged but for the bound on loops, it is not seen to differ.
        let unchanged = |workgroup_size| {
            let mutate = |module: &mut naga::Module| budget::bound_loops(module, MOST_ROUNDS);
            compile(&CompileOptions { workgroup_size, checked: true, mutate: Some(&mutate), ..Default::default() }).ok()
        };
        assert_eq!(differs(&unchanged), None, "{kernel}, unchanged");
        let sites = sites_of(&compile, &is_of_kernels);
        tallies.push(try_all(kernel, sites, &compile, &mut differs));
        // The next kernel is tried among unchanged ones.
        for (trial, backend) in trials.iter().zip(&mut backends) {
            let kernel = unchanged(trial.workgroup_size()).expect("the kernel compiles");
            backend.restart(&kernel, KernelForm::Spirv, true).expect("the device restores a kernel");
        }
    }
    report(&tallies);
}

#[test]
fn every_change_of_a_library_is_seen() {
    let device = device();
    let arguments = arguments(PROBE_ARGUMENTS);
    let input = words_of(&arguments);
    let mut tallies = Vec::new();
    for probe in PROBES.iter().filter(|probe| is_chosen(probe.name)) {
        let expected = probe.expected(&arguments);
        let mut differs = |changed: &dyn Fn(u32) -> Option<CompiledKernel>| {
            let kernel = changed(64)?;
            let inputs = [input.as_slice()];
            let words = expected.len();
            match device.run_kernel(&kernel, KernelForm::Spirv, &inputs, words, PROBE_ARGUMENTS) {
                Ok(got) => probe.difference(&arguments, &got, &expected),
                Err(e) => Some(e.to_string()),
            }
        };
        let compile = |options: &CompileOptions| probe.compile(options);
        let unchanged = |workgroup_size| {
            compile(&CompileOptions { workgroup_size, ..CompileOptions::default() }).ok()
        };
        assert_eq!(differs(&unchanged), None, "{}, unchanged", probe.name);
        let wanted = |library: Option<&str>| {
            library.is_some_and(|library| probe.libraries.contains(&library))
        };
        let sites = sites_of(&compile, &wanted);
        tallies.push(try_all(probe.name, sites, &compile, &mut differs));
    }
    report(&tallies);
}

#[test]
fn no_explanation_is_out_of_date() {
    let mut descriptions = Vec::new();
    for kernel in KERNELS.iter().map(|source| source.name) {
        let compile = |options: &CompileOptions| shader::compile(kernel, options);
        let sites = sites_of(&compile, &is_of_kernels);
        descriptions.extend(sites.into_iter().map(|site| (kernel, site.description)));
    }
    for probe in PROBES {
        let compile = |options: &CompileOptions| probe.compile(options);
        let sites = sites_of(&compile, &|_| true);
        descriptions.extend(sites.into_iter().map(|site| (probe.name, site.description)));
    }
    let idle = explained::idle(&descriptions);
    assert!(idle.is_empty(), "explanations of changes that there are not: {idle:#?}");
}
