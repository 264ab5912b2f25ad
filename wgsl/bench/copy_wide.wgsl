// copy_wide: the copy again, a record an invocation, in four words of 64 bits.
//
// For devices that have them: software drivers make an access of each word. Reads: source.
// Writes: destination.
// Invariant: destination = source over the first `count` records.

#import motes::dispatch::linear_index

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read> source: array<vec4<u64>>;
@group(0) @binding(1) var<storage, read_write> destination: array<vec4<u64>>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn copy_wide(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= records.count {
        return;
    }
    destination[at] = source[at];
}
