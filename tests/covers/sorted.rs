//! The sort's kernels against the standard library's stable sort.

use motes::backend::Backend;
use motes::gpu::GpuOptions;
use motes::layout::Cover;
use motes::plan::Stage;

use crate::common::{hash, on_each_adapter, on_gpu};
use crate::{counts_of, plan_for, white};
use motes::cpu::cover::far_to_near;
use motes::cpu::shape::disc_of;

#[test]
fn pairs_are_sorted_stably_by_all_bits_of_their_keys() {
    let (plan, inputs) = plan_for(8, 8, 5000);
    on_each_adapter(|name, device| {
        let options = GpuOptions {
            workgroup_size: 24,
            ..GpuOptions::default()
        };
        let mut gpu = on_gpu(device, &plan, &options);
        for (salt, count) in [5000u32, 0, 1, 511, 512, 513, 1025, 4096]
            .into_iter()
            .enumerate()
        {
            // Any bits of depth but NaNs; every third is one of few, so that many are equal.
            let depth = |at: u32| {
                let bits = hash(at ^ (salt as u32) << 20);
                f32::from_bits(if at.is_multiple_of(3) {
                    0x4000_0000 + (bits % 5)
                } else {
                    bits & 0xbf7f_ffff
                })
            };
            let covers: Vec<Cover> = (0..count)
                .map(|at| match at % 17 {
                    0 => Cover::default(),
                    _ => disc_of(4.0, 4.0, 1.0, 0.0, &white(0.5, depth(at))),
                })
                .collect();
            let mut expected: Vec<(u32, u32)> = (0..count)
                .map(|at| (far_to_near(&covers[at as usize]), at))
                .collect();
            expected.sort_by_key(|pair| pair.0);
            gpu.write("covers", bytemuck::cast_slice(&covers))
                .expect("there is room");
            gpu.write("cover_counts", &counts_of(&covers))
                .expect("there is room");
            gpu.run_stage(Stage::Cover, &inputs).expect("it runs");
            let words = gpu.read("sort_pairs").expect("it is read");
            let got: Vec<(u32, u32)> = words
                .chunks(2)
                .take(count as usize)
                .map(|pair| (pair[0], pair[1]))
                .collect();
            assert!(got == expected, "{name}, {count} pairs");
        }
    });
}
