//! What a flock has come to, in the numbers of those who study flocks. Computed by the processor
//! from the state itself, in 64 bits and in one order: the same on every adapter.

mod tree;

use glam::DVec3;
use rayon::prelude::*;

use super::{Simulation, SimulationError};
use crate::layout::{Boid, FlockFrame};
use tree::Tree;

/// Numbers of one flock in one frame. Neighbours are those of its own flock; on a torus they are
/// looked for across its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlockMetrics {
    /// Boids.
    pub count: u32,
    /// Length of the mean of the headings, 0 ..= 1: 1 where all fly the same way. Who stands counts
    /// as no heading.
    pub polarisation: f64,
    /// World units a frame.
    pub mean_speed: f64,
    /// Median of the distances of boids to their nearest neighbours, world units; of an even number
    /// of boids the mean of the two in the middle. None of a boid that is alone.
    pub median_nearest_distance: Option<f64>,
    /// Mean number of neighbours nearer than the flock's `perception_radius`. On a torus less than
    /// two of those across, who is seen twice counts twice.
    pub mean_neighbours: f64,
}

impl FlockMetrics {
    /// Of these boids, which are a whole flock, of one boid at least.
    pub fn of(flock: &FlockFrame, boids: &[Boid]) -> Self {
        let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let (mut headings, mut speeds) = (DVec3::ZERO, 0.0);
        for boid in boids {
            let velocity = wide(boid.velocity());
            headings += velocity.normalize_or_zero();
            speeds += velocity.length();
        }
        let count = boids.len() as f64;
        let tree = Tree::new(boids.iter().map(Boid::position).collect());
        let [x, y, z, _] = flock.torus;
        let shifts = shifts(wide([x, y, z]));
        let radius = f64::from(flock.edges_max[3]);
        let (mut nearest, neighbours): (Vec<f64>, Vec<u64>) = (0..tree.len())
            .into_par_iter()
            .map(|own| seen_by(&tree, own, &shifts, radius * radius))
            .unzip();
        Self {
            count: boids.len() as u32,
            polarisation: headings.length() / count,
            mean_speed: speeds / count,
            median_nearest_distance: (boids.len() > 1).then(|| median_root(&mut nearest)),
            mean_neighbours: neighbours.iter().sum::<u64>() as f64 / count,
        }
    }
}

/// All ways around a torus of these extents, that of staying first.
fn shifts(extents: DVec3) -> Vec<DVec3> {
    let mut shifts = vec![DVec3::ZERO];
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        let way = axis * extents;
        if way != DVec3::ZERO {
            let around = |shift: &DVec3| [*shift, *shift - way, *shift + way];
            shifts = shifts.iter().flat_map(around).collect();
        }
    }
    shifts
}

/// Squared distance to the nearest, and how many are within the squared radius.
fn seen_by(tree: &Tree, own: usize, shifts: &[DVec3], squared: f64) -> (f64, u64) {
    let place = tree.place(own);
    let mut nearest = f64::INFINITY;
    let mut neighbours = 0;
    for shift in shifts {
        let from = place + shift;
        nearest = tree.nearest_squared(from, own, nearest);
        neighbours += tree.count_within(from, squared);
        // Not itself, nor its own images.
        neighbours -= u64::from(from.distance_squared(place) < squared);
    }
    (nearest, neighbours)
}

/// The median of the roots of at least two squares.
fn median_root(squares: &mut [f64]) -> f64 {
    let half = squares.len() / 2;
    let is_even = squares.len().is_multiple_of(2);
    let (below, &mut middle, _) = squares.select_nth_unstable_by(half, f64::total_cmp);
    if is_even {
        let lower = below.iter().copied().fold(0.0, f64::max);
        return 0.5 * (lower.sqrt() + middle.sqrt());
    }
    middle.sqrt()
}

impl Simulation {
    /// Numbers of each flock, in the scene's order; none before the first frame is stepped.
    ///
    /// # Errors
    /// The machine fails.
    pub fn flock_metrics(&mut self) -> Result<Vec<FlockMetrics>, SimulationError> {
        let Some(inputs) = &self.inputs else {
            return Ok(Vec::new());
        };
        if inputs.flocks.is_empty() {
            return Ok(Vec::new());
        }
        let words = self.backend.read("boids")?;
        let boids: &[Boid] = bytemuck::cast_slice(&words);
        let of_flock = |flock: &FlockFrame| {
            let [first, count, ..] = flock.members.map(|word| word as usize);
            FlockMetrics::of(flock, &boids[first..first + count])
        };
        Ok(inputs.flocks.iter().map(of_flock).collect())
    }
}
