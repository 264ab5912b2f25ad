//! A run's whole state, to go on from without stepping again what led to it.
//!
//! Most runs need none: whoever is alive was born at most a lifetime ago, so a run can be entered
//! anywhere from one lifetime before. Where particles live without limit, births are dropped for
//! want of room or boids fly, the whole past counts, and a snapshot stands for it.

use std::io::{self, Write};

use super::{Simulation, SimulationError};
use crate::backend::Living;
use crate::cpu::digest;
use crate::layout::{Boid, DroppedFlame, Particle, SpreadCounts, SpreadPoint};
use crate::plan::{Plan, Stage};

/// What the bytes of a snapshot begin with; the last is the version of what follows.
const MAGIC: &[u8; 8] = b"motes-s\x04";

/// Words between that and the particles: frame, number of systems, number of particles, number of
/// boids, number of places of their trails, words of fronts.
const HEAD_WORDS: usize = 6;

/// Words of a particle.
const PARTICLE_WORDS: usize = size_of::<Particle>() / 4;

/// Words of a boid.
const BOID_WORDS: usize = size_of::<Boid>() / 4;

/// Words of a place of a trail.
const PLACE_WORDS: usize = 4;
/// Words of a dropped flame.
const DROPPED_WORDS: usize = size_of::<DroppedFlame>() / 4;

/// Words of a control point.
const POINT_WORDS: usize = size_of::<SpreadPoint>() / 4;

/// The living after some frame, as they are stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snapshot {
    frame: i32,
    system_count: u32,
    /// Particles, then boids, then the places of their trails, then fronts.
    words: Vec<u32>,
    live: u32,
    boid_count: u32,
    place_count: u32,
    front_words: u32,
}

/// Why bytes are no snapshot, or not one of that run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SnapshotError {
    /// They do not begin as a snapshot does, or as one of another version.
    NotASnapshot,
    /// They end too early or too late, or have been changed.
    Damaged,
    /// The run has other systems, fewer places, or begins later.
    OfAnotherRun,
    /// There is no room in memory for it.
    TooLarge,
}

impl std::fmt::Display for SnapshotError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::NotASnapshot => "this is no snapshot of this version of Motes",
            Self::Damaged => "the snapshot is damaged",
            Self::OfAnotherRun => "the snapshot is of another run",
            Self::TooLarge => "there is no room in memory for the snapshot",
        })
    }
}

impl std::error::Error for SnapshotError {}

impl Snapshot {
    /// The last frame that had been stepped; below 0 in what comes before a scene's beginning.
    pub fn frame(&self) -> i32 {
        self.frame
    }

    /// How many particles were alive.
    pub fn live(&self) -> u32 {
        self.live
    }

    /// The particles' words, the boids', their trails' and the fronts'.
    fn living(&self) -> Living<'_> {
        let (particles, rest) = self.words.split_at(self.live as usize * PARTICLE_WORDS);
        let (boids, rest) = rest.split_at(self.boid_count as usize * BOID_WORDS);
        let (trails, front) = rest.split_at(self.place_count as usize * PLACE_WORDS);
        Living {
            particles,
            boids,
            trails,
            front,
        }
    }

    /// Writes the bytes that [`Snapshot::from_bytes`] reads, the same on every machine: 40, 32 for
    /// each particle and each boid, 16 for each place of a boid's trail, and if any fire spreads 64, 8 for
    /// each ring, 64 for each control point and 48 for each place of a dropped flame.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_to(&self, out: &mut impl Write) -> io::Result<()> {
        let head = self.head();
        out.write_all(MAGIC)?;
        for word in head.iter().chain(&self.words) {
            out.write_all(&word.to_le_bytes())?;
        }
        out.write_all(&seal(&head, &self.words).to_le_bytes())
    }

    fn head(&self) -> [u32; HEAD_WORDS] {
        [
            self.frame.cast_unsigned(),
            self.system_count,
            self.live,
            self.boid_count,
            self.place_count,
            self.front_words,
        ]
    }

    /// Reads what [`Snapshot::write_to`] wrote.
    ///
    /// # Errors
    /// [`SnapshotError::NotASnapshot`], [`SnapshotError::Damaged`], [`SnapshotError::TooLarge`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        let rest = bytes
            .strip_prefix(MAGIC)
            .ok_or(SnapshotError::NotASnapshot)?;
        let (body, found) = rest.split_last_chunk::<8>().ok_or(SnapshotError::Damaged)?;
        let (quads, odd) = body.as_chunks::<4>();
        let mut body = quads.iter().map(|word| u32::from_le_bytes(*word));
        let head = [(); HEAD_WORDS].map(|()| body.next());
        let [
            Some(frame),
            Some(system_count),
            Some(live),
            Some(boid_count),
            Some(place_count),
            Some(front_words),
        ] = head
        else {
            return Err(SnapshotError::Damaged);
        };
        let mut words = Vec::new();
        words
            .try_reserve_exact(body.len())
            .map_err(|_| SnapshotError::TooLarge)?;
        words.extend(body);
        let is_whole = odd.is_empty()
            && words.len() as u64
                == u64::from(live) * PARTICLE_WORDS as u64
                    + u64::from(boid_count) * BOID_WORDS as u64
                    + u64::from(place_count) * PLACE_WORDS as u64
                    + u64::from(front_words)
            && u64::from_le_bytes(*found)
                == seal(
                    &[
                        frame,
                        system_count,
                        live,
                        boid_count,
                        place_count,
                        front_words,
                    ],
                    &words,
                );
        is_whole
            .then(|| Self {
                frame: frame.cast_signed(),
                system_count,
                words,
                live,
                boid_count,
                place_count,
                front_words,
            })
            .ok_or(SnapshotError::Damaged)
    }
}

/// Whether these are words of fronts of the plan: kernels index by faces, rings and slots.
fn front_fits(plan: &Plan, front: &[u32]) -> bool {
    const COUNT_WORDS: usize = size_of::<SpreadCounts>() / 4;
    if plan.spread_count == 0 {
        return front.is_empty();
    }
    let Some((counts, rest)) = front.split_first_chunk::<COUNT_WORDS>() else {
        return false;
    };
    let rings = plan.ring_count as usize;
    let flames = plan.dropped_places as usize * DROPPED_WORDS;
    let catches = 4 * plan.ignitions.piece_count() as usize;
    if rest.len() < 2 * rings + flames + catches {
        return false;
    }
    let (spans, rest) = rest.split_at(2 * rings);
    let (flames, rest) = rest.split_at(flames);
    let (catches, points) = rest.split_at(catches);
    let (catches, _) = catches.as_chunks::<4>();
    // Each piece burns where one of its faces is.
    let is_on = |(caught, [first, count]): (&[u32; 4], [u32; 2])| {
        caught[0] == 0 || (first..first + count).contains(&caught[1])
    };
    let (flames, _) = flames.as_chunks::<DROPPED_WORDS>();
    let (points, odd) = points.as_chunks::<POINT_WORDS>();
    let [total, ..] = *counts;
    let (spans, _) = spans.as_chunks::<2>();
    // Each ring is where its span says, one after the other.
    let is_in_place = |(at, point): (u32, &[u32; POINT_WORDS])| {
        let (face, ring, slot) = (point[2], point[3], point[15]);
        let span = spans.get(ring as usize);
        (face as usize) < plan.spreads.faces.len()
            && slot < plan.spread_count
            && span.is_some_and(|[first, last]| (*first..=*last).contains(&at) && *last < total)
    };
    let has_fire = |flame: &[u32; DROPPED_WORDS]| flame[3] < plan.fire_count;
    odd.is_empty()
        && flames.iter().all(has_fire)
        && catches.iter().zip(plan.ignitions.piece_faces()).all(is_on)
        && total as usize == points.len()
        && total <= plan.point_capacity
        && (0..).zip(points).all(is_in_place)
}

/// What tells changed words from unchanged ones.
fn seal(head: &[u32], words: &[u32]) -> u64 {
    digest(head, 1).rotate_left(1) ^ digest(words, 1)
}

impl Simulation {
    /// The state after the last frame stepped; `None` before the first.
    ///
    /// # Errors
    /// The machine fails.
    pub fn snapshot(&mut self) -> Result<Option<Snapshot>, SimulationError> {
        let Some(inputs) = &self.inputs else {
            return Ok(None);
        };
        let frame = inputs.frame.frame.cast_signed();
        let mut words = self.backend.read("particles")?;
        let live = (words.len() / PARTICLE_WORDS) as u32;
        if self.plan.boid_count > 0 {
            words.extend(self.backend.read("boids")?);
        }
        if self.plan.boid_trail_count > 0 {
            words.extend(self.backend.read("boid_trails")?);
        }
        let others = words.len();
        if self.plan.spread_count > 0 {
            for buffer in [
                "spread_counts",
                "ring_spans",
                "dropped_flames",
                "catches",
                "control_points",
            ] {
                words.extend(self.backend.read(buffer)?);
            }
        }
        let front_words = (words.len() - others) as u32;
        Ok(Some(Snapshot {
            frame,
            system_count: self.plan.system_count,
            words,
            live,
            boid_count: self.plan.boid_count,
            place_count: self.plan.boid_trail_count,
            front_words,
        }))
    }

    /// Goes on from a snapshot of a run of the same scene, seed and changes, on whichever adapter:
    /// as if all of it had been stepped here. For runs whose inputs are the plan's own.
    ///
    /// # Errors
    /// [`SimulationError::Snapshot`] where it is of another run, as far as can be told; the machine
    /// fails.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), SimulationError> {
        self.put_living(snapshot)?;
        self.grow_tree(self.next_frame)
    }

    fn put_living(&mut self, snapshot: &Snapshot) -> Result<(), SimulationError> {
        let plan = &self.plan;
        let living = snapshot.living();
        let (particles, _) = living.particles.as_chunks::<PARTICLE_WORDS>();
        let (boids, _) = living.boids.as_chunks::<BOID_WORDS>();
        let is_of_plan = |particle: &[u32; PARTICLE_WORDS]| {
            let [.., birth] = particle;
            birth >> 16 < plan.system_count
        };
        // Kernels index by the slot and the index of a boid: they are those of its place.
        let places = (0..).zip(plan.boid_counts());
        let places = places.flat_map(|(slot, count)| (0..count).map(move |index| (slot, index)));
        let are_in_place = snapshot.boid_count == plan.boid_count
            && boids.iter().zip(places).all(|(boid, (slot, index))| {
                let [_, _, _, of_slot, _, _, _, at] = *boid;
                (of_slot, at) == (slot, index)
            });
        let fits = are_in_place
            && front_fits(plan, living.front)
            && snapshot.system_count == plan.system_count
            && snapshot.place_count == plan.boid_trail_count
            && snapshot.live() <= plan.capacity
            && snapshot.frame >= plan.first_frame
            && particles.iter().all(is_of_plan);
        if !fits {
            return Err(SimulationError::Snapshot(SnapshotError::OfAnotherRun));
        }
        let frames = i64::from(plan.row_count);
        let earliest = (i64::from(snapshot.frame) - frames + 1).max(plan.first_frame.into()) as i32;
        let recent: Vec<_> = (earliest..=snapshot.frame)
            .map(|frame| plan.inputs(frame.cast_unsigned()))
            .collect();
        self.backend.restore(&living, &recent)?;
        self.inputs = recent.into_iter().last();
        self.next_frame = snapshot.frame + 1;
        Ok(())
    }

    /// Bears the systems of all frames before this one, without their particles: they are hashes of
    /// their parents' keys and of their births, and few (Reeves 1983, section 3; RA12).
    pub(super) fn grow_tree(&mut self, before: i32) -> Result<(), SimulationError> {
        if self.plan.tree_levels == 0 {
            return Ok(());
        }
        for frame in self.plan.first_frame..before {
            let inputs = self.plan.inputs(frame.cast_unsigned());
            self.backend.run_stage(Stage::Tree, &inputs)?;
        }
        Ok(())
    }

    /// Sets the first frame of a run that has not begun: it starts there, empty. Says nothing to one
    /// that has.
    pub fn begin_at(&mut self, first: i32) {
        if self.inputs.is_none() {
            self.next_frame = first;
        }
    }
}
