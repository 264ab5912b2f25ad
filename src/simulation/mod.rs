//! The library's front door: a scene under way on an adapter.

mod error;

pub use error::SimulationError;

use crate::backend::Backend;
use crate::cpu::CpuBackend;
use crate::cpu::footprint::world_of;
use crate::cpu::particle::{STREAM_PLACE, draw, identity_of, lifetime_of, row_index};
use crate::exact::dot3;
use crate::gpu::{self, AdapterDescription, GpuBackend, GpuOptions};
use crate::layout::{FrameStats, Particle, SystemRow};
use crate::plan::{FrameInputs, Plan, PlanError, Turn};
use crate::scene::Scene;

/// Which adapter to run on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// Hardware, else software Vulkan, else the processor.
    #[default]
    Auto,
    /// The processor, without any driver.
    Cpu,
    /// The first adapter whose name or driver contains this, whatever the case.
    Named(String),
}

impl AdapterChoice {
    /// As people write it: `auto`, `cpu`, or part of an adapter's name.
    pub fn parse(text: &str) -> Self {
        match text.trim().to_lowercase().as_str() {
            "" | "auto" => Self::Auto,
            "cpu" => Self::Cpu,
            name => Self::Named(name.to_owned()),
        }
    }
}

/// How to run a scene. Nothing here but the turns changes a bit of the result.
#[derive(Default)]
pub struct Options<'a> {
    /// Where.
    pub adapter: AdapterChoice,
    /// One past the last frame that will be stepped; 0 for the scene's own length. The computed
    /// capacity covers frames below it.
    pub frame_end: u32,
    /// Changes of parameters while it runs.
    pub turns: Vec<Turn>,
    /// How a device is used.
    pub gpu: GpuOptions<'a>,
    /// Threads of the processor's backend; `None` for one a core.
    pub threads: Option<usize>,
}

/// A live particle, for people: world space, units a frame, frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleState {
    /// World position.
    pub position: [f32; 3],
    /// World velocity, units a frame.
    pub velocity: [f32; 3],
    /// Frames since birth.
    pub age: u32,
    /// Frames it has been given in all.
    pub lifetime: u32,
    /// Index of its system in the scene.
    pub system: u32,
    /// A hash of who it is: the same in every run of the scene and seed.
    pub id: u32,
}

/// A scene under way.
pub struct Simulation {
    plan: Plan,
    backend: Box<dyn Backend>,
    /// Inputs of the last frame stepped.
    inputs: Option<FrameInputs>,
    next_frame: u32,
}

/// The names of all adapters that a choice can name.
pub fn adapter_names() -> Vec<String> {
    let mut names: Vec<_> = gpu::adapters()
        .into_iter()
        .map(|adapter| adapter.name)
        .collect();
    names.push("cpu".into());
    names
}

fn backend(plan: &Plan, options: &Options) -> Result<Box<dyn Backend>, SimulationError> {
    let on_cpu = || -> Result<Box<dyn Backend>, SimulationError> {
        Ok(Box::new(CpuBackend::new(plan, options.threads)?))
    };
    let on = |device: &gpu::GpuDevice| -> Result<Box<dyn Backend>, SimulationError> {
        Ok(Box::new(GpuBackend::new(device, plan, &options.gpu)?))
    };
    match &options.adapter {
        AdapterChoice::Cpu => on_cpu(),
        AdapterChoice::Named(name) => match gpu::open(name)? {
            Some(device) => on(&device),
            None => Err(SimulationError::NoAdapter {
                wanted: name.clone(),
                available: adapter_names(),
            }),
        },
        // An adapter that does not open, or has no room, is passed over.
        AdapterChoice::Auto => gpu::adapters()
            .iter()
            .filter_map(|adapter| gpu::open(&adapter.name).ok().flatten())
            .find_map(|device| on(&device).ok())
            .map_or_else(on_cpu, Ok),
    }
}

impl Simulation {
    /// Plans the scene and opens the adapter. No frame has been stepped.
    ///
    /// # Errors
    /// [`SimulationError`].
    pub fn new(scene: &Scene, options: &Options) -> Result<Self, SimulationError> {
        let plan = Plan::with_turns(scene, &options.turns, options.frame_end)?;
        let backend = backend(&plan, options)?;
        Ok(Self::with_backend(plan, backend))
    }

    /// On a backend of the caller's making.
    pub fn with_backend(plan: Plan, backend: Box<dyn Backend>) -> Self {
        Self {
            plan,
            backend,
            inputs: None,
            next_frame: 0,
        }
    }

    /// The plan that it follows.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Name of the adapter that it runs on.
    pub fn adapter_name(&self) -> String {
        self.backend.adapter_name()
    }

    /// Whether its bits are those of every exact adapter.
    pub fn is_exact(&self) -> bool {
        self.backend.is_exact()
    }

    /// The last frame that has been stepped.
    pub fn frame(&self) -> Option<u32> {
        self.inputs.as_ref().map(|inputs| inputs.frame.frame)
    }

    /// Steps the next frame: births, deaths, motion. May return before the device is done.
    ///
    /// # Errors
    /// The machine fails.
    pub fn step(&mut self) -> Result<(), SimulationError> {
        let inputs = self.plan.inputs(self.next_frame);
        self.step_with(inputs)
    }

    /// Steps the next frame with inputs of the caller's making; its frame number, and all sizes and
    /// counts, are set here.
    ///
    /// # Errors
    /// The machine fails, or the inputs use what the plan does not ([`crate::plan::Uses`]).
    pub fn step_with(&mut self, mut inputs: FrameInputs) -> Result<(), SimulationError> {
        if !self.plan.uses.cover(&inputs) {
            return Err(SimulationError::Plan(PlanError {
                message: "these inputs use what no system of the plan does".into(),
                help: "give the plan a system, or a change, that has the same particle shapes \
                       and an intensity threshold where the inputs have one"
                    .into(),
            }));
        }
        let slots = self.plan.system_count as usize;
        if inputs.systems.len() != slots || inputs.rows.len() != slots {
            return Err(SimulationError::Plan(PlanError {
                message: format!(
                    "inputs for {} systems and {} rows",
                    inputs.systems.len(),
                    inputs.rows.len()
                ),
                help: format!("this plan has {slots} of each"),
            }));
        }
        // What holds for a whole run is the plan's: kernels index by it.
        inputs.frame = crate::layout::Frame {
            frame: self.next_frame,
            ..self.plan.bounded(inputs.frame)
        };
        self.backend.step(&inputs)?;
        self.inputs = Some(inputs);
        self.next_frame += 1;
        Ok(())
    }

    /// Steps, undrawn, until `frame` has been stepped. A run that has not begun starts at the
    /// earliest frame that can still be seen in it (Reeves 1983, section 3), with the same result
    /// as the whole run, as long as no births were dropped.
    ///
    /// # Errors
    /// The machine fails.
    pub fn seek(&mut self, frame: u32) -> Result<(), SimulationError> {
        self.seek_from(self.plan.restart_frame(frame), frame)
    }

    /// As [`Simulation::seek`], but a run that has not begun starts at frame `first`, empty.
    ///
    /// # Errors
    /// The machine fails.
    pub fn seek_from(&mut self, first: u32, frame: u32) -> Result<(), SimulationError> {
        if self.inputs.is_none() {
            self.next_frame = first;
        }
        while self.next_frame <= frame {
            self.step()?;
        }
        Ok(())
    }

    /// Draws the last frame stepped.
    ///
    /// # Errors
    /// The machine fails.
    pub fn draw(&mut self) -> Result<(), SimulationError> {
        if let Some(inputs) = &self.inputs {
            self.backend.draw(inputs)?;
        }
        Ok(())
    }

    /// The image drawn last: RGBA, four bytes a pixel, rows from the top.
    ///
    /// # Errors
    /// The machine fails.
    pub fn image(&mut self) -> Result<Vec<u8>, SimulationError> {
        let pixels = self.backend.read("image")?;
        Ok(pixels.into_iter().flat_map(u32::to_le_bytes).collect())
    }

    /// The living, in storage order: by birth frame, system and index.
    ///
    /// # Errors
    /// The machine fails.
    pub fn particles(&mut self) -> Result<Vec<ParticleState>, SimulationError> {
        let Some(inputs) = &self.inputs else {
            return Ok(Vec::new());
        };
        let words = self.backend.read("particles")?;
        let particles: Vec<Particle> = bytemuck::pod_collect_to_vec(&words);
        // Rows of earlier frames, as far back as a particle can have been born.
        let rows_of = |birth_frame: u32| self.plan.inputs(birth_frame).rows;
        let mut rows: Vec<SystemRow> = Vec::new();
        let mut rows_frame = None;
        Ok(particles
            .iter()
            .map(|particle| {
                let (who, age) = identity_of(particle, inputs);
                if rows_frame != Some(who.birth_frame) {
                    rows = rows_of(who.birth_frame);
                    rows_frame = Some(who.birth_frame);
                }
                let slot = particle.slot();
                let system = &inputs.systems[slot as usize];
                let row = &rows[row_index(slot, 0, 0)];
                let position = world_of(system, particle.position().into());
                // A velocity only turns: taking the origin away again would cost it its last digits.
                let turned = |[x, y, z, _]: [f32; 4]| {
                    dot3(glam::Vec3::new(x, y, z), particle.velocity().into())
                };
                let velocity = glam::Vec3::new(
                    turned(system.world_from_system_x),
                    turned(system.world_from_system_y),
                    turned(system.world_from_system_z),
                );
                ParticleState {
                    position: position.into(),
                    velocity: velocity.into(),
                    age,
                    lifetime: lifetime_of(who, row.speed_and_lifetime),
                    system: slot,
                    id: draw(who, STREAM_PLACE).x,
                }
            })
            .collect())
    }

    /// Statistics of all frames stepped since the last call.
    ///
    /// # Errors
    /// The machine fails.
    pub fn take_statistics(&mut self) -> Result<Vec<FrameStats>, SimulationError> {
        Ok(self.backend.take_statistics()?)
    }

    /// Digest of the living: equal digests mean equal states.
    ///
    /// # Errors
    /// The machine fails.
    pub fn state_digest(&mut self) -> Result<u64, SimulationError> {
        Ok(self.backend.state_digest()?)
    }

    /// Digest of the image drawn last.
    ///
    /// # Errors
    /// The machine fails.
    pub fn image_digest(&mut self) -> Result<u64, SimulationError> {
        Ok(self.backend.image_digest()?)
    }
}

/// All adapters, best first; the processor is not among them.
pub fn adapters() -> Vec<AdapterDescription> {
    gpu::adapters()
}
