//! The library's front door: a scene under way on an adapter.

mod error;
mod lines;
mod radiance;
mod snapshot;

pub use error::SimulationError;
pub use lines::Line;
pub use radiance::linear_of;
pub use snapshot::{Snapshot, SnapshotError};

use crate::backend::Backend;
use crate::cpu::CpuBackend;
use crate::cpu::particle::{STREAM_PLACE, draw, identity_of, lifetime_of, row_index};
use crate::cpu::projection::world_of;
use crate::exact::dot3;
use crate::gpu::{self, AdapterDescription, GpuBackend, GpuOptions};
use crate::layout::{
    Frame, FrameStats, Particle, SHAPE_CURVE, SYSTEM_PARABOLIC, SystemFrame, SystemRow,
};
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
    /// What the image drawn last was drawn with.
    drawn: Option<Frame>,
    next_frame: i32,
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
            next_frame: plan.first_frame,
            plan,
            backend,
            inputs: None,
            drawn: None,
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

    /// The last frame that has been stepped; modulo 2^32 before frame 0.
    pub fn frame(&self) -> Option<u32> {
        self.inputs.as_ref().map(|inputs| inputs.frame.frame)
    }

    /// Steps the next frame: births, deaths, motion. May return before the device is done.
    ///
    /// # Errors
    /// The machine fails.
    pub fn step(&mut self) -> Result<(), SimulationError> {
        let inputs = self.plan.inputs(self.next_frame.cast_unsigned());
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
                help: "give the plan a system, or a change, that has all that these inputs have: \
                       particle shapes, thresholds, bounds, drag, noise, layers and the like"
                    .into(),
            }));
        }
        check_sizes(&self.plan, &inputs).map_err(SimulationError::Plan)?;
        // What holds for a whole run is the plan's: kernels index by it.
        inputs.frame = Frame {
            frame: self.next_frame.cast_unsigned(),
            wind_count: inputs.winds.len() as u32,
            layer_plane_count: inputs.layer_planes.len() as u32,
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
    pub fn seek_from(&mut self, first: i32, frame: u32) -> Result<(), SimulationError> {
        self.begin_at(first);
        while i64::from(self.next_frame) <= i64::from(frame) {
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
            self.drawn = Some(inputs.frame);
        }
        Ok(())
    }

    /// What the last frame stepped was made from: its view, background and exposure among others.
    pub fn frame_inputs(&self) -> Option<&FrameInputs> {
        self.inputs.as_ref()
    }

    /// Names of the picture's layers: those of the scene and `rest`; `particles` alone if the scene
    /// has none.
    pub fn layer_names(&self) -> Vec<String> {
        self.plan.layer_names()
    }

    /// Draws one layer of the last frame stepped, on black: the light of the particles in it.
    /// Layers sum to the whole, step by step of light.
    ///
    /// # Errors
    /// The machine fails.
    pub fn draw_layer(&mut self, index: usize) -> Result<(), SimulationError> {
        let Some(inputs) = &self.inputs else {
            return Ok(());
        };
        let mut inputs = inputs.clone();
        inputs.frame.background = [0.0; 4];
        inputs.frame.layer = if inputs.layer_planes.is_empty() {
            0
        } else {
            index as u32 + 1
        };
        self.backend.draw(&inputs)?;
        self.drawn = Some(inputs.frame);
        Ok(())
    }

    /// The living as line segments, in storage order; without those that reach nearer than the
    /// camera sees (Reeves 1983, 4.2).
    ///
    /// # Errors
    /// The machine fails.
    pub fn lines(&mut self) -> Result<Vec<Line>, SimulationError> {
        let mut lines = Vec::new();
        self.for_each_particle(|particle, inputs, rows| {
            lines.extend(lines::line_of(particle, inputs, rows));
        })?;
        Ok(lines)
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
        let mut states = Vec::new();
        self.for_each_particle(|particle, inputs, rows| {
            states.push(state_of(particle, inputs, rows));
        })?;
        Ok(states)
    }

    /// Hands over the living, in storage order, each with the parameter rows of its birth frame.
    fn for_each_particle(
        &mut self,
        mut take: impl FnMut(&Particle, &FrameInputs, &[SystemRow]),
    ) -> Result<(), SimulationError> {
        let Some(inputs) = &self.inputs else {
            return Ok(());
        };
        let words = self.backend.read("particles")?;
        let particles: Vec<Particle> = bytemuck::pod_collect_to_vec(&words);
        let mut rows: Vec<SystemRow> = Vec::new();
        let mut rows_frame = None;
        for particle in &particles {
            let (who, _) = identity_of(particle, inputs);
            if rows_frame != Some(who.birth_frame) {
                rows = self.plan.inputs(who.birth_frame).rows;
                rows_frame = Some(who.birth_frame);
            }
            take(particle, inputs, &rows);
        }
        Ok(())
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

/// A particle as people see it; `rows` are those of its birth frame.
fn state_of(particle: &Particle, inputs: &FrameInputs, rows: &[SystemRow]) -> ParticleState {
    let (who, age) = identity_of(particle, inputs);
    let slot = particle.slot();
    let system = &inputs.systems[slot as usize];
    let row = &rows[row_index(slot, 0, 0)];
    let position = world_of(system, particle.position().into());
    // A velocity only turns: taking the origin away again would cost it its last digits.
    let mut velocity = glam::Vec3::from(particle.velocity());
    if system.flags & SYSTEM_PARABOLIC != 0 {
        // What is stored is that halfway through the next frame.
        velocity -= glam::Vec3::from_slice(&system.acceleration) * 0.5;
    }
    let turned = |[x, y, z, _]: [f32; 4]| dot3(glam::Vec3::new(x, y, z), velocity);
    ParticleState {
        position: position.into(),
        velocity: [
            turned(system.world_from_system_x),
            turned(system.world_from_system_y),
            turned(system.world_from_system_z),
        ],
        age,
        lifetime: lifetime_of(who, row.speed_and_lifetime),
        system: slot,
        id: draw(who, STREAM_PLACE).x,
    }
}

/// Whether lists of the caller's making are as long as the plan's, or as they can be.
fn check_sizes(plan: &Plan, inputs: &FrameInputs) -> Result<(), PlanError> {
    let refuse = |message: String, help: String| Err(PlanError { message, help });
    let slots = plan.system_count as usize;
    if inputs.systems.len() != slots || inputs.rows.len() != slots {
        return refuse(
            format!(
                "inputs for {} systems and {} rows",
                inputs.systems.len(),
                inputs.rows.len()
            ),
            format!("this plan has {slots} of each"),
        );
    }
    for (what, count, most) in [
        ("bounds", inputs.bounds.len(), Plan::MOST_BOUNDS),
        ("winds", inputs.winds.len(), Plan::MOST_WINDS),
        ("layer planes", inputs.layer_planes.len(), Plan::MOST_LAYERS),
    ] {
        if count > most as usize {
            return refuse(format!("{count} {what}"), format!("at most {most}"));
        }
    }
    let end = |system: &SystemFrame| u64::from(system.first_bound) + u64::from(system.bound_count);
    let last = inputs.systems.iter().map(end).max().unwrap_or(0);
    if last > inputs.bounds.len() as u64 {
        return refuse(
            format!("a system's bounds end at {last}"),
            format!("there are {}", inputs.bounds.len()),
        );
    }
    let is_stored = |row: &SystemRow| {
        let [_, first, len, _] = row.shape;
        let stored = plan.curve_points.len() as f32;
        row.kinds[0] != SHAPE_CURVE || (first >= 0.0 && len >= 1.0 && first + len < stored)
    };
    if !inputs.rows.iter().all(is_stored) {
        return refuse(
            "a row names points of curves that the plan has not".into(),
            "give the plan a system that is born on that curve".into(),
        );
    }
    Ok(())
}

/// All adapters, best first; the processor is not among them.
pub fn adapters() -> Vec<AdapterDescription> {
    gpu::adapters()
}
