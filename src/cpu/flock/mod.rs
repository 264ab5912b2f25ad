//! The stages of flocks.

pub mod cells;
pub mod hatch;
pub mod steer;

use rayon::prelude::*;

use crate::backend::{BackendError, try_zeroed};
use crate::cpu::draw::boid_shapes::boid_shapes;
use crate::layout::{Boid, Cover};
use crate::plan::{FrameInputs, Plan};

/// All flocks of a run.
#[derive(Debug)]
pub(super) struct Flocks {
    /// In the order of flocks and of indices.
    pub(super) boids: Vec<Boid>,
    /// The cell of each.
    pub(super) cells: Vec<u32>,
    /// How many boids stand before each cell, and how many there are.
    pub(super) starts: Vec<u32>,
    /// The boids by cell, and within a cell in order.
    pub(super) sorted: Vec<Boid>,
}

impl Flocks {
    pub(super) fn new(plan: &Plan) -> Result<Self, BackendError> {
        let boids = plan.boid_count as usize;
        Ok(Self {
            boids: try_zeroed(boids, "boids")?,
            cells: try_zeroed(boids, "boids' cells")?,
            starts: try_zeroed(plan.cell_count as usize + 1, "grid cells")?,
            sorted: try_zeroed(boids, "sorted boids")?,
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

    /// Adds the boids' records of what covers.
    pub(super) fn shapes(&self, inputs: &FrameInputs, covers: &mut Vec<Cover>) {
        let of_boid = |boid: &Boid| {
            let flock = &inputs.flocks[boid.flock() as usize];
            let faces = 0..flock.drawn[1];
            let record = |face| boid_shapes(flock, boid, face, inputs);
            faces.map(record).collect::<Vec<_>>()
        };
        covers.par_extend(
            self.boids
                .par_iter()
                .with_min_len(1024)
                .flat_map_iter(of_boid),
        );
    }

    pub(super) fn steer(&mut self, inputs: &FrameInputs) {
        let (sorted, starts) = (&self.sorted, &self.starts);
        let moved: Vec<Boid> = (0..sorted.len())
            .into_par_iter()
            .with_min_len(16)
            .map(|own| steer::steer(inputs, starts, sorted, own))
            .collect();
        for boid in moved {
            let [first, ..] = inputs.flocks[boid.flock() as usize].members;
            self.boids[(first + boid.index()) as usize] = boid;
        }
    }
}
