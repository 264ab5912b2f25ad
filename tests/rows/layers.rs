//! Pictures in layers: Reeves (1983), 2.5.

use glam::DVec3;
use motes::backend::Backend;
use motes::gpu::GpuOptions;
use motes::plan::{FrameInputs, Plan};
use motes::scene::Scene;

use crate::common::{self, large_shapes};
use crate::light::Light;
use crate::support::{Run, on_every_backend, sample, scene};

/// A backend that has stepped a scene to a frame, and that frame's inputs.
struct Stepped {
    backend: Box<dyn Backend>,
    inputs: FrameInputs,
    plan: Plan,
}

impl Stepped {
    fn new(on: &str, scene: &Scene, frame: u32) -> Self {
        let plan = Plan::new(scene, frame + 1).expect("the scene can be planned");
        let mut backend: Box<dyn Backend> = match on {
            "cpu" => Box::new(common::on_cpu(&plan)),
            name => {
                let device = common::open(name);
                Box::new(common::on_gpu(&device, &plan, &GpuOptions::default()))
            }
        };
        for frame in 0..=frame {
            let inputs = plan.inputs(frame);
            backend.step(&inputs).expect("the backend steps");
        }
        Self {
            backend,
            inputs: plan.inputs(frame),
            plan,
        }
    }

    /// Layers, and the rest.
    fn layer_count(&self) -> u32 {
        self.inputs.layer_planes.len() as u32 + 1
    }

    /// The light of one layer, from 1, or of all, 0.
    fn light(&mut self, layer: u32) -> Light {
        self.inputs.frame.layer = layer;
        self.backend.draw(&self.inputs).expect("the backend draws");
        let mut limbs = |name| self.backend.read(name).expect("the light can be read");
        let (low, high) = (limbs("light_low"), limbs("light_high"));
        let sum = |(low, high): (&u32, &u32)| u64::from(*low) | (u64::from(*high) << 32);
        Light {
            width: self.plan.width as usize,
            steps: low.iter().zip(&high).map(sum).collect(),
        }
    }

    fn layers(&mut self) -> Vec<Light> {
        (1..=self.layer_count())
            .map(|layer| self.light(layer))
            .collect()
    }
}

fn layers(planes: &[([f64; 3], [f64; 3])]) -> String {
    let tables: Vec<_> = planes
        .iter()
        .enumerate()
        .map(|(at, (point, normal))| {
            format!("{{ name = \"layer-{at}\", point = {point:?}, normal = {normal:?} }}")
        })
        .collect();
    format!("layer = [{}]", tables.join(", "))
}

/// Several ways to cut: across, askew, crossing, the same plane twice.
const CUTS: [&[([f64; 3], [f64; 3])]; 4] = [
    &[([0.1, 0.2, 0.0], [1.0, 0.0, 0.0])],
    &[
        ([0.0, 0.0, -0.5], [0.0, 0.0, 1.0]),
        ([0.3, 0.0, 0.0], [1.0, 2.0, 0.5]),
    ],
    &[
        ([0.0, 0.0, 0.0], [0.0, 3.0, 0.0]),
        ([0.0, 0.1, 0.0], [0.0, 3.0, 0.0]),
        ([0.0, 0.1, 0.0], [0.0, -1.0, 0.0]),
    ],
    &[
        ([-0.8, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([-0.4, 0.0, 0.0], [1.0, 0.1, 0.0]),
        ([0.0, 0.0, 0.0], [1.0, 0.0, 0.2]),
        ([0.2, 0.0, 0.0], [1.0, 0.0, -0.2]),
        ([0.4, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.6, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.8, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
    ],
];

/// Fails unless the layers' light is that of the whole, step by step.
fn assert_sum(what: &str, whole: &Light, layers: &[Light]) {
    let sum = |at: usize| layers.iter().map(|layer| layer.steps[at]).sum::<u64>();
    let sums: Vec<u64> = (0..whole.steps.len()).map(sum).collect();
    assert!(sums == whole.steps, "{what}: {} layers", layers.len());
    let lit = layers.iter().filter(|layer| !layer.is_dark()).count();
    println!("{what}: {lit} of {} layers have light", layers.len());
    assert!(lit > 1, "{what}: nothing is split");
}

#[test]
fn r33_the_layers_add_up_to_the_picture_bit_for_bit() {
    on_every_backend(|on| {
        for cut in sample(on, &CUTS) {
            let with_layers = |mut scene: Scene| {
                // The layers of a scene that is all systems, for one that is not written here.
                let cut = crate::support::scene(&layers(cut), &[""]);
                scene.layers = cut.layers;
                scene
            };
            for (what, split, frame) in [
                ("everything", with_layers(common::everything()), 9),
                ("large shapes", with_layers(large_shapes(150, 60)), 2),
            ] {
                let mut unsplit = split.clone();
                unsplit.layers.clear();
                let expected = Stepped::new(on, &unsplit, frame).light(0);
                let mut stepped = Stepped::new(on, &split, frame);
                let (whole, parts) = (stepped.light(0), stepped.layers());
                assert!(whole == expected, "{what}: layers change the whole");
                assert_sum(what, &whole, &parts);
            }
        }
    });
}

/// Places on a grid, 4 units apart in the picture and at many depths, and where they are seen.
fn grid() -> Vec<(DVec3, (usize, usize))> {
    let mut places = Vec::new();
    for at in 0..49u32 {
        let (i, j) = (f64::from(at % 7) - 3.0, f64::from(at / 7) - 3.0);
        let z = f64::from(at * 5 % 11) * 2.0 - 10.0;
        // Its place moves outward as it goes away, so that it stays in its pixel.
        let distance = (32.0 - z) / 32.0;
        let (x, y) = (8.0 * i + 0.5, 8.0 * j + 0.5);
        places.push((
            DVec3::new(x * distance, y * distance, z),
            ((32.0 + x) as usize, (32.0 - y) as usize),
        ));
    }
    places
}

/// A disc that stays in its pixel, at a place.
fn point(name: &str, place: DVec3) -> String {
    format!(
        "name = \"{name}\"\n position = {:?}\n size = 0.1\n lifetime = 1\n color = [64, 32, 16]",
        place.to_array()
    )
}

#[test]
fn r33_each_particle_is_in_the_layer_of_its_side_and_in_no_other() {
    let points: Vec<String> = grid()
        .iter()
        .enumerate()
        .map(|(at, (place, _))| point(&format!("p{at}"), *place))
        .collect();
    let systems: Vec<&str> = points.iter().map(String::as_str).collect();
    let cuts: [&[([f64; 3], [f64; 3])]; 3] = [
        &[
            ([0.1, 0.3, 0.2], [1.0, 0.0, 0.0]),
            ([0.1, 0.3, 5.2], [0.1, 0.2, -1.0]),
        ],
        &[
            ([0.0, 0.0, -4.3], [0.0, 0.0, 1.0]),
            ([0.0, 0.0, 3.3], [0.0, 0.0, 2.0]),
        ],
        &[
            ([-9.3, 0.0, 0.0], [5.0, 1.0, 0.0]),
            ([0.2, 0.0, 0.0], [5.0, -1.0, 0.0]),
            ([11.1, 3.0, 0.0], [5.0, 0.0, 1.0]),
        ],
    ];
    on_every_backend(|on| {
        for &cut in sample(on, &cuts) {
            let mut stepped = Stepped::new(on, &scene(&layers(cut), &systems), 0);
            let parts = stepped.layers();
            let mut counts = vec![0; parts.len()];
            for (place, (x, y)) in grid() {
                let is_behind = |(point, normal): &([f64; 3], [f64; 3])| {
                    (place - DVec3::from(*point)).dot(DVec3::from(*normal)) < 0.0
                };
                let expected = cut.iter().position(is_behind).unwrap_or(cut.len());
                counts[expected] += 1;
                for (layer, light) in parts.iter().enumerate() {
                    let is_lit = light.at(x, y, 0) > 0.0;
                    assert_eq!(
                        is_lit,
                        layer == expected,
                        "{place} in layer {layer} of {cut:?}"
                    );
                }
            }
            println!("{counts:?}");
            assert!(counts.iter().filter(|count| **count > 0).count() > 1);
        }
    });
}

#[test]
fn r33_what_is_on_a_plane_is_in_front_of_it() {
    on_every_backend(|on| {
        let planes = layers(&[([2.0, 0.0, 0.0], [1.0, 0.0, 0.0])]);
        for (x, layer) in [(2.0, 2), (1.999, 1), (2.001, 2)] {
            let system = point("one", DVec3::new(x, 0.0, 0.0));
            let mut stepped = Stepped::new(on, &scene(&planes, &[&system]), 0);
            assert!(
                !stepped.light(layer).is_dark() && stepped.light(3 - layer).is_dark(),
                "{x}"
            );
        }
    });
}

#[test]
fn r33_layers_are_of_the_world_and_not_of_a_moved_system() {
    on_every_backend(|on| {
        // One at world x = 6 and, turned half around y, one at world x = -6.
        let line = |name: &str, degrees: u32| {
            format!(
                "name = \"{name}\"\n lifetime = 1\n color = [64, 32, 16]\n size = 0.1\n speed = 6
                rotation_degrees = [0, {degrees}]
                generation_shape = {{ kind = \"circle\", radius = 0 }}"
            )
        };
        let planes = layers(&[([0.0, 0.0, 0.0], [1.0, 0.0, 0.0])]);
        let systems = [line("right", 90), line("left", 270)];
        let systems: Vec<&str> = systems.iter().map(String::as_str).collect();
        let mut stepped = Stepped::new(on, &scene(&planes, &systems), 0);
        let side = |light: &Light, right: bool| {
            let lit = light
                .pixels(0)
                .filter(|(x, _, light)| *light > 0.0 && (*x > 32.0) == right);
            lit.count()
        };
        let (behind, rest) = (stepped.light(1), stepped.light(2));
        assert!(side(&behind, false) > 0 && side(&behind, true) == 0);
        assert!(side(&rest, true) > 0 && side(&rest, false) == 0);
    });
}

#[test]
fn r32_a_layer_is_a_picture_of_its_own() {
    // A red one behind a plane of some other object, a green one before it.
    let system = |name: &str, z: f64, color: &str| {
        format!(
            "name = \"{name}\"\n position = [0, 0, {z}]\n lifetime = 5\n color = {color}
            size = {}\n particle_shape = \"rectangle\"",
            8.0 * (32.0 - z) / 32.0
        )
    };
    let (red, green) = (
        system("red", -4.0, "[0.5, 0, 0]"),
        system("green", 4.0, "[0, 0.25, 0]"),
    );
    let planes = layers(&[([0.0, 0.0, 0.0], [0.0, 0.0, 1.0])]);
    on_every_backend(|on| {
        let mut stepped = Stepped::new(on, &scene(&planes, &[&red, &green]), 0);
        let mut picture = |layer: u32| {
            stepped.light(layer);
            stepped
                .backend
                .read("image")
                .expect("the image can be read")
        };
        let at = |image: &[u32]| image[32 * 64 + 32] & 0x00ff_ffff;
        let (back, front, whole) = (picture(1), picture(2), picture(0));
        assert_eq!(at(&back), 0x80);
        assert_eq!(at(&front), 0x40 << 8);
        assert_eq!(at(&whole), 0x4080);
        // An opaque blue object in the left half comes between them.
        let layer = |words: &[u32]| motes::output::Rgba8Image {
            width: 64,
            height: 64,
            pixels: words.iter().flat_map(|word| word.to_le_bytes()).collect(),
        };
        let black = layer(&[0xff00_0000; 64 * 64]);
        let object: Vec<u32> = (0..64 * 64)
            .map(|at| if at % 64 <= 32 { 0xffff_0000 } else { 0 })
            .collect();
        let (back, front) = (layer(&back).into_layer(), layer(&front).into_layer());
        let composed = black.under(&back).under(&layer(&object)).under(&front);
        let pixel = |x: usize| &composed.pixels[4 * (32 * 64 + x)..][..4];
        // The front's alpha is its brightest channel: so much of the object is hidden by it.
        assert_eq!(pixel(32), [0, 0x40, 0xbf, 0xff]);
        assert_eq!(pixel(0), [0, 0, 0xff, 0xff]);
        assert_eq!(pixel(63), [0, 0, 0, 0xff]);
        // Layers do not touch the state: the next frame is as if nothing had been asked.
        let plan = stepped.plan.clone();
        let next = plan.inputs(1);
        stepped.backend.step(&next).expect("the backend steps");
        let mut other = Run::of_plan(on, plan);
        other.step_to(1);
        let digest = stepped.backend.state_digest().expect("the backend digests");
        assert_eq!(
            digest,
            other
                .simulation
                .state_digest()
                .expect("the backend digests")
        );
    });
}
