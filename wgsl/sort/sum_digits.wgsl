// sum_digits: for each digit, how many pairs of it stand in the runs before each run.
//
// Second step of a pass of the sort. One invocation a digit. Reads: sort_count. Writes: digit_counts,
// digit_starts.
// Invariant: digit_counts[d runs + r] is the number of pairs with digit d in runs before r, and
// digit_starts[d] that in all.

#import motes::dispatch::linear_index
#import motes::sort::{DIGITS, runs_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<storage, read> sort_count: array<u32>;
@group(0) @binding(1) var<storage, read_write> digit_counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> digit_starts: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn sum_digits(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let digit = linear_index(global_id, WORKGROUP_SIZE);
    if digit >= DIGITS {
        return;
    }
    let runs = runs_of(sort_count[0]);
    var before = 0u;
    for (var run = 0u; run < runs; run += 1u) {
        let count = digit_counts[digit * runs + run];
        digit_counts[digit * runs + run] = before;
        before += count;
    }
    digit_starts[digit] = before;
}
