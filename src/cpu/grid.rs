//! The grid of a flock: which cell a place falls in, and which cells are around a cell. Twin of
//! `wgsl/lib/grid.wgsl`.

use glam::{IVec3, Vec3};

use crate::exact::{floor_exact, to_i32};
use crate::layout::{EDGES_TORUS, FlockFrame};

#[inline]
fn coordinate(offset: f32, cells_per_unit: f32, cells: u32, wraps: bool) -> i32 {
    let at = to_i32(offset * cells_per_unit);
    let count = cells.cast_signed();
    if wraps {
        return (at % count + count) % count;
    }
    at.clamp(0, count - 1)
}

/// Coordinates of the grid cell that a place falls in; what is outside falls in the nearest.
#[inline]
pub fn cell_coordinates(flock: &FlockFrame, position: Vec3) -> IVec3 {
    let offset = position - Vec3::from_slice(&flock.grid_min);
    let wraps = flock.members[3] == EDGES_TORUS;
    let [x, y, z, _] = flock.cells_per_unit;
    IVec3::new(
        coordinate(offset.x, x, flock.grid[0], wraps),
        coordinate(offset.y, y, flock.grid[1], wraps),
        coordinate(offset.z, z, flock.grid[2], wraps),
    )
}

/// The number of a cell among those of all flocks: cells along x are neighbours.
#[inline]
pub fn cell_index(flock: &FlockFrame, x: i32, y: i32, z: i32) -> u32 {
    let [x, y, z] = [x, y, z].map(i32::cast_unsigned);
    flock.grid[3] + (z * flock.grid[1] + y) * flock.grid[0] + x
}

/// The nearest way around the torus along an axis; the way itself where there is none.
#[inline]
pub fn nearest_way(offset: f32, extent: f32, inverse: f32) -> f32 {
    offset - extent * floor_exact(offset * inverse + 0.5)
}

/// First of at most three coordinates to look at along an axis.
#[inline]
pub fn first_around(coordinate: i32, cells: u32) -> i32 {
    if cells >= 3 { coordinate - 1 } else { 0 }
}

/// A coordinate around the torus.
#[inline]
pub fn around(coordinate: i32, cells: u32) -> i32 {
    let count = cells.cast_signed();
    if coordinate < 0 {
        coordinate + count
    } else if coordinate >= count {
        coordinate - count
    } else {
        coordinate
    }
}
