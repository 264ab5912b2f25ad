//! Where an adapter takes no SPIR-V, plain WGSL runs: not exact, but the same picture to the eye.
//! Tried on an adapter that would take SPIR-V, for want of one that does not.

mod common;

use motes::backend::Backend;
use motes::gpu::GpuOptions;
use motes::plan::Plan;

#[test]
fn plain_wgsl_runs_and_says_that_it_is_not_exact() {
    let scene = common::everything();
    let plan = Plan::new(&scene, 0).expect("a good plan");
    common::on_each_adapter(|name, device| {
        let options = GpuOptions {
            plain: true,
            ..GpuOptions::default()
        };
        let mut plain = common::on_gpu(device, &plan, &options);
        let mut exact = common::on_gpu(device, &plan, &GpuOptions::default());
        assert!(!plain.is_exact(), "{name}");
        assert!(exact.is_exact(), "{name}");
        let mut live = (0, 0);
        for frame in 0..12 {
            let inputs = plan.inputs(frame);
            for backend in [&mut plain, &mut exact] {
                backend.step(&inputs).expect("it steps");
                backend.draw(&inputs).expect("it draws");
            }
            let count =
                |backend: &mut dyn Backend| backend.take_statistics().expect("it counts")[0].live;
            live = (count(&mut plain), count(&mut exact));
        }
        // A rounding at a threshold may kill a particle a frame sooner or later.
        assert!(live.0.abs_diff(live.1) <= 2, "{name}: {live:?} live");
        let bytes = |backend: &mut dyn Backend| -> Vec<u8> {
            let words = backend.read("image").expect("it reads");
            words.into_iter().flat_map(u32::to_le_bytes).collect()
        };
        let (got, expected) = (bytes(&mut plain), bytes(&mut exact));
        let lit = expected.iter().filter(|byte| **byte != expected[0]).count();
        assert!(lit > 1000, "{name}: a picture");
        let apart = got
            .iter()
            .zip(&expected)
            .filter(|(a, b)| a.abs_diff(**b) > 2)
            .count();
        assert!(
            apart * 200 < got.len(),
            "{name}: {apart} of {} bytes apart",
            got.len()
        );
    });
}
