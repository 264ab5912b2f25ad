//! Scenes of one fire that spreads, and what its control points come to on the processor.

use motes::scene::{Scene, parse};
use motes::simulation::{AdapterChoice, Options, PointState, Simulation};
use tempfile::TempDir;

use crate::common;

/// A scene of one fire that spreads. `fire` are keys of the fire, `spread` of its spread,
/// `ignitions` lines of `[[fire.spread.ignition]]` each, `rest` further tables.
pub(crate) fn text(fire: &str, spread: &str, ignitions: &[&str], rest: &str) -> String {
    let tables: String = ignitions
        .iter()
        .map(|lines| format!("[[fire.spread.ignition]]\n{lines}\n"))
        .collect();
    format!(
        "image = {{ width = 64, height = 48 }}
         camera = {{ position = [0, 0.5, 5], target = [0, 0, 0] }}
         [[fire]]
         name = \"fire\"
         {fire}
         [fire.spread]
         {spread}
         {tables}{rest}"
    )
}

pub(crate) fn scene(fire: &str, spread: &str, ignitions: &[&str], rest: &str) -> Scene {
    common::scene_of(&text(fire, spread, ignitions, rest))
}

/// The same with a mesh of an OBJ file of this text, called `m.obj`.
pub(crate) fn scene_on(obj: &str, fire: &str, spread: &str, ignitions: &[&str]) -> Scene {
    let folder = TempDir::new().expect("the machine has room for temporary files");
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("m.obj"), obj).expect("a temporary folder can be written");
    let file = at("scene.toml").to_string_lossy().into_owned();
    let text = text(fire, &format!("mesh = \"m.obj\"\n{spread}"), ignitions, "");
    parse(&text, &file, "test").unwrap_or_else(|e| panic!("{e}"))
}

/// A run on the processor.
pub(crate) fn run(scene: &Scene) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        frame_end: 100_000,
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("the scene can be planned")
}

/// The control points after a frame.
pub(crate) fn points_at(scene: &Scene, frame: u32) -> Vec<PointState> {
    let mut run = run(scene);
    run.seek(frame).expect("it runs");
    run.control_points().expect("they are read")
}

/// A place, or a way.
pub(crate) type Place = [f64; 3];

pub(crate) fn place(of: [f32; 3]) -> Place {
    of.map(f64::from)
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

/// The area within a ring that lies in the x-y plane; above 0 where it is counterclockwise.
pub(crate) fn flat_area(ring: &[PointState]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    let twice = ring.iter().zip(next).map(|(a, b)| {
        let ([ax, ay, _], [bx, by, _]) = (place(a.position), place(b.position));
        ax * by - ay * bx
    });
    0.5 * twice.sum::<f64>()
}

#[track_caller]
pub(crate) fn assert_close(got: f64, wanted: f64, most: f64) {
    assert!(
        (got - wanted).abs() <= most,
        "{got} instead of {wanted}, off by {:e}",
        (got - wanted).abs()
    );
}

/// Two square walls of edge 2 that meet at a right angle at x = 0, z = 0: the floor z = 0 to the
/// right, facing +z, and a wall x = 0 above it, facing +x. The corner between them is an inner one.
pub(crate) const INNER_CORNER: &str = "v 0 -1 0\nv 2 -1 0\nv 2 1 0\nv 0 1 0\nv 0 -1 2\nv 0 1 2\n\
                                       f 1 2 3 4\nf 1 4 6 5\n";
