// copy_vec4: the copy again, four words an invocation.
//
// Neighbours take neighbouring vectors, which hardware joins into wide accesses. Reads: source.
// Writes: destination.
// Invariant: destination = source over the first `count` records of two vectors.

#import motes::dispatch::linear_index

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read> source: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> destination: array<vec4<u32>>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn copy_vec4(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= 2u * records.count {
        return;
    }
    destination[at] = source[at];
}
