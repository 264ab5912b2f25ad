//! Linear light of real scenes against the bytes of the same frames, and of their layers.

use motes::gpu::GpuOptions;
use motes::plan::Plan;
use motes::scene::Scene;
use motes::simulation::Simulation;

use crate::common;

/// The display-referred value of linear light, by the standard's formula.
pub(crate) fn displayed(linear: f32) -> f64 {
    let linear = f64::from(linear);
    if linear <= 0.0031308 {
        linear * 12.92
    } else {
        linear.powf(1.0 / 2.4) * 1.055 - 0.055
    }
}

/// A scene of every kind of particle over a background, cut by two planes, much of it brighter than white.
fn cut_scene() -> Scene {
    let mut scene = common::everything();
    let layers = "layer = [{ name = \"a\", point = [0.1, 0, 0], normal = [1, 0, 0] },
                  { name = \"b\", point = [0, 0.2, 0], normal = [0.3, 1, 0] }]
                  camera = { position = [0, 0, 5], target = [0, 0, 0] }
                  [[system]]
                  name = \"x\"
                  initial_mean_parts = 1
                  generation_shape = { kind = \"sphere\", radius = 0 }
                  speed = 0
                  lifetime = 1
                  color = [1, 1, 1]
                  size = 1";
    scene.layers = common::scene_of(layers).layers;
    scene.image.exposure = 1.7;
    scene
}

fn on(name: &str, plan: &Plan) -> Simulation {
    let plan = plan.clone();
    match name {
        "cpu" => {
            let backend = common::on_cpu(&plan);
            Simulation::with_backend(plan, Box::new(backend))
        }
        name => {
            let backend = common::on_gpu(&common::open(name), &plan, &GpuOptions::default());
            Simulation::with_backend(plan, Box::new(backend))
        }
    }
}

/// Where the byte is not that of the float, the float lies within rounding of the border between two bytes.
#[test]
fn linear_light_is_that_of_the_bytes_on_every_backend() {
    let plan = Plan::new(&cut_scene(), 12).unwrap();
    let mut expected: Vec<Vec<f32>> = Vec::new();
    for name in std::iter::once("cpu".to_owned()).chain(common::adapters()) {
        let mut simulation = on(&name, &plan);
        assert!(simulation.radiance().unwrap().iter().all(|v| *v == 0.0));
        let (mut bright, mut other, mut all) = (0, 0, 0);
        for (at, frame) in [0, 5, 11].into_iter().enumerate() {
            simulation.seek(frame).unwrap();
            simulation.draw().unwrap();
            let (light, bytes) = (simulation.radiance().unwrap(), simulation.image().unwrap());
            assert_eq!(4 * light.len(), 3 * bytes.len());
            let (pixels, _) = bytes.as_chunks::<4>();
            let channels = pixels.iter().flat_map(|pixel| &pixel[..3]);
            for (light, byte) in light.iter().zip(channels) {
                let level = displayed(*light).clamp(0.0, 1.0) * 255.0 + 0.5;
                all += 1;
                bright += u32::from(*light > 1.0);
                if level.floor() != f64::from(*byte) {
                    other += 1;
                    let off = (level - level.round()).abs();
                    assert!(off < 5e-5, "{name}: {light} is {level}, the byte {byte}");
                }
            }
            // Stepping without drawing changes neither.
            simulation.step().unwrap();
            assert!(simulation.radiance().unwrap() == light, "{name}");
            if expected.len() == at {
                expected.push(light);
            } else {
                assert!(
                    light
                        .iter()
                        .map(|v| v.to_bits())
                        .eq(expected[at].iter().map(|v| v.to_bits())),
                    "{name}, frame {frame}"
                );
            }
        }
        println!("{name}: {other} of {all} bytes differ, {bright} are brighter than white");
        assert!(bright > 1000 && other * 1000 < all);
    }
}

#[test]
fn display_values_of_layers_and_background_sum_to_the_picture() {
    let scene = cut_scene();
    let background = scene.image.background.map(f64::from);
    let mut simulation = on("cpu", &Plan::new(&scene, 12).unwrap());
    simulation.seek(11).unwrap();
    simulation.draw().unwrap();
    let whole = simulation.radiance().unwrap();
    let mut sums: Vec<f64> = (0..whole.len()).map(|at| background[at % 3]).collect();
    let layers = simulation.layer_names();
    assert_eq!(layers, ["a", "b", "rest"]);
    for index in 0..layers.len() {
        simulation.draw_layer(index).unwrap();
        let layer = simulation.radiance().unwrap();
        assert!(layer.iter().any(|v| *v > 0.1), "layer {index} is dark");
        for (sum, light) in sums.iter_mut().zip(&layer) {
            *sum += displayed(*light);
        }
    }
    let mut worst = 0.0f64;
    for (sum, light) in sums.iter().zip(&whole) {
        worst = worst.max((sum / displayed(*light) - 1.0).abs());
    }
    println!("at most {worst:e} off");
    assert!(worst < 1e-6, "{worst:e}");
}
