//! Clouds that throw shadows on themselves (Reeves 1983, section 5). A test's name begins with the id of its
//! row.

#[path = "../common/mod.rs"]
mod common;

use motes::backend::Backend;
use motes::gpu::GpuOptions;
use motes::layout::Cover;
use motes::plan::{Plan, Stage};
use motes::scene::Scene;
use motes::simulation::{AdapterChoice, Options, ParticleState, Simulation};

use common::{assert_twins, frames_of, on_cpu};

/// Discs of a slab across the light, and their radius.
const DISCS: f64 = 30_000.0;
const RADIUS: f64 = 0.02;

/// A slab that is as wide as the box of cells, between heights -0.75 and 1.25, and a few clear places below
/// it; the light comes from above.
fn slab(direction: &str, transparency: f64, softness: f64) -> Scene {
    common::scene_of(&format!(
        "image = {{ width = 64, height = 64 }}
         camera = {{ position = [0, 0, 9], target = [0, 0, 0] }}
         light = {{ direction = {direction}, color = [1, 0.5, 0.25], ambient = [0, 0, 0.25], shadow_radius = 2, shadow_cells = 16 }}
         [[system]]
         name = \"slab\"
         position = [0, 0.25, 0]
         initial_mean_parts = {DISCS}
         birth_rounding = \"nearest\"
         end_frame = 1
         generation_shape = {{ kind = \"box\", length = 4, width = 2, height = 4 }}
         speed = 0
         color = [1, 1, 1]
         size = {RADIUS}
         transparency = {transparency}
         edge_softness = {softness}
         blend = \"over\"
         shading = \"lit_cloud\"
         [[system]]
         name = \"below\"
         position = [0, -1.5, 0]
         initial_mean_parts = 400
         birth_rounding = \"nearest\"
         end_frame = 1
         generation_shape = {{ kind = \"box\", length = 3, width = 0.1, height = 3 }}
         speed = 0
         color = [1, 1, 1]
         size = 0.01
         transparency = 0.999
         blend = \"over\"
         shading = \"lit_cloud\""
    ))
}

/// Particles after the first frame, and the colours that they are drawn with.
fn lit(scene: &Scene) -> Vec<(ParticleState, [f64; 3])> {
    let plan = Plan::new(scene, 1).expect("the scene can be planned");
    let mut backend = on_cpu(&plan);
    let inputs = plan.inputs(0);
    backend.step(&inputs).expect("it steps");
    for stage in [Stage::Shade, Stage::Shapes] {
        backend.run_stage(stage, &inputs).expect("it draws");
    }
    let covers: Vec<Cover> =
        bytemuck::pod_collect_to_vec(&backend.read("covers").expect("it can be read"));
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    let mut run = Simulation::new(scene, &options).expect("the scene can be planned");
    run.seek(0).expect("it steps");
    let states = run.particles().expect("they can be read");
    assert_eq!(states.len(), covers.len());
    let color = |cover: &Cover| [0, 1, 2].map(|i| f64::from(f32::from_bits(cover.color[i])));
    states.into_iter().zip(covers.iter().map(color)).collect()
}

/// The mean opacity of a disc whose edge takes that share of its radius, in rings.
fn mean_of_edge(softness: f64) -> f64 {
    let rings = 100_000;
    let ring = |at: i32| {
        let radius = (f64::from(at) + 0.5) / f64::from(rings);
        let within = if softness > 0.0 {
            ((1.0 - radius) / softness).min(1.0)
        } else {
            1.0
        };
        2.0 * radius * within * within * (3.0 - 2.0 * within) / f64::from(rings)
    };
    (0..rings).map(ring).sum()
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    assert!(count > 100);
    sum / f64::from(count)
}

#[test]
fn r86_light_falls_by_e_to_the_depth_of_a_slab() {
    for (transparency, softness) in [(0.9, 0.0), (0.5, 0.0), (0.0, 0.0), (0.2, 0.6), (0.0, 1.0)] {
        let parts = lit(&slab("[0, 1, 0]", transparency, softness));
        let disc = std::f64::consts::PI * RADIUS * RADIUS * mean_of_edge(softness);
        let depth = DISCS * (1.0 - transparency) * disc / 16.0;
        let below = parts.iter().filter(|(state, _)| state.system == 1);
        let passed = mean(below.map(|(_, color)| color[0]));
        println!("depth {depth}: {passed}, and {} is right", (-depth).exp());
        assert!(
            (passed / (-depth).exp() - 1.0).abs() < 0.05,
            "{depth}: {passed}"
        );
        // And in the slab, from the top down, by as much as is above; not at its edges, which cells blur.
        for height in [-0.25, 0.25, 0.75] {
            let near = parts.iter().filter(|(state, _)| {
                let [x, y, z] = state.position;
                state.system == 0
                    && (f64::from(y) - height).abs() < 0.05
                    && x.abs() < 1.7
                    && z.abs() < 1.7
            });
            let above = depth * (1.25 - height) / 2.0;
            let here = mean(near.map(|(_, color)| color[0]));
            assert!(
                (here / (-above).exp() - 1.0).abs() < 0.05,
                "{height} of {depth}: {here}"
            );
        }
    }
}

#[test]
fn r86_colours_are_those_of_the_light_and_what_is_from_everywhere() {
    for (_, [red, green, blue]) in lit(&slab("[0, 1, 0]", 0.5, 0.0)) {
        assert!((green - 0.5 * red).abs() < 1e-6 && (blue - 0.25 - 0.25 * red).abs() < 1e-6);
    }
}

#[test]
fn r86_nothing_is_in_the_way_of_light_from_the_other_side() {
    let parts = lit(&slab("[0.2, -1, 0.1]", 0.5, 0.0));
    let below = parts.iter().filter(|(state, _)| state.system == 1);
    assert!(mean(below.map(|(_, color)| color[0])) > 0.999);
    let at = |low: f32, high: f32| {
        let parts = parts.iter();
        let there = parts.filter(|(state, _)| {
            let [x, y, z] = state.position;
            state.system == 0 && y > low && y < high && x.abs() < 1.2 && z.abs() < 1.2
        });
        mean(there.map(|(_, color)| color[0]))
    };
    assert!(at(-0.75, -0.35) > 1.5 * at(0.85, 1.25));
}

#[test]
fn without_a_box_all_of_a_cloud_is_lit() {
    let mut scene = slab("[0, 1, 0]", 0.5, 0.0);
    scene.light.shadow_radius = None;
    for (_, color) in lit(&scene) {
        assert_eq!(color, [1.0, 0.5, 0.5]);
    }
}

#[test]
fn clouds_are_the_same_stage_by_stage() {
    let plan = Plan::new(&common::all_kinds_of_clouds(), 4).expect("the scene can be planned");
    let frames = frames_of(&plan, 4);
    for workgroup_size in [24, 256] {
        let options = GpuOptions {
            workgroup_size,
            cover_slice: 1024,
            page_bytes: 2048 * 32,
            ..GpuOptions::default()
        };
        assert_twins(&plan, &frames, &options);
    }
}

/// The shipped cloud, small, after a frame: its particles, and which pixels of its picture it is seen in.
fn billows(change: impl Fn(&mut Scene), frame: u32) -> (Vec<ParticleState>, Vec<bool>) {
    let mut scene = motes::scene::load("billows").expect("it is built in");
    (scene.image.width, scene.image.height) = (320, 180);
    // The sky without haze, so that what differs from it is the cloud.
    scene.systems.retain(|system| system.name != "haze");
    change(&mut scene);
    let sky = scene
        .image
        .background
        .map(|part| (part * 255.0 + 0.5) as u8);
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    let mut run = Simulation::new(&scene, &options).expect("the scene can be planned");
    run.seek(frame).expect("it steps");
    run.draw().expect("it draws");
    let bytes = run.image().expect("it can be read");
    let far = |pixel: &[u8]| (0..3).any(|i| pixel[i].abs_diff(sky[i]) > 60);
    let seen = bytes.chunks(4).map(far).collect();
    (run.particles().expect("they can be read"), seen)
}

#[test]
fn r85_the_wind_and_many_billows_make_a_complex_shape() {
    let (parts, seen) = billows(|_| (), 60);
    // Wind alone makes the difference: the same particles are there without it.
    let (calm, _) = billows(|scene| scene.winds.clear(), 60);
    assert_eq!(parts.len(), calm.len());
    let mut squared = 0.0;
    for (here, there) in parts.iter().zip(&calm) {
        assert_eq!(here.id, there.id);
        let by = [0, 1, 2].map(|i| f64::from(here.position[i] - there.position[i]));
        squared += by.iter().map(|part| part * part).sum::<f64>();
    }
    let carried = (squared / parts.len() as f64).sqrt();
    let mut systems: Vec<u32> = parts.iter().map(|state| state.system).collect();
    systems.sort_unstable();
    systems.dedup();
    // How long its outline is: squared, over what a disc of that area has.
    let (width, height) = (320, 180);
    let (mut area, mut edges) = (0.0, 0.0);
    for y in 1..height - 1 {
        for x in 1..width - 1 {
            let at = |x: usize, y: usize| seen[y * width + x];
            area += f64::from(u8::from(at(x, y)));
            for (beside, below) in [(1, 0), (0, 1)] {
                edges += f64::from(u8::from(at(x, y) != at(x + beside, y + below)));
            }
        }
    }
    // Steps along pixels are 4 / pi longer than an outline of all directions.
    let outline = edges * std::f64::consts::FRAC_PI_4;
    let round = outline * outline / (2.0 * std::f64::consts::TAU * area);
    println!(
        "{} particles of {} systems, {carried} carried by the wind, {round} times as round as a disc",
        parts.len(),
        systems.len()
    );
    assert!(area > 2000.0, "{area} pixels");
    assert!(systems.len() > 80, "{}", systems.len());
    assert!(carried > 0.1, "{carried}");
    assert!(round > 1.8, "{round}");
}
