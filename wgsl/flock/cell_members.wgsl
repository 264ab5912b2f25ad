// cell_members: who is in each cell, in any order.
//
// Fifth step of the sort by cell. One invocation a boid of the flock.
// Reads: flocks, boid_cells, cell_starts. Writes: cell_members, cell_counts.
// Invariant: each boid is once among the members of its cell; counts are zeros again at the end.

#import motes::dispatch::linear_index
#import motes::layout::FlockFrame

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Which {
    flock: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<storage, read> flocks: array<FlockFrame>;
@group(0) @binding(1) var<storage, read> boid_cells: array<u32>;
@group(0) @binding(2) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(3) var<storage, read_write> cell_members: array<u32>;
@group(0) @binding(4) var<storage, read_write> cell_counts: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn list_members(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= flocks[which.flock].members.y {
        return;
    }
    let boid = flocks[which.flock].members.x + at;
    let cell = boid_cells[boid];
    let left = atomicSub(&cell_counts[cell], 1u);
    cell_members[cell_starts[cell] + left - 1u] = boid;
}
