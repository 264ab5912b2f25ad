// births: how many particles each system asks for in this frame (motes::births).
//
// Reeves 1983, 2.1. One invocation a system; those that bear systems bear no particles.
// Reads: frame, system_frames. Writes: birth_counts.
// Invariant: birth_counts[s] depends on the system, the view and the frame alone.

#import motes::births::births_of
#import motes::layout::{Frame, SYSTEM_BEARS_SYSTEMS, SystemFrame}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read_write> birth_counts: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn births(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let slot = global_id.x;
    if slot >= frame.system_count {
        return;
    }
    let system = system_frames[slot];
    let count = births_of(frame, system);
    birth_counts[slot] = select(count, 0u, (system.flags & SYSTEM_BEARS_SYSTEMS) != 0u);
}
