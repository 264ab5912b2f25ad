//! Light of particles on the planet, the ground and surfaces: gathered to point lights on the device, and
//! held against the sum over all particles.

use motes::backend::Backend;
use motes::layout::{CLUSTER_LIGHTS, FlameLight};
use motes::plan::{Plan, Stage};
use motes::scene::Scene;
use motes::simulation::{AdapterChoice, Options, Simulation};

use crate::common;
use crate::support::*;

/// Frames that the scenes here run before they are looked at.
const FRAMES: u32 = 6;

/// Systems of known size and colour that throw light of `gain`, below the eye: a sheet near the ground, a
/// heap, and few large ones apart.
fn systems(gain: &str) -> String {
    let system = |name: &str, shape: &str, more: &str| {
        format!(
            "[[system]]
             name = \"{name}\"
             birth_rounding = \"nearest\"
             generation_shape = {{ {shape} }}
             lifetime = 4
             {more}
             {gain}\n"
        )
    };
    [
        system(
            "sheet",
            "kind = \"box\", length = 6, width = 0.3, height = 4",
            "position = [0, 0.4, 0]\ninitial_mean_parts = 700\nspeed = 0\ncolor = [0.4, 0.1, 0.02]\nsize = 0.05",
        ),
        system(
            "heap",
            "kind = \"sphere\", radius = 0.5",
            "position = [-1.5, 1.2, -1]\ninitial_mean_parts = 300\nspeed = 0.02\ncolor = [0.1, 0.3, 0.6]\nsize = 0.06\ntransparency = 0.5",
        ),
        system(
            "few",
            "kind = \"circle\", radius = 1",
            "position = [2, 2, 1]\ninitial_mean_parts = 3\nspeed = 0.1\ncolor = [2, 2, 1]\nsize = 0.1\nparticle_shape = \"rectangle\"",
        ),
    ]
    .concat()
}

/// What a particle of each system makes of white a unit away: colour, opacity, the share of a unit disc.
const SENT: [([f64; 3], f64); 3] = [
    ([0.4, 0.1, 0.02], 0.05 * 0.05),
    ([0.1, 0.3, 0.6], 0.5 * 0.06 * 0.06),
    ([2.0, 2.0, 1.0], 0.1 * 0.1 * 4.0 / std::f64::consts::PI),
];

/// The eye is high over the middle; nothing but particles gives light.
fn scene_of(gain: &str, what: &str) -> Scene {
    common::scene_of(&format!(
        "frames = 8
         image = {{ width = {WIDTH}, height = {HEIGHT} }}
         camera = {{ position = [0, 9, 0.01], target = [0, 0, 0], vertical_fov_degrees = 60 }}
         light = {{ color = [0, 0, 0], ambient = [0, 0, 0] }}
         {what}
         {}",
        systems(gain)
    ))
}

/// A ground of reflectance 0.5 at height 0.
const GROUND: &str = "ground = { color = [0.5, 0.5, 0.5], radius = 100000 }";

/// Places and systems of all particles, and what a buffer holds after the last frame.
fn run(scene: &Scene, buffer: &str) -> (Vec<(Place, usize)>, Vec<u32>) {
    let plan = Plan::new(scene, FRAMES).expect("the scene can be planned");
    let mut cpu = common::on_cpu(&plan);
    for frame in 0..FRAMES {
        cpu.step(&plan.inputs(frame)).expect("it steps");
    }
    cpu.draw(&plan.inputs(FRAMES - 1)).expect("it draws");
    let words = cpu.read(buffer).expect("it is read");
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    let mut simulation = Simulation::new(scene, &options).expect("the scene can be planned");
    simulation.seek(FRAMES - 1).expect("it steps");
    let particles = simulation.particles().expect("they can be read");
    let placed = particles
        .iter()
        .map(|it| (it.position.map(f64::from), it.system as usize));
    (placed.collect(), words)
}

/// The light on a place of that unit normal: of every particle by its distance and slant.
fn exact(particles: &[(Place, usize)], place: Place, normal: Place) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (at, system) in particles {
        let away = minus(*at, place);
        let squared = dot(away, away);
        let falls = dot(normal, away).max(0.0) / (squared * squared.sqrt());
        let (color, share) = SENT[*system];
        sum = [0, 1, 2].map(|i| sum[i] + color[i] * share * falls);
    }
    sum
}

/// The way from the eye through the middle of a pixel, as far as depth 1: right is x, up is -z.
fn way(pixel: usize) -> Place {
    let focal = HEIGHT as f64 / 2.0 / 30f64.to_radians().tan();
    let right = ((pixel % WIDTH) as f64 + 0.5 - WIDTH as f64 / 2.0) / focal;
    let up = (HEIGHT as f64 / 2.0 - (pixel / WIDTH) as f64 - 0.5) / focal;
    [right, -1.0, -up]
}

fn floats(words: &[u32]) -> Vec<[f64; 4]> {
    let (pixels, _) = words.as_chunks::<4>();
    let float = |bits: u32| f64::from(f32::from_bits(bits));
    pixels.iter().map(|pixel| pixel.map(float)).collect()
}

/// What was got in a pixel, and what is right.
type Pair = ([f64; 3], [f64; 3]);

/// How far the sums over the picture are from each other, as a share, and how far pixels are, as a share of the
/// brightest: the worst, and the mean.
fn off(pairs: &[Pair]) -> ([f64; 3], f64, f64) {
    let total = |of: &dyn Fn(&Pair) -> f64| pairs.iter().map(of).sum::<f64>();
    let shares =
        [0, 1, 2].map(|i| total(&|(got, _)| got[i]) / total(&|(_, wanted)| wanted[i]) - 1.0);
    let brightest = pairs
        .iter()
        .flat_map(|(_, wanted)| wanted)
        .fold(0.0, |a: f64, b| a.max(*b));
    let apart = |(got, wanted): &Pair| {
        let by_channel = [0, 1, 2].map(|i| (got[i] - wanted[i]).abs() / brightest);
        by_channel.into_iter().fold(0.0, f64::max)
    };
    let worst = pairs.iter().map(apart).fold(0.0, f64::max);
    let mean = total(&|pair| apart(pair)) / pairs.len() as f64;
    (shares, worst, mean)
}

/// The light that was gathered is that of all particles, as nearly as it is said to be.
fn assert_is_the_sum(pairs: &[Pair]) {
    let (shares, worst, mean) = off(pairs);
    println!("sums are off by {shares:?}, pixels by {worst} at most, {mean} in the mean");
    assert!(shares.iter().all(|share| share.abs() < 0.05), "{shares:?}");
    assert!(worst < 0.25 && mean < 0.025, "{worst}, {mean}");
}

#[test]
fn r65_light_of_particles_on_the_ground_is_the_sum_over_all_of_them() {
    let (particles, ground) = run(&scene_of("light = 1", GROUND), "ground_pixels");
    assert_eq!(particles.len(), 4 * (700 + 300 + 3));
    let pairs: Vec<_> = floats(&ground)
        .into_iter()
        .enumerate()
        .step_by(7)
        .map(|(pixel, [red, green, blue, _])| {
            let [x, _, z] = way(pixel).map(|part| part * 9.0);
            let wanted = exact(&particles, [x, 0.0, z + 0.01], [0.0, 1.0, 0.0]);
            ([red, green, blue].map(|part| part / 0.5), wanted)
        })
        .collect();
    assert_is_the_sum(&pairs);
}

#[test]
fn r65_light_of_particles_on_a_planet_is_the_sum_over_all_of_them() {
    // Its top is the height 0 of the ground.
    let planet = "planet = { center = [0, -5, 0], radius = 5, color = [0.5, 0.5, 0.5], relief = 0, contrast = 0 }";
    let (particles, planet) = run(&scene_of("light = 1", planet), "planet_pixels");
    let mut pairs = Vec::new();
    for (pixel, [red, green, blue, clear]) in floats(&planet).into_iter().enumerate() {
        if clear > 0.0 || pixel % 7 > 0 {
            continue;
        }
        let way = way(pixel);
        let to_center = [0.0, -14.0, -0.01];
        let (along, squared) = (dot(way, to_center), dot(way, way));
        let inside = along * along - squared * (dot(to_center, to_center) - 25.0);
        let far = (along - inside.sqrt()) / squared;
        let normal = minus(way.map(|part| part * far), to_center).map(|part| part / 5.0);
        let place = [0, 1, 2].map(|i| normal[i] * 5.0 + [0.0, -5.0, 0.0][i]);
        let wanted = exact(&particles, place, normal);
        pairs.push(([red, green, blue].map(|part| part / 0.5), wanted));
    }
    assert!(pairs.len() > 500);
    assert_is_the_sum(&pairs);
}

#[test]
fn r65_light_of_particles_on_a_surface_is_the_sum_over_all_of_them() {
    // A table at height 0, seen from above.
    let table = surface("plane", &format!("scale = 40\n{}", lying()));
    let (particles, words) = run(&scene_of("light = 1", &table), "surface_pixels");
    let pairs: Vec<_> = floats(&words)
        .into_iter()
        .enumerate()
        .step_by(7)
        .map(|(pixel, [red, green, blue, clear])| {
            assert_eq!(clear, 0.0, "the table fills the picture");
            let [x, _, z] = way(pixel).map(|part| part * 9.0);
            let wanted = exact(&particles, [x, 0.0, z + 0.01], [0.0, 1.0, 0.0]);
            ([red, green, blue].map(|part| part / 0.5), wanted)
        })
        .collect();
    assert_is_the_sum(&pairs);
}

/// How the built-in plane has to turn to face y.
fn lying() -> String {
    let mesh = motes::mesh::builtin("plane")
        .expect("it is built in")
        .expect("it is right");
    let [_, y, z] = mesh.doubled_area(0);
    let turn = if y.abs() > z.abs() { 0 } else { 90 };
    format!("rotation_degrees = [{turn}, 0]")
}

/// The point lights after the last frame.
fn lights(scene: &Scene) -> Vec<FlameLight> {
    let (_, words) = run(scene, "cluster_lights");
    let records: Vec<FlameLight> = bytemuck::pod_collect_to_vec(&words);
    assert_eq!(records.len(), 1 + CLUSTER_LIGHTS as usize);
    let count = records[0].place[0] as usize;
    assert!(
        records[1 + count..]
            .iter()
            .all(|it| *it == FlameLight::default())
    );
    records[1..=count].to_vec()
}

fn sum_of(lights: &[FlameLight]) -> [f64; 3] {
    let color = |light: &FlameLight, i: usize| f64::from(f32::from_bits(light.color[i]));
    [0, 1, 2].map(|i| lights.iter().map(|light| color(light, i)).sum())
}

#[test]
fn r65_lights_are_few_and_lose_nothing_of_what_particles_send() {
    let scene = scene_of("light = 1", GROUND);
    let lights_of_one = lights(&scene);
    let count = lights_of_one.len();
    println!("{count} lights stand for {} particles", 4 * 1003);
    assert!(count > 20 && count < 200, "{count}");
    let counts = [2800.0, 1200.0, 12.0];
    let sum = sum_of(&lights_of_one);
    for (i, got) in sum.iter().enumerate() {
        let of_system = |(count, (color, share)): (f64, ([f64; 3], f64))| count * color[i] * share;
        let wanted: f64 = counts.into_iter().zip(SENT).map(of_system).sum();
        assert!((got / wanted - 1.0).abs() < 1e-4, "{got}, not {wanted}");
    }
    let threefold = sum_of(&lights(&scene_of("light = 3", GROUND)));
    for (got, one) in threefold.iter().zip(sum) {
        assert!((got / one - 3.0).abs() < 1e-4, "{got}, not {}", 3.0 * one);
    }
}

#[test]
fn r65_lights_do_not_depend_on_the_order_of_systems_and_are_their_systems_own() {
    let scene = scene_of("light = 1", GROUND);
    let mut turned = scene.clone();
    turned.systems.reverse();
    assert_eq!(lights(&scene), lights(&turned));
    // Only those that throw light are gathered, in a cube of their own.
    let mut alone = scene.clone();
    alone.systems.truncate(2);
    for scene in [&mut turned, &mut alone] {
        for system in &mut scene.systems {
            system.light = if system.name == "heap" { 1.0 } else { 0.0 };
        }
    }
    assert_eq!(lights(&alone), lights(&turned));
    assert_ne!(lights(&alone), lights(&scene));
}

#[test]
fn r65_lights_stand_at_the_middle_of_what_they_stand_for() {
    // All within less than the least cube: their mean is known.
    let mut scene = scene_of("light = 1", GROUND);
    scene.systems.truncate(1);
    let shape = motes::scene::GenerationShape::Sphere { radius: 0.0 };
    scene.systems[0].generation_shape = shape;
    let lights = lights(&scene);
    assert_eq!(lights.len(), 1);
    for (got, wanted) in lights[0]
        .place
        .map(f32::from_bits)
        .iter()
        .zip([0.0, 0.4, 0.0, 0.0])
    {
        assert!((got - wanted).abs() < 1e-5, "{lights:?}");
    }
}

#[test]
fn r65_particles_throw_no_light_unless_they_are_told_to() {
    let scene = scene_of("", GROUND);
    assert!(scene.systems.iter().all(|system| system.light == 0.0));
    let plan = Plan::new(&scene, FRAMES).expect("the scene can be planned");
    assert!(!plan.has(Stage::Clusters));
    let (_, ground) = run(&scene, "ground_pixels");
    let is_dark = |pixel: &[f64; 4]| pixel[..3].iter().all(|part| *part == 0.0);
    assert!(floats(&ground).iter().all(is_dark));
    // Nor is anything gathered where there is nothing to be lit.
    let plan = Plan::new(&scene_of("light = 1", ""), FRAMES).expect("the scene can be planned");
    assert!(!plan.has(Stage::Clusters));
}
