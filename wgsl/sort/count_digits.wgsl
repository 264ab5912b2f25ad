// count_digits: how many pairs of each run have each digit of their keys.
//
// First step of a pass of a stable radix sort (Knuth, TAOCP 3, 5.2.5) of pairs by 8 bits of their keys;
// passes over all bits, from the lowest, sort by the whole key. An invocation takes a contiguous run,
// so there are no barriers. Reads: sort_count (word 0: how many pairs), sort_pairs (key, value).
// Writes: digit_counts.
// Invariant: digit_counts[d runs + r] is the number of pairs of run r whose digit is d.

#import motes::dispatch::linear_index
#import motes::sort::{DIGITS, Digit, RUN, digit_of, runs_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

var<immediate> digit: Digit;

@group(0) @binding(0) var<storage, read> sort_count: array<u32>;
@group(0) @binding(1) var<storage, read> sort_pairs: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read_write> digit_counts: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn count_digits(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let count = sort_count[0];
    let runs = runs_of(count);
    let run = linear_index(global_id, WORKGROUP_SIZE);
    if run >= runs {
        return;
    }
    for (var at = 0u; at < DIGITS; at += 1u) {
        digit_counts[at * runs + run] = 0u;
    }
    let end = min((run + 1u) * RUN, count);
    for (var at = run * RUN; at < end; at += 1u) {
        digit_counts[digit_of(sort_pairs[at].x, digit) * runs + run] += 1u;
    }
}
