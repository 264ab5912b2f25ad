//! The grid of a flock: which cell a place falls in, and which cells are around a cell. Twin of
//! `wgsl/lib/grid.wgsl`.

use glam::{IVec3, Vec3};

use crate::exact::{
    clamp_exact, f32_of_i32, f32_of_u32, floor_exact, less, max_exact, shared_constants,
    square_root, to_i32,
};
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

shared_constants! {
    /// How far beyond what is in reach a boid looks, in cells, for rounding: no flock has more than
    /// 2,048 cells along an axis.
    pub const CELL_SLACK: f32 = 0.000_976_562_5;
}

/// Cells along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The first; on a torus counted on around it.
    pub first: i32,
    /// How many.
    pub count: i32,
}

#[inline]
fn in_cells(flock: &FlockFrame, axis: usize, offset: f32) -> f32 {
    let per_unit = flock.cells_per_unit[axis];
    if flock.members[3] == EDGES_TORUS {
        let turns = floor_exact(offset * flock.torus_inverse[axis]);
        return (offset - flock.torus[axis] * turns) * per_unit;
    }
    clamp_exact(offset * per_unit, 0.0, f32_of_u32(flock.grid[axis]))
}

/// Where a place is in the grid, in cells: on a torus in its first turn, else cut off at the ends.
#[inline]
pub fn place_in_cells(flock: &FlockFrame, position: Vec3) -> Vec3 {
    let offset = position - Vec3::from_slice(&flock.grid_min);
    Vec3::new(
        in_cells(flock, 0, offset.x),
        in_cells(flock, 1, offset.y),
        in_cells(flock, 2, offset.z),
    )
}

/// The cells whose boids may be as near as `reach` along the axis, both in cells; each once.
#[inline]
pub fn span(place: f32, reach: f32, cells: u32, wraps: bool) -> Span {
    let first = to_i32(place - reach - CELL_SLACK);
    let last = to_i32(place + reach + CELL_SLACK);
    let end = cells.cast_signed() - 1;
    if wraps {
        let count = (last - first).min(end) + 1;
        return Span { first, count };
    }
    let low = first.clamp(0, end);
    let count = last.clamp(0, end) - low + 1;
    Span { first: low, count }
}

/// How far the boids of a cell are from the place along an axis, at least, in world units; where a
/// span goes all around a torus, nobody knows by which way.
#[inline]
pub fn gap_to(cell: i32, place: f32, extent: f32, spanned: i32, cells: u32, wraps: bool) -> f32 {
    if wraps && spanned == cells.cast_signed() {
        return 0.0;
    }
    let below = f32_of_i32(cell) - place;
    max_exact(max_exact(below, -1.0 - below) - CELL_SLACK, 0.0) * extent
}

/// Half of the part of a row that is in reach, whose gaps across have that squared length; below 0
/// where nothing is.
#[inline]
pub fn half_row(reach: f32, gaps: f32) -> f32 {
    if !less(0.0, gaps) {
        return reach;
    }
    let squared = reach * reach - gaps;
    if less(0.0, squared) {
        square_root(squared)
    } else {
        -1.0
    }
}

/// A cell's coordinate in the first turn of a torus, of at most one turn more or less.
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
