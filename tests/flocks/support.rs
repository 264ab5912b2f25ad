//! Scenes of flocks in a few lines, and runs of them.

use motes::backend::{Backend, Living};
use motes::layout::Boid;
use motes::plan::{FrameInputs, Plan, STAGES};
use motes::scene::Scene;

use crate::common;

/// A scene of these flocks, each a table's lines.
pub(crate) fn scene(flocks: &[&str]) -> Scene {
    let text: String = flocks
        .iter()
        .map(|lines| format!("[[flock]]\n{lines}\n"))
        .collect();
    common::scene_of(&format!(
        "image = {{ width = 64, height = 48 }}
         camera = {{ position = [250, 150, -400], target = [250, 150, 0], up = [0, -1, 0] }}
         {text}"
    ))
}

/// The built-in scene of that name.
pub(crate) fn shipped(name: &str) -> Scene {
    motes::scene::load(name).expect("it is built in")
}

/// The same of that seed.
pub(crate) fn shipped_of(name: &str, seed: u64) -> Scene {
    let mut scene = shipped(name);
    scene.seed = seed;
    scene
}

/// The same in this wind.
pub(crate) fn windy(wind: &str, flocks: &[&str]) -> Scene {
    let mut windy = scene(flocks);
    let text = format!(
        "camera = {{ position = [0, 0, -1], target = [0, 0, 0] }}\n{wind}\n[[flock]]\n{FREE}"
    );
    windy.winds = common::scene_of(&text).winds;
    windy
}

/// The article's 500 boids, without rules.
pub(crate) const FREE: &str = "name = \"boids\"
    count = 500
    region = { min = [0, 0, 0], max = [500, 300, 0] }
    edges = { kind = \"wrap\", min = [0, 0, 0], max = [500, 300, 0] }";

/// The same with all three rules.
pub(crate) fn flocking() -> String {
    format!("{FREE}\n[[flock.relation]]\nkind = \"flock\"\n")
}

/// The same with one rule.
pub(crate) fn one_rule(rule: &str) -> String {
    let rules = ["separation", "alignment", "cohesion"];
    let others = rules.iter().filter(|other| **other != rule);
    let lines: String = others
        .map(|other| format!("{other}_weight = 0\n"))
        .collect();
    format!("{}{lines}", flocking())
}

/// Three predators, as free as the boids of [`FREE`].
pub(crate) const PREDATORS: &str = "name = \"predators\"
    count = 3
    region = { min = [0, 0, 0], max = [500, 300, 0] }
    edges = { kind = \"wrap\", min = [0, 0, 0], max = [500, 300, 0] }
    size = 10
    color = [1, 0, 0]";

/// Steps one frame of the simulation, stage by stage.
pub(crate) fn step(backend: &mut dyn Backend, inputs: &FrameInputs) {
    for info in STAGES.iter().filter(|info| !info.draws) {
        backend.run_stage(info.stage, inputs).expect("it runs");
    }
}

/// The boids as they are.
pub(crate) fn boids(backend: &mut dyn Backend) -> Vec<Boid> {
    bytemuck::pod_collect_to_vec(&backend.read("boids").expect("boids can be read"))
}

/// A plan of the scene.
pub(crate) fn plan(scene: &Scene) -> Plan {
    Plan::new(scene, scene.frames).expect("the scene can be planned")
}

/// A place and a velocity.
pub(crate) type State = ([f32; 3], [f32; 3]);

/// Puts the boids of the plan's flocks, in order, into these states, as after frame 0.
pub(crate) fn place(backend: &mut dyn Backend, plan: &Plan, states: &[State]) {
    let slots = (0..).zip(plan.boid_counts());
    let ids = slots.flat_map(|(slot, count)| (0..count).map(move |index| (slot, index)));
    let boids: Vec<Boid> = states
        .iter()
        .zip(ids)
        .map(|((position, velocity), (slot, index))| {
            let [x, y, z] = position.map(f32::to_bits);
            let [vx, vy, vz] = velocity.map(f32::to_bits);
            Boid {
                position_and_flock: [x, y, z, slot],
                velocity_and_index: [vx, vy, vz, index],
            }
        })
        .collect();
    assert_eq!(boids.len(), plan.boid_count as usize, "one state a boid");
    // None has been elsewhere.
    let trails: Vec<[u32; 4]> = boids
        .iter()
        .zip(
            boids
                .iter()
                .map(|boid| plan.inputs(0).flocks[boid.flock() as usize]),
        )
        .flat_map(|(boid, flock)| {
            let [x, y, z, _] = boid.position_and_flock;
            let places = if flock.trail[2] > 0 {
                flock.trail[1] + 1
            } else {
                0
            };
            std::iter::repeat_n([x, y, z, 0], places as usize)
        })
        .collect();
    let living = Living {
        front: &[],
        particles: &[],
        boids: bytemuck::cast_slice(&boids),
        trails: bytemuck::cast_slice(&trails),
    };
    backend
        .restore(&living, &[plan.inputs(0)])
        .expect("there is room");
}

/// The states a frame after these, on the processor.
pub(crate) fn stepped(plan: &Plan, states: &[State]) -> Vec<State> {
    let mut cpu = common::on_cpu(plan);
    place(&mut cpu, plan, states);
    step(&mut cpu, &plan.inputs(1));
    states_of(&boids(&mut cpu))
}

pub(crate) fn states_of(boids: &[Boid]) -> Vec<State> {
    boids
        .iter()
        .map(|boid| (boid.position(), boid.velocity()))
        .collect()
}

/// What is left of a flock's `lines` when their `key`s are replaced.
pub(crate) fn with(lines: &str, keys: &[(&str, &str)]) -> String {
    let mut lines: Vec<String> = lines.lines().map(str::to_owned).collect();
    for (key, value) in keys {
        let starts = |line: &String| line.trim().starts_with(&format!("{key} ="));
        match lines.iter().position(starts) {
            Some(at) => lines[at] = format!("{key} = {value}"),
            None => lines.insert(0, format!("{key} = {value}")),
        }
    }
    lines.join("\n") + "\n"
}

/// Numbers that look random, the same each time (Steele et al. 2014, SplitMix).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let unit = ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1u64 << 53) as f64;
        low + unit * (high - low)
    }
}
