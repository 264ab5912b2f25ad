// digest: 64 bits that tell whether two lists of records are the same.
//
// The sum, modulo 2^32 for each half, of a hash of each record's index and words; a sum does not
// depend on the order in which invocations run. An invocation takes 64 records.
// Reads: counts, words. Writes: digest.
// Invariant: the digest of no records is zero.

#import motes::dispatch::linear_index
#import motes::layout::Counts
#import motes::rng::pcg4d

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Records {
    // Index of the first record here, and how many fit here.
    first: u32,
    capacity: u32,
    vectors_per_record: u32,
    // Where the digest's two words stand.
    digest_at: u32,
    // 1: only the first counts.live records count; 0: all.
    live_only: u32,
}
var<immediate> records: Records;

@group(0) @binding(0) var<storage, read> counts: Counts;
@group(0) @binding(1) var<storage, read> words: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> digest: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn digest_records(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let start = linear_index(global_id, WORKGROUP_SIZE) * 64u;
    let live = min(counts.live - min(counts.live, records.first), records.capacity);
    let count = select(records.capacity, live, records.live_only == 1u);
    let end = min(start + 64u, count);
    var low = 0u;
    var high = 0u;
    for (var at = start; at < end; at += 1u) {
        var hash = pcg4d(vec4<u32>(records.first + at, 0u, 0u, 0u));
        for (var vector = 0u; vector < records.vectors_per_record; vector += 1u) {
            hash = pcg4d(hash ^ words[at * records.vectors_per_record + vector]);
        }
        low += hash.x;
        high += hash.y;
    }
    if start < end {
        atomicAdd(&digest[records.digest_at], low);
        atomicAdd(&digest[records.digest_at + 1u], high);
    }
}
