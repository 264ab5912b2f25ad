//! Passes of a scene: which there are, and what each had to do.

use motes::backend::Backend;
use motes::bench::{Clock, Job, Measure, Part, Run, Target, run};
use motes::gpu::STAGE_KERNELS;
use motes::plan::{Plan, STAGES};
use motes::scene::Scene;

use crate::{common, counted, small, targets};

fn measured(targets: &[Target], scene: &Scene, frames: u32) -> Vec<Run> {
    let job = Job {
        scene,
        particles: None,
    };
    run(targets, &job, &counted(frames), &mut |_| true).expect("it is measured")
}

fn pass<'a>(run: &'a Run, name: &str) -> &'a Measure {
    let found = run.passes.iter().find(|pass| pass.name == name);
    found.unwrap_or_else(|| panic!("no pass `{name}` among {:?}", run.passes))
}

/// The kernels of the stages that the plan has.
fn kernels_of(plan: &Plan) -> Vec<&'static str> {
    let of_plan = STAGE_KERNELS.iter().filter(|of| plan.has(of.stage));
    of_plan.map(|of| of.kernel).collect()
}

#[test]
fn every_stage_and_kernel_is_a_pass_in_the_order_of_the_frame() {
    let plan = Plan::new(&small(), 1).expect("it is planned");
    for (target, run) in targets().iter().zip(measured(&targets(), &small(), 3)) {
        let names: Vec<&str> = run.passes.iter().map(|pass| pass.name.as_str()).collect();
        let timed = run.frame_ms.clock == Clock::GpuTimestamps;
        let expected: Vec<&str> = match target {
            Target::Cpu => {
                let stages = STAGES.iter().filter(|info| plan.has(info.stage));
                stages.map(|info| info.name).collect()
            }
            Target::Gpu(_) => {
                let mut kernels = kernels_of(&plan);
                if timed && names.contains(&"draw/clear_light") {
                    // No kernel, but the device's own command, before the splat.
                    let splat = kernels.iter().position(|name| *name == "draw/splat");
                    kernels.insert(splat.expect("light is splatted"), "draw/clear_light");
                }
                kernels
            }
        };
        assert_eq!(names, expected, "{}", target.name());
        let draws = |pass: &&Measure| pass.part == Some(Part::Draw);
        let first = run.passes.iter().position(|pass| draws(&pass));
        let drawn = run.passes.iter().skip(first.expect("it draws"));
        assert!(drawn.clone().all(|pass| draws(&pass)) && drawn.count() >= 2);
        for pass in &run.passes {
            assert_eq!(pass.ms.samples.len(), 3, "{}", pass.name);
            assert_eq!(pass.note, None, "{}", pass.name);
        }
        assert_eq!((run.frames, run.frame_ms.samples.len()), (3, 3));
        assert_eq!(run.image_px, Some([64, 36]));
        let is_device = matches!(target, Target::Gpu(_));
        assert_eq!(run.gpu_memory_bytes.is_some(), is_device);
    }
}

#[test]
fn a_frame_is_its_passes_and_no_longer_than_the_machines_clock_says() {
    for run in measured(&targets(), &small(), 4) {
        for at in 0..4 {
            let sum = |part: Option<Part>| -> f64 {
                let of_part = |pass: &&Measure| part.is_none() || pass.part == part;
                let passes = run.passes.iter().filter(of_part);
                passes.map(|pass| pass.ms.samples[at]).sum()
            };
            for (told, part) in [
                (&run.frame_ms, None),
                (&run.step_ms, Some(Part::Step)),
                (&run.draw_ms, Some(Part::Draw)),
            ] {
                let difference = (told.samples[at] - sum(part)).abs();
                assert!(difference < 1e-4, "{part:?} differs by {difference} ms");
            }
            let wall = run.wall_ms.as_ref().expect("it has one").samples[at];
            assert!(run.frame_ms.samples[at] <= wall * 1.001 + 0.01);
        }
    }
}

/// Counts by another way than the harness: a run of its own, particle by particle.
#[test]
fn items_and_bytes_are_what_the_frame_had() {
    let scene = small();
    let plan = Plan::new(&scene, 60).expect("it is planned");
    let mut cpu = common::on_cpu(&plan);
    let warm = 40;
    for frame in 0..=warm {
        cpu.step(&plan.inputs(frame)).expect("it steps");
    }
    cpu.draw(&plan.inputs(warm)).expect("it draws");
    let particles = cpu.read("particles").expect("it is read");
    let live = particles.len() as u64 / 8;
    let stats = cpu.take_statistics().expect("they are there");
    let last = stats.last().expect("the last frame");
    let (born, total) = (u64::from(last.born), live + u64::from(last.died));
    assert_eq!((live, born, total), (1000, 25, 1025));
    let light = cpu.read("light_low").expect("it is read");
    let mut lit = 0;
    for pixel in 0..64 * 36 {
        lit += u64::from((0..3).any(|channel| light[pixel * 3 + channel] != 0));
    }
    assert!(lit > 100);

    // One frame each: the same one.
    for (target, run) in targets().iter().zip(measured(&targets(), &scene, 1)) {
        assert_eq!((run.live, run.warm_up_frames), (Some(1000), 40));
        assert_eq!((run.particles, run.dropped), (1000, 0));
        let far = run.copy_kernel_gb_per_s.expect("a copy beside it");
        assert!(run.copy_in_cache_gb_per_s.is_some_and(|near| near >= far));
        let bytes = (4_194_304u64 * 64) as f64;
        let copy_ms = run.copy_ms.as_ref().expect("its samples").median;
        assert!((far * copy_ms * 1e6 / bytes - 1.0).abs() < 1e-6);
        let is_device = matches!(target, Target::Gpu(_));
        assert_eq!(run.dispatch_ms.is_some(), is_device);
        // 1025 particles are 33 words, in one run, in one run of runs.
        let kernels: &[(&str, u64, u64)] = &[
            ("systems/births", 1, plan_frame_bytes() + 4),
            ("systems/offsets", 1, 8),
            ("particles/emit", 25, 25 * 32),
            ("particles/cull", 1025, (25 + 33) * 8 + 33 * 4),
            ("scan/count_bits", 33, 34 * 4),
            ("scan/sum_runs", 1, 8),
            ("scan/survivors", 1, 8),
            ("scan/spread_runs", 1, 12),
            ("scan/spread_bits", 33, 67 * 4),
            ("scan/pages", 1, 2 * 12 + 8),
            ("particles/advance", 1025, 1000 * 64 + 33 * 8),
            ("draw/splat", 1000, 1000 * 32 + lit * 24),
            ("draw/large_work", 1, 24),
            ("draw/splat_large", 0, 0),
            ("draw/resolve", 2304, 2304 * 28),
        ];
        for (kernel, items, bytes) in kernels {
            let name = match target {
                Target::Cpu => kernel.rsplit('/').next().expect("a name"),
                Target::Gpu(_) => kernel,
            };
            let is_stage = STAGES.iter().any(|info| info.name == name);
            if matches!(target, Target::Cpu) && !is_stage {
                continue;
            }
            let pass = pass(&run, name);
            let told = (pass.items, pass.bytes);
            assert_eq!(told, (*items, *bytes), "{name} on {}", target.name());
            let rate = pass.gb_per_s.unwrap_or(0.0) * pass.ms.median * 1e6;
            let off = (rate - *bytes as f64).abs();
            assert!(off <= 1e-3 * *bytes as f64, "{name}: {rate}");
            // All of this fits in a cache.
            let copy = run.copy_in_cache_gb_per_s.expect("a copy beside it");
            if let (Some(share), Some(rate)) = (pass.share_of_copy, pass.gb_per_s) {
                assert!((share * copy - rate).abs() <= 1e-6 * rate, "{name}");
            }
        }
    }
}

/// A system's inputs in a frame, as WGSL lays them out.
fn plan_frame_bytes() -> u64 {
    let layout = motes::gpu::shader::struct_layout("lib/layout", "SystemFrame");
    let shape = layout.expect("it composes").expect("it is there");
    shape.stride.into()
}

#[test]
fn particles_that_cover_many_pixels_are_items_of_their_own_kernel() {
    let text = crate::SMALL.replace("size = 0.05", "size = 2.5");
    let text = text.replace("width = 64\nheight = 36", "width = 160\nheight = 90");
    let large = motes::scene::parse(&text, "large.toml", "large").expect("a good scene");
    let large = large.with_births(0.08);
    for (target, run) in targets().iter().zip(measured(&targets(), &large, 1)) {
        if let Target::Gpu(_) = target {
            let work = pass(&run, "draw/splat_large");
            // All that are seen: the camera has them all before it.
            assert_eq!((work.items, work.bytes), (80, 80 * 36));
        }
    }
}

/// Whatever is in a scene is measured by the same harness; passes that take turns are told together.
#[test]
fn flocks_and_what_covers_are_measured_as_anything_else() {
    let mut scene = motes::scene::load("flock").expect("it is built in");
    (scene.image.width, scene.image.height) = (96, 54);
    for (target, run) in targets().iter().zip(measured(&targets(), &scene, 2)) {
        assert_eq!((run.live, run.warnings.len()), (Some(500), 0), "{run:?}");
        if let Target::Gpu(_) = target {
            assert_eq!(pass(&run, "flock/steer").items, 500);
            assert_eq!(pass(&run, "draw/boid_shapes").items, 500);
            assert_eq!(pass(&run, "sort/place_digits").items, 4 * 500);
            if run.frame_ms.clock == Clock::GpuTimestamps {
                // Four passes of 8 bits.
                assert_eq!(pass(&run, "sort/place_digits").dispatches, Some(4));
                let (ms, count) = run.dispatches_ms().expect("it has dispatches");
                let expected = run.passes.len() as u32 + 4 * 3;
                assert!(count >= expected, "{count} of {expected}");
                let each = run.dispatch_ms.as_ref().expect("measured").median;
                assert!((ms - each * f64::from(count)).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn pages_make_no_passes_of_their_own() {
    // The pass of a kernel holds the dispatches of all pages; only the page count shows.
    let scene = small();
    let plan = Plan::new(&scene, 50).expect("it is planned");
    let options = motes::gpu::GpuOptions {
        timed: true,
        page_bytes: 1 << 16,
        ..Default::default()
    };
    let many = scene.with_births(20.0);
    let plan_of_many = Plan::new(&many, 50).expect("it is planned");
    for plan in [plan, plan_of_many] {
        // 2048 particles of 32 bytes each.
        let pages = plan.capacity.div_ceil(2048);
        let device = common::open("llvmpipe");
        let mut backend = common::on_gpu(&device, &plan, &options);
        assert_eq!(backend.page_count(), pages);
        backend.step(&plan.inputs(0)).expect("it steps");
        backend.draw(&plan.inputs(0)).expect("it draws");
        let times = backend.take_times().expect("it is timed");
        let names: Vec<_> = times.iter().flatten().map(|(name, _)| *name).collect();
        let mut kernels = kernels_of(&plan);
        let splat = kernels.iter().position(|name| *name == "draw/splat");
        kernels.insert(splat.expect("light is splatted"), "draw/clear_light");
        assert_eq!(names, kernels);
    }
}
