//! Every stage of flames on every adapter against the processor, bit for bit.

use motes::gpu::GpuOptions;

use crate::common::*;
use crate::support::plan;

#[test]
fn p44_everything_is_the_same_stage_by_stage() {
    let plan = plan(&all_kinds_of_fires());
    let mut frames = frames_of(&plan, 8);
    // One of a layer.
    if let Some(last) = frames.last_mut() {
        last.frame.layer = 1;
    }
    for workgroup_size in [64, 256] {
        let options = GpuOptions {
            workgroup_size,
            ..GpuOptions::default()
        };
        on_each_adapter(|name, device| {
            let mut gpu = on_gpu(device, &plan, &options);
            if let Err(difference) = compare_run(&frames, &mut gpu, &mut on_cpu(&plan)) {
                panic!("{name}: {difference}");
            }
        });
    }
}
