//! How a plan is run on a device, and what of the kernels it leaves out.

use super::device::GpuDevice;
use crate::plan::Plan;

/// A change that a test makes to one kernel's module.
#[derive(Clone, Copy)]
pub struct Mutation<'a> {
    /// The kernel, e.g. `particles/advance`.
    pub kernel: &'a str,
    /// The change, after the lint.
    pub change: &'a dyn Fn(&mut naga::Module),
}

/// How to run on a device. None of these but `plain` changes a bit of the result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Invocations a workgroup, 8 ..= 256, a multiple of 8; 0 for the default of 256.
    pub workgroup_size: u32,
    /// Most bytes a page of the pools; 0 for as much as the adapter binds.
    pub page_bytes: u64,
    /// Pixels of the side of the tiles that what covers is sorted into, a multiple of 4 that is at
    /// most 256; 0 for the default of 16. Tiles are larger where they would be too many.
    pub tile_px: u32,
    /// Records of what covers that are drawn at a time, a multiple of 1,024 that is at most 32,768; 0
    /// for as many as memory is meant for.
    pub cover_slice: u32,
    /// Whether kernels check their own indices and bound their loops.
    pub checked: bool,
    /// Whether the adapter gets plain WGSL though it would take SPIR-V: what adapters that take
    /// none get. This alone may change bits.
    pub plain: bool,
    /// Whether 64-bit integers are left unused on a device that has them.
    pub narrow: bool,
    /// Whether kernels are timed, each in a pass of its own.
    pub timed: bool,
}

/// Switches that are off in a kernel of the plan: of what this does not use, or another kernel does.
pub(super) fn switches_off(
    plan: &Plan,
    gpu: &GpuDevice,
    kernel: &str,
    wide: bool,
) -> Vec<&'static str> {
    let switches = plan.uses.switches().into_iter();
    let throngs = plan.uses.throngs;
    // Who has been cut is counted in words that only wide devices have a binding for.
    let again = wide && gpu.ends_loops();
    let sixteens = throngs && (!wide || kernel == "flock/steer_again");
    switches
        .filter(|(switch, _)| *switch != "THRONGS")
        .chain([("THRONGS", throngs && again), ("SIXTEENS", sixteens)])
        .filter_map(|(switch, used)| (!used).then_some(switch))
        .collect()
}
