//! The bits of a scene depend on nothing but the scene: not on the adapter, the workgroup size, the
//! pages that pools are cut into, checks in kernels, threads, or where a run begins.

mod common;

use std::collections::HashSet;

use motes::backend::Backend;
use motes::check::{CompareOptions, compare, default_frames, shrunk};
use motes::cpu::CpuBackend;
use motes::gpu::GpuOptions;
use motes::layout::FrameStats;
use motes::plan::Plan;
use motes::scene::{BUILTIN, Scene, load};
use motes::simulation::Simulation;

/// Everything that a frame leaves behind: its statistics, the digests of its state and image.
type Frame = (Vec<FrameStats>, u64, u64);

/// All frames of a run.
fn run(plan: &Plan, frames: u32, mut backend: impl Backend) -> Vec<Frame> {
    (0..frames)
        .map(|frame| {
            let inputs = plan.inputs(frame);
            backend.step(&inputs).expect("the machine does not fail");
            backend.draw(&inputs).expect("the machine does not fail");
            (
                backend
                    .take_statistics()
                    .expect("the machine does not fail"),
                backend.state_digest().expect("the machine does not fail"),
                backend.image_digest().expect("the machine does not fail"),
            )
        })
        .collect()
}

fn cpu(plan: &Plan, threads: Option<usize>) -> CpuBackend {
    CpuBackend::new(plan, threads).expect("the plan fits the processor")
}

/// The scene of all shapes, how it runs, and that a run of it says something.
fn everything() -> (Plan, Vec<Frame>) {
    let scene = common::everything();
    let plan = Plan::new(&scene, scene.frames).expect("the scene can be planned");
    let frames = run(&plan, scene.frames, cpu(&plan, None));
    let births: u32 = frames.iter().map(|(lines, ..)| lines[0].born).sum();
    let deaths: u32 = frames.iter().map(|(lines, ..)| lines[0].died).sum();
    assert!(
        births > 5000 && deaths > 1000,
        "{births} births, {deaths} deaths"
    );
    let mut digests: Vec<u64> = frames.iter().flat_map(|&(_, a, b)| [a, b]).collect();
    digests.sort_unstable();
    digests.dedup();
    assert_eq!(
        digests.len(),
        2 * frames.len(),
        "frames differ from each other"
    );
    (plan, frames)
}

/// Bytes of the smallest page: 2,048 particles.
const SMALL_PAGE: u64 = 1 << 16;

/// The same frames as the processor's in each variant on the first adapter.
fn assert_same(variants: impl IntoIterator<Item = GpuOptions>) {
    let (plan, expected) = everything();
    let device = common::open(&common::adapters()[0]);
    for options in variants {
        let what = format!(
            "workgroup {}, pages of {} bytes, checked: {}",
            options.workgroup_size, options.page_bytes, options.checked
        );
        let got = run(
            &plan,
            expected.len() as u32,
            common::on_gpu(&device, &plan, &options),
        );
        assert_eq!(got, expected, "{what}");
    }
}

#[test]
fn workgroup_sizes_change_nothing() {
    let of = |workgroup_size| GpuOptions {
        workgroup_size,
        ..GpuOptions::default()
    };
    assert_same([64, 128, 256, 8].map(of));
}

#[test]
fn pages_change_nothing() {
    let (plan, _) = everything();
    assert!(
        u64::from(plan.capacity) * 32 > 2 * SMALL_PAGE,
        "too few particles for three pages"
    );
    let of = |page_bytes| GpuOptions {
        page_bytes,
        ..GpuOptions::default()
    };
    // The last stands for as much as the adapter binds.
    assert_same([SMALL_PAGE, 0].map(of));
}

#[test]
fn pages_of_a_mebibyte_change_nothing() {
    const PAGE: u32 = 1 << 20;
    let options = GpuOptions {
        page_bytes: PAGE.into(),
        ..GpuOptions::default()
    };
    let device = common::open(&common::adapters()[0]);
    let on_gpu = |plan: &Plan, frames| run(plan, frames, common::on_gpu(&device, plan, &options));

    // Room for three pages: capacity changes no bits.
    let (tight, expected) = everything();
    let scene = Scene {
        capacity: Some(70_000),
        ..common::everything()
    };
    let roomy = Plan::new(&scene, scene.frames).expect("the scene can be planned");
    assert!(tight.capacity < PAGE / 32 && roomy.capacity > 2 * PAGE / 32);
    assert_eq!(on_gpu(&roomy, scene.frames), expected);

    // Particles in two pages.
    let mut crowd = crowd();
    crowd.systems[0].births.initial_mean_parts = 18_000.0;
    let plan = Plan::new(&crowd, crowd.frames).expect("the scene can be planned");
    let expected = run(&plan, crowd.frames, cpu(&plan, None));
    let most = expected.iter().map(|(lines, ..)| lines[0].live).max();
    assert!(most > Some(PAGE / 32), "{most:?} particles");
    assert_eq!(on_gpu(&plan, crowd.frames), expected);
}

/// Light in limbs alone, particles in words of 32 bits: what devices without 64-bit integers do.
#[test]
fn narrow_kernels_change_nothing() {
    let of = |workgroup_size| GpuOptions {
        workgroup_size,
        narrow: true,
        ..GpuOptions::default()
    };
    assert_same([0, 64].map(of));
}

#[test]
fn checked_kernels_change_nothing() {
    let of = |page_bytes| GpuOptions {
        page_bytes,
        checked: true,
        ..GpuOptions::default()
    };
    assert_same([0, SMALL_PAGE].map(of));
}

#[test]
fn another_driver_changes_nothing_with_everything_else_changed() {
    let (plan, expected) = everything();
    let adapters = common::adapters();
    let device = common::open(&adapters[adapters.len() - 1]);
    let options = GpuOptions {
        workgroup_size: 64,
        page_bytes: SMALL_PAGE,
        checked: true,
        ..GpuOptions::default()
    };
    let backend = common::on_gpu(&device, &plan, &options);
    assert_eq!(run(&plan, expected.len() as u32, backend), expected);
}

#[test]
fn threads_change_nothing() {
    let (plan, expected) = everything();
    for threads in [1, 2, 5] {
        assert_eq!(
            run(&plan, expected.len() as u32, cpu(&plan, Some(threads))),
            expected,
            "{threads} threads"
        );
    }
    // Chunks of particles go to threads: more than one of them.
    let crowd = crowd();
    let plan = Plan::new(&crowd, crowd.frames).expect("the scene can be planned");
    let of = |threads| run(&plan, crowd.frames, cpu(&plan, Some(threads)));
    assert_eq!(of(1), of(2));
}

#[test]
fn a_run_that_begins_late_is_the_whole_run() {
    let scene = Scene {
        frames: 40,
        ..common::everything()
    };
    let plan = Plan::new(&scene, scene.frames).expect("the scene can be planned");
    let whole = run(&plan, scene.frames, cpu(&plan, None));
    let device = common::open(&common::adapters()[0]);
    for frame in [3, 17, 29, 39] {
        let first = plan.restart_frame(frame);
        assert_eq!(first == 0, frame == 3, "{frame} is entered from {first}");
        let on_gpu = common::on_gpu(&device, &plan, &GpuOptions::default());
        let backends: [Box<dyn Backend>; 2] = [Box::new(cpu(&plan, None)), Box::new(on_gpu)];
        for backend in backends {
            let mut simulation = Simulation::with_backend(plan.clone(), backend);
            simulation.seek(frame).expect("the machine does not fail");
            simulation.draw().expect("the machine does not fail");
            let state = simulation
                .state_digest()
                .expect("the machine does not fail");
            let image = simulation
                .image_digest()
                .expect("the machine does not fail");
            let (_, whole_state, whole_image) = whole[frame as usize];
            let name = simulation.adapter_name();
            assert_eq!(
                (state, image),
                (whole_state, whole_image),
                "{frame} on {name}"
            );
            let line = simulation
                .take_statistics()
                .expect("the machine does not fail");
            let line = line.last().expect("frames were stepped");
            assert_eq!(*line, whole[frame as usize].0[0], "{frame} on {name}");
        }
    }
}

/// Frames of each scene in the bounded run: the whole one sees all deaths, too.
const FEW_FRAMES: u32 = 30;

/// The same of scenes whose fires spread: many flames are large in their pictures.
const FEW_FRAMES_OF_SPREADS: u32 = 8;

/// In the bounded run, adapters after the first leave out scenes whose kernels they have had.
#[test]
fn every_built_in_scene_passes_check_on_every_adapter() {
    let first = common::adapters().swap_remove(0);
    common::on_each_adapter(|adapter, device| {
        let mut met = HashSet::new();
        for builtin in BUILTIN {
            let scene = load(builtin.name).expect("it is built in");
            let frames = if common::full() {
                scene.frames
            } else {
                let spreads = scene.fires.iter().any(|fire| fire.spread.is_some());
                let few = if spreads {
                    FEW_FRAMES_OF_SPREADS
                } else {
                    FEW_FRAMES
                };
                default_frames(&scene).min(few)
            };
            let scene = match common::full() {
                true => scene,
                false => shrunk(&scene, frames).expect("it can be planned"),
            };
            let plan = Plan::new(&scene, frames).expect("it can be planned");
            let is_new = met.insert(plan.uses.switches());
            if !is_new && adapter != first && !common::full() {
                continue;
            }
            let outcome = compare(
                &plan,
                &mut || Ok(Box::new(common::on_cpu(&plan))),
                &mut || {
                    Ok(Box::new(common::on_gpu(
                        device,
                        &plan,
                        &GpuOptions::default(),
                    )))
                },
                &CompareOptions {
                    frames,
                    record: false,
                },
                &mut |_| {},
            )
            .expect("the machine does not fail");
            if let Some(difference) = &outcome.difference {
                panic!("{} on {adapter}:\n{difference}", builtin.name);
            }
            assert_eq!(outcome.frames, frames, "{}", builtin.name);
            // Flocks keep the number of their boids, and fires that of their flames.
            let few = if common::full() { 1000 } else { 50 };
            assert!(
                outcome.most_particles > few || plan.system_count == 0 || plan.fire_count > 0,
                "{}: {outcome:?}",
                builtin.name
            );
        }
    });
}

/// More particles than a thread takes at a time, born and dying in every frame.
fn crowd() -> Scene {
    common::scene_of(
        r#"
frames = 6
[image]
width = 64
height = 36
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "crowd"
initial_mean_parts = 9000
generation_shape = { kind = "sphere", radius = 1 }
speed = { mean = 0.1, var = 0.05 }
lifetime = { mean = 2, var = 1 }
color = [0.01, 0.02, 0.03]
size = 0.01
"#,
    )
}
