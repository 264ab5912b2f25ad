// The grid of a flock: which cell a place falls in, and which cells are around a cell. Reads and
// writes no buffers. Twin of src/cpu/grid.rs.
// Invariant: two places whose distance along each axis is less than a cell fall in the same cell or
// in neighbours, on a torus around its ends.
#define_import_path motes::grid

#import motes::exact::{floor_exact, to_i32}
#import motes::layout::{EDGES_TORUS, FlockFrame}

fn coordinate(offset: f32, cells_per_unit: f32, cells: u32, wraps: bool) -> i32 {
    let at = to_i32(offset * cells_per_unit);
    let count = i32(cells);
    if wraps {
        return (at % count + count) % count;
    }
    return clamp(at, 0, count - 1);
}

// Coordinates of the grid cell that a place falls in; what is outside falls in the nearest.
fn cell_coordinates(flock: FlockFrame, position: vec3<f32>) -> vec3<i32> {
    let offset = position - flock.grid_min.xyz;
    let wraps = flock.members.w == EDGES_TORUS;
    return vec3<i32>(
        coordinate(offset.x, flock.cells_per_unit.x, flock.grid.x, wraps),
        coordinate(offset.y, flock.cells_per_unit.y, flock.grid.y, wraps),
        coordinate(offset.z, flock.cells_per_unit.z, flock.grid.z, wraps),
    );
}

// The number of a cell among those of all flocks: cells along x are neighbours.
fn cell_index(flock: FlockFrame, x: i32, y: i32, z: i32) -> u32 {
    return flock.grid.w + (u32(z) * flock.grid.y + u32(y)) * flock.grid.x + u32(x);
}

// The nearest way around the torus along an axis; the way itself where there is none.
fn nearest_way(offset: f32, extent: f32, inverse: f32) -> f32 {
    return offset - extent * floor_exact(offset * inverse + 0.5f);
}

// First of at most three coordinates to look at along an axis.
fn first_around(coordinate: i32, cells: u32) -> i32 {
    return select(0i, coordinate - 1i, cells >= 3u);
}

// A coordinate around the torus.
fn around(coordinate: i32, cells: u32) -> i32 {
    let count = i32(cells);
    return select(select(coordinate, coordinate - count, coordinate >= count), coordinate + count, coordinate < 0i);
}
