//! Where the particle of a flame goes in still air and in a wind that is the same everywhere.

use crate::support::*;

/// A wind that is the same everywhere.
const BREEZE: &str = "[[wind]]\nkind = \"uniform\"\nvelocity = [0.3, 0, 0.1]\n";

/// Second differences of the places: what the wind adds to the velocity, in units of a step.
fn changes(way: &[Place]) -> Vec<Place> {
    let steps: Vec<Place> = way.windows(2).map(|two| minus(two[1], two[0])).collect();
    steps.windows(2).map(|two| minus(two[1], two[0])).collect()
}

#[test]
fn p33_a_constant_wind_adds_the_same_to_the_velocity_in_each_step() {
    let fire = lone("speed = \"free\"\nstart_speed = 2\nbuoyancy = 0.5\nheight = 3");
    let way = way(&scene_with(&[&fire], BREEZE), 7);
    // u = (0.3, 0.5, 0.1); the sum of the speeds 2, 2.5, 3 ... of 24 steps makes the height.
    let unit = 3.0 / (24.0 * 2.0 + 276.0 * 0.5);
    for (n, place) in (0..).map(f64::from).zip(&way) {
        let risen = n * (n - 1.0) / 2.0;
        let wanted = [0.3 * risen, 2.0 * n + 0.5 * risen, 0.1 * risen].map(|x| x * unit);
        assert_near(*place, wanted, 2e-5);
    }
    assert_eq!(way.len(), 25);
}

#[test]
fn p34_without_wind_what_rises_is_against_gravity() {
    for (gravity, up) in [
        ("[0, -1, 0]", [0.0, 1.0, 0.0]),
        ("[0, 0, 3]", [0.0, 0.0, -1.0]),
    ] {
        for strength in [1.0, 2.0] {
            let lines = format!(
                "speed = \"free\"\nstart_speed = 0\nbuoyancy = {strength}\ngravity = {gravity}"
            );
            // Whatever k_g is, a flame is as high as it should be.
            for change in changes(&way(&flame(&lines), 0)) {
                assert_near(change, up.map(|x| x / 276.0), 1e-6);
            }
        }
    }
    // With another start, k_g shows.
    let half = |strength: &str| {
        let lines = format!("speed = \"free\"\nstart_speed = 23\nbuoyancy = {strength}");
        let way = way(&flame(&lines), 0);
        changes(&way)[3][1] / (way[1][1] - way[0][1])
    };
    assert!((half("1") - 1.0 / 23.0).abs() < 1e-4, "{}", half("1"));
    assert!((half("2") - 2.0 / 23.0).abs() < 1e-4, "{}", half("2"));
}

#[test]
fn p35_without_gravity_flames_take_no_shape() {
    let normal = [0.6, 0.0, 0.8];
    let listed = "[[fire.flame]]\nposition = [0, 0, 0]\nnormal = [3, 0, 4]";
    for speed in ["normalised", "free"] {
        let way = way(
            &flame(&format!("speed = \"{speed}\"\nbuoyancy = 0\n{listed}")),
            3,
        );
        for (n, place) in (0..).map(f64::from).zip(&way) {
            assert_near(*place, normal.map(|x| x * n / 24.0), 1e-6);
        }
    }
    let still = way(&flame("speed = \"free\"\nstart_speed = 0\nbuoyancy = 0"), 3);
    assert!(still.iter().all(|place| *place == [0.0; 3]), "{still:?}");
}

#[test]
fn p42_normalised_velocities_make_steps_of_one_length() {
    let listed = "[[fire.flame]]\nposition = [0, 0, 0]\nnormal = [1, 0, 0]";
    let scene = scene_with(
        &[&lone(&format!("height = 24\nnoisiness = 0.3\n{listed}"))],
        BREEZE,
    );
    for pair in way(&scene, 5).windows(2) {
        let step = length(minus(pair[1], pair[0]));
        assert!((step - 1.0).abs() < 1e-5, "{step}");
    }
    // In still air, the angle to the vertical halves in each step.
    let way = way(&flame(&format!("height = 24\n{listed}")), 0);
    let mut wanted = [0.0; 3];
    for (n, place) in (0..).zip(&way) {
        assert_near(*place, wanted, 2e-5);
        let angle = std::f64::consts::FRAC_PI_2 / f64::from(1 << n);
        wanted = [wanted[0] + angle.sin(), wanted[1] + angle.cos(), 0.0];
    }
    assert_near(way[24], [2.481_050, 22.605_350, 0.0], 2e-5);
}

#[test]
fn p42_what_a_ceiling_stops_goes_along_it() {
    let ceiling =
        "rotation_degrees = [90, 0]\nroots = { kind = \"mesh\", mesh = \"plane\", count = 1000 }";
    let still = format!("name = \"fire\"\nnoisiness = 0\n{ceiling}");
    let scene = scene_with(&[&still], "");
    let down = flames(&scene, 0);
    assert_eq!(down.len(), 1000);
    let mut ways_apart = std::collections::BTreeSet::new();
    for (flame, way) in down.iter().zip(ways(&scene, 0)) {
        assert!(way.iter().flatten().all(|x| x.is_finite()), "{way:?}");
        for pair in way.windows(2) {
            let step = length(minus(pair[1], pair[0]));
            assert!((step - 1.0 / 24.0).abs() < 1e-5, "{step}");
        }
        assert!(flame.normal()[1] < -0.999, "it hangs from the ceiling");
        let aside = minus(way[4], way[0]);
        ways_apart.insert((8.0 * aside[2].atan2(aside[0])).floor() as i32);
    }
    assert!(
        ways_apart.len() > 20,
        "each its own way: {}",
        ways_apart.len()
    );
    // Where a wind blows along the ceiling, they all follow it.
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [0.2, 0, 0]\n";
    let down = "name = \"fire\"\nnoisiness = 0\n[[fire.flame]]\nposition = [0, 0, 0]\nnormal = [0, -1, 0]\n";
    let way = way(&scene_with(&[down], wind), 0);
    assert!(way[5][0] > 0.02 && way[5][2].abs() < 1e-6, "{way:?}");
}

#[test]
fn p43_flames_that_double_back_have_no_gaps() {
    // Against the wind: out, around and back.
    let lines = "width = 0.2\nbuoyancy = 0.15\n\
                 [[fire.flame]]\nposition = [-0.3, 0.3, 0]\nnormal = [1, 0.02, 0]";
    let wind = "[[wind]]\nkind = \"uniform\"\nvelocity = [-0.13, 0, 0]\n";
    let scene = scene_with(&[&lone(lines)], wind);
    let way = way(&scene, 0);
    let farthest = way.iter().map(|place| place[0]).fold(f64::MIN, f64::max);
    let out = farthest - way[0][0];
    let back = farthest - way[24][0];
    assert!(out > 0.1 && back > 0.1, "{out} out, {back} back");
    let drawn = drawn(&scene, 0);
    for pair in drawn.discs.windows(2) {
        let at = |disc: &motes::layout::FlameDisc| {
            disc.place.map(|bits| f64::from(f32::from_bits(bits)))
        };
        let ([x, y, inverse, _], [other_x, other_y, ..]) = (at(&pair[0]), at(&pair[1]));
        let apart = (x - other_x).hypot(y - other_y);
        assert!(
            apart * inverse < 1.0,
            "{apart} px, half-width {}",
            1.0 / inverse
        );
    }
}

#[test]
fn p44_without_wind_nothing_changes_with_time() {
    let scene = flame("height = 0.8");
    assert_eq!(ways(&scene, 0), ways(&scene, 100));
    assert_eq!(drawn(&scene, 0).image, drawn(&scene, 100).image);
}
