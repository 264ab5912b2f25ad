// The grid of a flock: which cell a place falls in, and which cells are around a cell. Reads and
// writes no buffers. Twin of src/cpu/grid.rs.
// Invariant: whoever is nearer than a reach is in one of the rows of its spans, within half a row;
// on a torus around its ends.
#define_import_path motes::grid

#import motes::exact::{
    clamp_exact, f32_of_i32, f32_of_u32, floor_exact, less, max_exact, square_root, to_i32,
}
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

// How far beyond what is in reach a boid looks, in cells, for rounding: no flock has more than 2,048
// cells along an axis.
const CELL_SLACK: f32 = 0.0009765625f;

// Cells along an axis: the first, on a torus counted on around it, and how many.
struct Span {
    first: i32,
    count: i32,
}

fn in_cells(offset: f32, cells_per_unit: f32, cells: u32, torus: vec2<f32>, wraps: bool) -> f32 {
    if wraps {
        return (offset - torus.x * floor_exact(offset * torus.y)) * cells_per_unit;
    }
    return clamp_exact(offset * cells_per_unit, 0.0f, f32_of_u32(cells));
}

// Where a place is in the grid, in cells: on a torus in its first turn, else cut off at the ends.
fn place_in_cells(flock: FlockFrame, position: vec3<f32>) -> vec3<f32> {
    let offset = position - flock.grid_min.xyz;
    let wraps = flock.members.w == EDGES_TORUS;
    let per_unit = flock.cells_per_unit;
    let torus = flock.torus;
    let inverse = flock.torus_inverse;
    return vec3<f32>(
        in_cells(offset.x, per_unit.x, flock.grid.x, vec2<f32>(torus.x, inverse.x), wraps),
        in_cells(offset.y, per_unit.y, flock.grid.y, vec2<f32>(torus.y, inverse.y), wraps),
        in_cells(offset.z, per_unit.z, flock.grid.z, vec2<f32>(torus.z, inverse.z), wraps),
    );
}

// The cells whose boids may be as near as `reach` along the axis, both in cells; each once.
fn span(place: f32, reach: f32, cells: u32, wraps: bool) -> Span {
    let first = to_i32(place - reach - CELL_SLACK);
    let last = to_i32(place + reach + CELL_SLACK);
    let end = i32(cells) - 1i;
    if wraps {
        return Span(first, min(last - first, end) + 1i);
    }
    let low = clamp(first, 0i, end);
    return Span(low, clamp(last, 0i, end) - low + 1i);
}

// How far the boids of a cell are from the place along an axis, at least, in world units; where a
// span goes all around a torus, nobody knows by which way.
fn gap_to(cell: i32, place: f32, extent: f32, spanned: i32, cells: u32, wraps: bool) -> f32 {
    if wraps && spanned == i32(cells) {
        return 0.0f;
    }
    let below = f32_of_i32(cell) - place;
    return max_exact(max_exact(below, -1.0f - below) - CELL_SLACK, 0.0f) * extent;
}

// Half of the part of a row that is in reach, whose gaps across have that squared length; below 0
// where nothing is.
fn half_row(reach: f32, gaps: f32) -> f32 {
    if !less(0.0f, gaps) {
        return reach;
    }
    let squared = reach * reach - gaps;
    return select(-1.0f, square_root(squared), less(0.0f, squared));
}

// A cell's coordinate in the first turn of a torus, of at most one turn more or less.
fn around(coordinate: i32, cells: u32) -> i32 {
    let count = i32(cells);
    return select(select(coordinate, coordinate - count, coordinate >= count), coordinate + count, coordinate < 0i);
}
