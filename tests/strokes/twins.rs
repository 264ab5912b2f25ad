//! Strokes on every adapter against the processor, bit for bit, stage by stage.

use motes::gpu::GpuOptions;
use motes::plan::Plan;

use crate::common::{self, compare_run, frames_of, on_cpu, on_each_adapter, on_gpu};

#[test]
fn strokes_are_the_same_stage_by_stage() {
    let plan = Plan::new(&common::all_kinds_of_strokes(), 6).expect("the scene can be planned");
    let mut frames = frames_of(&plan, 6);
    if let Some(last) = frames.last_mut() {
        last.frame.layer = 1;
    }
    for workgroup_size in [24, 256] {
        let options = GpuOptions {
            workgroup_size,
            cover_slice: 1024,
            // Several pages.
            page_bytes: 2048 * 32,
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
