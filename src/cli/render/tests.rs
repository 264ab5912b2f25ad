//! Runs whose device fails under way, which no driver does on request.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::Duration;

use super::job::{Job, Pictures};
use super::journal::{Finished, Journal};
use super::request::Request;
use super::summary::Summary;
use crate::backend::{Backend, BackendError, Living};
use crate::cli::CliError;
use crate::cli::interrupt::Interrupt;
use crate::cpu::CpuBackend;
use crate::layout::FrameStats;
use crate::output::{FrameSink, OutputTarget, StatsWriter};
use crate::plan::{FrameInputs, Plan, Population, Stage};
use crate::recording::Recording;
use crate::scene::{self, Scene};
use crate::simulation::Simulation;

/// Frames of each run.
const FRAMES: u32 = 12;

/// What a device can be asked for when it fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Call {
    Step,
    Draw,
    Read,
    Statistics,
}

/// The processor, until frame `frame` asks for `call`.
struct Failing {
    cpu: CpuBackend,
    now: u32,
    fails: Option<(u32, Call, BackendError)>,
}

impl Failing {
    fn pass(&self, call: Call) -> Result<(), BackendError> {
        match &self.fails {
            Some((frame, when, error)) if (*frame, *when) == (self.now, call) => Err(error.clone()),
            _ => Ok(()),
        }
    }
}

impl Backend for Failing {
    fn adapter_name(&self) -> String {
        "failing".into()
    }

    fn is_exact(&self) -> bool {
        true
    }

    fn run_stage(&mut self, stage: Stage, inputs: &FrameInputs) -> Result<(), BackendError> {
        self.now = inputs.frame.frame;
        self.pass(if stage.info().draws {
            Call::Draw
        } else {
            Call::Step
        })?;
        self.cpu.run_stage(stage, inputs)
    }

    fn read(&mut self, buffer: &str) -> Result<Vec<u32>, BackendError> {
        self.pass(Call::Read)?;
        self.cpu.read(buffer)
    }

    fn take_statistics(&mut self) -> Result<Vec<FrameStats>, BackendError> {
        self.pass(Call::Statistics)?;
        self.cpu.take_statistics()
    }

    fn restore(&mut self, living: &Living<'_>, recent: &[FrameInputs]) -> Result<(), BackendError> {
        self.cpu.restore(living, recent)
    }

    fn population_digest(&mut self, population: Population) -> Result<u64, BackendError> {
        self.cpu.population_digest(population)
    }

    fn image_digest(&mut self) -> Result<u64, BackendError> {
        self.cpu.image_digest()
    }
}

fn fountain() -> Scene {
    let sets = ["image.width=64".to_owned(), "image.height=36".to_owned()];
    scene::load_with("fountain", &sets).expect("a built-in scene")
}

/// Renders into `folder` as the program does, going on if it can.
fn render(
    folder: &Path,
    out: &str,
    fails: Option<(u32, Call, BackendError)>,
) -> Result<Summary, CliError> {
    let scene = fountain();
    let plan = Plan::new(&scene, FRAMES).expect("it can be planned");
    let cpu = CpuBackend::new(&plan, Some(1)).expect("it fits");
    let backend = Failing { cpu, now: 0, fails };
    let mut simulation = Simulation::with_backend(plan, Box::new(backend));
    let target = OutputTarget::parse(&folder.join(out).display().to_string())?;
    let interrupt = Interrupt::listen()?;
    let place = folder.join(".journal");
    let (journal, finished) = match Journal::resume(&place, 1, &[folder.to_owned()])? {
        Some(found) => found,
        None => (
            Journal::begin(&place, 1, &[folder.to_owned()])?,
            Finished::default(),
        ),
    };
    let sink = FrameSink::open(&target, 64, 36, 24.0, FRAMES)?;
    let request = Request {
        scene,
        frames: 0..FRAMES,
        target,
        layers: Vec::new(),
        dumps: vec![5],
        dump_dir: folder.to_owned(),
        populations: vec![Population::Particles],
        recording: Recording::default(),
        turns: Vec::new(),
    };
    let mut job = Job {
        pictures: Pictures::Frames(sink),
        request: &request,
        stats: Some(StatsWriter::create(&folder.join("s.csv"))?),
        journal: Some(journal),
        snapshot_every: Duration::ZERO,
        keeps_states: true,
        interrupt: &interrupt,
    };
    let summary = job.render(&mut simulation, &finished);
    let summary = summary.map_err(|error| job.told(error))?;
    job.finish()?;
    Ok(summary)
}

/// Bytes of the files with final names, by path.
fn files_in(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(one) = folders.pop() {
        for entry in fs::read_dir(one).expect("a folder").flatten() {
            let path = entry.path();
            let name = path.strip_prefix(folder).expect("it is in there");
            let name = name.display().to_string();
            if name.starts_with(".journal") {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else {
                files.insert(name, fs::read(path).expect("a file"));
            }
        }
    }
    files
}

#[test]
fn a_device_that_fails_is_told_and_the_run_goes_on_with_the_same_files() {
    for out in ["all", "a.gif"] {
        let whole = tempfile::tempdir().expect("room");
        render(whole.path(), out, None).expect("nothing fails");
        let expected = files_in(whole.path());
        assert!(expected.len() >= 3, "{:?}", expected.keys());
        for (number, call) in [Call::Step, Call::Draw, Call::Read, Call::Statistics]
            .into_iter()
            .enumerate()
        {
            let here = tempfile::tempdir().expect("room");
            let frame = 3 + 2 * number as u32;
            for (error, named) in [
                (
                    BackendError::DeviceLost("it went".into()),
                    "the device was lost: it went",
                ),
                (
                    BackendError::OutOfMemory("a lot".into()),
                    "out of memory: a lot",
                ),
                (BackendError::Internal("no".into()), "refused a call: no"),
            ] {
                let ended = render(here.path(), out, Some((frame, call, error)));
                let error = ended.expect_err("it fails");
                assert_eq!(error.code, 3, "{call:?}: {}", error.message);
                assert!(error.message.contains(named), "{}", error.message);
                assert!(error.message.contains("help: "), "{}", error.message);
                let found = files_in(here.path());
                assert!(!found.contains_key("s.csv") && !found.contains_key("a.gif"));
                let whole = found
                    .iter()
                    .all(|(name, bytes)| expected.get(name) == Some(bytes));
                assert!(whole, "{call:?}, {named}: {:?}", found.keys());
                let frames = if out == "all" { frame as usize } else { 0 };
                assert!(found.len() >= frames, "{call:?}: {:?}", found.keys());
            }
            render(here.path(), out, None).expect("nothing fails any more");
            assert!(files_in(here.path()) == expected, "{out}, {call:?}");
            assert!(!here.path().join(".journal").exists());
        }
    }
}
