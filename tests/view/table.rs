//! The knobs of Perry's Table 3.1, turned while it burns (3.5.2).

use super::*;

/// The values at their lows and highs that the thesis has, or as near to them as the scene can show.
const TABLE: [(&str, &str); 8] = [
    ("fire.oak.spread.time_scale", "0.04"),
    ("fire.oak.spread.drop_distance", "0.025"),
    ("fire.oak.spread.separation", "0.02"),
    ("fire.oak.spread.curvature_distance", "0.5"),
    ("fire.oak.lifetime", "40"),
    ("fire.oak.inverse_cohesion", "10"),
    ("fire.oak.noisiness", "0"),
    ("fire.oak.sampling", "1"),
];

const CUBE: &str = r#"frames = 120
image = { width = 64, height = 36 }
camera = { position = [0, 0, 3], target = [0, 0, 0], vertical_fov_degrees = 90 }
[[fire]]
name = "oak"
lifetime = 12
height = 0.3
[fire.spread]
mesh = "cube"
scale = 0.25
time_scale = 0.1
drop_distance = 0.05
separation = 0.06
curvature_distance = 0.05
ignition = [{ position = [0, 0, -0.25] }]
"#;

/// Two flames a long way apart.
const PAIR: &str = r#"frames = 400
image = { width = 64, height = 36 }
camera = { position = [0, 0, 3], target = [0, 0, 0] }
[[fire]]
name = "pair"
noisiness = 0.04
sampling = 0.05
inverse_cohesion = 0.02
flame = [{ position = [-0.6, 0, 0] }, { position = [0.6, 0, 0] }]
"#;

/// What there is after so many frames, where a place was lit by a click and a knob was turned, or not.
struct Counts {
    points: usize,
    flames: usize,
    travelled: f32,
    digest: u64,
    sway: Vec<[f32; 3]>,
}

fn counts(turned: Option<(&str, &str)>) -> Counts {
    let (_folder, mut session) = begun(CUBE);
    steps(&mut session, 3);
    session.simulation().draw().expect("it is drawn");
    let lit = session.touch([32.0, 18.0], false);
    assert!(matches!(lit, Ok(Some(_))), "{lit:?}");
    if let Some((path, value)) = turned {
        session.turn(path, value).expect(path);
    }
    // Before fronts meet.
    steps(&mut session, 8);
    let points = session.simulation().control_points();
    let points = points.expect("they are told");
    let lit_by_hand = points.iter().filter(|point| point.ring == 1);
    let travelled = lit_by_hand.fold(0.0, |most: f32, point| most.max(point.travelled));
    steps(&mut session, 16);
    let simulation = session.simulation();
    let points = simulation.control_points().expect("they are told");
    Counts {
        flames: simulation.flames().expect("they are told").len(),
        travelled,
        points: points.len(),
        sway: simulation.flame_lights().expect("they are told"),
        digest: digest(&mut session),
    }
}

#[test]
fn p78d_each_knob_of_the_table_does_what_the_session_of_the_thesis_saw() {
    let own = counts(None);
    assert!(
        own.points > 40 && own.flames > 40,
        "{} {}",
        own.points,
        own.flames
    );
    let [slower, denser, finer, wider, longer, apart, still, restless] =
        TABLE.map(|one| counts(Some(one)));
    assert!(
        slower.travelled < 0.6 * own.travelled,
        "{}",
        slower.travelled
    );
    assert!(denser.flames > 3 * own.flames / 2, "{}", denser.flames);
    assert!(finer.points > 3 * own.points / 2, "{}", finer.points);
    // Outer edges count from farther away: it is faster near them.
    assert!(
        wider.travelled > 1.05 * own.travelled,
        "{}",
        wider.travelled
    );
    assert!(longer.flames > 3 * own.flames / 2, "{}", longer.flames);
    // These three bend flames, and move no front.
    for bent in [&apart, &still, &restless] {
        assert_eq!((bent.points, bent.flames), (own.points, own.flames));
        assert!(bent.sway != own.sway);
    }
    for other in [&slower, &denser, &finer, &wider] {
        assert_ne!(other.digest, own.digest);
    }
}

/// How far both flames lean to the right, frame by frame.
fn leaning(session: &mut Session, frames: u32) -> Vec<[f32; 2]> {
    let mut all = Vec::new();
    for _ in 0..frames {
        steps(session, 1);
        let lights = session.simulation().flame_lights().expect("they are told");
        all.push([lights[0][0] + 0.6, lights[1][0] - 0.6]);
    }
    all
}

fn correlation(pairs: impl Iterator<Item = [f32; 2]>) -> f64 {
    let pairs: Vec<[f64; 2]> = pairs.map(|pair| pair.map(f64::from)).collect();
    let count = pairs.len() as f64;
    let mean = [0, 1].map(|at| pairs.iter().map(|pair| pair[at]).sum::<f64>() / count);
    let product = |a: usize, b: usize| {
        let of = |pair: &[f64; 2]| (pair[a] - mean[a]) * (pair[b] - mean[b]);
        pairs.iter().map(of).sum::<f64>()
    };
    product(0, 1) / (product(0, 0) * product(1, 1)).sqrt()
}

fn memory(leaning: &[[f32; 2]]) -> f64 {
    correlation(leaning.windows(2).map(|both| [both[0][0], both[1][0]]))
}

#[test]
fn p78d_both_sides_part_and_memory_goes_as_knobs_turn() {
    let (_folder, mut session) = begun(PAIR);
    let together = leaning(&mut session, 120);
    // Sampled so fast, a frame knows nothing of the one before.
    session.turn("fire.pair.sampling", "1").expect("it turns");
    let restless = leaning(&mut session, 120);
    let (before, after) = (memory(&together), memory(&restless));
    assert!(before > 0.9 && after < 0.5, "{before} {after}");
    session
        .turn("fire.pair.sampling", "0.05")
        .expect("it turns");
    session
        .turn("fire.pair.inverse_cohesion", "5")
        .expect("it turns");
    let apart = leaning(&mut session, 120);
    let of = |pairs: &[[f32; 2]]| correlation(pairs.iter().copied());
    assert!(of(&together) > 0.95, "{}", of(&together));
    assert!(of(&apart) < 0.6, "{}", of(&apart));
    // Less noise: frames differ less.
    session
        .turn("fire.pair.noisiness", "0.01")
        .expect("it turns");
    let calm = leaning(&mut session, 120);
    let sway = |leaning: &[[f32; 2]]| {
        let change = leaning
            .windows(2)
            .map(|both| (both[1][0] - both[0][0]).abs());
        change.sum::<f32>()
    };
    assert!(
        sway(&calm) < 0.6 * sway(&apart),
        "{} {}",
        sway(&calm),
        sway(&apart)
    );
}

#[test]
fn p78d_a_garage_takes_the_fire_on() {
    // Boxes that share a wall: what burns on the first goes on over the second.
    let boxes = |second: bool| {
        let mut text = String::new();
        let mut corners = 0;
        let width = if second { 2 } else { 1 };
        for x in 0..=width {
            for y in 0..2 {
                for z in 0..2 {
                    text += &format!("v {x} {y} {z}\n");
                    corners += 1;
                }
            }
        }
        assert_eq!(corners, 4 * (width + 1));
        // Corner (x, y, z) is number 4 x + 2 y + z + 1.
        let at = |x: i32, y: i32, z: i32| 4 * x + 2 * y + z + 1;
        let mut quad = |a: [i32; 3], b: [i32; 3], c: [i32; 3], d: [i32; 3]| {
            let [a, b, c, d] = [a, b, c, d].map(|[x, y, z]| at(x, y, z));
            text += &format!("f {a} {b} {c} {d}\n");
        };
        for x in 0..width {
            let far = x + 1;
            quad([x, 0, 1], [far, 0, 1], [far, 1, 1], [x, 1, 1]);
            quad([x, 0, 0], [x, 1, 0], [far, 1, 0], [far, 0, 0]);
            quad([x, 1, 0], [x, 1, 1], [far, 1, 1], [far, 1, 0]);
            quad([x, 0, 0], [far, 0, 0], [far, 0, 1], [x, 0, 1]);
        }
        quad([0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]);
        quad([width, 0, 0], [width, 1, 0], [width, 1, 1], [width, 0, 1]);
        text
    };
    let burnt = |second: bool| {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("house.obj"), boxes(second)).expect("it is written");
        let scene = folder.path().join("house.toml");
        let text = CUBE
            .replace("mesh = \"cube\"\nscale = 0.25", "mesh = \"house.obj\"")
            .replace("time_scale = 0.1", "time_scale = 0.3")
            .replace("[0, 0, -0.25]", "[0.5, 0.5, 1]");
        std::fs::write(&scene, text).expect("it is written");
        let mut session =
            Session::new(source(&scene, &["fire.oak.spread.separation=0.1"])).expect("it begins");
        let mut flames = 0;
        let mut farthest = 0.0f32;
        for _ in 0..60 {
            steps(&mut session, 1);
            let now = session.simulation().flames().expect("they are told");
            farthest = now
                .iter()
                .fold(farthest, |most, flame| most.max(flame.position[0]));
            flames += now.iter().filter(|flame| flame.age == 0).count();
        }
        (flames, farthest)
    };
    let (own, house) = (burnt(false), burnt(true));
    assert!(own.1 < 1.0 + 1e-4 && house.1 > 1.4, "{own:?} {house:?}");
    assert!(house.0 > own.0 + own.0 / 10, "{own:?} {house:?}");
}
