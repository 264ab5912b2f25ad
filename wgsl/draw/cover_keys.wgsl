// cover_keys: for each record of what covers, the key that sorts it from far to near.
//
// One invocation a record. Reads: sort_count, covers. Writes: sort_pairs.
// Invariant: sorted stably, pairs are in the order of depth and, of equal depth, of identity; records of
// nothing come first.

#import motes::cover::far_to_near
#import motes::dispatch::linear_index
#import motes::layout::Cover

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<storage, read> sort_count: array<u32>;
@group(0) @binding(1) var<storage, read> covers: array<Cover>;
@group(0) @binding(2) var<storage, read_write> sort_pairs: array<vec2<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn cover_keys(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= sort_count[0] {
        return;
    }
    sort_pairs[at] = vec2<u32>(far_to_near(covers[at]), at);
}
