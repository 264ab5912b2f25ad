// surface_work: how much work there is for listed triangles.
//
// One invocation. Reads: large_faces. Writes: dispatches, at the place that it is told.
// Invariant: each listed triangle has as many invocations as share it.

#import motes::dispatch::dispatch_for
#import motes::layout::Dispatch

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    // Invocations a triangle.
    shares: u32,
    place: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<storage, read> large_faces: array<u32>;
@group(0) @binding(1) var<storage, read_write> dispatches: array<Dispatch>;

@compute @workgroup_size(1)
fn surface_work() {
    dispatches[work.place] = dispatch_for(large_faces[0] * work.shares, WORKGROUP_SIZE);
}
