//! Trees and planets on every adapter against the processor, bit for bit, stage by stage.

use motes::gpu::GpuOptions;
use motes::plan::Plan;
use motes::scene::Scene;

use crate::common::{self, compare_run, frames_of, on_cpu, on_each_adapter, on_gpu};
use crate::support::{CHILD, PARENT, scene};

fn assert_twins(scene: &Scene, frames: u32) {
    let plan = Plan::new(scene, frames).expect("the scene can be planned");
    let frames = frames_of(&plan, frames);
    let options = GpuOptions {
        page_bytes: 64 << 10,
        workgroup_size: 64,
        ..GpuOptions::default()
    };
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, &plan, &options);
        if let Err(difference) = compare_run(&frames, &mut gpu, &mut on_cpu(&plan)) {
            panic!("{name}: {difference}");
        }
    });
}

/// Everything that children can have, on three levels, with parameters that change.
fn rich() -> Scene {
    let parent = "name = \"parent\"
        position = { keys = [[0, [0, 0, 0]], [12, [3, 1, 0]]] }
        rotation_degrees = { keys = [[0, [0, 10]], [12, [40, -30]]] }
        initial_mean_parts = 2.5
        var_parts = 2
        burst = [{ frame = 1, parts = 4 }]
        generation_shape = { kind = \"sphere\", radius = 3 }
        ejection_angle_degrees = 40
        speed = { mean = 0.2, var = 0.1 }
        lifetime = { mean = 6, var = 3 }
        acceleration = [0, -0.01, 0]
        color = [0, 0, 0]
        size = 1";
    let middle = "name = \"middle\"
        parent = \"parent\"
        child_up = \"outward\"
        particle_space = \"world\"
        end_frame = 4
        initial_mean_parts = 1
        generation_shape = { kind = \"ring\", inner_radius = 0.4, outer_radius = 1 }
        ejection_angle_degrees = 20
        speed = 0.1
        lifetime = 4
        color = { mean = [0.1, 0.2, 0.3], rate = [0.01, 0, 0] }
        size = { mean = 0.5, rate = 0.01 }
        [system.inherit]
        generation_scale = 0.4
        color = { mean = [0.1, 0.1, 0.1], var = [0.1, 0.1, 0.1], rate = [0.01, 0.01, 0.01] }
        size = { mean = 0.02, var = 0.01, rate = 0.001, rate_var = 0.001 }";
    let puff = "name = \"puff\"
        parent = \"middle\"
        rotation_degrees = [20, 30]
        position = [0.1, 0, 0.2]
        first_frame = 1
        initial_mean_parts_per_area = 0.05
        delta_mean_parts_per_area = -0.004
        var_parts_per_area = 0.01
        burst = [{ frame = 0, parts = { mean = 6, var = 3 } }]
        generation_shape = { kind = \"cone\", height = 0.5, angle_degrees = 20 }
        ejection_angle_degrees = 30
        speed = { keys = [[0, 0.1], [12, 0.3]] }
        lifetime = { mean = 5, var = 2 }
        acceleration = [0, 0, -0.02]
        acceleration_space = \"system\"
        color = { mean = [0.4, 0.1, 0.02], var = [0.1, 0, 0] }
        transparency = 0.2
        size = 0.05
        particle_shape = \"streak\"
        birth_moment = \"within_frame\"
        [system.inherit]
        mean_parts = 0.02
        var_parts = 0.01
        ejection_angle_degrees = 20
        speed = { mean = 0.05, var = 0.02 }
        lifetime = { mean = 1, var = 1 }
        transparency = { mean = 0.1, var = 0.1, rate = 0.01, rate_var = 0.01 }
        color = { mean = [0.1, 0.1, 0.1], rate_var = [0.01, 0.01, 0.01] }";
    let mut scene = scene(&[parent, middle, puff]);
    scene.camera.position = [0.0, 1.0, 14.0];
    scene
}

#[test]
fn a_rich_tree_is_the_same_stage_by_stage() {
    assert_twins(&rich(), 14);
}

#[test]
fn a_tree_without_enough_room_is_the_same() {
    let mut scene = rich();
    scene.max_systems = Some(11);
    scene.capacity = Some(300);
    assert_twins(&scene, 14);
}

#[test]
fn rings_and_a_lit_planet_are_the_same_stage_by_stage() {
    let scene = common::scene_of(&format!(
        "image = {{ width = 130, height = 70, background = [0.1, 0, 0.2] }}
         camera = {{ position = {{ keys = [[0, [4, 9, 20]], [12, [-3, 8, 19]]] }}, target = [0, 1, 5] }}
         light = {{ direction = [1, 0.2, 0.4], ambient = [0.05, 0.05, 0.05] }}
         planet = {{ center = [0.5, 0, 0], radius = 10, relief = 0.4, contrast = 0.8, octaves = 3 }}
         [[lamp]]
         position = [0, 0, 13]
         color = {{ keys = [[0, [0, 0, 0]], [6, [3, 2, 1]]] }}
         distance = 2
         [[system]]
         name = \"wall\"
         position = [0.5, 0, 10]
         generation_shape = {{ kind = \"rings\", radius = 10, wall_speed = 0.8, ring_frames = 2, density = 0.8 }}
         speed = 0
         lifetime = 8
         color = [0, 0, 0]
         size = 1
         [[system]]
         {CHILD}
         [system.inherit]
         speed = 0.1
         [[system]]
         name = \"stars\"
         first_frame = -1
         end_frame = 0
         initial_mean_parts = 400
         generation_shape = {{ kind = \"sphere\", radius = 60 }}
         speed = 0
         color = [1, 1, 1]
         size = {{ mean = 0.3, var = 0.25 }}"
    ).replace("\"parent\"", "\"wall\""));
    assert_twins(&scene, 12);
}

#[test]
fn parents_in_many_slots_are_the_same() {
    let parent = PARENT.replace("parts = 3", "parts = 30");
    assert_twins(&scene(&[&parent, CHILD]), 10);
}
