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
            "mesh = \"cube\"\nmaterial = [{ part = \"+x\", speed = 0.4, lifetime = 5 }, { part = \"+y\", speed = 1.7 }]\nscale = 0.5\ntime_scale = 0.3\nseparation = 0.05\ndrop_distance = 0.06\nmax_flames = 40\nchar = { max_marks = 50 }",
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

/// Spills, stains and grain, on letters that flames light one after the other while they move and turn.
fn further_kinds(max_points: u32) -> Scene {
    scene_of(&format!(
        "image = {{ width = 32, height = 24 }}
         camera = {{ position = [0, 0.6, 3], target = [0, 0.4, 0] }}
         [[surface]]
         mesh = \"letters:ion\"
         grain = {{ pattern = \"rings\", direction = [0.2, 1, 0.1], scale = 7, shift = 0.4 }}
         [[fire]]
         name = \"letters\"
         height = 0.5
         width = 0.1
         lifetime = 9
         wind_factor = 4
         position = {{ keys = [[0, [0, 0.2, 0]], [30, [0.3, 0.3, 0.1]]] }}
         rotation_degrees = {{ keys = [[0, [0, 0]], [30, [5, 30]]] }}
         [fire.spread]
         mesh = \"letters:ion\"
         catch_points = 7
         time_scale = 0.2
         separation = 0.06
         drop_distance = 0.08
         max_flames = 70
         max_points = {max_points}
         grain = {{ pattern = \"rings\", direction = [0.2, 1, 0.1], scale = 7, shift = 0.4 }}
         smoke = {{ speed = 0.06, frames = 20, max_puffs = 60 }}
         line = {{ width = 0.01 }}
         [[fire.spread.ignition]]
         position = [-1, 0.1, 0.2]
         [[fire.spread.ignition]]
         position = [1, 0, 0.2]
         first_frame = 25
         [[fire]]
         name = \"wine\"
         lifetime = 1
         [fire.spread]
         mesh = \"sphere\"
         law = \"spill\"
         time_scale = 0.3
         max_flames = 50
         max_points = 300
         grain = {{ pattern = \"stripes\", direction = [1, 0, 0], scale = 5, strength = 1 }}
         [[fire.spread.ignition]]
         position = [0.2, 0.9, 0]
         [[fire]]
         name = \"ink\"
         [fire.spread]
         mesh = \"plane\"
         law = \"stain\"
         heading = \"normal\"
         time_scale = 0.5
         max_flames = 50
         max_points = 300
         [[fire.spread.ignition]]
         position = [0.2, 0.3, 0]
         [[wind]]
         kind = \"uniform\"
         velocity = [0.4, 0.1, 0]"
    ))
}

#[test]
fn p86_p92_p94_everything_is_the_same_stage_by_stage() {
    let scene = further_kinds(700);
    let plan = Plan::new(&scene, 60).expect("the scene can be planned");
    let mut cpu = on_cpu(&plan);
    let frames = frames_of(&plan, 40);
    for inputs in &frames {
        motes::backend::Backend::step(&mut cpu, inputs).expect("it runs");
    }
    let rings = motes::backend::Backend::read(&mut cpu, "ring_spans").expect("they are read");
    let begun = rings.chunks(2).filter(|span| span[1] > 0).count();
    assert!(begun >= 5, "a letter lit by flames, of {begun} rings");
    assert_twins(&plan, &frames, 64);
}

#[test]
fn p86_everything_is_the_same_where_rings_are_dropped() {
    let scene = further_kinds(36);
    let plan = Plan::new(&scene, 60).expect("the scene can be planned");
    assert_twins(&plan, &frames_of(&plan, 40), 256);
}

#[test]
fn p78_everything_is_the_same_where_points_are_dropped() {
    let scene = all_kinds(40);
    let plan = Plan::new(&scene, 60).expect("the scene can be planned");
    assert_twins(&plan, &frames_of(&plan, 40), 64);
}
