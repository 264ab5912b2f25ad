//! Every stage of flames on every adapter against the processor, bit for bit.

use motes::backend::Backend;
use motes::gpu::GpuOptions;
use motes::plan::Stage;

use crate::common::*;
use crate::support::{plan, scene_with};

#[test]
fn p44_everything_is_the_same_stage_by_stage() {
    let plan = plan(&all_kinds_of_fires());
    let mut frames = frames_of(&plan, 8);
    // One of a layer.
    if let Some(last) = frames.last_mut() {
        last.frame.layer = 1;
    }
    // In one page, and in pages of 32 flames.
    for (workgroup_size, page_bytes) in [(64, 0), (256, 48 << 10)] {
        let options = GpuOptions {
            workgroup_size,
            page_bytes,
            ..GpuOptions::default()
        };
        assert_twins(&plan, &frames, &options);
    }
}

#[test]
fn p44_plain_flames_are_the_same_though_each_block_has_other_ages() {
    for name in ["candle", "torch"] {
        let mut scene = motes::scene::load(name).expect("it is built in");
        (scene.image.width, scene.image.height) = (200, 150);
        let plan = plan(&scene);
        let frames = frames_of(&plan, 2);
        for tile_px in [0, 8, 32] {
            let options = GpuOptions {
                tile_px,
                ..GpuOptions::default()
            };
            on_each_adapter(|on, device| {
                let mut gpu = on_gpu(device, &plan, &options);
                if let Err(difference) = compare_run(&frames, &mut gpu, &mut on_cpu(&plan)) {
                    panic!("{name} on {on}: {difference}");
                }
            });
        }
    }
}

#[test]
fn p76_more_flames_than_a_page_holds_are_the_same_as_fewer() {
    // Kindled one after the other, so slowly that a flame's number times the frames of it passes 2^32.
    let scene = scene_with(
        &[
            "name = \"field\"\nroots = { kind = \"disc\", radius = 1, count = 70_000 }\n\
           kindling_frames = 139_999\nlights = 3\nheight = { mean = 0.1, var = 0.05 }\nwidth = 0.01\n",
        ],
        "[ground]\nposition = [0, -0.1, 0]\nradius = 10\n",
    );
    let plan = plan(&scene);
    let inputs = plan.inputs(100_000);
    let mut cpu = on_cpu(&plan);
    let burning = |words: &[u32]| words.chunks(16).filter(|flame| flame[15] == 1).count();
    let stages = [
        (Stage::Kindle, "flames"),
        (Stage::Trace, "flame_steps"),
        (Stage::Lights, "flame_lights"),
        (Stage::FlameDiscs, "flame_discs"),
        (Stage::Glow, "light_low"),
    ];
    cpu.run_stage(Stage::Splat, &inputs).expect("it is dark");
    let wanted = stages.map(|(stage, buffer)| {
        cpu.run_stage(stage, &inputs).expect("it runs");
        cpu.read(buffer).expect("it is read")
    });
    assert_eq!(burning(&wanted[0]), 50_001);
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, &plan, &GpuOptions::default());
        gpu.run_stage(Stage::Splat, &inputs).expect("it is dark");
        for ((stage, buffer), wanted) in stages.into_iter().zip(&wanted) {
            gpu.run_stage(stage, &inputs).expect("it runs");
            let got = gpu.read(buffer).expect("it is read");
            assert!(got == *wanted, "{buffer} on {name}");
        }
    });
}

#[test]
fn p80_a_strip_that_fills_the_picture_is_whole() {
    let lines = "name = \"wall\"\nform = \"strip\"\nheight = 6\nwidth = 14\n[[fire.flame]]\nposition = [0, -2, -1]\n";
    let mut scene = scene_with(&[lines], "");
    (scene.image.width, scene.image.height) = (1280, 720);
    let plan = plan(&scene);
    let frames = frames_of(&plan, 1);
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, &plan, &GpuOptions::default());
        let mut cpu = on_cpu(&plan);
        if let Err(difference) = compare_run(&frames, &mut gpu, &mut cpu) {
            panic!("{name}: {difference}");
        }
    });
}
