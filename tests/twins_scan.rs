//! The scan over survivors and the compaction on every adapter against plain Rust, `retain` and
//! running sums: the processor's backend has no part in it.
mod common;

use common::*;
use motes::backend::Backend;
use motes::exact::snap;
use motes::gpu::{GpuBackend, GpuOptions, STAGE_KERNELS};
use motes::layout::{Counts, Particle};
use motes::plan::{FrameInputs, Plan};

fn read<T: bytemuck::Pod>(gpu: &mut GpuBackend, buffer: &str) -> Vec<T> {
    bytemuck::pod_collect_to_vec(&gpu.read(buffer).expect("the device reads back"))
}

/// What becomes of a survivor (Reeves 1983, 2.3), without the library's own helpers.
fn moved(particle: &Particle, inputs: &FrameInputs) -> Particle {
    let acceleration = inputs.systems[particle.slot() as usize].acceleration;
    let (position, velocity) = (particle.position(), particle.velocity());
    let mut moved = *particle;
    for axis in 0..3 {
        moved.position_and_index[axis] = snap(position[axis] + velocity[axis]).to_bits();
        moved.velocity_and_birth[axis] = snap(velocity[axis] + acceleration[axis]).to_bits();
    }
    moved
}

/// Runs the frames kernel by kernel and checks what each of the scan's leaves behind.
fn assert_scans(plan: &Plan, frames: &[FrameInputs], options: &GpuOptions) {
    let cut = Cut::new(options.workgroup_size, options.page_bytes, plan.capacity);
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, plan, options);
        for inputs in frames {
            let place = format!("{name}, frame {}", inputs.frame.frame);
            let mut present: Vec<Particle> = Vec::new();
            let mut alive: Vec<bool> = Vec::new();
            let mut lists = 0;
            for one in STAGE_KERNELS.iter().filter(|one| !one.stage.info().draws) {
                gpu.run_kernel(one, inputs)
                    .expect("the device runs every kernel");
                match one.kernel {
                    "systems/offsets" => {
                        let counts = read::<Counts>(&mut gpu, "counts")[0];
                        let expected = cut.after_offsets(&counts);
                        lists = expected.len();
                        let got = read::<u32>(&mut gpu, "dispatches");
                        assert_eq!(first_difference(&got[..lists], &expected), None, "{place}");
                    }
                    "particles/cull" => {
                        present = read(&mut gpu, "particles");
                        let bits: Vec<u32> = read(&mut gpu, "alive_bits");
                        assert_eq!(bits.len(), present.len().div_ceil(32), "{place}");
                        let all = bits
                            .iter()
                            .flat_map(|w| (0..32).map(move |at| w >> at & 1 == 1));
                        alive = all.collect();
                        assert!(
                            !alive[present.len()..].contains(&true),
                            "{place}: a bit too many"
                        );
                        alive.truncate(present.len());
                    }
                    "scan/spread_bits" => {
                        let got: Vec<u32> = read(&mut gpu, "word_ranks");
                        let mut before = 0;
                        for (word, bits) in alive.chunks(32).enumerate() {
                            let expected = bits.iter().rev().fold(0, |w, b| w << 1 | u32::from(*b));
                            let ranks = &got[word * 2..][..2];
                            assert_eq!(ranks, [before, expected], "{place}: word {word}");
                            before += bits.iter().filter(|alive| **alive).count() as u32;
                        }
                    }
                    "scan/pages" => {
                        let expected = cut.after_pages(&alive);
                        let got = &read::<u32>(&mut gpu, "dispatches")[lists..];
                        let got = &got[..expected.len()];
                        assert_eq!(first_difference(got, &expected), None, "{place}, pages");
                    }
                    _ => {}
                }
            }
            let mut at = 0;
            present.retain(|_| {
                at += 1;
                alive[at - 1]
            });
            let expected: Vec<_> = present.iter().map(|one| moved(one, inputs)).collect();
            let got: Vec<Particle> = read(&mut gpu, "particles");
            assert_eq!(got.len(), expected.len(), "{place}");
            let differs = got
                .iter()
                .zip(&expected)
                .position(|(got, expected)| got != expected);
            assert_eq!(
                differs, None,
                "{place}: the first survivor that is not as it should be"
            );
            let counts = read::<Counts>(&mut gpu, "counts")[0];
            assert_eq!(counts.live as usize, expected.len(), "{place}");
            assert_eq!(counts.total - counts.live, counts.died, "{place}");
        }
    });
}

#[test]
fn survivors_are_kept_in_order_across_pages() {
    let options = GpuOptions {
        workgroup_size: 32,
        page_bytes: 64 << 10,
        ..GpuOptions::default()
    };
    let plan = everything_turning(&everything());
    assert_scans(&plan, &frames_of(&plan, 12), &options);
    let plan = everything_turning(&everything_within(2500));
    assert_scans(&plan, &frames_of(&plan, 8), &options);
    let (plan, mut frames) = adversarial(3, 100, 6);
    // What moves them is for the twins to compare: here, the order counts.
    for system in frames.iter_mut().flat_map(|inputs| &mut inputs.systems) {
        system.acceleration[3] = 0.0;
    }
    assert_scans(&plan, &frames, &options);
}

#[test]
fn survivors_are_kept_in_order_on_the_edges_of_words_runs_and_pages() {
    let (plan, frames) = counted(EDGES_CAPACITY, EDGES);
    let options = GpuOptions {
        workgroup_size: 32,
        page_bytes: 64 << 10,
        ..GpuOptions::default()
    };
    assert_scans(&plan, &frames, &options);
    let (plan, frames) = generations(GENERATIONS);
    assert_scans(&plan, &frames, &options);
}

/// More particles than two sums of the second level, and than a row of the smallest workgroups.
#[test]
fn survivors_are_kept_in_order_through_all_levels_of_the_scan() {
    let (plan, frames) = counted(CROWD_CAPACITY, CROWD);
    let options = GpuOptions {
        workgroup_size: 8,
        page_bytes: 1 << 30,
        ..GpuOptions::default()
    };
    assert_scans(&plan, &frames, &options);
}
