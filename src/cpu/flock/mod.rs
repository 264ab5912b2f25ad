//! The stages of flocks.

pub mod cells;
pub mod hatch;
pub mod steer;

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use crate::backend::{BackendError, try_zeroed};
use crate::cpu::draw::boid_shapes::boid_shapes;
use crate::cpu::draw::boid_trails::boid_trails;
use crate::layout::{Boid, Cover, FlockFrame};
use crate::plan::{FrameInputs, Plan, SolidTables};

/// The places of a boid's trail among those of all.
fn ring_of(flock: &FlockFrame, boid: &Boid) -> Range<usize> {
    let [first, mask, ..] = flock.trail.map(|word| word as usize);
    let ring = first + boid.index() as usize * (mask + 1);
    ring..ring + mask + 1
}

/// All flocks of a run.
#[derive(Debug)]
pub(super) struct Flocks {
    /// In the order of flocks and of indices.
    pub(super) boids: Vec<Boid>,
    /// Where those that have trails have been: rings, in the same order.
    pub(super) trails: Vec<[u32; 4]>,
    /// The cell of each.
    pub(super) cells: Vec<u32>,
    /// How many boids stand before each cell, and how many there are.
    pub(super) starts: Vec<u32>,
    /// The boids by cell, and within a cell in order.
    pub(super) sorted: Vec<Boid>,
    /// Faces of the meshes that they stay out of.
    solids: Arc<SolidTables>,
}

impl Flocks {
    pub(super) fn new(plan: &Plan) -> Result<Self, BackendError> {
        let boids = plan.boid_count as usize;
        Ok(Self {
            boids: try_zeroed(boids, "boids")?,
            trails: try_zeroed(plan.boid_trail_count as usize, "boids' trails")?,
            cells: try_zeroed(boids, "boids' cells")?,
            starts: try_zeroed(plan.cell_count as usize + 1, "grid cells")?,
            sorted: try_zeroed(boids, "sorted boids")?,
            solids: Arc::clone(&plan.solids),
        })
    }

    pub(super) fn hatch(&mut self, inputs: &FrameInputs) {
        for (slot, flock) in inputs.flocks.iter().enumerate() {
            let [first, count, ..] = flock.members.map(|word| word as usize);
            self.boids[first..first + count]
                .par_iter_mut()
                .enumerate()
                .for_each(|(index, boid)| {
                    *boid = hatch::hatch(flock, slot as u32, index as u32);
                });
            if flock.trail[2] > 0 {
                for boid in &self.boids[first..first + count] {
                    // It has never been elsewhere.
                    let [x, y, z, _] = boid.position_and_flock;
                    self.trails[ring_of(flock, boid)].fill([x, y, z, 0]);
                }
            }
        }
    }

    pub(super) fn sort(&mut self, inputs: &FrameInputs) {
        let flocks = &inputs.flocks;
        self.cells
            .par_iter_mut()
            .zip(&self.boids)
            .for_each(|(cell, boid)| {
                *cell = cells::cell_of(&flocks[boid.flock() as usize], boid);
            });
        cells::sort(&self.boids, &self.cells, &mut self.starts, &mut self.sorted);
    }

    /// Adds the boids' records of what covers, and those of their trails.
    pub(super) fn shapes(&self, inputs: &FrameInputs, covers: &mut Vec<Cover>) {
        for flock in &inputs.flocks {
            let [first, count, ..] = flock.members.map(|word| word as usize);
            let boids = || {
                let own = &self.boids[first..first + count];
                own.par_iter().with_min_len(1024)
            };
            if flock.trail[2] > 0 {
                let trail = |boid| boid_trails(flock, boid, &self.trails, inputs);
                covers.par_extend(boids().flat_map_iter(trail));
            }
            let of_boid = |boid| boid_shapes(flock, boid, inputs);
            covers.par_extend(boids().flat_map_iter(of_boid));
        }
    }

    pub(super) fn steer(&mut self, inputs: &FrameInputs) {
        let (sorted, starts) = (&self.sorted, &self.starts);
        let solid_faces = &self.solids.rows;
        let moved: Vec<Boid> = (0..sorted.len())
            .into_par_iter()
            .with_min_len(16)
            .map(|own| steer::steer(inputs, starts, sorted, solid_faces, own))
            .collect();
        for boid in moved {
            let flock = &inputs.flocks[boid.flock() as usize];
            let [first, ..] = flock.members;
            let before = &mut self.boids[(first + boid.index()) as usize];
            if flock.trail[2] > 0 {
                let [x, y, z, _] = before.position_and_flock;
                let slot = (inputs.frame.frame & flock.trail[1]) as usize;
                self.trails[ring_of(flock, &boid)][slot] = [x, y, z, 0];
            }
            *before = boid;
        }
    }
}
