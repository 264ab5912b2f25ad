//! Scenes of trees in a few lines, and runs of them on the processor.

use motes::backend::Backend;
use motes::cpu::CpuBackend;
use motes::layout::{Counts, NODE_FREE, Node, SystemFrame, SystemRow};
use motes::plan::Plan;
use motes::scene::Scene;
use motes::simulation::{AdapterChoice, Options, ParticleState, Simulation};

use crate::common;

/// A scene of these systems, a table's lines each.
pub(crate) fn scene(systems: &[&str]) -> Scene {
    let tables: String = systems
        .iter()
        .map(|lines| format!("[[system]]\n{lines}\n"))
        .collect();
    common::scene_of(&format!(
        "frames = 60
         image = {{ width = 160, height = 90 }}
         camera = {{ position = [0, 4, 40], target = [0, 0, 0] }}
         {tables}"
    ))
}

/// A system that bears three systems a frame in a disc, for 20 frames each.
pub(crate) const PARENT: &str = "name = \"parent\"
    initial_mean_parts = 3
    birth_rounding = \"nearest\"
    generation_shape = { kind = \"circle\", radius = 5 }
    speed = { mean = 0.1, var = 0.05 }
    lifetime = { mean = 20, var = 3 }
    color = [0, 0, 0]
    size = 1";

/// What it bears.
pub(crate) const CHILD: &str = "name = \"child\"
    parent = \"parent\"
    initial_mean_parts = 4
    birth_rounding = \"nearest\"
    generation_shape = { kind = \"circle\", radius = 0.5 }
    ejection_angle_degrees = 20
    speed = { mean = 0.2, var = 0.05 }
    lifetime = { mean = 10, var = 2 }
    color = [0.4, 0.1, 0.02]
    size = 0.05";

/// A whole tree of two levels.
pub(crate) fn family(more_of_parent: &str, more_of_child: &str) -> Scene {
    scene(&[
        &format!("{PARENT}\n{more_of_parent}"),
        &format!("{CHILD}\n{more_of_child}"),
    ])
}

/// A run on the processor.
pub(crate) struct Run {
    pub(crate) plan: Plan,
    pub(crate) backend: CpuBackend,
    pub(crate) frame: u32,
}

impl Run {
    pub(crate) fn new(scene: &Scene) -> Self {
        let plan = Plan::new(scene, scene.frames).expect("the scene can be planned");
        let backend = common::on_cpu(&plan);
        let frame = plan.first_frame.cast_unsigned();
        Self {
            plan,
            backend,
            frame,
        }
    }

    /// Steps the next frame.
    pub(crate) fn step(&mut self) {
        let inputs = self.plan.inputs(self.frame);
        self.backend.step(&inputs).expect("it steps");
        self.frame = self.frame.wrapping_add(1);
    }

    pub(crate) fn read<T: bytemuck::Pod>(&mut self, name: &str) -> Vec<T> {
        bytemuck::pod_collect_to_vec(&self.backend.read(name).expect("it can be read"))
    }

    pub(crate) fn counts(&mut self) -> Counts {
        self.read::<Counts>("tree_counts")[0]
    }

    pub(crate) fn births(&mut self) -> Vec<u32> {
        self.read("birth_counts")
    }

    /// Those that are there: node, frame and row.
    pub(crate) fn borne(&mut self) -> Vec<(Node, SystemFrame, SystemRow)> {
        let nodes: Vec<Node> = self.read("nodes");
        let systems: Vec<SystemFrame> = self.read("borne_systems");
        let rows: Vec<SystemRow> = self.read("rows");
        let (first, ring) = (self.plan.own_system_count, self.plan.row_count);
        let now = self.frame.wrapping_sub(1) % ring;
        let row = |at: usize| rows[((first + at as u32) * ring + now) as usize];
        let all = nodes.iter().zip(&systems).enumerate();
        all.filter(|(_, (node, _))| node.spans[0] != NODE_FREE)
            .map(|(at, (node, system))| (*node, *system, row(at)))
            .collect()
    }

    /// Those that were born in the last frame stepped.
    pub(crate) fn newborn(&mut self) -> Vec<(Node, SystemFrame, SystemRow)> {
        let now = self.frame.wrapping_sub(1);
        let mut all = self.borne();
        all.retain(|(node, ..)| node.who[1] == now);
        all
    }
}

/// Where a system is in the world.
pub(crate) fn origin(system: &SystemFrame) -> [f64; 3] {
    // Its particles are in its own space, and that leads to the world.
    [
        system.world_from_system_x,
        system.world_from_system_y,
        system.world_from_system_z,
    ]
    .map(|row| f64::from(row[3]))
}

/// Where its up points in the world.
pub(crate) fn up(system: &SystemFrame) -> [f64; 3] {
    [
        system.world_from_system_x,
        system.world_from_system_y,
        system.world_from_system_z,
    ]
    .map(|row| f64::from(row[2]))
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// The particles after a frame, on the processor.
pub(crate) fn particles(scene: &Scene, frame: u32) -> Vec<ParticleState> {
    let mut simulation = simulation(scene);
    simulation.seek(frame).expect("it steps");
    simulation.particles().expect("they can be read")
}

pub(crate) fn simulation(scene: &Scene) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("the scene can be planned")
}
