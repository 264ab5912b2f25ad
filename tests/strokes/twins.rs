//! Strokes on every adapter against the processor, bit for bit, stage by stage.

use motes::gpu::GpuOptions;
use motes::plan::Plan;

use crate::common::{self, assert_twins, frames_of};

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
        assert_twins(&plan, &frames, &options);
    }
}
