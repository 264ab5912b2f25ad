//! Scenes in a few lines, runs on every backend, and pictures as sums of light.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use motes::backend::{Backend, BackendError, Living};
use motes::cpu::particle::{Appearance, Identity, appearance_of, identity_of, row_index};
use motes::gpu::GpuOptions;
use motes::layout::{FrameStats, Particle};
use motes::plan::{FrameInputs, Plan, Population, Stage};
use motes::scene::Scene;
use motes::simulation::{ParticleState, Simulation};

use crate::common;
use crate::light::{self, Light};

/// At z = 0 a world unit is a pixel, and the origin is the middle of the picture: 64 pixels at
/// 90 degrees from 32 units away.
const PICTURE: &str = "image.width = 64
    image.height = 64
    camera.position = [0, 0, 32]
    camera.target = [0, 0, 0]
    camera.vertical_fov_degrees = 90";

/// A point that stays where it is, one a frame.
const SYSTEM: &str = "name = \"one\"
    initial_mean_parts = 1
    birth_rounding = \"nearest\"
    generation_shape = { kind = \"sphere\", radius = 0 }
    speed = 0
    lifetime = 1000
    color = [0.5, 0.25, 0.125]
    size = 1";

fn key_of(line: &str) -> &str {
    line.split('=').next().unwrap_or_default().trim()
}

/// The lines, and those of `defaults` whose keys they do not have.
fn over(defaults: &str, lines: &str) -> String {
    // The two triples of births exclude each other.
    let is_given = |default: &str| {
        let default = key_of(default);
        let replaces = |key: &str| key == default || key == format!("{default}_per_area");
        lines.lines().any(|line| replaces(key_of(line)))
    };
    let kept = defaults.lines().filter(|line| !is_given(line));
    kept.chain(lines.lines())
        .fold(String::new(), |text, line| text + line.trim() + "\n")
}

/// A scene of lines of TOML, a key each, over the defaults above: `picture` at the top, with
/// dotted keys, and `systems` of a text each.
pub(crate) fn scene(picture: &str, systems: &[&str]) -> Scene {
    let mut text = over(PICTURE, picture);
    for system in systems {
        text += "[[system]]\n";
        text += &over(SYSTEM, system);
    }
    common::scene_of(&text)
}

/// `cpu` and the adapters that tests must run on.
pub(crate) fn backends() -> Vec<String> {
    std::iter::once("cpu".to_owned())
        .chain(common::adapters())
        .collect()
}

/// Runs `test` on the processor and on every adapter.
pub(crate) fn on_every_backend(test: impl Fn(&str)) {
    for name in backends() {
        println!("on {name}");
        let _emptied = light::EmptyAtTheEnd;
        test(&name);
    }
}

/// All of them on the processor, and the first two on an adapter, where a run takes long to begin
/// and gives the same bits.
pub(crate) fn sample<'a, T>(on: &str, all: &'a [T]) -> &'a [T] {
    if on == "cpu" {
        all
    } else {
        &all[..all.len().min(2)]
    }
}

/// What a simulation asked its backend for: the frame, and `step` or `draw`.
pub(crate) type Call = (u32, &'static str);

/// A backend that a simulation and a test hold together.
struct Held {
    backend: Box<dyn Backend>,
    calls: Vec<Call>,
}

#[derive(Clone)]
struct Shared(Arc<Mutex<Held>>);

impl Shared {
    fn held(&self) -> std::sync::MutexGuard<'_, Held> {
        self.0.lock().expect("no other test has it")
    }
}

impl Backend for Shared {
    fn adapter_name(&self) -> String {
        self.held().backend.adapter_name()
    }

    fn is_exact(&self) -> bool {
        self.held().backend.is_exact()
    }

    fn run_stage(&mut self, stage: Stage, inputs: &FrameInputs) -> Result<(), BackendError> {
        let mut held = self.held();
        held.calls.push((inputs.frame.frame, stage.info().name));
        held.backend.run_stage(stage, inputs)
    }

    fn step(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        let mut held = self.held();
        held.calls.push((inputs.frame.frame, "step"));
        held.backend.step(inputs)
    }

    fn draw(&mut self, inputs: &FrameInputs) -> Result<(), BackendError> {
        let mut held = self.held();
        held.calls.push((inputs.frame.frame, "draw"));
        held.backend.draw(inputs)
    }

    fn restore(&mut self, living: &Living<'_>, recent: &[FrameInputs]) -> Result<(), BackendError> {
        self.held().backend.restore(living, recent)
    }

    fn read(&mut self, buffer: &str) -> Result<Vec<u32>, BackendError> {
        self.held().backend.read(buffer)
    }

    fn take_statistics(&mut self) -> Result<Vec<FrameStats>, BackendError> {
        self.held().backend.take_statistics()
    }

    fn population_digest(&mut self, population: Population) -> Result<u64, BackendError> {
        self.held().backend.population_digest(population)
    }

    fn image_digest(&mut self) -> Result<u64, BackendError> {
        self.held().backend.image_digest()
    }
}

/// A living particle: who, its state in the world, and what it looks like.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub(crate) who: Identity,
    pub(crate) raw: Particle,
    pub(crate) state: ParticleState,
    pub(crate) at_birth: Appearance,
    pub(crate) drawn: Appearance,
}

/// A simulation whose backend a test can read.
pub(crate) struct Run {
    pub(crate) simulation: Simulation,
    backend: Shared,
}

impl Run {
    /// A run of `scene`, for frames below `frame_end`, on `cpu` or the adapter of that name.
    pub(crate) fn new(on: &str, scene: &Scene, frame_end: u32) -> Self {
        Self::of_plan(
            on,
            Plan::new(scene, frame_end).expect("the scene can be planned"),
        )
    }

    /// A run of `plan` on `cpu` or the adapter of that name.
    pub(crate) fn of_plan(on: &str, plan: Plan) -> Self {
        let backend: Box<dyn Backend> = match on {
            "cpu" => Box::new(common::on_cpu(&plan)),
            name => Box::new(common::on_gpu(
                &common::open(name),
                &plan,
                &GpuOptions::default(),
            )),
        };
        let backend = Shared(Arc::new(Mutex::new(Held {
            backend,
            calls: Vec::new(),
        })));
        Self {
            simulation: Simulation::with_backend(plan, Box::new(backend.clone())),
            backend,
        }
    }

    /// Steps until `frame` has been stepped, from frame 0 if the run has not begun.
    pub(crate) fn step_to(&mut self, frame: u32) {
        while self
            .simulation
            .frame()
            .is_none_or(|stepped| stepped < frame)
        {
            self.simulation.step().expect("the backend steps");
        }
    }

    /// The inputs of the last frame stepped.
    fn inputs(&self) -> FrameInputs {
        let frame = self.simulation.frame().expect("a frame has been stepped");
        self.simulation.plan().inputs(frame)
    }

    /// The living.
    pub(crate) fn members(&mut self) -> Vec<Member> {
        let states = self.simulation.particles().expect("the state can be read");
        let words = self
            .backend
            .read("particles")
            .expect("the state can be read");
        let inputs = self.inputs();
        let mut rows = (inputs.frame.frame, inputs.rows.clone());
        let member = |(raw, state): (Particle, ParticleState)| {
            let (who, age) = identity_of(&raw, &inputs);
            if rows.0 != who.birth_frame {
                rows = (
                    who.birth_frame,
                    self.simulation.plan().inputs(who.birth_frame).rows,
                );
            }
            let row = &rows.1[row_index(raw.slot(), 0, 0)];
            let at_birth = appearance_of(who, row, 0);
            Member {
                who,
                raw,
                state,
                at_birth,
                drawn: appearance_of(who, row, age + 1),
            }
        };
        let raws: Vec<Particle> = bytemuck::pod_collect_to_vec(&words);
        assert_eq!(raws.len(), states.len());
        raws.into_iter().zip(states).map(member).collect()
    }

    /// Statistics of the frames since the last call.
    pub(crate) fn statistics(&mut self) -> Vec<FrameStats> {
        self.simulation
            .take_statistics()
            .expect("the statistics can be read")
    }

    /// Draws the last frame stepped, and reads the image.
    pub(crate) fn image(&mut self) -> Vec<u8> {
        self.simulation.draw().expect("the backend draws");
        self.simulation.image().expect("the image can be read")
    }

    /// Draws the last frame stepped, and reads the sums of light before they are clamped.
    pub(crate) fn light(&mut self) -> Light {
        self.simulation.draw().expect("the backend draws");
        let mut limbs = |name| self.backend.read(name).expect("the light can be read");
        let (low, high) = (limbs("light_low"), limbs("light_high"));
        let sum = |(low, high): (&u32, &u32)| u64::from(*low) | (u64::from(*high) << 32);
        Light {
            width: self.simulation.plan().width as usize,
            steps: low.iter().zip(&high).map(sum).collect(),
        }
    }

    /// What the simulation asked its backend for since the last call.
    pub(crate) fn take_calls(&mut self) -> Vec<Call> {
        std::mem::take(&mut self.backend.held().calls)
    }
}

/// Fails unless `got` is within a `share` of `expected`.
pub(crate) fn assert_within(what: &str, got: f64, expected: f64, share: f64) {
    let off = got / expected - 1.0;
    println!(
        "{what}: {got:.5}, expected {expected:.5}, off by {:+.3} %",
        off * 100.0
    );
    assert!(
        off.abs() <= share,
        "{what}: {got}, expected {expected}, off by {:+.3} %",
        off * 100.0
    );
}

impl Run {
    /// Births asked for in the last frame stepped, system by system.
    pub(crate) fn births_by_system(&mut self) -> Vec<u32> {
        let births = self.backend.read("birth_counts");
        births.expect("births can be read")
    }

    /// Steps from wherever the run is until `frame` has been stepped, which may be before frame 0.
    pub(crate) fn step_through(&mut self, frame: i32) {
        while self.simulation.frame() != Some(frame.cast_unsigned()) {
            self.simulation.step().expect("the backend steps");
        }
    }
}

/// Who a particle is: system, birth frame, index.
pub(crate) type Who = (u32, u32, u32);

fn who(member: &Member) -> Who {
    (
        member.state.system,
        member.who.birth_frame,
        member.who.index,
    )
}

/// The living of a run after a frame.
pub(crate) fn living(run: &mut Run, frame: u32) -> BTreeMap<Who, Member> {
    run.step_to(frame);
    let members = run.members();
    members
        .into_iter()
        .map(|member| (who(&member), member))
        .collect()
}
