// births: how many particles each system asks for in this frame.
//
// Reeves 1983, 2.1: NParts = MeanParts + Rand() VarParts, or that times the screen area of the
// system, and bursts besides; made whole by stochastic rounding (or to the nearest), never negative.
// One invocation a system. Reads: frame, system_frames. Writes: birth_counts.
// Invariant: birth_counts[s] depends on the system, the view and the frame alone.

#import motes::area::screen_area_px
#import motes::exact::{at_least_zero, to_i32}
#import motes::layout::{Frame, SYSTEM_PER_AREA, SYSTEM_STOCHASTIC, SystemFrame}
#import motes::particle::{Identity, STREAM_BIRTHS, draw}
#import motes::rng::{signed_float, unit_float}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

// Below 2^24, so that a count is exact as a float.
const MOST_BIRTHS: i32 = 16777215;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read_write> birth_counts: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn births(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let slot = global_id.x;
    if slot >= frame.system_count {
        return;
    }
    let key = system_frames[slot].key;
    let random = draw(Identity(key, frame.frame, 0u), STREAM_BIRTHS);
    let flags = system_frames[slot].flags;
    var wanted = system_frames[slot].mean_parts
        + signed_float(random.x) * system_frames[slot].var_parts;
    if (flags & SYSTEM_PER_AREA) != 0u {
        wanted *= screen_area_px(frame, system_frames[slot].bounding_sphere);
    }
    let burst = system_frames[slot].burst_parts
        + signed_float(random.z) * system_frames[slot].burst_var;
    // Neither takes from the other.
    wanted = at_least_zero(wanted) + at_least_zero(burst);
    let stochastic = (flags & SYSTEM_STOCHASTIC) != 0u;
    let count = to_i32(wanted + select(0.5f, unit_float(random.y), stochastic));
    birth_counts[slot] = u32(min(count, MOST_BIRTHS));
}
