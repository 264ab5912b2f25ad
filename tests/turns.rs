//! A scene that is turned while it runs: the same bits as one whose turns were known, or a refusal.

mod common;

use motes::plan::Turn;
use motes::scene::{self, Scene};
use motes::{AdapterChoice, Options, Simulation, SimulationError};

const SCENE: &str = r#"
frames = 30
capacity = 4000
[image]
width = 40
height = 30
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "only"
initial_mean_parts = 40
generation_shape = { kind = "sphere", radius = 0.5 }
speed = { mean = 0.05, var = 0.02 }
lifetime = { mean = 8, var = 3 }
color = { mean = [0.2, 0.1, 0.05], var = [0.05, 0.05, 0.05] }
size = { mean = 0.05, var = 0.02 }
"#;

fn scene_with(changes: &[(&str, &str)]) -> Scene {
    let text = changes
        .iter()
        .fold(SCENE.to_owned(), |text, (from, to)| text.replace(from, to));
    scene::parse(&text, "turned.toml", "turned").expect("a good scene")
}

fn base() -> Scene {
    scene_with(&[])
}

/// More of them, which live longer, are streaks, fade and are dragged: what the base has none of.
fn much_else() -> Scene {
    scene_with(&[(
        "initial_mean_parts = 40",
        "initial_mean_parts = 90\nparticle_shape = \"streak\"\nintensity_threshold = 0.01\n\
         drag = 0.1",
    )])
}

fn longer() -> Scene {
    scene_with(&[("mean = 8, var = 3", "mean = 15, var = 3")])
}

fn on_mesh(mesh: &str) -> Scene {
    let shape = format!("{{ kind = \"mesh\", mesh = \"{mesh}\" }}");
    scene_with(&[("{ kind = \"sphere\", radius = 0.5 }", &shape)])
}

fn begun(on: &str, editable: bool, turns: Vec<Turn>) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::parse(on),
        editable,
        turns,
        ..Options::default()
    };
    Simulation::new(&base(), &options).expect("it starts")
}

/// Digests of the state and the picture after every frame.
fn digests(simulation: &mut Simulation, frames: u32) -> Vec<(u64, u64)> {
    let mut all = Vec::new();
    for _ in 0..frames {
        simulation.step().expect("it steps");
        simulation.draw().expect("it draws");
        all.push((
            simulation.state_digest().expect("it reads"),
            simulation.image_digest().expect("it reads"),
        ));
    }
    all
}

fn message(error: SimulationError) -> String {
    assert!(error.is_users_fault());
    error.to_string()
}

#[test]
fn a_turn_on_the_way_is_the_turn_that_was_known() {
    let turns = [(6, much_else()), (13, longer()), (20, base())];
    let known: Vec<Turn> = turns
        .iter()
        .map(|(frame, scene)| Turn {
            frame: *frame,
            scene: scene.clone(),
        })
        .collect();
    let expected = digests(&mut begun("cpu", false, known), 28);
    let unturned = digests(&mut begun("cpu", false, Vec::new()), 28);
    assert_eq!(expected[..6], unturned[..6]);
    assert!(
        expected[6..]
            .iter()
            .zip(&unturned[6..])
            .all(|(turned, plain)| turned != plain)
    );
    for on in std::iter::once("cpu".to_owned()).chain(common::adapters()) {
        let mut simulation = begun(&on, true, Vec::new());
        let mut got = digests(&mut simulation, 6);
        for (at, (frame, scene)) in turns.iter().enumerate() {
            // What comes last for a frame holds.
            simulation.turn(base()).expect("it has room");
            simulation.turn(scene.clone()).expect("it has room");
            let next = turns.get(at + 1).map_or(28, |(next, _)| *next);
            got.extend(digests(&mut simulation, next - frame));
        }
        assert!(got == expected, "{on}");
        assert_eq!(simulation.frame(), Some(27));
    }
}

#[test]
fn turns_that_were_known_hold_after_one_that_was_not() {
    let turn = |frame, scene| Turn { frame, scene };
    let all = vec![turn(5, longer()), turn(10, much_else())];
    let expected = digests(&mut begun("cpu", false, all), 16);
    let mut simulation = begun("cpu", true, vec![turn(10, much_else())]);
    let mut got = digests(&mut simulation, 5);
    simulation.turn(longer()).expect("it has room");
    got.extend(digests(&mut simulation, 11));
    assert!(got == expected);
}

#[test]
fn a_turn_may_name_any_mesh_that_the_run_has() {
    let turn = |frame, scene| Turn { frame, scene };
    let all = vec![turn(5, on_mesh("torus")), turn(8, on_mesh("cube"))];
    let expected = digests(&mut begun("cpu", false, all), 10);
    let known = || vec![turn(8, on_mesh("cube")), turn(20, on_mesh("torus"))];
    for on in ["cpu"]
        .into_iter()
        .map(str::to_owned)
        .chain(common::adapters())
    {
        let mut simulation = begun(&on, true, known());
        let mut got = digests(&mut simulation, 5);
        simulation.turn(on_mesh("torus")).expect("it has it");
        got.extend(digests(&mut simulation, 5));
        assert!(got == expected, "{on}");
    }
}

#[test]
fn inputs_name_faces_that_are_there() {
    let options = Options {
        adapter: AdapterChoice::Cpu,
        ..Options::default()
    };
    let mut simulation = Simulation::new(&on_mesh("cube"), &options).expect("it starts");
    let inputs = simulation.plan().inputs(0);
    for (first, count) in [
        (0.0, 13.0),
        (1.0, 12.0),
        (-1.0, 12.0),
        (0.0, 0.0),
        (f32::NAN, 1.0),
    ] {
        let mut wrong = inputs.clone();
        wrong.rows[0].shape[1..3].copy_from_slice(&[first, count]);
        let error = message(simulation.step_with(wrong).expect_err("they are not there"));
        assert!(error.contains("faces of meshes"), "{error}");
    }
    simulation.step_with(inputs).expect("they are there");
}

#[test]
fn a_turn_without_room_is_refused_and_changes_nothing() {
    let plain = digests(&mut begun("cpu", false, Vec::new()), 10);
    for editable in [false, true] {
        let mut simulation = begun("cpu", editable, Vec::new());
        let mut got = digests(&mut simulation, 5);
        let refused = |simulation: &mut Simulation, scene: Scene| {
            message(simulation.turn(scene).expect_err("it has no room"))
        };
        let fixed = scene_with(&[("width = 40", "width = 41")]);
        assert!(refused(&mut simulation, fixed).contains("frame 5 alters what holds"));
        let forever = scene_with(&[("mean = 8, var = 3", "mean = 400")]);
        let error = refused(&mut simulation, forever);
        assert!(error.contains("frame 5 uses what the run"), "{error}");
        if !editable {
            let error = refused(&mut simulation, much_else());
            assert!(error.contains("begin the run as one"), "{error}");
        }
        let error = refused(&mut simulation, on_mesh("cube"));
        let why = match editable {
            false => "frame 5 uses what the run",
            true => "frame 5 names a mesh, to be born on, that the run has not",
        };
        assert!(error.contains(why), "{error}");
        got.extend(digests(&mut simulation, 5));
        assert!(got == plain, "editable: {editable}");
    }

    let mut scene = base();
    scene.capacity = None;
    let options = Options {
        adapter: AdapterChoice::Cpu,
        editable: true,
        ..Options::default()
    };
    let mut simulation = Simulation::new(&scene, &options).expect("it starts");
    simulation.step().expect("it steps");
    let mut more = scene_with(&[("initial_mean_parts = 40", "initial_mean_parts = 900")]);
    more.capacity = None;
    let error = message(simulation.turn(more).expect_err("it has no room"));
    assert!(
        error.contains("`capacity`") && error.contains("particles alive"),
        "{error}"
    );
}
