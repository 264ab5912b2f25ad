//! The keys of Table 3.1 and their faults.

use motes::scene::parse;
use motes::scene::schema::{Field, Kind, SPREAD};

use crate::support::*;

#[test]
fn p78b_ranges_hold_those_of_the_thesis() {
    let limits = |key: &str| {
        let field: &Field = SPREAD.iter().find(|field| field.key == key).expect(key);
        match field.kind {
            Kind::Numbers { limits, .. } => (limits.min, limits.max, field.keyed),
            _ => panic!("{key} is no number"),
        }
    };
    for (key, least, most) in [
        ("time_scale", 0.004, 0.4),
        ("drop_distance", 0.01, 1.0),
        ("separation", 0.01, 0.2),
        ("curvature_distance", 0.01, 0.5),
    ] {
        let (min, max, keyed) = limits(key);
        assert!(min <= least && max >= most && keyed, "{key}");
    }
}

#[test]
fn p78b_at_all_corners_of_the_table_nothing_is_lost() {
    for corner in 0..16u32 {
        let pick = |bit: u32, low: f64, high: f64| if corner >> bit & 1 == 1 { high } else { low };
        let spread = format!(
            "mesh = \"cube\"\nscale = 0.25\ntime_scale = {}\ndrop_distance = {}\nseparation = {}\n\
             curvature_distance = {}\nmax_points = 3000",
            pick(0, 0.004, 0.4),
            pick(1, 0.01, 1.0),
            pick(2, 0.01, 0.2),
            pick(3, 0.01, 0.5),
        );
        let scene = scene("", &spread, &["position = [0, 0, 0.25]"], "");
        for point in points_at(&scene, 200) {
            let numbers = point.position.iter().chain(&point.heading);
            assert!(
                numbers.chain([&point.travelled]).all(|x| x.is_finite()),
                "{point:?}"
            );
            let farthest = point
                .position
                .iter()
                .fold(0.0, |most: f32, x| most.max(x.abs()));
            assert_close(farthest.into(), 0.25, 1e-5);
            assert_close(length(place(point.heading)), 1.0, 1e-5);
            assert!(point.inert < 3, "{point:?}");
        }
    }
}

#[test]
fn p78d_values_change_while_it_burns() {
    let spread = "mesh = \"plane\"\ntime_scale = { keys = [[0, 0.1], [10, 0.1], [11, 0]] }";
    let scene = scene("buoyancy = 0", spread, &["position = [0, 0, 0]"], "");
    let at = |frame| points_at(&scene, frame)[0].travelled;
    assert_close(at(10).into(), 0.18, 1e-5);
    assert_eq!(at(30), at(11));
}

fn refusal(fire: &str, spread: &str, ignitions: &[&str]) -> String {
    let text = text(fire, spread, ignitions, "");
    match parse(&text, "test.toml", "test") {
        Ok(_) => panic!("this is right: {text}"),
        Err(e) => e.to_string(),
    }
}

#[test]
fn pa19_faults_name_the_key_and_what_would_be_right() {
    let none = refusal("", "mesh = \"cube\"\nignition = []", &[]);
    assert!(
        none.contains("`fire.fire.spread.ignition` is empty"),
        "{none}"
    );
    let cold = refusal(
        "",
        "mesh = \"cube\"\nformula = { thickness = 1, fuel_temperature = 2000 }",
        &["position = [0, 0, 1]"],
    );
    assert!(cold.contains("hotter than the flame's 1500"), "{cold}");
    let folder = tempfile::TempDir::new().expect("the machine has room");
    let at = |name: &str| folder.path().join(name);
    let fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    std::fs::write(at("m.obj"), fan).expect("it is written");
    let text = text("", "mesh = \"m.obj\"", &["position = [0, 0, 1]"], "");
    let file = at("s.toml").to_string_lossy().into_owned();
    let error = parse(&text, &file, "s")
        .expect_err("an edge has three faces")
        .to_string();
    for part in [
        "`fire.fire.spread.mesh`",
        "m.obj",
        "from (0, 0, 0) to (1, 0, 0) has 3 faces",
    ] {
        assert!(error.contains(part), "{error}");
    }
}
