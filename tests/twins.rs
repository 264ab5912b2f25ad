//! Every stage on every adapter against the processor, bit for bit: after each stage, every state
//! buffer that it writes; after each frame, digests and statistics.
mod common;

use common::*;
use motes::gpu::GpuOptions;
use motes::layout::Counts;
use motes::plan::{FrameInputs, Plan};

/// Small pages, so that survivors cross from page to page.
fn small_pages() -> GpuOptions {
    GpuOptions {
        page_bytes: 64 << 10,
        workgroup_size: 64,
        ..GpuOptions::default()
    }
}

#[test]
fn everything_is_the_same_stage_by_stage() {
    let scene = everything();
    let plan = Plan::new(&scene, scene.frames).expect("the scene can be planned");
    assert_twins(&plan, &frames_of(&plan, 16), &GpuOptions::default());
}

#[test]
fn everything_is_the_same_while_parameters_turn() {
    let plan = everything_turning(&everything());
    assert!(plan.row_count > 1);
    assert_twins(&plan, &frames_of(&plan, 16), &small_pages());
}

#[test]
fn everything_is_the_same_when_births_are_dropped() {
    let plan = everything_turning(&everything_within(2500));
    assert_twins(&plan, &frames_of(&plan, 12), &small_pages());
}

#[test]
fn what_moves_blows_and_ends_particles_is_the_same() {
    for flat in [false, true] {
        let (plan, frames) = windy_frames(flat, 16);
        assert_twins(&plan, &frames, &small_pages());
    }
}

#[test]
fn glaring_light_and_streaks_across_the_edges_are_the_same() {
    for scene in [glaring(), cut_corners()] {
        let plan = Plan::new(&scene, 3).expect("the scene can be planned");
        assert_twins(&plan, &frames_of(&plan, 3), &small_pages());
    }
}

#[test]
fn extreme_inputs_are_the_same_stage_by_stage() {
    for seed in 0..if full() { 200 } else { 6 } {
        // Where the 16 bits of birth frames wrap, and where the ring of statistics does.
        let first = [65_530, 131_066, 250][seed as usize % 3];
        let (plan, frames) = adversarial(seed, first, 10);
        assert_twins(&plan, &frames, &small_pages());
    }
}

#[test]
fn few_systems_are_the_same() {
    for (count, row_count) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
        let (plan, frames) = few_systems(count, row_count);
        assert_twins(&plan, &frames, &small_pages());
    }
}

#[test]
fn systems_on_their_way_to_the_origin_are_blown_where_they_are() {
    for (from, to) in [("[-3, 1, 2]", "[0, 0, 0]"), ("[0, 0, 0]", "[0, 2, 0]")] {
        let scene = scene_of(&format!(
            "capacity = 400\n[image]\nwidth = 64\nheight = 36\n[camera]\nposition = [0, 0, 9]\n\
             target = [0, 0, 0]\n[[wind]]\nkind = \"vortex\"\nspeed = 0.4\nradius = 1\n\
             position = [0, 0, 0]\naxis = [0, 0, 1]\n[[system]]\nname = \"s\"\n\
             initial_mean_parts = 30\nspeed = 0.02\nlifetime = 5\nsize = 0.1\ndrag = 0.4\n\
             generation_shape = {{ kind = \"sphere\", radius = 0.5 }}\ncolor = {{ mean = [1, 1, 1] }}\n\
             position = {{ keys = [[0, {from}], [7, {to}]] }}\n"
        ));
        let plan = Plan::new(&scene, 10).expect("the scene can be planned");
        assert_twins(&plan, &frames_of(&plan, 10), &small_pages());
    }
}

#[test]
fn births_on_meshes_are_the_same() {
    let scene = born_on_meshes();
    let plan = Plan::new(&scene, 4).expect("the scene can be planned");
    assert!(plan.meshes.choices.len() > 1 << 16);
    assert_twins(&plan, &frames_of(&plan, 4), &small_pages());
}

#[test]
fn nothing_at_all_is_the_same() {
    let plan = everything_turning(&everything_within(1));
    let mut frames = frames_of(&plan, 4);
    for inputs in &mut frames[..3] {
        for system in &mut inputs.systems {
            (system.mean_parts, system.var_parts) = (0.0, 0.0);
        }
    }
    assert_twins(&plan, &frames, &small_pages());
    let counts = |inputs: &FrameInputs| {
        let mut cpu = on_cpu(&plan);
        compare_run(std::slice::from_ref(inputs), &mut on_cpu(&plan), &mut cpu).expect("itself");
        let words = motes::backend::Backend::read(&mut cpu, "counts").expect("a state buffer");
        let [counts]: [Counts; 1] = bytemuck::pod_collect_to_vec(&words)
            .try_into()
            .expect("one");
        counts
    };
    assert_eq!(counts(&frames[0]), Counts::default());
    assert!(counts(&frames[3]).dropped > 0 && counts(&frames[3]).live == 1);
}

#[test]
fn large_shapes_are_the_same() {
    let scene = large_shapes(320, 300);
    let plan = Plan::new(&scene, 3).expect("the scene can be planned");
    assert_twins(&plan, &frames_of(&plan, 3), &small_pages());
}

#[test]
fn what_covers_is_the_same_stage_by_stage() {
    let scene = covering();
    let plan = Plan::new(&scene, 4).expect("the scene can be planned");
    let mut frames = frames_of(&plan, 4);
    frames[3].frame.layer = 1;
    for cover_slice in [0, 1024] {
        let options = GpuOptions {
            cover_slice,
            ..small_pages()
        };
        assert_twins(&plan, &frames, &options);
    }
}
