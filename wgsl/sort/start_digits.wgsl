// start_digits: where the pairs of each digit begin.
//
// Third step of a pass of the sort. One invocation in all. Writes: digit_starts.
// Invariant: digit_starts[d] is the number of pairs with digits below d.

#import motes::sort::DIGITS

@group(0) @binding(0) var<storage, read_write> digit_starts: array<u32>;

@compute @workgroup_size(1)
fn start_digits() {
    var before = 0u;
    for (var digit = 0u; digit < DIGITS; digit += 1u) {
        let count = digit_starts[digit];
        digit_starts[digit] = before;
        before += count;
    }
}
