//! Footprints of many pixels are shared out over 256 invocations, row by row: in a picture with more
//! rows than that, each row is still drawn once. Also several systems whose parameters never change.

mod common;

use motes::gpu::GpuOptions;
use motes::plan::Plan;

const SCENE: &str = r#"
frames = 6
[image]
width = 700
height = 420
[camera]
position = [0, 0, 3]
target = [0, 0, 0]
[[system]]
name = "streaks"
initial_mean_parts = 2
generation_shape = { kind = "sphere", radius = 0.5 }
speed = { mean = 0.5, var = 0.5 }
lifetime = 4
color = [0.05, 0.02, 0.01]
size = { mean = 0.5, var = 0.4 }
particle_shape = "streak"
[[system]]
name = "squares"
initial_mean_parts = 2
generation_shape = { kind = "sphere", radius = 0.5 }
speed = 0.1
lifetime = 3
color = [0.01, 0.02, 0.05]
size = { mean = 0.6, var = 0.5 }
particle_shape = "rectangle"
[[system]]
name = "discs"
initial_mean_parts = 2
generation_shape = { kind = "sphere", radius = 0.5 }
speed = 0.1
lifetime = 2
color = [0.01, 0.05, 0.02]
size = { mean = 1.6, var = 1.5 }
"#;

#[test]
fn every_row_of_a_large_footprint_is_drawn_once() {
    let plan = Plan::new(&common::scene_of(SCENE), 0).expect("a good plan");
    let frames: Vec<_> = (0..5).map(|frame| plan.inputs(frame)).collect();
    common::on_each_adapter(|name, device| {
        let mut gpu = common::on_gpu(device, &plan, &GpuOptions::default());
        let mut cpu = common::on_cpu(&plan);
        common::compare_run(&frames, &mut gpu, &mut cpu)
            .unwrap_or_else(|difference| panic!("{name}: {difference}"));
    });
}
