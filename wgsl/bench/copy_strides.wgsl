// copy_strides: the copy again, eight vectors an invocation, each as far from the next as there
// are invocations.
//
// Neighbours take neighbouring vectors, and several loads are under way at once. Reads: source.
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
fn copy_strides(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let vectors = 2u * records.count;
    let stride = (vectors + 7u) / 8u;
    let first = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if first >= stride {
        return;
    }
    for (var at = first; at < vectors; at += stride) {
        destination[at] = source[at];
    }
}
