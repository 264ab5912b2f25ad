//! Births on meshes: the shapes of Reeves (1983), section 2.2, carried on to surfaces.

use glam::DVec3;
use motes::plan::Plan;
use motes::scene::{GenerationShape, Scene};
use tempfile::TempDir;

use crate::common::statistics::{assert_distributed, assert_uniform};
use crate::support::{Run, on_every_backend, scene};

/// Corners of triangles that share no vertex, of areas from 0.005 to 24, in no plane together; each
/// a line, `x y z` three times.
const FACES: [[[f64; 3]; 3]; 6] = [
    [[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [0.0, 6.0, 0.0]],
    [[1.0, 1.0, 3.0], [1.1, 1.0, 3.0], [1.0, 1.0, 3.1]],
    [[-2.0, 0.0, 1.0], [-2.0, 3.0, 1.0], [-2.0, 0.0, 5.0]],
    [[0.0, -1.0, 0.0], [0.0, -1.0, 2.0], [3.0, -2.0, 0.5]],
    [[5.0, 5.0, 5.0], [6.0, 5.5, 5.0], [5.0, 6.0, 5.5]],
    [[-4.0, -4.0, -4.0], [-4.0, -3.0, -4.0], [-3.5, -4.0, -4.2]],
];

fn corners(face: usize) -> [DVec3; 3] {
    FACES[face].map(DVec3::from_array)
}

/// Twice the area times the unit normal.
fn normal(face: usize) -> DVec3 {
    let [a, b, c] = corners(face);
    (b - a).cross(c - a)
}

/// A scene of one system with `lines`, born on those triangles, out of a file.
fn on_the_faces(folder: &TempDir, lines: &str) -> Scene {
    let mut obj = String::new();
    for (at, face) in FACES.iter().enumerate() {
        for [x, y, z] in face {
            obj += &format!("v {x} {y} {z}\n");
        }
        let first = 3 * at + 1;
        obj += &format!("f {first} {} {}\n", first + 1, first + 2);
    }
    let path = folder.path().join("faces.obj");
    std::fs::write(&path, obj).expect("a temporary folder can be written");
    let mut scene = scene("", &[lines]);
    let file = folder.path().join("scene.toml");
    let text = "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n[[system]]\nname = \"one\"\n\
                initial_mean_parts = 1\nspeed = 0\nlifetime = 1\ncolor = [1, 1, 1]\nsize = 1\n\
                generation_shape = { kind = \"mesh\", mesh = \"faces.obj\", scale = 2 }\n";
    std::fs::write(&file, text).expect("a temporary folder can be written");
    let loaded = motes::scene::load(&file.to_string_lossy()).unwrap_or_else(|e| panic!("{e}"));
    let shape: GenerationShape = loaded.systems[0].generation_shape.clone();
    scene.systems[0].generation_shape = shape;
    scene
}

struct Birth {
    place: DVec3,
    velocity: DVec3,
}

fn births(on: &str, scene: &Scene) -> Vec<Birth> {
    let mut run = Run::new(on, scene, 1);
    run.step_to(0);
    let vector = |words: [f32; 3]| DVec3::from_array(words.map(f64::from));
    let birth = |member: &crate::support::Member| {
        let velocity = vector(member.raw.velocity());
        let place = vector(member.raw.position()) - velocity;
        Birth { place, velocity }
    };
    run.members().iter().map(birth).collect()
}

#[test]
fn r15_a_mesh_is_covered_evenly() {
    let folder = tempfile::tempdir().expect("the machine has room for temporary files");
    const COUNT: usize = 60_000;
    let lines = format!("initial_mean_parts = {COUNT}\n ejection_axis = \"outward\"\n speed = 0.5");
    let scene = on_the_faces(&folder, &lines);
    let births = births("cpu", &scene);
    assert_eq!(births.len(), COUNT);
    // The face is told by the normal that they leave along.
    let mut shares: Vec<Vec<[f64; 3]>> = vec![Vec::new(); FACES.len()];
    for birth in &births {
        let fits = |face: &usize| normal(*face).normalize().dot(birth.velocity / 0.5) > 1.0 - 1e-6;
        let found: Vec<usize> = (0..FACES.len()).filter(fits).collect();
        let [face] = found[..] else {
            panic!("{found:?} for {}", birth.velocity);
        };
        // In barycentric coordinates; the mesh is scaled by 2.
        let [a, b, c] = corners(face);
        let (p, n) = (birth.place / 2.0, normal(face));
        let part = |from: DVec3, to: DVec3| (to - from).cross(p - from).dot(n) / n.length_squared();
        let coordinates = [part(b, c), part(c, a), part(a, b)];
        let away = (p - a).dot(n.normalize()).abs();
        assert!(away < 2e-6, "{away} off face {face}");
        assert!(coordinates.iter().all(|x| *x > -1e-4), "{coordinates:?}");
        shares[face].push(coordinates);
    }
    let whole: f64 = (0..FACES.len()).map(|face| normal(face).length()).sum();
    let chi_square: f64 = (0..FACES.len())
        .map(|face| {
            let expected = COUNT as f64 * normal(face).length() / whole;
            let off = shares[face].len() as f64 - expected;
            println!("face {face}: {} for {expected:.1}", shares[face].len());
            off * off / expected
        })
        .sum();
    // The 99th percentile with 5 degrees of freedom.
    assert!(chi_square < 15.09, "chi-square {chi_square}");
    // Within a face, each coordinate is as low as a part of the area is near to a side.
    for corner in 0..3 {
        let what = format!("nearness to corner {corner}");
        let samples: Vec<f64> = shares[0].iter().map(|it| it[corner]).collect();
        assert_distributed(&what, &samples, |x| 1.0 - (1.0 - x.clamp(0.0, 1.0)).powi(2));
    }
}

#[test]
fn r18_births_on_a_mesh_leave_within_a_cone_about_the_normal() {
    let folder = tempfile::tempdir().expect("the machine has room for temporary files");
    // One scale, many places: only the plane face's births are looked at.
    let lines = "initial_mean_parts = 20000\n ejection_angle_degrees = 30\n speed = 0.5\n \
                 ejection_axis = \"outward\"\n rotation_degrees = [0, 90]\n position = [1, 2, 3]";
    let scene = on_the_faces(&folder, lines);
    // As stored, in the system's space, where the first face looks along +z.
    let cosines: Vec<f64> = births("cpu", &scene)
        .iter()
        .filter(|birth| birth.place.z.abs() < 1e-6)
        .map(|birth| birth.velocity.z / 0.5)
        .collect();
    assert!(cosines.len() > 10_000);
    let least = cosines.iter().copied().fold(1.0, f64::min);
    assert!(least > 30f64.to_radians().cos() - 1e-4, "{least}");
    assert_uniform("cosine", &cosines, 30f64.to_radians().cos(), 1.0);
    let raw = |on: &str| {
        let mut run = Run::new(on, &scene, 1);
        run.step_to(0);
        let members = run.members();
        members.iter().map(|member| member.raw).collect::<Vec<_>>()
    };
    let expected = raw("cpu");
    on_every_backend(|on| assert!(raw(on) == expected, "{on}"));
}

#[test]
fn ra3_the_sphere_around_a_mesh_is_where_its_box_is() {
    let folder = tempfile::tempdir().expect("the machine has room for temporary files");
    let scene = on_the_faces(&folder, "rotation_degrees = [0, 90]\n position = [1, 2, 3]");
    let plan = Plan::new(&scene, 1).expect("the scene can be planned");
    let [x, y, z, radius] = plan.inputs(0).systems[0].bounding_sphere.map(f64::from);
    // The box is -4 .. 8, -4 .. 6, -4.2 .. 5.5; local z is turned to x, and x to -z.
    let center = DVec3::new(2.0, 1.0, 0.65);
    let expected = DVec3::new(
        1.0 + 2.0 * center.z,
        2.0 + 2.0 * center.y,
        3.0 - 2.0 * center.x,
    );
    let got = DVec3::new(x, y, z);
    assert!((got - expected).length() < 1e-5, "{got} for {expected}");
    let distances = FACES.iter().flatten();
    let farthest = distances
        .map(|p| DVec3::from_array(*p).distance(center))
        .fold(0.0, f64::max);
    assert!((radius - 2.0 * farthest).abs() < 1e-4, "{radius}");
}
