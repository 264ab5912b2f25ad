// large_work: how much work splat_large has in one page.
//
// One invocation. Reads: frame. Writes: large_particles (word 0, the count, becomes 0 for the next
// frame and is kept in word 1), dispatches.
// Invariant: splat_large looks at exactly the particles that splat has left to it.

#import motes::dispatch::dispatch_for
#import motes::footprint::SHARES
#import motes::layout::{Dispatch, Frame}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> large_particles: array<u32>;
@group(0) @binding(2) var<storage, read_write> dispatches: array<Dispatch>;

@compute @workgroup_size(1)
fn large_work() {
    let count = large_particles[0];
    large_particles[0] = 0u;
    large_particles[1] = count;
    let pairs = frame.page_count * (frame.page_count + 1u) / 2u;
    let place = 2u + 3u * frame.page_count + pairs + pages.page;
    dispatches[place] = dispatch_for(count * SHARES, WORKGROUP_SIZE);
}
