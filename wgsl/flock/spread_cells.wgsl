// spread_cells: for each cell, how many boids stand before it.
//
// Fourth step of the sort by cell. Reads: frame, cell_counts, cell_sums. Writes: cell_starts.
// Invariant: the boids of cell c are [cell_starts[c], cell_starts[c + 1]) of the sorted ones.

#import motes::dispatch::linear_index
#import motes::layout::Frame

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> cell_counts: array<u32>;
@group(0) @binding(2) var<storage, read> cell_sums: array<u32>;
@group(0) @binding(3) var<storage, read_write> cell_starts: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn spread_cells(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let run = linear_index(global_id, WORKGROUP_SIZE);
    let first = run * 64u;
    if first >= frame.cell_count {
        return;
    }
    let end = min(first + 64u, frame.cell_count);
    var before = cell_sums[run];
    for (var cell = first; cell < end; cell += 1u) {
        cell_starts[cell] = before;
        before += cell_counts[cell];
    }
    if end == frame.cell_count {
        cell_starts[end] = before;
    }
}
