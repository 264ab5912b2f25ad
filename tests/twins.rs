//! Every stage on every adapter against the processor, bit for bit.
mod common;

use common::*;
use motes::gpu::GpuOptions;
use motes::plan::Plan;

#[test]
fn everything_is_the_same_stage_by_stage() {
    let scene = everything();
    let plan = Plan::new(&scene, scene.frames).expect("the scene can be planned");
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, &plan, &GpuOptions::default());
        let mut cpu = on_cpu(&plan);
        if let Err(difference) = compare_run(&frames_of(&plan, 16), &mut gpu, &mut cpu) {
            panic!("{name}: {difference}");
        }
    });
}
