// burning: which dropped flames burn, of every 32.
//
// Perry 1994, 3.4: a flame burns as many frames as its fuel is flammable. One invocation a run of those
// that may burn yet.
// Reads: frame, spread_counts, dropped_flames. Writes: flame_runs (a bit for each that burns; how many
// go out in this frame).
// Invariant: a flame goes out once, after as many frames as it was given when it was dropped.

#import motes::dispatch::linear_index
#import motes::layout::{DroppedFlame, Frame, SpreadCounts}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Work {
    // Places for flames.
    places: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> spread_counts: SpreadCounts;
@group(0) @binding(2) var<storage, read> dropped_flames: array<DroppedFlame>;
@group(0) @binding(3) var<storage, read_write> flame_runs: array<vec2<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn burning(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let run = linear_index(global_id, WORKGROUP_SIZE);
    let first = spread_counts.flames_first + run * 32u;
    let count = spread_counts.flames_total - spread_counts.flames_first;
    if run * 32u >= count {
        return;
    }
    let end = min(32u, count - run * 32u);
    var bits = 0u;
    var out = 0u;
    for (var at = 0u; at < end; at += 1u) {
        let flame = dropped_flames[(first + at) % work.places];
        let age = frame.frame - flame.normal_and_birth.w;
        let lifetime = flame.identity.z;
        if lifetime == 0u || age < lifetime {
            bits |= 1u << at;
        }
        out += select(0u, 1u, lifetime != 0u && age == lifetime);
    }
    flame_runs[run] = vec2<u32>(bits, out);
}
