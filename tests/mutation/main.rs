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

mod bench;
mod budget;
mod changes;
mod explained;
mod printed;
mod sites;
mod trials;

use std::sync::Mutex;
use std::thread::ScopedJoinHandle;

use common::*;
use motes::gpu::KernelForm;
use motes::gpu::shader::{CompileOptions, ShaderError};
use sites::Site;

/// Files whose changes are tried at the same time, each on a device of its own.
const WORKERS: usize = 2;

/// Changes tried of each file, unless all are.
const SAMPLE: usize = 8;

/// Sets of arguments that a probe kernel is tried on.
const PROBE_ARGUMENTS: u32 = 60_000;

/// Rounds that the loops of a probed function make at most in one invocation.
const PROBE_ROUNDS: u32 = 1000;

/// Files not all of whose changes have a trial that sees them or a reason yet: only the whole run
/// tries them.
const OWED: [&str; 78] = [
    "draw/smoke",
    "lib/layout",
    "scan/survivors",
    "spread/front",
    "spread/walk",
    "draw/dim",
    "spread/arrive",
    "spread/enlist",
    "spread/block",
    "spread/gaps",
    "spread/sum_gaps",
    "spread/book",
    "spread/burning",
    "spread/drop",
    "spread/insert",
    "spread/ignite",
    "spread/catch",
    "spread/caught",
    "lib/meet",
    "lib/grain",
    "lib/walk",
    "lib/drops",
    "tree/bear",
    "tree/settle",
    "tree/found",
    "tree/pose",
    "flames/kindle",
    "flames/dropped",
    "flames/trace",
    "flames/shine",
    "flames/gather",
    "particles/span",
    "particles/shed",
    "particles/cluster",
    "lib/cluster",
    "draw/ground",
    "draw/surface_raster",
    "draw/surface_work",
    "draw/surface",
    "lib/raster",
    "lib/veil",
    "lib/behind",
    "flock/cells",
    "flock/steer",
    "draw/boid_shapes",
    "draw/boid_trails",
    "draw/marks",
    "draw/front_lines",
    "draw/strokes",
    "lib/stroke",
    "draw/deposit",
    "draw/shade",
    "lib/shade",
    "draw/hide",
    "draw/splat",
    "draw/splat_large",
    "draw/flame_discs",
    "draw/clear_flame_tiles",
    "draw/bin_flames",
    "draw/glow_work",
    "draw/glow",
    "draw/glow_small",
    "lib/flame_tile",
    "draw/strip_joints",
    "draw/strips",
    "lib/strip",
    "lib/solid",
    "lib/cover",
    "lib/shape",
    "lib/births",
    "lib/tree",
    "lib/inherit",
    "lib/reach",
    "lib/disc",
    "lib/flame",
    "lib/fan",
    "lib/pillar",
    "lib/detail",
];

/// How the changes of one file fared.
#[derive(Default)]
struct Tally {
    file: String,
    sites: usize,
    invalid: usize,
    caught: usize,
    explained: usize,
    unexplained: Vec<String>,
}

/// Whether changes and how they were caught are printed one by one: `MOTES_VERBOSE=1`.
fn is_verbose() -> bool {
    std::env::var_os("MOTES_VERBOSE").is_some()
}

/// Tries the changes of one file, or those of them whose description has what the variable
/// `MOTES_CHANGE` says in it; `differs` says how one is seen to be wrong, or that it makes no
/// valid kernel.
fn try_all(
    file: &str,
    sites: &[Site],
    differs: &mut dyn FnMut(&Site) -> Result<Option<String>, ShaderError>,
) -> Tally {
    let mut tally = Tally {
        file: file.to_owned(),
        sites: sites.len(),
        ..Tally::default()
    };
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_by_key(|at| hash(*at as u32));
    let wanted = std::env::var("MOTES_CHANGE").unwrap_or_default();
    order.retain(|at| sites[*at].description.contains(&wanted));
    for at in order {
        let what = &sites[at].description;
        let tried = tally.caught + tally.explained + tally.unexplained.len();
        if !full() && tried == SAMPLE {
            break;
        }
        let (place, outcome) = match differs(&sites[at]) {
            Err(_) => (&mut tally.invalid, "makes no kernel".to_owned()),
            Ok(Some(difference)) => (&mut tally.caught, difference),
            Ok(None) => match explained::reason(file, what) {
                Some(reason) => (&mut tally.explained, reason.to_owned()),
                None => {
                    tally.unexplained.push(format!("{file} | {what}"));
                    println!("{file} | {what}\n    IS NOT SEEN");
                    continue;
                }
            },
        };
        *place += 1;
        if is_verbose() {
            println!("{file} | {what}\n    {outcome}");
        }
    }
    tally
}

/// Prints the table, and fails where a change has gone unseen for no known reason.
fn report(tallies: &[Tally]) {
    println!(
        "{:24} changes  invalid   caught  explained  unexplained",
        "file"
    );
    for tally in tallies {
        println!(
            "{:24} {:7} {:8} {:8} {:10} {:12}",
            tally.file,
            tally.sites,
            tally.invalid,
            tally.caught,
            tally.explained,
            tally.unexplained.len()
        );
    }
    let unexplained: Vec<_> = tallies
        .iter()
        .flat_map(|tally| &tally.unexplained)
        .collect();
    assert!(
        unexplained.is_empty(),
        "changes that no comparison saw:\n{}",
        unexplained
            .iter()
            .map(|one| format!("  {one}\n"))
            .collect::<String>()
    );
}

/// Whether the variable `MOTES_KERNEL`, if it is set, names this kernel, perhaps among others.
fn is_chosen(kernel: &str) -> bool {
    let chosen = std::env::var("MOTES_KERNEL");
    chosen.map_or(true, |names| names.split(',').any(|name| name == kernel))
}

#[test]
fn every_change_of_a_kernel_is_seen() {
    let trials = trials::trials();
    let mut files = bench::files();
    files.retain(|file| is_chosen(file.name));
    let mut bench = bench::Bench::new(&trials);
    // Unchanged but for the bound on loops, none is seen to differ.
    let unchanged = bench.difference(&bench::File::all_of(&files), None);
    assert_eq!(unchanged.expect("the kernels compile"), None, "unchanged");
    drop(bench);
    files.retain(|file| full() || !OWED.contains(&file.name));
    let files = Mutex::new(files.into_iter());
    let next = || files.lock().expect("nobody panics with it").next();
    let try_some = || {
        let mut bench = bench::Bench::new(&trials);
        let mut tallies = Vec::new();
        while let Some(file) = next() {
            let mut differs = |site: &Site| bench.difference(&file, Some(site));
            tallies.push(try_all(file.name, &file.sites(), &mut differs));
        }
        tallies
    };
    // What takes time is compiling, one kernel after the other.
    let mut tallies: Vec<Tally> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..WORKERS).map(|_| scope.spawn(try_some)).collect();
        let of = |worker: ScopedJoinHandle<'_, _>| worker.join().expect("it ends");
        workers.into_iter().flat_map(of).collect()
    });
    tallies.sort_by(|a, b| a.file.cmp(&b.file));
    report(&tallies);
}

#[test]
fn every_change_of_a_probed_library_is_seen() {
    let device = open_anew(&adapters()[0]);
    let arguments = arguments(PROBE_ARGUMENTS);
    let input = words_of(&arguments);
    let mut tallies = Vec::new();
    for probe in PROBES.iter().filter(|probe| is_chosen(probe.name)) {
        let expected = probe.expected(&arguments);
        let differs = |site: Option<&Site>| {
            let mutate = |module: &mut naga::Module| {
                if let Some(site) = site {
                    site.apply(module);
                }
                budget::bound_loops(module, PROBE_ROUNDS);
            };
            let kernel = probe.compile(&CompileOptions {
                workgroup_size: 64,
                mutate: Some(&mutate),
                ..CompileOptions::default()
            })?;
            let inputs = [input.as_slice()];
            let words = expected.len();
            let got =
                device.run_kernel(&kernel, KernelForm::Spirv, &inputs, words, PROBE_ARGUMENTS);
            Ok::<_, ShaderError>(match got {
                Ok(got) => probe.difference(&arguments, &got, &expected),
                Err(e) => Some(e.to_string()),
            })
        };
        let unchanged = differs(None).expect("the kernel compiles");
        assert_eq!(unchanged, None, "{}, unchanged", probe.name);
        let sites = probe_sites(probe);
        tallies.push(try_all(probe.name, &sites, &mut |site| differs(Some(site))));
    }
    report(&tallies);
}

/// Changes of the libraries that the probe evaluates.
fn probe_sites(probe: &ProbeKernel) -> Vec<Site> {
    let wanted =
        |library: Option<&str>| library.is_some_and(|library| probe.libraries.contains(&library));
    sites::of_kernel(&|options| probe.compile(options), &[], &wanted)
}

#[test]
fn no_explanation_is_out_of_date() {
    let of = |name: &'static str, sites: Vec<Site>| {
        let descriptions = sites.into_iter().map(|site| site.description);
        descriptions.map(move |what| (name, what))
    };
    let files = bench::files();
    let changes: Vec<_> = files
        .iter()
        .flat_map(|file| of(file.name, file.sites()))
        .chain(
            PROBES
                .iter()
                .flat_map(|probe| of(probe.name, probe_sites(probe))),
        )
        .collect();
    let idle = explained::idle(&changes);
    assert!(
        idle.is_empty(),
        "explanations of changes that there are not: {idle:#?}"
    );
}
