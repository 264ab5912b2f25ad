//! Every stage of spreading on every adapter against the processor, bit for bit.

use motes::gpu::GpuOptions;
use motes::plan::{FrameInputs, Plan};
use motes::scene::Scene;

use crate::common::*;

/// Fronts of every kind at once: they move and turn, cross edges, corners and borders, meet inner and
/// outer edges, begin at different times, and have too little room in the end.
fn all_kinds(max_points: u32) -> Scene {
    let fires = [
        (
            "lifetime = 9\ngrowth_frames = 4\nposition = { keys = [[0, [0, 0.5, 0]], [30, [0.6, 0.7, 0.2]]] }\n\
             rotation_degrees = { keys = [[0, [10, 0]], [30, [25, 80]]] }",
            "mesh = \"cube\"\nscale = 0.5\ntime_scale = 0.3\nseparation = 0.05\ndrop_distance = 0.06\nmax_flames = 40\nchar = { max_marks = 50 }",
            "position = [0, 0, 0.5]\npoints = 8\n[[fire.spread.ignition]]\nposition = [0.5, 0.4, 0.1]\nfirst_frame = 7",
        ),
        (
            "wind_factor = 3\nlifetime = 4\nlights = 3",
            "mesh = \"torus\"\ntime_scale = 0.4\nheading = \"normal\"\nseparation = 0.1\ndrop_distance = 0.05\ndrop_counter = \"carry\"\nmax_flames = 60\nchar = { size = 0.3, glow_frames = 3, edge_softness = 0.4, max_marks = 30 }\nline = { width = 0.02, opacity = 0.7 }\ncurvature_distance = 0.03",
            "position = [1, 0.1, 0]",
        ),
        (
            "rotation_degrees = [-90, 0]",
            "mesh = \"plane\"\ntime_scale = { keys = [[0, 0.1], [20, 1]] }\ninsertion = \"midpoint\"\nseparation = 0.2\ndrop_distance = 0.02\ndrop_counter = \"carry\"\nmax_flames = 90",
            "position = [0.1, 0.2, 0]\nfirst_frame = 2\npoints = 5",
        ),
        (
            "gravity = [0.2, -1, 0.1]",
            "mesh = \"sphere\"\nscale = 0.3\ntime_scale = 3\nseparation = 0.08\ncurvature = \"ignored\"\nmax_flames = 20",
            "position = [0, 1, 0]",
        ),
        (
            "",
            "mesh = \"cylinder\"\nscale = 0.4\ntime_scale = 2\nseparation = 0.03\ncurvature = \"literal\"\ncurvature_distance = 2\nmax_flames = 30",
            "position = [1, 0, 0.3]",
        ),
    ];
    let text: String = fires
        .iter()
        .enumerate()
        .map(|(at, (fire, spread, ignition))| {
            format!(
                "[[fire]]\nname = \"f{at}\"\n{fire}\n[fire.spread]\nmax_points = {max_points}\n{spread}\n\
                 [[fire.spread.ignition]]\n{ignition}\n"
            )
        })
        .collect();
    scene_of(&format!(
        "image = {{ width = 32, height = 24 }}
         camera = {{ position = [0, 0.6, 3], target = [0, 0.4, 0] }}
         {text}
         [ground]
         position = [0, -0.8, 0]
         radius = 5
         [[wind]]
         kind = \"vortex\"
         position = [0.2, 0, 0]
         speed = 0.3
         [[wind]]
         kind = \"noise\"
         strength = 0.1"
    ))
}

fn assert_twins(plan: &Plan, frames: &[FrameInputs], workgroup_size: u32) {
    let options = GpuOptions {
        workgroup_size,
        ..GpuOptions::default()
    };
    on_each_adapter(|name, device| {
        let mut gpu = on_gpu(device, plan, &options);
        if let Err(difference) = compare_run(frames, &mut gpu, &mut on_cpu(plan)) {
            panic!("{name}: {difference}");
        }
    });
}

#[test]
fn p78_everything_is_the_same_stage_by_stage() {
    let scene = all_kinds(400);
    let plan = Plan::new(&scene, 60).expect("the scene can be planned");
    for workgroup_size in [64, 256] {
        assert_twins(&plan, &frames_of(&plan, 40), workgroup_size);
    }
}

#[test]
fn p78_everything_is_the_same_where_points_are_dropped() {
    let scene = all_kinds(40);
    let plan = Plan::new(&scene, 60).expect("the scene can be planned");
    assert_twins(&plan, &frames_of(&plan, 40), 64);
}
