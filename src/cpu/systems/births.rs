//! births: how many particles each system asks for, where they go, and how many there is room for.
//! The float work is the twin of `wgsl/lib/births.wgsl`; the sums are plain Rust.

use crate::area::screen_area_px;
use crate::cpu::particle::{Identity, STREAM_BIRTHS, draw};
use crate::exact::{at_least_zero, shared_constants, to_i32};
use crate::layout::{
    Counts, Frame, SYSTEM_BEARS_SYSTEMS, SYSTEM_PER_AREA, SYSTEM_STOCHASTIC, SystemFrame,
};
use crate::plan::FrameInputs;
use crate::rng::{signed_float, unit_float};

shared_constants! {
    /// Below 2^24, so that a count is exact as a float.
    pub const MOST_BIRTHS: i32 = 16_777_215;
}

/// Births that the system asks for in `frame`, of particles or systems (Reeves 1983, 2.1).
pub fn births_of(system: &SystemFrame, frame: &Frame) -> u32 {
    let who = Identity {
        key: system.key,
        birth_frame: frame.frame,
        index: 0,
    };
    let random = draw(who, STREAM_BIRTHS);
    let mut wanted = system.mean_parts + signed_float(random.x) * system.var_parts;
    if system.flags & SYSTEM_PER_AREA != 0 {
        wanted *= screen_area_px(frame, system.bounding_sphere);
    }
    let burst = system.burst_parts + signed_float(random.z) * system.burst_var;
    // Neither takes from the other.
    wanted = at_least_zero(wanted) + at_least_zero(burst);
    let rounding = if system.flags & SYSTEM_STOCHASTIC != 0 {
        unit_float(random.y)
    } else {
        0.5
    };
    to_i32(wanted + rounding).min(MOST_BIRTHS) as u32
}

/// Births by system, and the running sum before each with the total at the end.
pub fn births(inputs: &FrameInputs) -> (Vec<u32>, Vec<u32>) {
    let counts: Vec<u32> = inputs
        .systems
        .iter()
        .map(|system| match system.flags & SYSTEM_BEARS_SYSTEMS {
            0 => births_of(system, &inputs.frame),
            _ => 0,
        })
        .collect();
    let mut offsets = vec![0];
    offsets.extend(counts.iter().scan(0u32, |sum, count| {
        *sum = sum.saturating_add(*count);
        Some(*sum)
    }));
    (counts, offsets)
}

/// The frame's books after the births: what does not fit in `capacity` is dropped.
pub fn book(live: u32, requested: u32, capacity: u32) -> Counts {
    let born = requested.min(capacity - live);
    Counts {
        live,
        requested,
        born,
        dropped: requested - born,
        total: live + born,
        ..Counts::default()
    }
}
