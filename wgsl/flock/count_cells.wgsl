// count_cells: the grid cell of each boid, and how many are in each cell.
//
// First step of the sort by cell. Each flock has a grid of its own, somewhat finer than how far
// others see it. One invocation a boid of the flock.
// Reads: flocks, boids. Writes: boid_cells, cell_counts (which begin as zeros).
// Invariant: counts do not depend on the order of the additions.

#import motes::dispatch::linear_index
#import motes::grid::{cell_coordinates, cell_index}
#import motes::layout::{Boid, FlockFrame}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Which {
    flock: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<storage, read> flocks: array<FlockFrame>;
@group(0) @binding(1) var<storage, read> boids: array<Boid>;
@group(0) @binding(2) var<storage, read_write> boid_cells: array<u32>;
@group(0) @binding(3) var<storage, read_write> cell_counts: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn count_cells(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let flock = flocks[which.flock];
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= flock.members.y {
        return;
    }
    let boid = flock.members.x + at;
    let place = bitcast<vec3<f32>>(boids[boid].position_and_flock.xyz);
    let cell = cell_coordinates(flock, place);
    let index = cell_index(flock, cell.x, cell.y, cell.z);
    boid_cells[boid] = index;
    atomicAdd(&cell_counts[index], 1u);
}
