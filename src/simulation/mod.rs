//! The library's front door: a scene under way on an adapter.

mod adapter;
mod boid_lines;
mod draw;
mod error;
mod flock_metrics;
mod inputs;
mod lines;
mod pick;
mod radiance;
mod read;
mod snapshot;
mod spread;

use std::sync::Arc;

pub use crate::gpu::{AdapterDescription, ParticleBuffers, TextureError, UnfitDevice, adapters};
pub use adapter::{AdapterChoice, adapter_names};
pub use error::SimulationError;
pub use flock_metrics::FlockMetrics;
pub use lines::Line;
pub use pick::{Pick, Ray};
pub use radiance::linear_of;
pub use read::{BoidState, FlameState, ParticleState};
pub use snapshot::{Snapshot, SnapshotError};
pub use spread::PointState;

use crate::backend::Backend;
use crate::gpu::GpuOptions;
use crate::gpu::shader::sources::KernelTexts;
use crate::layout::Frame;
use crate::plan::{FrameInputs, Plan, PlanError, Turn};
use crate::scene::Scene;
use adapter::backend;
use inputs::check_sizes;

/// How to run a scene. Nothing here but the turns, and other kernels, changes a bit of the result.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Where.
    pub adapter: AdapterChoice,
    /// One past the last frame that will be stepped; 0 for the scene's own length. The computed
    /// capacity covers frames below it.
    pub frame_end: u32,
    /// Changes of parameters while it runs, as far as they are known.
    pub turns: Vec<Turn>,
    /// Whether there may be more of them ([`Simulation::turn`]). Kernels then leave nothing out,
    /// and parameters are kept frame by frame: somewhat slower.
    pub editable: bool,
    /// How a device is used.
    pub gpu: GpuOptions,
    /// Kernels that a device runs in place of the program's own, which may change bits: for who works
    /// on them.
    pub kernels: Option<Arc<KernelTexts>>,
    /// Threads of the processor's backend; `None` for one a core.
    pub threads: Option<usize>,
}

/// A scene under way. It can be sent to another thread, and be used by one at a time.
pub struct Simulation {
    plan: Plan,
    backend: Box<dyn Backend>,
    /// One past the last frame that was planned for; 0 for the scene's own length.
    frame_end: u32,
    /// Inputs of the last frame stepped.
    inputs: Option<FrameInputs>,
    /// What the image drawn last was drawn with.
    drawn: Option<Frame>,
    next_frame: i32,
}

impl Simulation {
    /// Plans the scene and opens the adapter. No frame has been stepped.
    ///
    /// # Errors
    /// [`SimulationError`]: the scene cannot be planned, there is no such adapter, or it has no
    /// room for the plan.
    pub fn new(scene: &Scene, options: &Options) -> Result<Self, SimulationError> {
        let mut plan = Plan::with_turns(scene, &options.turns, options.frame_end)?;
        if options.editable {
            plan.make_editable();
        }
        let backend = backend(&plan, options)?;
        Ok(Self {
            frame_end: options.frame_end,
            ..Self::with_backend(plan, backend)
        })
    }

    /// On a backend of the caller's making.
    pub fn with_backend(plan: Plan, backend: Box<dyn Backend>) -> Self {
        Self {
            next_frame: plan.first_frame,
            plan,
            backend,
            frame_end: 0,
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
        let lacking = self.plan.uses.lacking(&inputs);
        if !lacking.is_empty() {
            return Err(SimulationError::Plan(PlanError {
                message: format!(
                    "these inputs use what the plan does not: {}",
                    lacking.join(", ")
                ),
                help: "give the plan a scene, or a change, that has all that these inputs have; \
                       `plan::Uses` says what each of these is"
                    .into(),
                key: None,
            }));
        }
        check_sizes(&self.plan, &inputs).map_err(SimulationError::Plan)?;
        // Flocks begin with the run, whichever its first frame.
        inputs.hatches = self.inputs.is_none();
        // What holds for a whole run is the plan's: kernels index by it.
        inputs.frame = Frame {
            frame: self.next_frame.cast_unsigned(),
            wind_count: inputs.winds.len() as u32,
            layer_plane_count: inputs.layer_planes.len() as u32,
            ..self.plan.bounded(inputs.frame)
        };
        if self.inputs.is_none() {
            self.grow_tree(self.next_frame)?;
        }
        self.backend.step(&inputs)?;
        self.inputs = Some(inputs);
        self.next_frame += 1;
        Ok(())
    }

    /// From the next frame on (not before frame 0), the scene is `scene`: as if it had been among
    /// [`Options::turns`], bit for bit. Turns that were known before and come later hold from their
    /// frames on. A turn that is refused leaves the simulation as it was.
    ///
    /// # Errors
    /// The turn alters what holds for a whole run (the list of systems, the number of layers, the
    /// image's size, the seed, the capacity), or has no room in what was begun with: begin with
    /// [`Options::editable`], and give the scene a `capacity` if its births may grow.
    pub fn turn(&mut self, scene: Scene) -> Result<(), SimulationError> {
        let frame = u32::try_from(self.next_frame).unwrap_or(0);
        self.plan = self.plan.turned(Turn { frame, scene }, self.frame_end)?;
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

    /// What the last frame stepped was made from: its view, background and exposure among others.
    pub fn frame_inputs(&self) -> Option<&FrameInputs> {
        self.inputs.as_ref()
    }
}
