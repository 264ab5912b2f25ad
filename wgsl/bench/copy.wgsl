// copy: the yardstick of a step: 32 bytes a record read and written, and nothing else.
//
// One invocation a record. Reads: source. Writes: destination.
// Invariant: destination = source over the first `count` records.

#import motes::dispatch::linear_index
#import motes::layout::Particle

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read> source: array<Particle>;
@group(0) @binding(1) var<storage, read_write> destination: array<Particle>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn copy(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= records.count {
        return;
    }
    destination[at] = source[at];
}
