//! cells: the boids sorted by grid cell, in plain Rust: no twin of `wgsl/flock/cells.wgsl` and the
//! kernels before it, so that the two sides are not one translation.

use crate::cpu::grid::{cell_coordinates, cell_index};
use crate::layout::{Boid, FlockFrame};

/// The cell that the boid is in, among those of all flocks.
pub fn cell_of(flock: &FlockFrame, boid: &Boid) -> u32 {
    let cell = cell_coordinates(flock, boid.position().into());
    cell_index(flock, cell.x, cell.y, cell.z)
}

/// Copies the boids in the order of their cells; within a cell they keep their order. `starts`
/// becomes how many stand before each cell, and how many there are.
pub(super) fn sort(boids: &[Boid], cells: &[u32], starts: &mut [u32], sorted: &mut [Boid]) {
    starts.fill(0);
    for cell in cells {
        starts[*cell as usize + 1] += 1;
    }
    let mut before = 0;
    for start in starts.iter_mut() {
        before += *start;
        *start = before;
    }
    let mut next = starts.to_vec();
    for (boid, cell) in boids.iter().zip(cells) {
        let place = &mut next[*cell as usize];
        sorted[*place as usize] = *boid;
        *place += 1;
    }
}
