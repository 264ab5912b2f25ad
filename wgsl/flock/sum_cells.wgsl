// sum_cells: how many boids are in each run of 64 cells.
//
// Second step of the sort by cell. An invocation takes a contiguous run, so there are no barriers.
// Reads: frame, cell_counts. Writes: cell_sums.
// Invariant: cell_sums[i] is the number of boids in cells [64 i, 64 (i + 1)).

#import motes::dispatch::linear_index
#import motes::layout::Frame

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> cell_counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> cell_sums: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn sum_cells(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let run = linear_index(global_id, WORKGROUP_SIZE);
    let first = run * 64u;
    if first >= frame.cell_count {
        return;
    }
    let end = min(first + 64u, frame.cell_count);
    var sum = 0u;
    for (var cell = first; cell < end; cell += 1u) {
        sum += cell_counts[cell];
    }
    cell_sums[run] = sum;
}
