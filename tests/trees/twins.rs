//! Trees and planets on every adapter against the processor, bit for bit, stage by stage.

use motes::gpu::GpuOptions;
use motes::plan::Plan;
use motes::scene::Scene;

use crate::common::{self, frames_of};
use crate::support::{CHILD, PARENT, scene};

pub(crate) fn assert_twins(scene: &Scene, frames: u32) {
    // Workgroups that no page is a multiple of, too.
    for (page_bytes, workgroup_size) in [(64 << 10, 64), (1 << 20, 24)] {
        assert_twins_in(scene, frames, page_bytes, workgroup_size);
    }
}

fn assert_twins_in(scene: &Scene, frames: u32, page_bytes: u64, workgroup_size: u32) {
    let plan = Plan::new(scene, frames).expect("the scene can be planned");
    let frames = frames_of(&plan, frames);
    let options = GpuOptions {
        page_bytes,
        workgroup_size,
        ..GpuOptions::default()
    };
    common::assert_twins(&plan, &frames, &options);
}

#[test]
fn a_rich_tree_is_the_same_stage_by_stage() {
    assert_twins(&common::rich_tree(), 14);
}

#[test]
fn a_tree_without_enough_room_is_the_same() {
    let mut scene = common::rich_tree();
    scene.max_systems = Some(11);
    scene.capacity = Some(300);
    assert_twins(&scene, 14);
}

#[test]
fn rings_and_a_lit_planet_are_the_same_stage_by_stage() {
    assert_twins(&common::lit_planet(), 12);
}

#[test]
fn parents_in_many_slots_are_the_same() {
    let parent = PARENT.replace("parts = 3", "parts = 30");
    assert_twins(&scene(&[&parent, CHILD]), 10);
}
