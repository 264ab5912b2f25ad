// cells: a copy of the boids, sorted by cell and within a cell by who they are.
//
// Last step of the sort by cell: a boid's rank in its cell is the number of those before it, which
// no order of the members changes. One invocation a boid of the flock.
// Reads: flocks, boids, boid_cells, cell_starts, cell_members. Writes: sorted_boids, overlooked.
// Invariant: the sort is stable, so the copy depends on nothing but the boids. Where a driver has ended a
// loop before its end, that is counted.

#import motes::dispatch::linear_index
#import motes::layout::{Boid, FlockFrame}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether a cell may have more boids than loops of software drivers turn, 65,535.
const CROWDS: bool = #{CROWDS};

struct Which {
    flock: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<storage, read> flocks: array<FlockFrame>;
@group(0) @binding(1) var<storage, read> boids: array<Boid>;
@group(0) @binding(2) var<storage, read> boid_cells: array<u32>;
@group(0) @binding(3) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(4) var<storage, read> cell_members: array<u32>;
@group(0) @binding(5) var<storage, read_write> sorted_boids: array<Boid>;
@group(0) @binding(6) var<storage, read_write> overlooked: array<atomic<u32>>;

// 1 if that member stands before the boid.
fn one_before(member: u32, boid: u32) -> u32 {
    return select(0u, 1u, cell_members[member] < boid);
}

fn four_before(member: u32, boid: u32) -> u32 {
    return one_before(member, boid) + one_before(member + 1u, boid)
        + one_before(member + 2u, boid) + one_before(member + 3u, boid);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn sort_into_cells(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= flocks[which.flock].members.y {
        return;
    }
    let boid = flocks[which.flock].members.x + at;
    let cell = boid_cells[boid];
    let start = cell_starts[cell];
    let end = cell_starts[cell + 1u];
    let grid = flocks[which.flock].grid;
    // All of a flock that has one cell are in it, in order.
    let is_lone = grid.x * grid.y * grid.z == 1u;
    var place = select(start, start + at, is_lone);
    var member = select(start, end, is_lone);
    // Sixteen a turn: a million may be in one cell.
    for (; CROWDS && member + 16u <= end; member += 16u) {
        place += four_before(member, boid) + four_before(member + 4u, boid)
            + four_before(member + 8u, boid) + four_before(member + 12u, boid);
    }
    for (; member < end; member += 1u) {
        place += one_before(member, boid);
    }
    if CROWDS && member < end {
        atomicAdd(&overlooked[0], 1u);
    }
    sorted_boids[place] = boids[boid];
}
