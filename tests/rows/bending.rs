//! The straight line suffices: Reeves (1983), section 3, footnote 4.

use motes::plan::Plan;
use motes::scene::{self, BUILTIN, ParticleShape, Scene};

use crate::support::Run;

/// The scene with at most about `most` particles alive, everything else as it is.
fn thinned(scene: &Scene, most: f32) -> Scene {
    let mut scene = scene.clone();
    let plan = Plan::new(&scene, scene.frames).expect("the scene can be planned");
    let share = (most / plan.capacity as f32).min(1.0);
    for births in scene.systems.iter_mut().map(|system| &mut system.births) {
        births.initial_mean_parts *= share;
        births.delta_mean_parts *= share;
        births.var_parts *= share;
    }
    scene.capacity = None;
    scene
}

#[test]
fn r60_shipped_scenes_bend_less_than_half_a_pixel_in_a_streak() {
    let mut streaks_seen = 0;
    for builtin in BUILTIN {
        let scene = scene::load(builtin.name).expect("a built-in scene is right");
        let is_streak =
            |system: u32| scene.systems[system as usize].particle_shape == ParticleShape::Streak;
        if !(0..scene.systems.len() as u32).any(is_streak) {
            println!("{}: no streaks", builtin.name);
            continue;
        }
        let mut run = Run::new("cpu", &thinned(&scene, 4000.0), scene.frames);
        let mut most = 0.0f32;
        for frame in 0..scene.frames {
            run.step_to(frame);
            let seen = run.simulation.plan().inputs(frame).frame;
            for member in run
                .members()
                .iter()
                .filter(|member| is_streak(member.state.system))
            {
                let [x, y, z] = member.state.position;
                let [rx, ry, rz, rw] = seen.view_from_world_z;
                let depth = rx * x + ry * y + rz * z + rw;
                if depth < seen.near {
                    continue;
                }
                let [ax, ay, az] = scene.systems[member.state.system as usize].acceleration;
                let bend = (ax * ax + ay * ay + az * az).sqrt() / 32.0;
                most = most.max(bend * seen.focal_px / depth);
                streaks_seen += 1;
            }
        }
        println!("{}: a streak bends by at most {most:.4} px", builtin.name);
        assert!(most < 0.5, "{}: a streak bends by {most} px", builtin.name);
    }
    assert!(streaks_seen > 1000, "the shipped scenes have streaks");
}
