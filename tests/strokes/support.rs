//! Scenes of strokes, what is drawn of them on the processor, and a camera of double precision.

use motes::backend::Backend;
use motes::cpu::CpuBackend;
use motes::layout::{COVER_STROKE, COVERS_OF_STROKES, Cover};
use motes::plan::{Plan, Stage};
use motes::scene::Scene;
use motes::simulation::{AdapterChoice, Options, ParticleState, Simulation};

use crate::common;

pub(crate) const WIDTH: u32 = 320;
pub(crate) const HEIGHT: u32 = 180;

/// Blades on a plane, all born in frame 0.
pub(crate) const BLADES: &str = "name = \"blades\"
    initial_mean_parts = 40
    birth_rounding = \"nearest\"
    end_frame = 1
    rotation_degrees = [-90, 0]
    generation_shape = { kind = \"circle\", radius = 1 }
    ejection_angle_degrees = 60
    ejection_spread = \"angle\"
    speed = { mean = 0.06, var = 0.03 }
    lifetime = { mean = 40, var = 15 }
    acceleration = [0.0005, -0.002, 0.0003]
    integration = \"parabola\"
    color = [0.5, 0.6, 0.4]
    size = 0.01
    blend = \"over\"
    particle_shape = \"stroke\"
    stroke_pieces = 48";

/// A scene of lines of TOML, a key each, at the top, and `systems` of a text each.
pub(crate) fn scene(picture: &str, systems: &[&str]) -> Scene {
    let tables: String = systems
        .iter()
        .map(|lines| format!("[[system]]\n{lines}\n"))
        .collect();
    let defaults = format!(
        "frames = 80
         image.width = {WIDTH}
         image.height = {HEIGHT}
         camera.position = [0.4, 1.1, 2.6]
         camera.target = [0, 0.6, 0]
         camera.vertical_fov_degrees = 60"
    );
    let key = |line: &str| line.split('=').next().unwrap_or_default().trim().to_owned();
    let given: Vec<String> = picture.lines().map(key).collect();
    let kept = defaults.lines().filter(|line| !given.contains(&key(line)));
    let kept: String = kept.map(|line| format!("{line}\n")).collect();
    common::scene_of(&format!("{kept}{picture}\n{tables}"))
}

/// A run on the processor that has drawn a frame.
pub(crate) fn drawn(scene: &Scene, frame: u32) -> (Plan, CpuBackend) {
    let plan = Plan::new(scene, scene.frames).expect("the scene can be planned");
    let mut backend = common::on_cpu(&plan);
    for at in plan.first_frame..=frame as i32 {
        let inputs = plan.inputs(at.cast_unsigned());
        backend.step(&inputs).expect("it steps");
    }
    let inputs = plan.inputs(frame);
    for stage in [Stage::Shapes, Stage::Cover] {
        backend.run_stage(stage, &inputs).expect("it draws");
    }
    (plan, backend)
}

/// The records of strokes, particle by particle, those of nothing left out: those of their shadows, and
/// of themselves.
pub(crate) fn records(plan: &Plan, backend: &mut CpuBackend) -> Vec<[Vec<Cover>; 2]> {
    let words = backend.read("covers").expect("it can be read");
    let counts = backend.read("cover_counts").expect("it can be read");
    let covers: Vec<Cover> = bytemuck::pod_collect_to_vec(&words);
    let before: u32 = counts[1..COVERS_OF_STROKES as usize].iter().sum();
    let [pieces, records] = plan.stroke_records.map(|count| count as usize);
    let of_strokes = &covers[before as usize..];
    assert_eq!(
        of_strokes.len(),
        counts[COVERS_OF_STROKES as usize] as usize
    );
    let pieces_of = |covers: &[Cover]| -> Vec<Cover> {
        let seen = covers.iter().filter(|it| it.shape[2] != 0);
        let seen: Vec<Cover> = seen.copied().collect();
        assert!(seen.iter().all(|it| it.shape[2] == COVER_STROKE));
        seen
    };
    of_strokes
        .chunks(records)
        .map(|own| own.split_at(records - pieces))
        .map(|(shadow, own)| [pieces_of(shadow), pieces_of(own)])
        .collect()
}

/// The particles after a frame.
pub(crate) fn particles(scene: &Scene, frame: u32) -> Vec<ParticleState> {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    let mut run = Simulation::new(scene, &options).expect("the scene can be planned");
    run.seek(frame).expect("it steps");
    run.particles().expect("they can be read")
}

pub(crate) type Vector = [f64; 3];

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// a + b times s.
pub(crate) fn plus(a: Vector, b: Vector, s: f64) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i] * s)
}

pub(crate) fn unit(v: Vector) -> Vector {
    v.map(|x| x / dot(v, v).sqrt())
}

/// Where the scene's camera sees a world place, in pixels, and how far ahead it is.
pub(crate) fn seen(scene: &Scene, place: Vector) -> ([f64; 2], f64) {
    let camera = &scene.camera;
    let [eye, target, up] = [camera.position, camera.target, camera.up].map(|v| v.map(f64::from));
    let ahead = unit(plus(target, eye, -1.0));
    let right = unit(cross(ahead, up));
    let up = cross(right, ahead);
    let (width, height) = (f64::from(scene.image.width), f64::from(scene.image.height));
    let half_angle = f64::from(camera.vertical_fov_degrees).to_radians() / 2.0;
    let focal = height / 2.0 / half_angle.tan();
    let away = plus(place, eye, -1.0);
    let depth = dot(away, ahead);
    let x = width / 2.0 + dot(away, right) * focal / depth;
    let y = height / 2.0 - dot(away, up) * focal / depth;
    ([x, y], depth)
}

/// How far a place of the picture is from a segment of it.
pub(crate) fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let away = [p[0] - a[0], p[1] - a[1]];
    let squared = way[0] * way[0] + way[1] * way[1];
    let t = if squared > 0.0 {
        ((away[0] * way[0] + away[1] * way[1]) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (away[0] - t * way[0]).hypot(away[1] - t * way[1])
}

/// Ends of a piece, pixels.
pub(crate) fn ends(piece: &Cover) -> [[f64; 2]; 2] {
    let [ax, ay, bx, by] = piece.points.map(|word| f64::from(f32::from_bits(word)));
    [[ax, ay], [bx, by]]
}
