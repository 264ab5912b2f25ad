// write_only: 32 bytes a record written, and nothing read.
//
// One invocation a record. Writes: destination. Invariant: every word is the record's number.

#import motes::dispatch::linear_index
#import motes::layout::Particle

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read_write> destination: array<Particle>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn write_only(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= records.count {
        return;
    }
    destination[at] = Particle(vec4<u32>(at), vec4<u32>(at));
}
