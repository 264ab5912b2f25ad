//! Where changed kernels are tried: the files that changes are made to, and runs under way.

use std::collections::{BTreeSet, HashMap};

use motes::gpu::shader::sources::{KERNELS, LIBRARIES, Source};
use motes::gpu::shader::{self, CompileOptions, CompiledKernel, ShaderError};
use motes::gpu::{GpuBackend, GpuDevice, KernelForm, STAGE_KERNELS};

use crate::budget::bound_loops;
use crate::common::*;
use crate::sites::{self, Site};
use crate::trials::Trial;

/// Rounds that the loops of a function make at most in one invocation.
const MOST_ROUNDS: u32 = 20_000;

/// Changes after which the device is opened anew: drivers keep something of every kernel.
const MOST_CHANGES: u32 = 60;

/// A WGSL file that changes are made to: a kernel's own, or a library that no probe evaluates; a
/// change to a library changes every kernel that has the changed code.
pub(crate) struct File {
    pub(crate) name: &'static str,
    /// The library's path; `None` for a kernel's own file.
    library: Option<String>,
    /// Kernels that have code of the file.
    kernels: Vec<&'static str>,
}

/// All such files.
pub(crate) fn files() -> Vec<File> {
    // What has another's file is mutated under the other's name.
    let own_file = |source: &&Source| source.file == format!("wgsl/{}.wgsl", source.name);
    let names = || KERNELS.iter().filter(own_file).map(|source| source.name);
    let is_probed = |path: &str| PROBES.iter().any(|probe| probe.libraries.contains(&path));
    let own = names().map(|name| File {
        name,
        library: None,
        kernels: vec![name],
    });
    let libraries = LIBRARIES.iter().filter_map(|source| {
        let path = source.name.replace("lib/", "motes::");
        (!is_probed(&path)).then(|| File {
            name: source.name,
            kernels: names()
                .filter(|name| !sites_in(name, Some(&path), &[]).is_empty())
                .collect(),
            library: Some(path),
        })
    });
    // lib/layout declares what others compute with.
    own.chain(libraries)
        .filter(|file| !file.kernels.is_empty())
        .collect()
}

fn sites_in(kernel: &str, library: Option<&str>, off: &[&'static str]) -> Vec<Site> {
    let compile = |options: &CompileOptions| shader::compile(kernel, options);
    sites::of_kernel(&compile, off, &|of| of == library)
}

impl File {
    /// The kernels of all these files, to be tried unchanged.
    pub(crate) fn all_of(files: &[Self]) -> Self {
        let kernels: BTreeSet<_> = files.iter().flat_map(|file| &file.kernels).collect();
        Self {
            name: "all",
            library: None,
            kernels: kernels.into_iter().copied().collect(),
        }
    }

    /// Changes of the file, each once, as they are in kernels that leave out nothing.
    pub(crate) fn sites(&self) -> Vec<Site> {
        let mut seen = BTreeSet::new();
        let of = |kernel: &&str| sites_in(kernel, self.library.as_deref(), &[]);
        let all = self.kernels.iter().flat_map(of);
        all.filter(|site| seen.insert(site.key())).collect()
    }
}

/// Runs of all trials, begun when they are first needed.
pub(crate) struct Bench<'a> {
    trials: &'a [Trial],
    runs: Vec<Option<Run>>,
    device: Option<GpuDevice>,
    changes: u32,
    /// Changes of a file in a kernel that is compiled without some switches: what is switched off
    /// is folded away, and changes have other places.
    places: HashMap<Place, Vec<Site>>,
}

/// File, kernel, switches.
type Place = (&'static str, &'static str, Vec<&'static str>);

/// A run and the kernels of it that are changed.
struct Run {
    backend: GpuBackend,
    changed: BTreeSet<&'static str>,
}

impl<'a> Bench<'a> {
    pub(crate) fn new(trials: &'a [Trial]) -> Self {
        Self {
            trials,
            runs: trials.iter().map(|_| None).collect(),
            device: None,
            changes: 0,
            places: HashMap::new(),
        }
    }

    /// How the first trial that sees the change (or no change but the bound on loops) sees it;
    /// `None` where none does. Runs begun are kept for the next change, of whatever file.
    ///
    /// # Errors
    /// The change makes no valid kernel.
    pub(crate) fn difference(
        &mut self,
        file: &File,
        site: Option<&Site>,
    ) -> Result<Option<String>, ShaderError> {
        if self.changes >= MOST_CHANGES {
            *self = Self {
                places: std::mem::take(&mut self.places),
                ..Self::new(self.trials)
            };
        }
        self.changes += 1;
        // On the first adapter of those to test.
        let device = self.device.get_or_insert_with(|| open_anew(&adapters()[0]));
        for (trial, run) in self.trials.iter().zip(&mut self.runs) {
            let off = trial.off(None);
            let mut kernels = Vec::new();
            for &kernel in file.kernels.iter().filter(|kernel| trial.runs(kernel)) {
                let places = self.places.entry((file.name, kernel, off.clone()));
                let places =
                    places.or_insert_with(|| sites_in(kernel, file.library.as_deref(), &off));
                let here = site.and_then(|site| places.iter().find(|one| one.key() == site.key()));
                if here.is_some() || site.is_none() {
                    kernels.push((kernel, compile(kernel, trial, here)?));
                }
            }
            if kernels.is_empty() {
                continue;
            }
            let run = run.get_or_insert_with(|| Run {
                backend: trial.backend(device),
                changed: BTreeSet::new(),
            });
            if let Some(difference) = run.difference(trial, &kernels, site.is_some())? {
                return Ok(Some(format!("{}: {difference}", trial.name)));
            }
        }
        Ok(None)
    }
}

impl Run {
    fn difference(
        &mut self,
        trial: &Trial,
        kernels: &[(&'static str, CompiledKernel)],
        is_changed: bool,
    ) -> Result<Option<String>, ShaderError> {
        let names: BTreeSet<_> = kernels.iter().map(|(kernel, _)| *kernel).collect();
        let restored: Vec<_> = self
            .changed
            .difference(&names)
            .map(|kernel| compile(kernel, trial, None))
            .collect::<Result<_, _>>()?;
        self.changed = if is_changed { names } else { BTreeSet::new() };
        for kernel in restored.iter().chain(kernels.iter().map(|(_, it)| it)) {
            if let Err(e) = self.backend.restart(kernel, KernelForm::Spirv, true) {
                return Ok(Some(format!("restart: {e}")));
            }
        }
        Ok(trial.difference(&mut self.backend))
    }
}

/// The kernel as the trial has it, changed or not, with checked indices and bounded loops.
fn compile(
    kernel: &str,
    trial: &Trial,
    site: Option<&Site>,
) -> Result<CompiledKernel, ShaderError> {
    let switched_off = site.and_then(Site::switched_off);
    let mutate = |module: &mut naga::Module| {
        if let Some(site) = site.filter(|_| switched_off.is_none()) {
            site.apply(module);
        }
        bound_loops(module, MOST_ROUNDS);
    };
    let off = trial.off(switched_off);
    shader::compile(
        kernel,
        &CompileOptions {
            workgroup_size: trial.workgroup_size(),
            checked: true,
            off: &off,
            wide: true,
            mutate: Some(&mutate),
            ..CompileOptions::default()
        },
    )
}

/// Kernels that are tried must be those that run, and the digest.
#[test]
fn every_kernel_is_run_by_the_trials() {
    let of_stages = STAGE_KERNELS.iter().map(|one| one.kernel);
    let run: BTreeSet<_> = of_stages.chain(["digest/digest", "draw/unpack"]).collect();
    assert_eq!(run, KERNELS.iter().map(|source| source.name).collect());
}
