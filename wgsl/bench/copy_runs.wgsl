// copy_runs: the copy again, a contiguous run of 16 records an invocation.
//
// Fewer invocations with longer work, for processors that run them one lane at a time. Reads:
// source. Writes: destination.
// Invariant: destination = source over the first `count` records of two vectors.

#import motes::dispatch::linear_index

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read> source: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> destination: array<vec4<u32>>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn copy_runs(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let first = linear_index(global_id, #{WORKGROUP_SIZE}u) * 32u;
    let end = min(first + 32u, 2u * records.count);
    for (var at = first; at < end; at += 1u) {
        destination[at] = source[at];
    }
}
