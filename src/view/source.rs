//! What is played with: a scene's files as they were read last, and runs made of them.

use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use super::detail::{Detail, hangs_on_pixels};
use super::session::Told;
use crate::gpu::shader::sources::KernelTexts;
use crate::gpu::{GpuDevice, GpuOptions};
use crate::plan::{Plan, Turn};
use crate::recording::Recording;
use crate::scene::{Draft, Knob, Loader, ParticleShape, Scene, SceneError};
use crate::simulation::{AdapterChoice, Options, Simulation, SimulationError};

/// Room for so many times the particles that the scene can have as it is.
const ROOM: u32 = 4;
/// Room at least.
const LEAST_ROOM: u32 = 100_000;
/// Room at most, unless the scene has more particles as it is.
const MOST_ROOM: u32 = 8_000_000;

/// Frames at least that a scene can be played in which something lives for ever: what is written of births
/// is kept for all of them.
const PLAYED_FRAMES: u32 = 8192;

/// What to play with, and on what.
pub struct Source {
    /// Name of a built-in scene, or path.
    pub scene: String,
    /// Changes made to it before it begins, as `--set` has them.
    pub sets: Vec<String>,
    /// How it is loaded.
    pub loader: Loader,
    /// Where it runs.
    pub device: GpuDevice,
    /// Whether the device was opened with a clock.
    pub is_timed: bool,
    /// Room for more particles than the scene asks for, as `--set` has it, where the scene names none.
    room: Option<String>,
    /// A folder of kernels to run in place of the program's own, and what was read of them last.
    kernels: Option<(PathBuf, Arc<KernelTexts>)>,
    /// How much of it is drawn, and what that changes of it, as `--set` has it.
    pub(super) detail: (Detail, Vec<String>),
    /// What was read of its files last.
    read: Option<Rc<Files>>,
    /// Files that were opened when they were read last, be it for nothing.
    tried: Vec<PathBuf>,
}

/// What a [`Source`] was at a time.
pub(super) struct AsRead {
    sets: Vec<String>,
    read: Option<Rc<Files>>,
    room: Option<String>,
    kernels: Option<(PathBuf, Arc<KernelTexts>)>,
    detail: (Detail, Vec<String>),
}

/// What was read of a scene's files.
pub(super) struct Files {
    pub(super) draft: Draft,
}

impl Source {
    /// A scene, by name or path, with changes made to it before it begins, loaded so, on that device, which
    /// has a clock or not.
    pub fn new(
        (scene, sets, loader): (&str, &[String], Loader),
        (device, is_timed): (GpuDevice, bool),
    ) -> Self {
        Self {
            scene: scene.to_owned(),
            sets: sets.to_vec(),
            loader,
            device,
            is_timed,
            room: None,
            kernels: None,
            detail: (Detail::FULL, Vec::new()),
            read: None,
            tried: Vec::new(),
        }
    }

    /// The same with kernels from files below a folder, as far as it has any, which are read again when
    /// they are written.
    #[must_use]
    pub fn with_kernels(self, folder: Option<PathBuf>) -> Self {
        Self {
            kernels: folder.map(|folder| (folder, Arc::default())),
            ..self
        }
    }

    /// Gives a scene that names no capacity one that its births may be turned up to.
    fn make_room(&mut self) -> Result<(), Told> {
        self.room = None;
        let scene = self.load(&[])?;
        if scene.capacity.is_some() || scene.systems.is_empty() {
            return Ok(());
        }
        let plan = Plan::new(&scene, scene.frames).map_err(|error| error.to_string())?;
        let room = plan
            .capacity
            .saturating_mul(ROOM)
            .clamp(LEAST_ROOM, MOST_ROOM);
        let capacity = room.max(plan.capacity);
        self.room = Some(format!("capacity={capacity}"));
        Ok(())
    }

    /// Changes made to the scene before it begins.
    pub(super) fn first_sets(&self) -> Vec<String> {
        self.sets.iter().chain(&self.room).cloned().collect()
    }

    pub(super) fn load(&self, sets: &[String]) -> Result<Scene, Told> {
        let (_, coarser) = &self.detail;
        self.load_as(&[&self.first_sets(), sets, coarser].concat())
    }

    fn load_as(&self, sets: &[String]) -> Result<Scene, Told> {
        self.draft_as(sets)?
            .scene()
            .map_err(|error| error.to_string())
    }

    fn draft_as(&self, sets: &[String]) -> Result<Draft, Told> {
        let draft = self.files()?.draft.with(sets);
        draft.map_err(|error| error.to_string())
    }

    pub(super) fn files(&self) -> Result<&Files, Told> {
        let read = self.read.as_deref();
        read.ok_or_else(|| format!("error: {} has not been read", self.scene))
    }

    /// Reads its file, its meshes and its kernels, once for many changes.
    pub(super) fn read_files(&mut self) -> Result<(), Told> {
        let mut tried = Vec::new();
        let mut read = || -> Result<Files, SceneError> {
            let draft = self.loader.draft(&self.scene, &[])?;
            let right = draft.with(&self.sets)?.scene();
            tried.extend(draft.files().into_iter().map(|(_, path)| path));
            right.map(|_| Files { draft })
        };
        let read = read().map_err(|error| error.to_string());
        self.tried = tried;
        let read = read?;
        if let Some((folder, texts)) = &mut self.kernels {
            let read = KernelTexts::read(folder);
            *texts = Arc::new(read.map_err(|told| format!("error: {told}"))?);
        }
        self.read = Some(Rc::new(read));
        self.make_room()
    }

    /// All that depends on what was read last.
    pub(super) fn as_read(&self) -> AsRead {
        AsRead {
            sets: self.sets.clone(),
            read: self.read.clone(),
            room: self.room.clone(),
            kernels: self.kernels.clone(),
            detail: self.detail.clone(),
        }
    }

    /// Makes it what it was.
    pub(super) fn put_back(&mut self, before: AsRead) {
        let AsRead {
            sets,
            read,
            room,
            kernels,
            detail,
        } = before;
        (self.sets, self.read, self.room) = (sets, read, room);
        (self.kernels, self.detail) = (kernels, detail);
    }

    /// Every file that it was read from, or would have been if it were right.
    pub(super) fn paths(&self) -> Vec<PathBuf> {
        let files = self.read.as_ref().map(|read| read.draft.files());
        let files = files.into_iter().flatten().map(|(_, path)| path);
        let kernels = self.kernels.iter();
        let kernels = kernels.flat_map(|(folder, _)| KernelTexts::files(folder));
        let mut paths: Vec<PathBuf> = files.chain(kernels).collect();
        for path in &self.tried {
            if !paths.contains(path) {
                paths.push(path.clone());
            }
        }
        paths
    }

    /// Draws the scene, as its file is now, with that much detail; with all, if what happens hangs on it.
    pub(super) fn draw_as(&mut self, detail: Detail) -> Result<(), Told> {
        let scene = self.load_as(&self.first_sets())?;
        let detail = match hangs_on_pixels(&scene) {
            true => Detail::FULL,
            false => detail,
        };
        self.detail = (detail, detail.sets(&scene));
        Ok(())
    }

    /// A run up to that end on its way to that frame: at the first frame that matters to it, none stepped.
    pub(super) fn set_out(
        &self,
        scene: &Scene,
        done: &Recording,
        (frame, frame_end): (u32, u32),
    ) -> Result<Simulation, Told> {
        let mut simulation = self.prepare(scene, done, frame_end)?;
        simulation.begin_at(simulation.plan().restart_frame(frame));
        Ok(simulation)
    }

    /// What was done, as turns of the scene as it is drawn.
    pub(super) fn turns(&self, done: &Recording) -> Result<Vec<Turn>, Told> {
        let (_, coarser) = &self.detail;
        let mut draft = self.draft_as(&[self.first_sets().as_slice(), coarser].concat())?;
        let turns = done.turns_on(&mut draft, ("", "changes"));
        turns.map_err(|refused| refused.message)
    }

    /// What of it the scene takes as it is now, with all changes of a key left out one of which it refuses;
    /// and these keys.
    pub(super) fn fitting(&self, done: &Recording) -> (Recording, Vec<String>) {
        let (mut fitting, mut left_out) = (done.clone(), Vec::new());
        let (_, coarser) = &self.detail;
        let sets = [self.first_sets().as_slice(), coarser].concat();
        while let Ok(mut draft) = self.draft_as(&sets)
            && let Err(refused) = fitting.turns_on(&mut draft, ("", "changes"))
        {
            let key = refused.change.key().to_owned();
            fitting.changes.retain(|change| change.key() != key);
            left_out.push(key);
        }
        (fitting, left_out)
    }

    /// What can be turned, as it is with these changes.
    pub(super) fn knobs(&self, changes: &[String]) -> Result<Vec<Knob>, Told> {
        let draft = self.draft_as(&[self.first_sets().as_slice(), changes].concat())?;
        draft.knobs().map_err(|error| error.to_string())
    }

    /// The run up to that frame, no frame of which has been stepped.
    pub(super) fn prepare(
        &self,
        scene: &Scene,
        done: &Recording,
        frame_end: u32,
    ) -> Result<Simulation, Told> {
        let options = Options {
            adapter: AdapterChoice::Device(self.device.clone()),
            frame_end,
            turns: self.turns(done)?,
            editable: true,
            gpu: GpuOptions {
                timed: self.is_timed,
                ..GpuOptions::default()
            },
            kernels: self.kernels.as_ref().map(|(_, texts)| Arc::clone(texts)),
            threads: None,
        };
        Simulation::new(scene, &options).map_err(told)
    }
}

/// The end of a run that is at `frame`: there is none to playing, but there is to what lives for ever, of
/// which births of all frames must have their places.
pub(super) fn frame_end(scene: &Scene, frame: u32) -> u32 {
    let played = scene.frames.max(frame.saturating_add(1));
    match lives_for_ever(scene) {
        true => played.max(PLAYED_FRAMES),
        false => scene.frames,
    }
}

/// Whether anything in the scene never dies.
pub(super) fn lives_for_ever(scene: &Scene) -> bool {
    let mut systems = scene.systems.iter();
    systems
        .any(|system| system.lifetime.is_none() || system.particle_shape == ParticleShape::Stroke)
}

pub(super) fn told(error: SimulationError) -> Told {
    error.to_string()
}
