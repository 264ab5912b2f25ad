//! What boids draw behind them.

use motes::scene::Scene;
use motes::simulation::Snapshot;
use motes::{AdapterChoice, Options, Simulation};

use crate::common::adapters;
use crate::looks::{boids, pixels};
use crate::support::*;

fn simulation(scene: &Scene, adapter: &str) -> Simulation {
    let options = Options {
        adapter: AdapterChoice::parse(adapter),
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("it begins")
}

/// Red of each column of a picture of 200 pixels, summed, 0 to 1 a pixel, after that frame.
fn columns(scene: &Scene, frame: u32) -> Vec<f64> {
    let mut simulation = simulation(scene, "cpu");
    simulation.seek(frame).expect("it steps");
    simulation.draw().expect("it draws");
    let image = simulation.image().expect("it can be read");
    let column = |x: usize| -> f64 {
        let rows = image.chunks(4 * 200);
        rows.map(|row| f64::from(row[4 * x]) / 255.0).sum()
    };
    (0..200).map(column).collect()
}

/// A boid that the wind takes along a row, from x = 20, at that speed.
fn blown(speed: f32, lines: &str) -> Scene {
    let lines = format!(
        "shape = \"disc\"\nsize = 10\nstart_speed = 0\nmax_speed = 50\ndrag = 1\n{lines}\n"
    );
    let mut scene = pixels(&[boids(1, &lines)], "[0, 0, 0]");
    let corner = [20.0, 50.0, 0.0];
    scene.flocks[0].region = motes::scene::Corners {
        min: corner,
        max: corner,
    };
    scene.winds = vec![motes::scene::Wind::Uniform {
        velocity: [speed, 0.0, 0.0],
    }];
    scene
}

#[test]
fn trails_lead_to_where_boids_were_and_fade() {
    let columns = columns(&blown(4.0, "trail_frames = 15"), 29);
    // It is at 20 + 30 · 4, and was at 80 fifteen frames ago.
    assert!(columns[..79].iter().all(|red| *red == 0.0), "{columns:?}");
    assert!(columns[146..].iter().all(|red| *red == 0.0), "{columns:?}");
    let segment = |age: usize| columns[136 - 4 * age..140 - 4 * age].iter().sum::<f64>() / 4.0;
    for age in 2..15 {
        // As wide as four tenths of its size, and as opaque, times what is left of 16.
        let part = (15 - age) as f64 / 16.0;
        let expected = 4.0 * part * part;
        let got = segment(age);
        assert!(
            (got - expected).abs() < 0.35 + 0.1 * expected,
            "{age}: {got}, not {expected}"
        );
        assert!(got < segment(age - 1), "{age}");
    }
}

#[test]
fn trails_begin_where_boids_do() {
    for frames in [1usize, 3, 7] {
        let columns = columns(&blown(6.0, "trail_frames = 20"), frames as u32 - 1);
        assert!(columns[..15].iter().all(|red| *red == 0.0));
        assert!(
            columns[20..20 + 6 * frames].iter().all(|red| *red > 0.1),
            "{columns:?}"
        );
        assert!(columns[28 + 6 * frames..].iter().all(|red| *red == 0.0));
    }
}

#[test]
fn who_jumps_across_the_world_leaves_no_line() {
    let corners = "min = [0, 0, 0], max = [180, 100, 0]";
    for kind in ["wrap", "torus"] {
        let edges = format!("edges = {{ kind = \"{kind}\", {corners} }}\ntrail_frames = 10");
        // Over the edge between frames 39 and 40.
        let columns = columns(&blown(4.0, &edges), 43);
        assert!(
            columns[30..120].iter().all(|red| *red == 0.0),
            "{kind}: {columns:?}"
        );
        assert!(
            columns[160..175].iter().all(|red| *red > 0.0),
            "{kind}: {columns:?}"
        );
        assert!(
            columns[2..10].iter().all(|red| *red > 0.0),
            "{kind}: {columns:?}"
        );
    }
}

#[test]
fn a_run_that_goes_on_from_a_snapshot_has_the_same_trails() {
    let lines = with(&flocking(), &[("trail_frames", "12"), ("count", "60")]);
    let scene = scene(&[FREE, &lines.replace("\"boids\"", "\"others\"")]);
    let mut whole = simulation(&scene, "cpu");
    whole.seek(25).expect("it steps");
    let snapshot = whole
        .snapshot()
        .expect("it can be read")
        .expect("it has begun");
    let mut bytes = Vec::new();
    snapshot.write_to(&mut bytes).expect("a vector takes all");
    let snapshot = Snapshot::from_bytes(&bytes).expect("as written");
    whole.seek(30).expect("it steps");
    whole.draw().expect("it draws");
    let expected = whole.image().expect("it can be read");
    for adapter in adapters().into_iter().chain(["cpu".to_owned()]) {
        let mut other = simulation(&scene, &adapter);
        other.restore(&snapshot).expect("of the same run");
        other.seek(30).expect("it steps");
        other.draw().expect("it draws");
        assert!(
            other.image().expect("it can be read") == expected,
            "{adapter}"
        );
    }
    // Trails of another length are of another run.
    let mut longer = scene.clone();
    longer.flocks[1].trail_frames = 30;
    assert!(simulation(&longer, "cpu").restore(&snapshot).is_err());
}
