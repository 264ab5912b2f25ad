// large_work: how much work splat_large has in one page.
//
// One invocation. Reads: frame. Writes: large_particles (counts become 0 for the next frame and are
// kept behind), dispatches.
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
    let few = large_particles[0];
    let many = large_particles[1];
    large_particles[0] = 0u;
    large_particles[1] = 0u;
    large_particles[2] = few;
    large_particles[3] = many;
    let pairs = frame.page_count * (frame.page_count + 1u) / 2u;
    let place = 2u + 3u * frame.page_count + pairs + pages.page;
    dispatches[place] = dispatch_for(few + many * SHARES, WORKGROUP_SIZE);
}
