//! Light on surfaces: as Lambert has it, from far away, from lamps and from flames; what is before
//! them; and values with keys.

use motes::plan::Plan;
use motes::scene::Projection;

use crate::support::*;

/// A wall at z = 0 that faces the eye.
fn wall(lines: &str) -> String {
    surface("plane", &format!("scale = 20\n{lines}"))
}

/// How the built-in plane has to turn to face z.
fn toward_eye() -> String {
    let mesh = motes::mesh::builtin("plane")
        .expect("it is built in")
        .expect("it is right");
    let [x, y, z] = mesh.doubled_area(0);
    let turn = if z.abs() > y.abs() && z.abs() > x.abs() {
        0
    } else {
        90
    };
    format!("rotation_degrees = [{turn}, 0]")
}

#[test]
fn walls_reflect_the_light_as_lambert_has_it() {
    let rest = format!("{NOBODY}{}", wall(&toward_eye()));
    let mut text = scene_with(&rest);
    text.light = motes::scene::Light {
        direction: [0.0, 3.0, 4.0],
        color: [0.5, 1.0, 0.25],
        ambient: [0.125, 0.0, 0.25],
        ..text.light
    };
    let drawn = drawn(&text);
    for pixel in &drawn.surfaces {
        let wanted = [0.5 * (0.125 + 0.4), 0.5 * 0.8, 0.5 * (0.25 + 0.2)];
        for (got, wanted) in pixel.iter().zip(wanted) {
            assert!((got - wanted).abs() < 1e-5, "{pixel:?}");
        }
        assert_eq!(pixel[3], 0.0);
    }
    let byte = (0.5 * 0.525f64 * 255.0).round() as u8;
    assert_eq!(drawn.bytes[Drawn::at(80, 60)][0], byte);
}

#[test]
fn r64_lamps_light_surfaces_by_distance_and_slant() {
    let lamp = "[[lamp]]\nposition = [0.5, 0.25, 1.5]\ncolor = [2, 1, 0]\ndistance = 2\n";
    let mut scene = scene_with(&format!("{NOBODY}{}{lamp}", wall(&toward_eye())));
    scene.light.ambient = [0.0; 3];
    let drawn = drawn(&scene);
    for (x, y) in [(80, 60), (100, 50), (20, 100), (150, 5)] {
        let place = [
            (x as f64 + 0.5 - 80.0) / focal() * 4.0,
            (60.0 - y as f64 - 0.5) / focal() * 4.0,
            0.0,
        ];
        let away = minus([0.5, 0.25, 1.5], place);
        let squared = dot(away, away);
        let wanted = 0.5 * 2.0 * 4.0 / squared * (1.5 / squared.sqrt());
        let got = drawn.surfaces[Drawn::at(x, y)][0];
        assert!((got / wanted - 1.0).abs() < 1e-3, "{got}, not {wanted}");
    }
}

#[test]
fn balls_look_round_and_cubes_do_not() {
    let lit = |mesh: &str, more: &str| {
        let mut scene = scene_with(&format!("{NOBODY}{}", surface(mesh, more)));
        scene.light = motes::scene::Light {
            direction: [0.0, 0.0, 1.0],
            color: [1.0; 3],
            ambient: [0.0; 3],
            ..scene.light
        };
        drawn(&scene)
    };
    // On a ball, light from the eye is the cosine of where it falls.
    let ball = lit("sphere", "");
    for x in [70, 80, 90, 95, 100, 104] {
        let across = (x as f64 + 0.5 - 80.0) / focal();
        let up = -0.5 / focal();
        let (a, b) = (1.0 + across * across + up * up, 4.0);
        let depth = (b - (b * b - a * 15.0f64).sqrt()) / a;
        let wanted = 0.5 * (4.0 - depth);
        let got = ball.surfaces[Drawn::at(x, 60)][0];
        assert!((got - wanted).abs() < 0.01, "{x}: {got}, not {wanted}");
    }
    // Where every crease counts, triangles are flat: pixels beside each other are alike.
    let alike = |drawn: &Drawn| {
        let pairs = drawn.surfaces.windows(2);
        let full = pairs.filter(|two| two.iter().all(|pixel| pixel[3] == 0.0));
        let differ: Vec<bool> = full
            .map(|two| (two[0][0] - two[1][0]).abs() < 1e-5)
            .collect();
        let count = differ.iter().filter(|alike| **alike).count();
        count as f64 / differ.len() as f64
    };
    let flat = lit("sphere", "crease_degrees = 0");
    let cube = lit("cube", "rotation_degrees = [30, 40]");
    let shares = [&ball, &flat, &cube].map(alike);
    assert!(
        2.0 * shares[0] < shares[1] && shares[1] < shares[2] && shares[2] > 0.9,
        "{shares:?}"
    );
}

#[test]
fn both_sides_of_a_triangle_are_seen() {
    let turned = toward_eye()
        .replace("[0,", "[180,")
        .replace("[90,", "[270,");
    for sides in [toward_eye(), turned] {
        let mut scene = scene_with(&format!("{NOBODY}{}", wall(&sides)));
        scene.light = motes::scene::Light {
            direction: [0.0, 0.0, 1.0],
            color: [1.0; 3],
            ambient: [0.0; 3],
            ..scene.light
        };
        let pixel = drawn(&scene).surfaces[Drawn::at(33, 44)];
        assert!((pixel[0] - 0.5).abs() < 1e-5, "{pixel:?}");
    }
}

#[test]
fn p45_flames_light_surfaces() {
    let fire = |light: f64| {
        let fire = format!(
            "[[fire]]\nname = \"fire\"\nlight = {light}\nwidth = 0.2\n[[fire.flame]]\nposition = [0, 0, 1]\n"
        );
        let mut scene = scene_with(&format!("{fire}{}", wall(&toward_eye())));
        scene.light.ambient = [0.0; 3];
        drawn(&scene)
    };
    let (lit, brighter) = (fire(1.0), fire(3.0));
    let at = |drawn: &Drawn, x, y| drawn.surfaces[Drawn::at(x, y)][0];
    assert!(at(&lit, 80, 50) > 0.0 && at(&lit, 80, 50) > 2.0 * at(&lit, 5, 115));
    let share = at(&brighter, 80, 50) / at(&lit, 80, 50);
    assert!((share - 3.0).abs() < 1e-3, "{share}");
}

#[test]
fn grounds_pillars_and_planets_are_before_what_is_behind_them() {
    // The lower half of the ball is below the ground, and what is not, is before it.
    let ground = "[ground]\nposition = [0, 0, 0]\nradius = 1000\ncolor = [0, 1, 0]\n";
    let half = drawn(&scene_with(&format!(
        "{NOBODY}{}{ground}",
        surface("sphere", "position = [0, -0.2, 0]")
    )));
    let column = |drawn: &Drawn, y: usize| drawn.surfaces[Drawn::at(80, y)][3];
    // From the ground's own height, it is a line: nothing of it is before the ball; from above, half is.
    assert_eq!(column(&half, 40), 0.0);
    // From above, what is seen of a ball half a radius below the ground's height is a disc in it.
    let sunk = "position = [0, -0.5, 0]";
    let mut above = scene_with(&format!("{NOBODY}{}{ground}", surface("sphere", sunk)));
    above.camera.position = [0.0, 4.0, 0.01];
    let above = drawn(&above);
    let covered: f64 = above.surfaces.iter().map(|pixel| 1.0 - pixel[3]).sum();
    let radius = 0.75f64.sqrt() / 4.0 * focal();
    let disc = std::f64::consts::PI * radius * radius;
    assert!((covered / disc - 1.0).abs() < 0.015, "{covered} of {disc}");
    // Deep below, nothing is left.
    let deep = "position = [0, -3, 0]";
    let mut below = scene_with(&format!("{NOBODY}{}{ground}", surface("sphere", deep)));
    below.camera.position = [0.0, 4.0, 0.01];
    let below = drawn(&below);
    assert!(below.surfaces.iter().all(|pixel| pixel[3] == 1.0));
    assert!(below.nearness.iter().flatten().all(|near| *near == 0.0));
    // A pillar and a planet hide a ball behind them, and not one before them.
    for hider in [
        "[[pillar]]\nposition = [0, -3, 0]\nradius = 0.8\nheight = 6\n",
        "planet = { radius = 0.8 }\n",
    ] {
        for (z, is_seen) in [(1.5, true), (-1.5, false)] {
            let ball = surface("sphere", &format!("scale = 0.3\nposition = [0, 0, {z}]"));
            let rest = match hider.starts_with("planet") {
                true => format!("{hider}{NOBODY}{ball}"),
                false => format!("{NOBODY}{ball}{hider}"),
            };
            let drawn = drawn(&scene_with(&rest));
            let seen = drawn.faces.iter().flatten().any(|face| *face != 0);
            assert_eq!(seen, is_seen, "{hider} {z}");
        }
    }
}

#[test]
fn surfaces_move_by_keys_and_by_turns_of_a_run() {
    let moving = "position = { keys = [[0, [-1, 0, 0]], [2, [1, 0, 0]]] }\nscale = 0.3";
    let scene = scene_with(&format!("{NOBODY}{}", surface("sphere", moving)));
    let plan = Plan::new(&scene, 3).expect("the scene can be planned");
    let at = |frame| plan.inputs(frame).surfaces[0].world_from_mesh_x[3];
    assert_eq!([at(0), at(1), at(2)], [-1.0, 0.0, 1.0]);
}

#[test]
fn surfaces_need_a_place_to_be_seen_from_and_their_number_holds() {
    let mut scene = scene_with(&format!("{NOBODY}{}", surface("cube", "")));
    let turned = motes::plan::Turn {
        frame: 1,
        scene: scene_with(NOBODY),
    };
    let refused = Plan::with_turns(&scene, &[turned], 3).expect_err("there is one less");
    assert!(refused.help.contains("number of surfaces"), "{refused}");
    scene.camera.projection = Projection::Orthographic;
    let refused = Plan::new(&scene, 1).expect_err("it cannot be seen");
    assert!(refused.message.contains("orthographic"), "{refused}");
}
