//! Scenes of fires in a few lines, and what their flames come to on the processor.

use motes::backend::Backend;
use motes::layout::{FLAME_STEPS, Flame, FlameDisc};
use motes::plan::{Plan, Stage};
use motes::scene::Scene;

use crate::common;

/// A scene of these fires, each a table's lines, and of the tables that follow them.
pub(crate) fn scene_with(fires: &[&str], rest: &str) -> Scene {
    let text: String = fires
        .iter()
        .map(|lines| format!("[[fire]]\n{lines}\n"))
        .collect();
    common::scene_of(&format!(
        "image = {{ width = 160, height = 120 }}
         camera = {{ position = [0, 0.5, 2.5], target = [0, 0.5, 0] }}
         {text}{rest}"
    ))
}

/// A scene of one fire with one flame at the origin, in still air.
pub(crate) fn flame(lines: &str) -> Scene {
    scene_with(&[&lone(lines)], "")
}

/// A fire with one flame, the wind of noise left out unless the lines have it.
pub(crate) fn lone(lines: &str) -> String {
    let still = if lines.contains("noisiness") {
        ""
    } else {
        "noisiness = 0\n"
    };
    let (keys, tables) = lines
        .split_once("[[fire.")
        .map_or((lines, String::new()), |two| {
            (two.0, format!("[[fire.{}", two.1))
        });
    let listed = if tables.contains("[[fire.flame]]") {
        ""
    } else {
        "[[fire.flame]]\nposition = [0, 0, 0]\n"
    };
    format!("name = \"fire\"\n{still}{keys}\n{tables}{listed}")
}

pub(crate) fn plan(scene: &Scene) -> Plan {
    Plan::new(scene, scene.frames).expect("the scene can be planned")
}

/// A place.
pub(crate) type Place = [f64; 3];

/// The way of each flame's particle at a frame.
pub(crate) fn ways(scene: &Scene, frame: u32) -> Vec<Vec<Place>> {
    let plan = plan(scene);
    let inputs = plan.inputs(frame);
    let mut cpu = common::on_cpu(&plan);
    for stage in [Stage::Kindle, Stage::Trace] {
        cpu.run_stage(stage, &inputs).expect("it runs");
    }
    let words = cpu.read("flame_steps").expect("it is read");
    let places: Vec<Place> = words
        .chunks(4)
        .map(|step| [0, 1, 2].map(|axis| f64::from(f32::from_bits(step[axis]))))
        .collect();
    places
        .chunks(FLAME_STEPS as usize)
        .map(<[Place]>::to_vec)
        .collect()
}

/// The way of the first flame's particle at a frame.
pub(crate) fn way(scene: &Scene, frame: u32) -> Vec<Place> {
    ways(scene, frame).swap_remove(0)
}

/// The flames at a frame.
pub(crate) fn flames(scene: &Scene, frame: u32) -> Vec<Flame> {
    let plan = plan(scene);
    let mut cpu = common::on_cpu(&plan);
    cpu.run_stage(Stage::Kindle, &plan.inputs(frame))
        .expect("it runs");
    bytemuck::pod_collect_to_vec(&cpu.read("flames").expect("it is read"))
}

/// What is drawn of a frame.
pub(crate) struct Drawn {
    /// Red, green, blue of each pixel, rows from the top.
    pub(crate) light: Vec<[f64; 3]>,
    /// The image's words.
    pub(crate) image: Vec<u32>,
    /// The particles of all flames.
    pub(crate) discs: Vec<FlameDisc>,
}

pub(crate) fn drawn(scene: &Scene, frame: u32) -> Drawn {
    let plan = plan(scene);
    let inputs = plan.inputs(frame);
    let mut cpu = common::on_cpu(&plan);
    cpu.step(&inputs).expect("it runs");
    cpu.draw(&inputs).expect("it runs");
    let mut read = |name: &str| cpu.read(name).expect("it is read");
    let (low, high) = (read("light_low"), read("light_high"));
    let channels: Vec<f64> = low
        .iter()
        .zip(&high)
        .map(|(low, high)| (f64::from(*high) * 4_294_967_296.0 + f64::from(*low)) / 1_048_576.0)
        .collect();
    Drawn {
        light: channels
            .chunks(3)
            .map(|pixel| [pixel[0], pixel[1], pixel[2]])
            .collect(),
        image: read("image"),
        discs: bytemuck::pod_collect_to_vec(&read("flame_discs")),
    }
}

pub(crate) fn minus(a: Place, b: Place) -> Place {
    [0, 1, 2].map(|axis| a[axis] - b[axis])
}

pub(crate) fn dot(a: Place, b: Place) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

pub(crate) fn length(a: Place) -> f64 {
    dot(a, a).sqrt()
}

/// Whether all three differ by no more than that.
#[track_caller]
pub(crate) fn assert_near(got: Place, wanted: Place, most: f64) {
    assert!(
        length(minus(got, wanted)) <= most,
        "{got:?} instead of {wanted:?}"
    );
}
