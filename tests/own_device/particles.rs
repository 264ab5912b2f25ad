//! The particles on the device, for callers who draw them themselves.

use motes::backend::Backend;
use motes::gpu::GpuOptions;
use motes::layout::{Counts, Particle};
use motes::plan::Plan;
use motes::{Options, Simulation};

use super::{Caller, common, on_processor};

#[test]
fn the_pages_hold_the_living_in_their_order_after_every_step() {
    let mut scene = common::everything();
    for system in &mut scene.systems {
        system.births.initial_mean_parts *= 12.0;
    }
    let options = || Options {
        gpu: GpuOptions {
            // 2,048 particles.
            page_bytes: 1 << 16,
            ..GpuOptions::default()
        },
        ..Options::default()
    };
    let plan = Plan::new(&scene, 0).expect("it can be planned");
    for name in common::adapters() {
        let mut processor = common::on_cpu(&plan);
        let mut caller = Caller::new(&name, &scene, options());
        let mut most = 0;
        for frame in 0..6 {
            processor.step(&plan.inputs(frame)).expect("it steps");
            caller.simulation.step().expect("it steps");
            let expected = processor.read("particles").expect("it reads");
            let buffers = caller.simulation.particle_buffers().expect("on a device");
            assert_eq!(buffers.page_len, 2048);
            let counts = caller.bytes_of(&buffers.counts, size_of::<Counts>() as u64);
            let counts: Counts = bytemuck::pod_read_unaligned(&counts);
            let mut left = counts.live;
            let mut got: Vec<u32> = Vec::new();
            for page in &buffers.pages {
                let here = left.min(buffers.page_len);
                let bytes = u64::from(here) * size_of::<Particle>() as u64;
                if bytes > 0 {
                    got.extend(bytemuck::pod_collect_to_vec::<u8, u32>(
                        &caller.bytes_of(page, bytes),
                    ));
                }
                left -= here;
            }
            assert!(got == expected, "{name}, frame {frame}");
            most = most.max(counts.live);
        }
        assert!(most > 2048, "more than a page: {most}");
    }
}

#[test]
fn the_pages_can_be_vertices_and_the_processor_has_none() {
    let scene = common::everything();
    let mut caller = Caller::new(&common::adapters()[0], &scene, Options::default());
    caller.simulation.step().expect("it steps");
    let buffers = caller.simulation.particle_buffers().expect("on a device");
    let usage = buffers.pages[0].usage();
    assert!(usage.contains(wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE));
    let mut processor: Simulation = on_processor(&scene);
    assert!(processor.particle_buffers().is_none());
}
