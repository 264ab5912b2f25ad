// atomic_contended: additions to one word, which all invocations want.
//
// One invocation an addition. Writes: table (atomic adds).
// Invariant: the first word has grown by the number of additions.

#import motes::dispatch::linear_index

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read_write> table: array<atomic<u32>>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn atomic_contended(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= records.count {
        return;
    }
    atomicAdd(&table[0], 1u);
}
