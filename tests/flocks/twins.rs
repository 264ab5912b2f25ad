//! Every stage of flocks on every adapter against the processor, bit for bit.

use motes::gpu::GpuOptions;
use motes::plan::Plan;

use crate::common::*;
use crate::support::*;

fn assert_twins(plan: &Plan, frames: u32, options: &GpuOptions) {
    let frames = frames_of(plan, frames);
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, plan, options);
        if let Err(difference) = compare_run(&frames, &mut gpu, &mut on_cpu(plan)) {
            panic!("{name}: {difference}");
        }
    });
}

#[test]
fn f40_everything_is_the_same_stage_by_stage() {
    let options = GpuOptions {
        workgroup_size: 64,
        ..GpuOptions::default()
    };
    assert_twins(&plan(&all_kinds_of_flocks()), 12, &options);
}

#[test]
fn whatever_drives_boids_drives_them_the_same_everywhere() {
    let options = GpuOptions {
        workgroup_size: 32,
        ..GpuOptions::default()
    };
    assert_twins(&plan(&driven_flocks()), 12, &options);
}
