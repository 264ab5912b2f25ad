//! Fire that gets over to what is apart, through the ways of its flames (Perry 1994, 4.6).

use motes::scene::{Scene, parse};
use motes::simulation::PointState;
use tempfile::TempDir;

use crate::support::*;

/// Boxes of edge 1 that stand so far apart along x.
fn boxes(gaps: &[f64]) -> String {
    let mut obj = String::new();
    let (mut left, mut first) = (0.0, 1);
    for gap in [0.0].iter().chain(gaps) {
        left += gap;
        for corner in 0..8 {
            let [x, y, z] = [0, 1, 2].map(|bit| f64::from(corner >> bit & 1));
            obj += &format!("v {} {y} {z}\n", left + x);
        }
        for corners in [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ] {
            let [a, b, c, d] = corners.map(|corner| corner + first);
            obj += &format!("f {a} {b} {c} {d}\n");
        }
        left += 1.0;
        first += 8;
    }
    obj
}

/// The first of them burns, on the side that faces the next, in a wind that lays its flames of this
/// height straight towards that.
fn apart(gaps: &[f64], height: f64, spread: &str) -> Scene {
    let folder = TempDir::new().expect("the machine has room");
    std::fs::write(folder.path().join("m.obj"), boxes(gaps)).expect("it is written");
    let fire = format!(
        "height = {height}\nwidth = 0.1\nbuoyancy = 0\nnoisiness = 0\nwind_factor = 10\nlifetime = 20"
    );
    let spread = format!(
        "mesh = \"m.obj\"\ntime_scale = 0.1\ndrop_distance = 0.1\nseparation = 0.2\n{spread}"
    );
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [0.1, 0, 0]";
    let text = text(&fire, &spread, &["position = [1, 0.4, 0.6]"], wind);
    let file = folder.path().join("s.toml").to_string_lossy().into_owned();
    parse(&text, &file, "s").unwrap_or_else(|e| panic!("{e}"))
}

/// The rings that there are, with their least x.
fn rings(points: &[PointState]) -> Vec<(u32, f64)> {
    let mut rings: Vec<(u32, f64)> = Vec::new();
    for point in points {
        let x = f64::from(point.position[0]);
        match rings.iter_mut().find(|(ring, _)| *ring == point.ring) {
            Some((_, least)) => *least = least.min(x),
            None => rings.push((point.ring, x)),
        }
    }
    rings
}

#[test]
fn p86_a_flame_lights_what_its_way_meets_in_the_first_frame_that_it_does() {
    let scene = apart(&[0.4], 0.6, "catch_points = 12");
    let mut run = run(&scene);
    let mut burns_since = None;
    for frame in 0..60 {
        run.seek(frame).expect("it runs");
        let flames = run.flames().expect("they are read");
        let points = run.control_points().expect("they are read");
        // Flames fly straight, so the first that there is meets the other box, across from its root.
        if burns_since.is_none() && !flames.is_empty() {
            burns_since = Some((frame, place(flames[0].position)));
        }
        let there: Vec<&PointState> = points
            .iter()
            .filter(|point| point.position[0] > 1.2)
            .collect();
        let Some((since, root)) = burns_since else {
            assert!(there.is_empty());
            continue;
        };
        if frame <= since {
            assert!(there.is_empty(), "in frame {frame}");
        }
        if frame == since + 1 {
            assert_eq!(there.len(), 12);
            for point in there {
                let [x, y, z] = minus(place(point.position), root);
                assert_close(x, 0.4, 1e-5);
                assert_close(y, 0.0, 1e-5);
                assert_close(z, 0.0, 1e-5);
                assert_eq!((point.travelled, point.inert), (0.0, 0));
            }
            return;
        }
    }
    panic!("nothing caught fire");
}

#[test]
fn p86_what_is_out_of_reach_does_not_catch_fire() {
    let rings_at = |gaps: &[f64], height: f64, spread: &str, frame: u32| {
        rings(&points_at(&apart(gaps, height, spread), frame)).len()
    };
    assert_eq!(rings_at(&[0.4], 0.39, "catch_points = 8", 200), 1);
    assert_eq!(rings_at(&[0.4], 0.41, "catch_points = 8", 200), 2);
    assert_eq!(rings_at(&[0.4], 0.6, "", 200), 1);
    // From one to the next, each once, but not over the wide gap.
    let long = apart(
        &[0.4, 0.3, 0.9],
        0.6,
        "catch_points = 8\nmax_points = 20000",
    );
    assert_eq!(rings(&points_at(&long, 260)).len(), 3);
}

#[test]
fn p86_flames_of_any_fire_light_what_they_meet() {
    let torch = "[[fire]]\nname = \"torch\"\nheight = 1\nnoisiness = 0\n[[fire.flame]]\nposition = [3.5, -0.5, 0.5]\nfirst_frame = 30";
    let folder = TempDir::new().expect("the machine has room");
    std::fs::write(folder.path().join("m.obj"), boxes(&[2.0])).expect("it is written");
    let spread = "mesh = \"m.obj\"\ncatch_points = 8\ntime_scale = 0.001\nmax_flames = 1";
    let text = text("buoyancy = 0", spread, &["position = [1, 0.4, 0.6]"], torch);
    let file = folder.path().join("s.toml").to_string_lossy().into_owned();
    let scene = parse(&text, &file, "s").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(rings(&points_at(&scene, 30)).len(), 1);
    let points = points_at(&scene, 31);
    let lit: Vec<&PointState> = points
        .iter()
        .filter(|point| point.position[0] > 2.0)
        .collect();
    assert_eq!(lit.len(), 8);
    // Straight up through its floor.
    assert_close(f64::from(lit[0].position[0]), 3.5, 1e-5);
    assert_close(f64::from(lit[0].position[1]), 0.0, 1e-5);
    assert_close(f64::from(lit[0].position[2]), 0.5, 1e-5);
}

#[test]
fn p86_a_run_goes_on_from_a_snapshot_where_something_is_about_to_burn() {
    let scene = apart(&[0.4], 0.6, "catch_points = 12");
    let whole = points_at(&scene, 40);
    let begun = (0..40).find(|frame| rings(&points_at(&scene, *frame)).len() == 2);
    let before = begun.expect("it catches fire") - 1;
    let mut first = run(&scene);
    first.seek(before).expect("it runs");
    let snapshot = first.snapshot().expect("it is read").expect("there is one");
    let mut second = run(&scene);
    second.restore(&snapshot).expect("it is of the same run");
    second.seek(40).expect("it runs");
    assert_eq!(second.control_points().expect("they are read"), whole);
}
