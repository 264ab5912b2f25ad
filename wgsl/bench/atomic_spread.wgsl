// atomic_spread: additions to words all over a table, as a splat of points makes them.
//
// One invocation an addition. Writes: table (atomic adds).
// Invariant: no word is hit by many invocations at a time.

#import motes::dispatch::linear_index

struct Records {
    count: u32,
}
var<immediate> records: Records;

// The table has 2^21 words.
const SHIFT: u32 = 11u;

@group(0) @binding(0) var<storage, read_write> table: array<atomic<u32>>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn atomic_spread(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= records.count {
        return;
    }
    atomicAdd(&table[(at * 0x9e3779b9u) >> SHIFT], 1u);
}
