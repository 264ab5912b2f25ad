// read_only: 32 bytes a record read, and next to nothing written.
//
// One invocation a record. Reads: source. Writes: destination, where a record is all zeros, which
// none of the benchmark's is; no driver can know that. Invariant: every word is looked at.

#import motes::dispatch::linear_index
#import motes::layout::Particle

struct Records {
    count: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read> source: array<Particle>;
@group(0) @binding(1) var<storage, read_write> destination: array<u32>;

@compute @workgroup_size(#{WORKGROUP_SIZE})
fn read_only(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, #{WORKGROUP_SIZE}u);
    if at >= records.count {
        return;
    }
    let record = source[at];
    let both = record.position_and_index | record.velocity_and_birth;
    if (both.x | both.y | both.z | both.w) == 0u {
        destination[at] = 1u;
    }
}
