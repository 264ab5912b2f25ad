// count_bits: how many of each run of 64 words' bits are set.
//
// First step of the prefix sum over the survivors. An invocation takes a contiguous run, so there
// are no barriers. Reads: counts, alive_bits. Writes: sums_1.
// Invariant: sums_1[i] is the number of survivors among particles [2048 i, 2048 (i + 1)).

#import motes::dispatch::linear_index
#import motes::layout::Counts

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<storage, read> counts: Counts;
@group(0) @binding(1) var<storage, read> alive_bits: array<u32>;
@group(0) @binding(2) var<storage, read_write> sums_1: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn count_bits(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let words = (counts.total + 31u) / 32u;
    let run = linear_index(global_id, WORKGROUP_SIZE);
    let first = run * 64u;
    if first >= words {
        return;
    }
    let end = min(first + 64u, words);
    var sum = 0u;
    for (var word = first; word < end; word += 1u) {
        sum += countOneBits(alive_bits[word]);
    }
    sums_1[run] = sum;
}
