//! Scenes that stand on edges: of words, runs, pages and levels of the scan, and of what kernels
//! tell apart by the number of systems and rows.

use motes::backend::Backend;
use motes::plan::{FrameInputs, Plan, Turn};

use super::{frames_of, on_cpu, scene_of, set_lifetime};

/// A plan and frames whose numbers of particles present, the living and the newborn, are those of
/// `totals`: to stand on the edges of words, runs, pages and levels of the scan. Where more are
/// alive than that, frames without births come first. A quarter dies in the frame of its birth.
pub(crate) fn counted(capacity: u32, totals: &[u32]) -> (Plan, Vec<FrameInputs>) {
    let scene = scene_of(&format!(
        r#"
capacity = {capacity}
[image]
width = 8
height = 8
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "counted"
initial_mean_parts = 1
birth_rounding = "nearest"
generation_shape = {{ kind = "rectangle", length = 1, width = 1 }}
speed = {{ mean = 0.1, var = 0.05 }}
lifetime = {{ mean = 2, var = 0.9 }}
color = {{ mean = [0.5, 0, 0], var = [0.5, 0, 0] }}
intensity_threshold = 0.25
size = 0.01
acceleration = [0.01, -0.02, 0.03]
"#
    ));
    let plan = Plan::new(&scene, 1).expect("the scene can be planned");
    let mut cpu = on_cpu(&plan);
    let mut frames: Vec<FrameInputs> = Vec::new();
    let mut live = 0;
    let mut totals = totals.iter().peekable();
    while let Some(total) = totals.peek() {
        let births = total.checked_sub(live);
        if births.is_some() {
            totals.next();
        }
        let mut inputs = plan.inputs(frames.len() as u32);
        inputs.systems[0].mean_parts = births.unwrap_or(0) as f32;
        cpu.step(&inputs).expect("the processor steps");
        live = cpu.read("counts").expect("a state buffer")[0];
        frames.push(inputs);
    }
    (plan, frames)
}

/// A plan and frames of generations that die all at once, one frame old: so many are born each
/// frame, and all of them survive it. The survivors begin and end where those numbers say.
pub(crate) fn generations(births: &[u32]) -> (Plan, Vec<FrameInputs>) {
    let (plan, _) = counted(EDGES_CAPACITY, &[]);
    let of = |(frame, births): (usize, &u32)| {
        let mut inputs = plan.inputs(frame as u32);
        inputs.systems[0].mean_parts = *births as f32;
        let row = &mut inputs.rows[0];
        (row.color_mean[0], row.color_var[0]) = (1.0, 0.0);
        (row.speed_and_lifetime[2], row.speed_and_lifetime[3]) = (1.0, 0.0);
        inputs
    };
    let frames = births.iter().enumerate().map(of).collect();
    (plan, frames)
}

/// Generations whose survivors begin and end on the edges of pages, with nothing before them.
pub(crate) const GENERATIONS: &[u32] = &[5000, 2048, 4096, 4096, 1, 0, 2048, 2048, 6144, 2048];

/// Totals on the edges of words of 32, runs of 2,048 and pages of as many, in an order that leaves
/// something behind the end; for [`counted`] with room for [`EDGES_CAPACITY`].
pub(crate) const EDGES: &[u32] = &[
    8192, 8191, 6145, 4097, 6144, 4096, 4095, 2049, 4159, 1984, 2080, 2048, 65, 33, 8192, 64, 32,
    31, 1, 0, 2047, 2049, 8161, 6145,
];

/// Room for [`EDGES`], with none to spare in the sums of 2,048.
pub(crate) const EDGES_CAPACITY: u32 = 8192;

/// Totals on the edges of the scan's levels, 131,072 particles a sum of the second, and more than
/// the 262,144 particles of one row of workgroups of 8; with room for [`CROWD_CAPACITY`].
pub(crate) const CROWD: &[u32] = &[290_000, 262_145, 262_144, 131_073, 131_072];

/// Room for [`CROWD`].
pub(crate) const CROWD_CAPACITY: u32 = 290_000;

/// A plan of `count` systems whose every parameter differs, with `row_count` rows kept for each,
/// and a few frames: what is looked up by system and birth frame must not be another's. 1 or 2
/// systems and 1 or 2 rows are told apart by kernels.
pub(crate) fn few_systems(count: u32, row_count: u32) -> (Plan, Vec<FrameInputs>) {
    let system = |slot: u32| {
        format!(
            r#"
[[system]]
name = "s{slot}"
position = [{slot}.25, 0.5, -0.1]
rotation_degrees = [1{slot}, 45]
initial_mean_parts = 150
var_parts = 20
generation_shape = {{ kind = "circle", radius = 0.{slot}5 }}
ejection_angle_degrees = 30
speed = {{ mean = 0.{slot}4, var = 0.05 }}
lifetime = 1
color = {{ mean = [{red}, 0.2, 0.{slot}1], var = [0.1, 0.2, 0.05], rate = [0.01, 0.02, 0.03] }}
size = {{ mean = 0.0{slot}4, var = 2 }}
acceleration = [0.{slot}1, -0.02, 0.03]
particle_shape = "{shape}"
intensity_threshold = 0.3
"#,
            red = [0.3, 0.33, 0.2][slot as usize % 3],
            shape = ["streak", "rectangle", "sphere"][slot as usize % 3]
        )
    };
    let scene = scene_of(&format!(
        "[image]\nwidth = 63\nheight = 47\n[camera]\nposition = [0.5, 0.3, 3]\n\
         target = [0.5, 0.5, 0]\n{}",
        (0..count).map(system).collect::<String>()
    ));
    let mut turned = scene.clone();
    for system in &mut turned.systems {
        set_lifetime(system, (row_count as f32 - 1.0).max(1.0), 0.0);
        system.speed.mean = -0.3;
        system.color.initial.mean.reverse();
    }
    let turns = [Turn {
        frame: 1,
        scene: turned,
    }];
    let turns = if row_count == 1 { &turns[..0] } else { &turns };
    let plan = Plan::with_turns(&scene, turns, 5).expect("the scene can be planned");
    assert_eq!((plan.system_count, plan.row_count), (count, row_count));
    let frames = frames_of(&plan, 5);
    (plan, frames)
}

/// A plan of so many systems that the births they ask for do not fit 32 bits, and a frame of it.
pub(crate) fn beyond_32_bits() -> (Plan, Vec<FrameInputs>) {
    let system = |slot: u32| {
        format!(
            "[[system]]\nname = \"s{slot}\"\ninitial_mean_parts = 16e6\nspeed = 0.1\n\
             generation_shape = {{ kind = \"sphere\", radius = 1 }}\nlifetime = 9\n\
             color = [0.1, 0.1, 0.1]\nsize = 0.1\n"
        )
    };
    let scene = scene_of(&format!(
        "capacity = 100\n[image]\nwidth = 8\nheight = 8\n[camera]\nposition = [0, 0, 5]\n\
         target = [0, 0, 0]\n{}",
        (0..300).map(system).collect::<String>()
    ));
    let plan = Plan::new(&scene, 1).expect("the scene can be planned");
    let frames = frames_of(&plan, 1);
    (plan, frames)
}
