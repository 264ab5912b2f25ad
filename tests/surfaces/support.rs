//! Scenes of surfaces in a few lines, and what is seen of them on the processor.

use motes::backend::Backend;
use motes::plan::Plan;
use motes::scene::Scene;

use crate::common;

pub(crate) type Place = [f64; 3];

/// Pixels across and down of the pictures here.
pub(crate) const WIDTH: usize = 160;
pub(crate) const HEIGHT: usize = 120;

/// Pixels a unit of x/z.
pub(crate) fn focal() -> f64 {
    60.0 / 22.5f64.to_radians().tan()
}

/// Whoever is needed for a scene, and never seen.
pub(crate) const NOBODY: &str = "[[system]]
    name = \"nobody\"
    initial_mean_parts = 0
    generation_shape = { kind = \"sphere\", radius = 0 }
    speed = 0
    lifetime = 1
    color = [0, 0, 0]
    size = 1\n";

/// The eye is at z = 4 and looks along -z; there is no light but from everywhere.
pub(crate) fn scene_with(rest: &str) -> Scene {
    common::scene_of(&format!(
        "frames = 4
         image = {{ width = {WIDTH}, height = {HEIGHT} }}
         camera = {{ position = [0, 0, 4], target = [0, 0, 0], near = 0.1 }}
         light = {{ direction = [0, 0, 1], color = [0, 0, 0], ambient = [1, 1, 1] }}
         {rest}"
    ))
}

/// A surface of that mesh.
pub(crate) fn surface(mesh: &str, lines: &str) -> String {
    format!("[[surface]]\nmesh = \"{mesh}\"\ncolor = [0.5, 0.5, 0.5]\n{lines}\n")
}

/// What a frame comes to.
pub(crate) struct Drawn {
    /// Red, green, blue and what shows of what is behind, of surfaces in each pixel.
    pub(crate) surfaces: Vec<[f64; 4]>,
    /// Of each pixel's four samples, the triangle and 1, or 0.
    pub(crate) faces: Vec<[u32; 4]>,
    /// How near each sample's is.
    pub(crate) nearness: Vec<[f64; 4]>,
    /// Light of particles and flames in each pixel, red.
    pub(crate) light: Vec<f64>,
    /// The picture's bytes: red, green, blue.
    pub(crate) bytes: Vec<[u8; 3]>,
}

impl Drawn {
    /// The number that a list has for the pixel.
    pub(crate) fn at(x: usize, y: usize) -> usize {
        y * WIDTH + x
    }
}

pub(crate) fn drawn(scene: &Scene) -> Drawn {
    let plan = Plan::new(scene, 1).expect("the scene can be planned");
    let inputs = plan.inputs(0);
    let mut cpu = common::on_cpu(&plan);
    cpu.step(&inputs).expect("it steps");
    cpu.draw(&inputs).expect("it draws");
    let mut read = |name: &str| cpu.read(name).expect("it is read");
    let float = |bits: u32| f64::from(f32::from_bits(bits));
    let (low, high) = (read("light_low"), read("light_high"));
    let light = low.iter().zip(high).step_by(3);
    Drawn {
        surfaces: read("surface_pixels")
            .as_chunks::<4>()
            .0
            .iter()
            .map(|pixel| pixel.map(float))
            .collect(),
        faces: read("surface_faces").as_chunks::<4>().0.to_vec(),
        nearness: read("surface_nearness")
            .as_chunks::<4>()
            .0
            .iter()
            .map(|pixel| pixel.map(float))
            .collect(),
        light: light
            .map(|(low, high)| (f64::from(*low) + f64::from(high) * 2f64.powi(32)) / 2f64.powi(20))
            .collect(),
        bytes: read("image")
            .iter()
            .map(|word| {
                let [red, green, blue, _] = word.to_le_bytes();
                [red, green, blue]
            })
            .collect(),
    }
}

/// Where a pixel's samples are, in pixels from its left upper corner.
pub(crate) const SAMPLES: [[f64; 2]; 4] = [
    [0.375, 0.125],
    [0.875, 0.375],
    [0.125, 0.625],
    [0.625, 0.875],
];

pub(crate) fn minus(a: Place, b: Place) -> Place {
    [0, 1, 2].map(|i| a[i] - b[i])
}

pub(crate) fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Place, b: Place) -> Place {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Turned about x, then about y, by degrees, scaled and moved.
pub(crate) fn placed(p: [f32; 3], [about_x, about_y]: [f64; 2], scale: f64, to: Place) -> Place {
    let [x, y, z] = p.map(|x| f64::from(x) * scale);
    let (s, c) = about_x.to_radians().sin_cos();
    let (y, z) = (c * y - s * z, s * y + c * z);
    let (s, c) = about_y.to_radians().sin_cos();
    [c * x + s * z + to[0], y + to[1], c * z - s * x + to[2]]
}
