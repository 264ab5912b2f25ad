//! Scenes of flocks in a few lines, and runs of them.

use motes::backend::Backend;
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
