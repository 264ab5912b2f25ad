// cell_offsets: cell_sums become exclusive prefix sums.
//
// Third step of the sort by cell. One invocation in all: a run stands for 64 cells, and there are
// fewer than 65,535 runs. Reads: frame. Writes: cell_sums.
// Invariant: cell_sums[i] is the number of boids before cell 64 i.

#import motes::layout::Frame

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> cell_sums: array<u32>;

@compute @workgroup_size(1)
fn cell_offsets() {
    let runs = (frame.cell_count + 63u) / 64u;
    var before = 0u;
    for (var run = 0u; run < runs; run += 1u) {
        let sum = cell_sums[run];
        cell_sums[run] = before;
        before += sum;
    }
}
