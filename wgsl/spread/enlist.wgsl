// enlist: which control points are in which cell of a grid, as lists.
//
// For the test of Perry 1994, 3.3.2, against double burning. A cell is a hash of where it is; its list
// begins in the first words of crowd, which begin as zeros, and of each point there is a word behind
// them that names the next. One invocation a control point.
// Reads: spreads, spread_counts, control_points. Writes: crowd (indices from 1; 0 ends a list).
// Invariant: the order within a list is any, and nothing may depend on it.

#import motes::dispatch::linear_index
#import motes::layout::{SPREAD_BLOCKS, SpreadCounts, SpreadFrame, SpreadPoint}
#import motes::walk::{crowd_cell, crowd_hash}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    // Lists, less one; a power of two.
    mask: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> spreads: array<SpreadFrame>;
@group(0) @binding(1) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(2) var<storage, read> control_points: array<SpreadPoint>;
@group(0) @binding(3) var<storage, read_write> crowd: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn enlist(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= spread_counts.total {
        return;
    }
    let place = control_points[at].position;
    let spread = spreads[place.w];
    if (spread.kinds.y & SPREAD_BLOCKS) == 0u {
        return;
    }
    let cell = crowd_cell(bitcast<vec3<f32>>(place.xyz), spread.distances.z);
    let list = crowd_hash(cell, place.w) & work.mask;
    atomicStore(&crowd[work.mask + 1u + at], atomicExchange(&crowd[list], at + 1u));
}
