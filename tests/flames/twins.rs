//! Every stage of flames on every adapter against the processor, bit for bit.

use motes::backend::Backend;
use motes::gpu::GpuOptions;
use motes::plan::{Plan, Stage};

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

#[test]
fn p80_more_strips_than_a_dispatch_has_are_all_drawn() {
    let scene = scene_with(
        &[
            "name = \"field\"\nform = \"line\"\nroots = { kind = \"disc\", radius = 1, count = 45_000 }\n\
           height = 0.1\nwidth = 0.01\n",
        ],
        "",
    );
    let plan = plan(&scene);
    let frames = frames_of(&plan, 1);
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, &plan, &GpuOptions::default());
        if let Err(difference) = compare_run(&frames, &mut gpu, &mut on_cpu(&plan)) {
            panic!("{name}: {difference}");
        }
    });
}

/// Pixels across and lines that each flame touches at a frame, cut off at the picture's edges.
fn touched(plan: &Plan, frame: u32) -> Vec<[u32; 2]> {
    let inputs = plan.inputs(frame);
    let mut cpu = on_cpu(plan);
    for stage in [Stage::Kindle, Stage::Trace, Stage::FlameDiscs] {
        cpu.run_stage(stage, &inputs).expect("it runs");
    }
    let words = cpu.read("flame_bounds").expect("they are read");
    let extent = |bounds: u32| (bounds >> 16) - (bounds & 0xffff);
    words
        .chunks(4)
        .map(|flame| [extent(flame[0]), extent(flame[1])])
        .collect()
}

#[test]
fn p26_flames_that_are_just_small_are_the_same_as_those_that_are_just_large() {
    // Ever wider and higher, in the middle of the picture and over its four edges.
    let mut flames = String::new();
    for (x, y) in [
        (0.0, 0.4),
        (-1.35, 0.5),
        (1.35, 0.45),
        (0.3, -0.65),
        (-0.4, 1.35),
    ] {
        let wider = (0..10).map(|at| (0.33 + 0.008 * f64::from(at), 0.3));
        let higher = (0..36).map(|at| (0.22, 0.3 + 0.012 * f64::from(at)));
        for (width, height) in wider.chain(higher) {
            flames += &format!(
                "[[fire.flame]]\nposition = [{x}, {y}, 0]\nwidth = {width}\nheight = {height}\n"
            );
        }
    }
    let looks = [
        "",
        "inner_alpha = 1.5\ninner_radius = 0.4\n",
        "particle_matrix = [0.9, 0.1, 0, 0.05, -0.1, 0.9, 0, -0.05, 0, 0, 1, 0, 0, 0, 0, 1]\n",
    ];
    let ball = "[[surface]]\nmesh = \"sphere\"\nscale = 0.5\nposition = [0.1, 0.5, 0.1]\n";
    let mut all = [0; 4];
    for rest in ["", ball] {
        for look in looks {
            let lines = format!("name = \"fire\"\nnoisiness = 0.02\n{look}{flames}");
            let plan = plan(&scene_with(&[&lines], rest));
            for [across, lines] in touched(&plan, 1) {
                all[0] += u32::from(across == 24 && lines <= 32);
                all[1] += u32::from(across == 25 && lines <= 32);
                all[2] += u32::from(lines == 32 && across <= 24);
                all[3] += u32::from(lines == 33 && across <= 24);
            }
            let frames = frames_of(&plan, 2);
            on_each_adapter(|name, device| {
                let mut gpu = on_gpu(device, &plan, &GpuOptions::default());
                if let Err(difference) = compare_run(&frames, &mut gpu, &mut on_cpu(&plan)) {
                    panic!("{name}: {look} {rest}: {difference}");
                }
            });
        }
    }
    assert!(all.iter().all(|count| *count > 3), "{all:?}");
}
