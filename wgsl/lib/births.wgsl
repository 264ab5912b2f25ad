// How many a system bears in a frame, particles or systems.
//
// Reeves 1983, 2.1: NParts = MeanParts + Rand() VarParts, or that times the screen area of the
// system, and bursts besides; made whole by stochastic rounding (or to the nearest), never negative.
// Reads and writes no buffers. Invariant: it depends on the system, the view and the frame alone;
// twin of src/cpu/systems/births.rs.
#define_import_path motes::births

#import motes::area::screen_area_px
#import motes::exact::{at_least_zero, to_i32}
#import motes::layout::{Frame, SYSTEM_PER_AREA, SYSTEM_STOCHASTIC, SystemFrame}
#import motes::particle::{Identity, STREAM_BIRTHS, draw}
#import motes::rng::{signed_float, unit_float}

// Below 2^24, so that a count is exact as a float.
const MOST_BIRTHS: i32 = 16777215;

fn births_of(view: Frame, system: SystemFrame) -> u32 {
    let random = draw(Identity(system.key, view.frame, 0u), STREAM_BIRTHS);
    var wanted = system.mean_parts + signed_float(random.x) * system.var_parts;
    if (system.flags & SYSTEM_PER_AREA) != 0u {
        wanted *= screen_area_px(view, system.bounding_sphere);
    }
    let burst = system.burst_parts + signed_float(random.z) * system.burst_var;
    // Neither takes from the other.
    wanted = at_least_zero(wanted) + at_least_zero(burst);
    let stochastic = (system.flags & SYSTEM_STOCHASTIC) != 0u;
    let count = to_i32(wanted + select(0.5f, unit_float(random.y), stochastic));
    return u32(min(count, MOST_BIRTHS));
}
