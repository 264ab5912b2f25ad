// spread_runs: sums_1 become exclusive prefix sums, from those of their runs of 64.
//
// Fourth step of the prefix sum over the survivors. Reads: counts, sums_2. Writes: sums_1.
// Invariant: sums_1[i] is the number of survivors before particle 2048 i.

#import motes::dispatch::linear_index
#import motes::layout::Counts

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<storage, read> counts: Counts;
@group(0) @binding(1) var<storage, read> sums_2: array<u32>;
@group(0) @binding(2) var<storage, read_write> sums_1: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn spread_runs(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let sums = (counts.total + 2047u) / 2048u;
    let run = linear_index(global_id, WORKGROUP_SIZE);
    let first = run * 64u;
    if first >= sums {
        return;
    }
    let end = min(first + 64u, sums);
    var before = sums_2[run];
    for (var at = first; at < end; at += 1u) {
        let sum = sums_1[at];
        sums_1[at] = before;
        before += sum;
    }
}
