// spread_bits: for each word of 32 particles, how many survivors stand before it.
//
// Last step of the prefix sum over the survivors. Reads: counts, alive_bits, sums_1.
// Writes: word_ranks.
// Invariant: word_ranks[w] is the number of survivors before particle 32 w, and the bits of the word.

#import motes::dispatch::linear_index
#import motes::layout::Counts

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<storage, read> counts: Counts;
@group(0) @binding(1) var<storage, read> alive_bits: array<u32>;
@group(0) @binding(2) var<storage, read> sums_1: array<u32>;
@group(0) @binding(3) var<storage, read_write> word_ranks: array<vec2<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn spread_bits(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let words = (counts.total + 31u) / 32u;
    let run = linear_index(global_id, WORKGROUP_SIZE);
    let first = run * 64u;
    if first >= words {
        return;
    }
    let end = min(first + 64u, words);
    var before = sums_1[run];
    for (var word = first; word < end; word += 1u) {
        let bits = alive_bits[word];
        word_ranks[word] = vec2<u32>(before, bits);
        before += countOneBits(bits);
    }
}
