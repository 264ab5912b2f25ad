//! What burns: how fast, for how long, and parts of a mesh that burn otherwise than the rest.

use motes::scene::{Scene, parse};
use motes::simulation::{AdapterChoice, Options, Simulation};

use crate::support::*;

/// How far the points of a fire come in a frame that is lit on that side of a cube, without wind.
fn speeds_on(side: &str, spread: &str) -> Vec<f64> {
    let spread = format!("mesh = \"cube\"\ntime_scale = 0.01\n{spread}");
    let scene = scene(
        "buoyancy = 0",
        &spread,
        &[&format!("position = {side}")],
        "",
    );
    let (before, after) = (points_at(&scene, 0), points_at(&scene, 1));
    let each = before.iter().zip(&after);
    each.map(|(a, b)| f64::from(b.travelled - a.travelled))
        .collect()
}

fn assert_speed(side: &str, spread: &str, wanted: f64) {
    for speed in speeds_on(side, spread) {
        assert_close(speed / wanted, 1.0, 1e-4);
    }
}

const RIGHT: &str = "[1, 0, 0]";
const FRONT: &str = "[0, 0, 1]";

#[test]
fn p49_speed_is_what_reaches_the_fuel_by_what_it_takes() {
    // v_s = q/(rho dh), times the scale of time.
    for (flux, heat) in [(0.09, 1.0), (0.36, 1.0), (0.09, 0.25), (3.0, 7.0)] {
        let spread = format!("opposed_flux = {flux}\nignition_heat = {heat}");
        assert_speed(FRONT, &spread, 0.01 * flux / heat);
    }
}

#[test]
fn p51_a_part_that_is_twice_as_thick_burns_half_as_fast() {
    let spread =
        "formula = { thickness = 0.0002 }\nmaterial = [{ part = \"+x\", thickness = 0.0004 }]";
    assert_speed(FRONT, spread, 0.01 * 0.001);
    assert_speed(RIGHT, spread, 0.01 * 0.0005);
    // Where the wind lays flames over it, too: that heat goes with 1/L as well.
    let scene = |thickness: f64| {
        let lines = format!(
            "mesh = \"cube\"\nformula = {{ thickness = 0.0002 }}\nmaterial = [{{ part = \"+z\", thickness = {thickness} }}]"
        );
        let scene = scene("", &lines, &["position = [0, 0, 1]\npoints = 4"], "");
        let points = points_at(&scene, 1);
        points
            .iter()
            .fold(0.0f32, |most, one| most.max(one.travelled))
    };
    assert_close(f64::from(scene(0.0004) / scene(0.0002)), 0.5, 1e-4);
}

#[test]
fn p53_what_is_thick_has_the_conductivity_of_the_solid() {
    let spread =
        "formula = { thickness = 0.0002 }\nmaterial = [{ part = \"+x\", conductivity = 0.2 }]";
    // lambda_s = 0.2 instead of lambda_g = 0.05.
    assert_speed(RIGHT, spread, 0.01 * 0.004);
    assert_speed(FRONT, spread, 0.01 * 0.001);
    let whole = "formula = { thickness = 0.0002, conductivity = 0.2 }";
    assert_speed(FRONT, whole, 0.01 * 0.004);
}

#[test]
fn p54_radiation_goes_with_the_fourth_power_of_the_flames_heat() {
    let upward = |kelvin: f64| {
        let lines = format!(
            "mesh = \"cube\"\nformula = {{ thickness = 0.002, conductivity = 0, flame_temperature = {kelvin} }}\ntime_scale = 1"
        );
        let scene = scene("", &lines, &["position = [0, 0, 1]\npoints = 4"], "");
        let points = points_at(&scene, 1);
        f64::from(
            points
                .iter()
                .fold(0.0f32, |most, one| most.max(one.travelled)),
        )
    };
    assert_close(upward(2000.0) / upward(1000.0), 16.0, 1e-3);
    // epsilon sigma T^4 h sin(Theta)/L through rho dh.
    let wanted = 0.1 * 5.670_374e-8 * 1e12 * 0.05 * 0.5 / 0.002 / 3e8;
    assert_close(upward(1000.0) / wanted, 1.0, 1e-3);
}

#[test]
fn p6b_parts_of_a_mesh_have_speeds_and_lifetimes_of_their_own() {
    let spread = "ignition_heat = 1\nmaterial = [{ part = \"+x\", speed = 3 }, { part = \"+y\", speed = 0 }]";
    assert_speed(FRONT, spread, 0.01 * 0.09);
    assert_speed(RIGHT, spread, 0.03 * 0.09);
    assert!(
        speeds_on("[0, 1, 0]", spread)
            .iter()
            .all(|speed| *speed == 0.0)
    );
    // Flames burn as long as what they were dropped on says.
    let frames = |side: &str| {
        let lines = "mesh = \"cube\"\ntime_scale = 0.08\ndrop_distance = 0.05\nseparation = 1\n\
                     material = [{ part = \"+x\", lifetime = 7 }]";
        let text = text("lifetime = 20", lines, &[&format!("position = {side}")], "");
        let mut run = run(&crate::common::scene_of(&text));
        let (mut born, mut died) = (None, None);
        for frame in 0..60 {
            run.seek(frame).expect("it runs");
            for line in run.take_statistics().expect("they are read") {
                born = born.or((line.flames_born > 0).then_some(frame));
                died = died.or((line.flames_died > 0).then_some(frame));
            }
        }
        died.expect("one goes out") - born.expect("one is dropped")
    };
    assert_eq!((frames(FRONT), frames(RIGHT)), (20, 7));
}

#[test]
fn p6b_a_front_changes_its_pace_where_the_part_changes() {
    // From the front to the right, where it is half as fast.
    let lines = "mesh = \"cube\"\ncurvature = \"ignored\"\nopposed_flux = 1\nconcurrent_flux = 0\n\
                 ignition_heat = 1\ntime_scale = 0.02\nmaterial = [{ part = \"+x\", speed = 0.5 }]";
    let scene = scene("", lines, &["position = [0.5, 0, 1]\npoints = 4"], "");
    let points = points_at(&scene, 60);
    let fastest = |towards: &dyn Fn(&Place) -> f64| {
        let all = points.iter().map(|point| towards(&place(point.position)));
        all.fold(f64::MIN, f64::max)
    };
    // 0.5 on the front in 25 frames, 35 at half the pace beyond the edge; 1.2 to the left.
    assert_close(
        fastest(&|p| if p[0] > 0.999 { 1.0 - p[2] } else { 0.0 }),
        0.35,
        0.011,
    );
    assert_close(fastest(&|p| 0.5 - p[0]), 1.2, 0.011);
}

#[test]
fn p6b_what_a_material_lacks_is_told() {
    let told = |material: &str| {
        let lines = format!("mesh = \"cube\"\nmaterial = [{material}]");
        let text = text("", &lines, &["position = [0, 0, 1]"], "");
        let error = parse(&text, "s.toml", "s").expect_err("it is refused");
        error.to_string()
    };
    let roof = told("{ part = \"roof\" }");
    assert!(
        roof.contains("`fire.fire.spread.material.0.part` is \"roof\""),
        "{roof}"
    );
    assert!(roof.contains("\"+x\", \"+y\", \"+z\""), "{roof}");
    let thick = told("{ part = \"+x\", thickness = 1 }");
    assert!(thick.contains("material.0.thickness` is 1"), "{thick}");
    assert!(thick.contains("formula"), "{thick}");
}

/// A cube that burns with marks and smoke.
fn whole_fire(lines: &str) -> Scene {
    let spread = format!(
        "mesh = \"cube\"\nscale = 0.5\ntime_scale = 0.2\nseparation = 0.08\ndrop_distance = 0.06\n\
         char = {{}}\nsmoke = {{}}\n{lines}"
    );
    let rest = "[ground]\nposition = [0, -0.6, 0]\nradius = 5\n[[wind]]\nkind = \"uniform\"\nvelocity = [0.2, 0, 0.1]";
    scene(
        "lifetime = 12\nlight = 30",
        &spread,
        &["position = [0, 0, 0.5]"],
        rest,
    )
}

#[test]
fn p2_a_fire_spreads_smokes_throws_light_and_dies() {
    let mut run = run(&whole_fire(""));
    let (mut born, mut died, mut far, mut lit) = (0, 0, Vec::new(), 0.0f32);
    for frame in (0..=90).step_by(10) {
        run.seek(frame).expect("it runs");
        for line in run.take_statistics().expect("they are read") {
            born += line.flames_born;
            died += line.flames_died;
        }
        let points = run.control_points().expect("they are read");
        far.push(
            points
                .iter()
                .map(|one| f64::from(one.travelled))
                .sum::<f64>(),
        );
        run.draw().expect("it is drawn");
        let lights = run.flame_lights().expect("they are read");
        lit = lights
            .iter()
            .flatten()
            .fold(lit, |most, light| most.max(*light));
    }
    assert!(far.is_sorted() && far[0] < far[4], "{far:?}");
    assert!(lit > 0.0);
    assert!(born > 100 && died > 50 && died <= born, "{born} and {died}");
    // Nothing is left to burn: all go out.
    run.seek(400).expect("it runs");
    run.take_statistics().expect("they are read");
    run.seek(401).expect("it runs");
    let lines = run.take_statistics().expect("they are read");
    assert_eq!(lines.last().map(|line| line.flames_live), Some(0));
}

/// What changes in a scene that is under way.
type Turn = fn(&mut Scene);

#[test]
fn p3_what_is_turned_in_a_frame_counts_from_the_next_on() {
    const TURNED: u32 = 24;
    let scene = whole_fire("");
    // Gravity, wind, flammability, fuel, illumination, spread and char.
    let turns: [(&str, Turn); 7] = [
        ("gravity", |scene| scene.fires[0].gravity = [0.6, -0.8, 0.0]),
        ("wind", |scene| scene.fires[0].wind_factor = 2.0),
        ("lifetime", |scene| {
            scene.fires[0].burning.lifetime = Some(5)
        }),
        ("time_scale", |scene| spread_of(scene).time_scale = 0.35),
        ("char", |scene| {
            spread_of(scene)
                .char
                .as_mut()
                .expect("it has marks")
                .opacity = 0.9;
        }),
        ("opposed_flux", |scene| spread_of(scene).opposed_flux = 0.2),
        ("light", |scene| scene.fires[0].lights.gain = 60.0),
    ];
    let all = |turn: Option<Turn>| {
        let options = Options {
            adapter: AdapterChoice::Cpu,
            frame_end: 1000,
            editable: true,
            ..Options::default()
        };
        let mut run = Simulation::new(&scene, &options).expect("it can be planned");
        let mut digests = Vec::new();
        for frame in 0..TURNED + 8 {
            if frame == TURNED
                && let Some(turn) = turn
            {
                let mut turned = scene.clone();
                turn(&mut turned);
                run.turn(turned).unwrap_or_else(|e| panic!("{e}"));
            }
            run.seek(frame).expect("it runs");
            run.draw().expect("it is drawn");
            digests.push((
                run.state_digest().expect("it is read"),
                run.image_digest().expect("it is read"),
            ));
        }
        digests
    };
    let still = all(None);
    for (name, turn) in turns {
        let turned = all(Some(turn));
        let same = still
            .iter()
            .zip(&turned)
            .take_while(|(a, b)| a == b)
            .count();
        assert!(
            same >= TURNED as usize,
            "{name} changes what was before it, frame {same}"
        );
        assert!(same < still.len(), "{name} changes nothing");
    }
}

fn spread_of(scene: &mut Scene) -> &mut motes::scene::FireSpread {
    scene.fires[0].spread.as_mut().expect("it spreads")
}

#[test]
fn p95_a_match_burns_like_a_tree_when_it_is_scaled() {
    let burnt = |scale: f64| {
        let by = |length: f64| length * scale;
        let spread = format!(
            "mesh = \"cylinder\"\nscale = {scale}\ntime_scale = {}\nseparation = {}\ndrop_distance = {}\n\
             curvature_distance = {}",
            by(0.2),
            by(0.1),
            by(0.15),
            by(0.1)
        );
        let fire = format!("height = {}\nwidth = {}\nlifetime = 9", by(0.4), by(0.1));
        let ignition = format!("position = [{}, {}, 0]", by(1.0), by(-0.8));
        let mut run = run(&scene(&fire, &spread, &[&ignition], ""));
        run.seek(50).expect("it runs");
        let flames = run.flames().expect("they are read").len();
        let points = run.control_points().expect("they are read");
        let places: Vec<Place> = points
            .iter()
            .map(|one| place(one.position).map(|x| x / scale))
            .collect();
        (flames, places)
    };
    let ((flames, small), (more, large)) = (burnt(0.25), burnt(16.0));
    assert!(flames > 20);
    assert_eq!((flames, small.len()), (more, large.len()));
    for (a, b) in small.iter().zip(&large) {
        assert!(length(minus(*a, *b)) < 1e-3, "{a:?} and {b:?}");
    }
}
