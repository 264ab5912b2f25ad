// place_digits: pairs take their places by the digit.
//
// Last step of a pass of the sort. An invocation takes a contiguous run, in order.
// Reads: sort_count, sort_pairs, digit_starts. Writes: digit_counts, sorted_pairs.
// Invariant: sorted_pairs are sort_pairs by rising digit; of equal digits, in the order that they had.

#import motes::dispatch::linear_index
#import motes::sort::{Digit, RUN, digit_of, runs_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

var<immediate> digit: Digit;

@group(0) @binding(0) var<storage, read> sort_count: array<u32>;
@group(0) @binding(1) var<storage, read> sort_pairs: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> digit_starts: array<u32>;
@group(0) @binding(3) var<storage, read_write> digit_counts: array<u32>;
@group(0) @binding(4) var<storage, read_write> sorted_pairs: array<vec2<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn place_digits(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let count = sort_count[0];
    let runs = runs_of(count);
    let run = linear_index(global_id, WORKGROUP_SIZE);
    if run >= runs {
        return;
    }
    let end = min((run + 1u) * RUN, count);
    for (var at = run * RUN; at < end; at += 1u) {
        let pair = sort_pairs[at];
        let of_digit = digit_of(pair.x, digit);
        let place = of_digit * runs + run;
        let before = digit_counts[place];
        digit_counts[place] = before + 1u;
        sorted_pairs[digit_starts[of_digit] + before] = pair;
    }
}
