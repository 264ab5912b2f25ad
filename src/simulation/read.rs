//! What comes back from a simulation: particles, statistics, digests.

use std::borrow::Cow;

use bytemuck::{Pod, Zeroable};

use super::boid_lines::lines_of_boid;
use super::lines::{line_of, lines_of_flame};
use super::{Line, Simulation, SimulationError};
use crate::backend::BackendError;
use crate::cpu::boid::boid_id;
use crate::cpu::particle::{STREAM_PLACE, draw, identity_of, lifetime_of, row_index};
use crate::cpu::projection::world_of;
use crate::exact::dot3;
use crate::layout::{
    Boid, FLAME_STEPS, Flame, FrameStats, Particle, SYSTEM_PARABOLIC, SystemFrame, SystemRow,
};
use crate::plan::{FrameInputs, Plan, Population};

/// A live particle, for people: world space, units a frame, frames. Its bytes are those of a
/// record of a dump: 40, no padding.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct ParticleState {
    /// World position.
    pub position: [f32; 3],
    /// World velocity, units a frame.
    pub velocity: [f32; 3],
    /// Frames since birth; 0 in the frame of birth.
    pub age: u32,
    /// Frames it has been given in all.
    pub lifetime: u32,
    /// Index of its system in the scene.
    pub system: u32,
    /// A hash of who it is: the same in every run of the scene and seed.
    pub id: u32,
}

/// A boid, for people: world space, units a frame. Its bytes are those of a record of a dump: 32,
/// no padding.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct BoidState {
    /// World position.
    pub position: [f32; 3],
    /// World velocity, units a frame.
    pub velocity: [f32; 3],
    /// Index of its flock in the scene.
    pub flock: u32,
    /// A hash of who it is: the same in every run of the scene and seed.
    pub id: u32,
}

/// A flame that burns, for people: world space, frames. Its bytes are those of a record of a dump:
/// 36, no padding.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct FlameState {
    /// Its root.
    pub position: [f32; 3],
    /// The unit vector that it leaves along.
    pub normal: [f32; 3],
    /// Frames since it was kindled; 0 in the frame in which it is.
    pub age: u32,
    /// Frames that it burns in all; 0 for ever.
    pub lifetime: u32,
    /// Index of its fire in the scene.
    pub fire: u32,
}

/// Systems that others have borne: their frames now, and their rows of all frames that count.
#[derive(Default)]
struct Borne {
    systems: Vec<SystemFrame>,
    rows: Vec<SystemRow>,
}

impl Borne {
    /// The inputs with them.
    fn filled<'a>(&self, inputs: &'a FrameInputs) -> Cow<'a, FrameInputs> {
        if self.systems.is_empty() {
            return Cow::Borrowed(inputs);
        }
        let mut filled = inputs.clone();
        filled.systems.extend_from_slice(&self.systems);
        Cow::Owned(filled)
    }

    /// Their rows of a frame.
    fn rows_of<'a>(&'a self, plan: &Plan, frame: u32) -> impl Iterator<Item = SystemRow> + 'a {
        let (first, mask) = (plan.own_system_count, plan.row_count - 1);
        let slots = first..first + self.systems.len() as u32;
        slots.map(move |slot| self.rows[row_index(slot, frame, mask)])
    }
}

impl Simulation {
    /// Systems that others have borne, as the backend has them.
    fn borne(&mut self) -> Result<Borne, SimulationError> {
        if self.plan.tree_levels == 0 {
            return Ok(Borne::default());
        }
        Ok(Borne {
            systems: bytemuck::pod_collect_to_vec(&self.backend.read("borne_systems")?),
            rows: bytemuck::pod_collect_to_vec(&self.backend.read("rows")?),
        })
    }

    /// The flames that burn, by fire and index; none before the first frame is stepped.
    ///
    /// # Errors
    /// The machine fails.
    pub fn flames(&mut self) -> Result<Vec<FlameState>, SimulationError> {
        Ok(self
            .burning()?
            .into_iter()
            .map(|(_, state)| state)
            .collect())
    }

    /// A light for each flame that burns, in the order of [`Simulation::flames`]: the mean place of
    /// its particle (Perry 1994, 3.2.4), world space.
    ///
    /// # Errors
    /// The machine fails.
    pub fn flame_lights(&mut self) -> Result<Vec<[f32; 3]>, SimulationError> {
        let burning = self.burning()?;
        if burning.is_empty() {
            return Ok(Vec::new());
        }
        let words = self.backend.read("flame_steps")?;
        let steps: &[[u32; 4]] = bytemuck::cast_slice(&words);
        let mean = |(at, _): (usize, FlameState)| {
            let own = steps.iter().skip(at * FLAME_STEPS as usize);
            let places = own.take(FLAME_STEPS as usize);
            let sum = places.fold([0.0; 3], |sum: [f32; 3], [x, y, z, _]| {
                let place = [x, y, z].map(|bits| f32::from_bits(*bits));
                [0, 1, 2].map(|axis| sum[axis] + place[axis])
            });
            sum.map(|sum| sum / FLAME_STEPS as f32)
        };
        Ok(burning.into_iter().map(mean).collect())
    }

    /// Where each flame that burns stands among all, and what it is.
    fn burning(&mut self) -> Result<Vec<(usize, FlameState)>, SimulationError> {
        let Some(inputs) = self
            .inputs
            .as_ref()
            .filter(|inputs| !inputs.fires.is_empty())
        else {
            return Ok(Vec::new());
        };
        let words = self.backend.read("flames")?;
        let flames: &[Flame] = bytemuck::cast_slice(&words);
        let state = |flame: &Flame| FlameState {
            position: flame.root(),
            normal: flame.normal(),
            age: inputs.frame.frame.wrapping_sub(flame.normal_and_birth[3]),
            lifetime: inputs.fires[flame.fire() as usize].times[2],
            fire: flame.fire(),
        };
        let burning = flames.iter().enumerate().filter(|(_, flame)| flame.burns());
        Ok(burning.map(|(at, flame)| (at, state(flame))).collect())
    }

    /// The boids, by flock and index; none before the first frame is stepped.
    ///
    /// # Errors
    /// The machine fails.
    pub fn boids(&mut self) -> Result<Vec<BoidState>, SimulationError> {
        let Some(inputs) = &self.inputs else {
            return Ok(Vec::new());
        };
        if self.plan.flock_count == 0 {
            return Ok(Vec::new());
        }
        let words = self.backend.read("boids")?;
        let boids: &[Boid] = bytemuck::cast_slice(&words);
        let state = |boid: &Boid| BoidState {
            position: boid.position(),
            velocity: boid.velocity(),
            flock: boid.flock(),
            id: boid_id(&inputs.flocks[boid.flock() as usize], boid.index()),
        };
        Ok(boids.iter().map(state).collect())
    }

    /// The living particles, in storage order: by birth frame, system and index.
    ///
    /// # Errors
    /// The machine fails.
    pub fn particles(&mut self) -> Result<Vec<ParticleState>, SimulationError> {
        let mut states: Vec<ParticleState> = Vec::new();
        let borne = self.borne()?;
        let words = self.backend.read("particles")?;
        let count = words.len() * 4 / size_of::<Particle>();
        states
            .try_reserve_exact(count)
            .map_err(|_| BackendError::OutOfMemory(format!("the states of {count} particles")))?;
        self.for_each_particle(&words, &borne, |particle, inputs, rows| {
            states.push(state_of(particle, inputs, rows));
        });
        Ok(states)
    }

    /// Hands over the living, whose words these are, in storage order, each with the parameter rows
    /// of its birth frame.
    fn for_each_particle(
        &self,
        words: &[u32],
        borne: &Borne,
        mut take: impl FnMut(&Particle, &FrameInputs, &[SystemRow]),
    ) {
        let Some(inputs) = &self.inputs else {
            return;
        };
        let inputs = &borne.filled(inputs);
        let particles: &[Particle] = bytemuck::cast_slice(words);
        let mut rows: Vec<SystemRow> = Vec::new();
        let mut rows_frame = None;
        for particle in particles {
            let (who, _) = identity_of(particle, inputs);
            if rows_frame != Some(who.birth_frame) {
                rows = self.plan.inputs(who.birth_frame).rows;
                rows.extend(borne.rows_of(&self.plan, who.birth_frame));
                rows_frame = Some(who.birth_frame);
            }
            take(particle, inputs, &rows);
        }
    }

    /// The living as line segments, in storage order: particles (Reeves 1983, 4.2), then flames,
    /// then boids; without those that reach nearer than the camera sees.
    ///
    /// # Errors
    /// The machine fails.
    pub fn lines(&mut self) -> Result<Vec<Line>, SimulationError> {
        let mut lines = Vec::new();
        let borne = self.borne()?;
        let words = self.backend.read("particles")?;
        self.for_each_particle(&words, &borne, |particle, inputs, rows| {
            lines.extend(line_of(particle, inputs, rows));
        });
        let Some(inputs) = &self.inputs else {
            return Ok(lines);
        };
        if !inputs.fires.is_empty() {
            let (flames, steps) = (
                self.backend.read("flames")?,
                self.backend.read("flame_steps")?,
            );
            let flames: &[Flame] = bytemuck::cast_slice(&flames);
            let steps: &[[u32; 4]] = bytemuck::cast_slice(&steps);
            let each = flames.iter().zip(steps.chunks(FLAME_STEPS as usize));
            for (flame, steps) in each.filter(|(flame, _)| flame.burns()) {
                lines.extend(lines_of_flame(flame, steps, inputs));
            }
        }
        if !inputs.flocks.is_empty() {
            let words = self.backend.read("boids")?;
            let boids: &[Boid] = bytemuck::cast_slice(&words);
            let words = self.backend.read("boid_trails")?;
            let trails: &[[u32; 4]] = bytemuck::cast_slice(&words);
            let of = |boid| lines_of_boid(boid, trails, inputs);
            lines.extend(boids.iter().flat_map(of));
        }
        Ok(lines)
    }

    /// Statistics of all frames stepped since the last call.
    ///
    /// # Errors
    /// The machine fails.
    pub fn take_statistics(&mut self) -> Result<Vec<FrameStats>, SimulationError> {
        Ok(self.backend.take_statistics()?)
    }

    /// Digest of all that lives: equal digests mean equal states.
    ///
    /// # Errors
    /// The machine fails.
    pub fn state_digest(&mut self) -> Result<u64, SimulationError> {
        Ok(self.backend.state_digest()?)
    }

    /// Digest of one population.
    ///
    /// # Errors
    /// The machine fails.
    pub fn population_digest(&mut self, population: Population) -> Result<u64, SimulationError> {
        Ok(self.backend.population_digest(population)?)
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
