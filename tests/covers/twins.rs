//! Every adapter against the processor: any tiles, rounds and workgroups, on records that are no
//! scene's.

use motes::backend::Backend;
use motes::gpu::{GpuBackend, GpuOptions};
use motes::layout::Cover;
use motes::plan::{FrameInputs, Stage};

use crate::common::{adapters, first_difference, full, on_each_adapter, on_gpu};
use crate::{anything, counts_of, drawn, plan_for, white};
use motes::cpu::shape::{disc_of, segment_of, triangle_of};

/// Puts the records on the device, runs the stage, and compares it with the processor.
fn assert_same(gpu: &mut GpuBackend, inputs: &FrameInputs, covers: &[Cover], what: &str) {
    let expected: Vec<u32> = drawn(covers, &inputs.frame)
        .into_iter()
        .flat_map(|pixel| pixel.map(f32::to_bits))
        .collect();
    gpu.write("covers", bytemuck::cast_slice(covers))
        .expect("there is room");
    gpu.write("cover_counts", &counts_of(covers))
        .expect("there is room");
    gpu.run_stage(Stage::Cover, inputs).expect("it runs");
    let rg = gpu.read("cover_rg").expect("it is read");
    let bt = gpu.read("cover_bt").expect("it is read");
    let got: Vec<u32> = rg
        .chunks(2)
        .zip(bt.chunks(2))
        .flat_map(|(rg, bt)| [rg[0], rg[1], bt[0], bt[1]])
        .collect();
    assert_eq!(first_difference(&got, &expected), None, "{what}");
}

#[test]
fn any_tiles_and_rounds_and_workgroups_give_the_same_bits() {
    let (width, height) = (74, 53);
    let (plan, inputs) = plan_for(width, height, 5000);
    let variants: &[(u32, u32, u32)] = &[
        (0, 0, 0),
        (4, 1024, 24),
        (32, 2048, 64),
        (20, 1024, 8),
        (8, 0, 256),
        (256, 4096, 0),
    ];
    on_each_adapter(|name, device| {
        // The first adapter tries all of them.
        let is_first = name == adapters()[0];
        let tried = if full() || is_first {
            variants
        } else {
            &variants[..2]
        };
        for &(tile_px, cover_slice, workgroup_size) in tried {
            let options = GpuOptions {
                tile_px,
                cover_slice,
                workgroup_size,
                ..GpuOptions::default()
            };
            let mut gpu = on_gpu(device, &plan, &options);
            // Fewer than before, none, and again more: nothing of one frame is left in the next.
            let counts = if full() {
                [5000, 4097, 1, 0, 1024, 1025, 3000].as_slice()
            } else {
                &[3000, 300, 0, 1025]
            };
            for (seed, &count) in counts.iter().enumerate() {
                let covers = anything(count, width, height, seed as u32);
                assert_same(
                    &mut gpu,
                    &inputs,
                    &covers,
                    &format!("{name}, {options:?}, {count}"),
                );
            }
        }
    });
}

#[test]
fn all_in_one_tile_and_all_in_every_tile_are_the_same() {
    let (plan, inputs) = plan_for(64, 48, 1500);
    let in_one = |at: usize| {
        let spread = at as f32 * 0.001;
        disc_of(35.0 + spread, 40.0, 1.5, 0.3, &white(0.02, 1.0 + spread))
    };
    let in_every = |at: usize| disc_of(32.0, 24.0, 300.0, 0.0, &white(0.004, 1.0 + at as f32));
    on_each_adapter(|name, device| {
        let options = GpuOptions {
            cover_slice: 1024,
            ..GpuOptions::default()
        };
        let mut gpu = on_gpu(device, &plan, &options);
        let all: Vec<Cover> = (0..1500).map(in_one).collect();
        assert_same(&mut gpu, &inputs, &all, &format!("{name}, one tile"));
        let all: Vec<Cover> = (0..1500).map(in_every).collect();
        assert_same(&mut gpu, &inputs, &all, &format!("{name}, every tile"));
    });
}

#[test]
fn what_is_extreme_is_the_same() {
    let (plan, inputs) = plan_for(64, 48, 64);
    let look = white(0.5, 3.0);
    let far = [
        0.0, 1.0, -1.0, 31.5, 1e3, -1e3, 1e6, -1e7, 1e12, -1e30, 1e-30,
    ];
    let mut covers = Vec::new();
    for (at, &x) in far.iter().enumerate() {
        let y = far[(at * 7 + 3) % far.len()];
        let place = glam::Vec2::new(x, y);
        covers.push(disc_of(x, 20.0, 16_384.0, 0.5, &look));
        covers.push(disc_of(20.0, y, 1e-6, 0.0, &look));
        covers.push(segment_of(place, glam::Vec2::splat(20.0), 2.0, &look));
        covers.push(segment_of(place, place, 3.0, &look));
        covers.push(triangle_of(
            place,
            glam::Vec2::new(y, x),
            glam::Vec2::splat(9.0),
            &look,
        ));
    }
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, &plan, &GpuOptions::default());
        assert_same(&mut gpu, &inputs, &covers, name);
    });
    let pixels = drawn(&covers, &inputs.frame);
    assert!(pixels.iter().flatten().all(|value| value.is_finite()));
}
