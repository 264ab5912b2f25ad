//! How fast control points are (equation 3.4 in its well-defined reading).

use crate::support::*;

/// How far points come in a frame that begin there, with the unit of heat and time, in the order of
/// their headings.
fn speeds(scene: &motes::scene::Scene) -> Vec<(Place, f64)> {
    let before = points_at(scene, 0);
    let after = points_at(scene, 1);
    let each = before.iter().zip(&after);
    each.map(|(a, b)| (place(a.heading), f64::from(b.travelled - a.travelled)))
        .collect()
}

/// A wall that stands upright, 2 by 2, facing +z, in the air that gravity makes rise.
fn wall(fire: &str, spread: &str) -> motes::scene::Scene {
    let spread = format!("mesh = \"plane\"\ntime_scale = 0.01\nignition_heat = 1\n{spread}");
    scene(fire, &spread, &["position = [0, 0, 0]\npoints = 72"], "")
}

#[test]
fn p56_speed_is_that_of_the_angle_to_the_wind() {
    for (heading, speed) in speeds(&wall("", "")) {
        let wanted = 0.09 + 0.13 * heading[1].max(0.0);
        assert_close(speed / 0.01, wanted, 1e-4 * wanted);
    }
}

#[test]
fn p50_a_fire_on_a_wall_goes_up_faster_than_down() {
    let found = speeds(&wall("", ""));
    let towards = |y: f64| {
        let of = |(heading, _): &&(Place, f64)| heading[1] * y > 0.999_999;
        found.iter().find(of).expect("a point goes there").1
    };
    assert_close(towards(1.0) / towards(-1.0), 0.22 / 0.09, 0.02);
}

#[test]
fn p55_the_fluxes_of_the_thesis_are_the_defaults() {
    let scene = scene("", "mesh = \"cube\"", &["position = [0, 0, 1]"], "");
    let spread = scene.fires[0].spread.as_ref().expect("it spreads");
    assert_eq!(spread.fluxes(), [0.09, 0.13]);
    // On a flat face without wind, v_s is 2 q_o: K is pi/2.
    let still = crate::support::scene(
        "buoyancy = 0",
        "mesh = \"cube\"\ntime_scale = 1",
        &["position = [0, 0, 1]"],
        "",
    );
    for (_, speed) in speeds(&still) {
        assert_close(speed, 0.18, 1e-6);
    }
}

#[test]
fn pa5_a_wind_that_meets_a_face_straight_spreads_nothing() {
    let floor = "rotation_degrees = [-90, 0]";
    for (_, speed) in speeds(&wall(floor, "")) {
        assert_close(speed / 0.01, 0.09, 1e-6);
    }
    for (_, speed) in speeds(&wall("buoyancy = 0", "")) {
        assert_close(speed / 0.01, 0.09, 1e-6);
    }
}

#[test]
fn p75_a_fire_that_moves_has_wind_from_ahead() {
    let moving = "buoyancy = 0\nposition = { keys = [[0, [0, 0, 0]], [10, [5, 0, 0]]] }";
    for (heading, speed) in speeds(&wall(moving, "")) {
        let wanted = 0.09 + 0.13 * (-heading[0]).max(0.0);
        assert_close(speed / 0.01, wanted, 1e-4 * wanted);
    }
}

/// How much faster a fire is on a face than where it is flat, at a distance from an edge, with d_t 0.2
/// and no wind.
fn hastened(inner: bool, away: f64) -> f64 {
    let spread = "time_scale = 0.0001\nignition_heat = 1\ncurvature_distance = 0.2";
    let fire = "buoyancy = 0";
    let of = if inner {
        let ignition = format!("position = [{away}, 0.3, 0]");
        speeds(&scene_on(INNER_CORNER, fire, spread, &[&ignition]))
    } else {
        let ignition = format!("position = [{}, 0.3, 1]", 1.0 - away);
        let spread = format!("mesh = \"cube\"\n{spread}");
        speeds(&scene(fire, &spread, &[&ignition], ""))
    };
    let (_, first) = of[0];
    assert!(
        of.iter().all(|(_, speed)| (speed - first).abs() < 1e-9),
        "{of:?}"
    );
    first / 0.0001 / 0.09
}

#[test]
fn p57_outer_edges_hasten_a_fire_and_inner_ones_delay_it() {
    for (away, share) in [(0.0, 1.0), (0.1, 0.5), (0.15, 0.25), (0.2, 0.0), (0.5, 0.0)] {
        assert_close(hastened(false, away), 1.0 + 0.5 * share, 2e-5);
        assert_close(hastened(true, away), 1.0 - 0.5 * share, 2e-5);
    }
}

#[test]
fn p57_edges_add_up_at_a_corner() {
    let spread =
        "mesh = \"cube\"\ntime_scale = 0.0001\nignition_heat = 1\ncurvature_distance = 0.2";
    let scene = scene("buoyancy = 0", spread, &["position = [0.95, 0.9, 1]"], "");
    // Half the flat angle for each: 1 - 0.05/0.2 and 1 - 0.1/0.2 of it.
    for (_, speed) in speeds(&scene) {
        assert_close(speed / 0.0001 / 0.09, 1.0 + 0.5 * 0.75 + 0.5 * 0.5, 2e-5);
    }
}

#[test]
fn p58_an_edge_counts_within_a_tenth_of_the_mean_edge() {
    let scene = |away: f64| {
        let spread = "mesh = \"cube\"\nscale = 3\ntime_scale = 0.0001\nignition_heat = 1";
        let ignition = format!("position = [{}, 0, 3]", 3.0 - away);
        crate::support::scene("buoyancy = 0", spread, &[&ignition], "")
    };
    let spread = |scene: &motes::scene::Scene| scene.fires[0].spread.clone().expect("it spreads");
    assert_close(spread(&scene(1.0)).curvature_distance.into(), 0.6, 1e-6);
    assert_close(speeds(&scene(0.3))[0].1 / 0.0001 / 0.09, 1.25, 1e-4);
    assert_close(speeds(&scene(0.61))[0].1 / 0.0001 / 0.09, 1.0, 1e-4);
}

#[test]
fn p59_to_the_letter_the_front_never_moves_where_it_is_flat() {
    let spread = "mesh = \"cube\"\ntime_scale = 0.4\ncurvature = \"literal\"";
    let still = scene("", spread, &["position = [0, 0, 1]"], "");
    for point in points_at(&still, 30) {
        assert_eq!(point.travelled, 0.0);
    }
    // Within d_t of an edge it does, by (1 - d/d_t) Theta (q_o + ...)/K with Theta the angle of the normals.
    let near = scene(
        "buoyancy = 0",
        "mesh = \"cube\"\ntime_scale = 0.001\ncurvature = \"literal\"\ncurvature_distance = 0.2",
        &["position = [0.9, 0, 1]"],
        "",
    );
    for (_, speed) in speeds(&near) {
        assert_close(speed / 0.001, 0.5 * 0.09, 1e-5);
    }
}

#[test]
fn p59_speed_goes_with_the_time_scale_and_against_the_heat_it_takes() {
    let speed = |lines: &str| {
        let spread = format!("mesh = \"cube\"\n{lines}");
        speeds(&scene(
            "buoyancy = 0",
            &spread,
            &["position = [0, 0, 1]"],
            "",
        ))[0]
            .1
    };
    let once = speed("time_scale = 0.1");
    assert_close(speed("time_scale = 0.2") / once, 2.0, 1e-5);
    assert_close(
        speed("time_scale = 0.1\nignition_heat = 1") / once,
        0.5,
        1e-5,
    );
}

#[test]
fn p52_p54_fluxes_by_the_formulas_go_with_what_they_should() {
    let fluxes = |lines: &str| {
        let spread = format!("mesh = \"cube\"\nformula = {{ {lines} }}");
        let scene = scene("", &spread, &["position = [0, 0, 1]"], "");
        let spread = scene.fires[0].spread.clone().expect("it spreads");
        spread.fluxes().map(f64::from)
    };
    let of = "flame_temperature = 1000, fuel_temperature = 400, conductivity = 0.08, emissivity = 0.2, flame_length = 0.1, flame_angle_degrees = 30";
    let [opposed, concurrent] = fluxes(&format!("{of}, thickness = 0.003"));
    assert_close(opposed, 0.08 * 600.0 / 0.003, 1.0);
    // 5.670374e-8 x 10^12 = 56703.74.
    assert_close(concurrent, 0.2 * 56_703.74 * 0.1 * 0.5 / 0.003, 20.0);
    let doubled = fluxes(&format!("{of}, thickness = 0.006"));
    assert_close(doubled[0] / opposed, 0.5, 1e-5);
    let hotter = fluxes(&format!(
        "{}, thickness = 0.003",
        of.replace("1000", "2000")
    ));
    assert_close(hotter[1] / concurrent, 16.0, 1e-4);
}

#[test]
fn p52_p54_by_the_formulas_paper_burns_as_fast_as_paper_does() {
    let fastest = |fire: &str, formula: &str| {
        let spread =
            format!("mesh = \"plane\"\nformula = {{ {formula} }}\ntime_scale = 1\nseparation = 1");
        let scene = scene(fire, &spread, &["position = [0, 0, 0]"], "");
        let speeds = speeds(&scene);
        speeds
            .iter()
            .fold(0.0, |most: f64, (_, speed)| most.max(*speed))
    };
    // lambda (T_f - T_i)/L = 0.05 x 1200/0.0002 = 300 kW/m^2, through 600 x 500,000 J/m^3: 1 mm/s, which
    // is what a sheet of 0.2 mm burns downward.
    let still = |formula: &str| fastest("buoyancy = 0", formula);
    assert_close(still("thickness = 0.0002"), 0.001, 1e-8);
    // 0.1 x 5.670374e-8 x 1500^4 x 0.05 x sin 30 degrees/0.0002 W/m^2 besides.
    let upward = 0.1 * 5.670_374e-8 * 1500f64.powi(4) * 0.05 * 0.5 / 0.0002;
    assert_close(
        fastest("", "thickness = 0.0002"),
        0.001 + upward / 3e8,
        1e-6,
    );
    // Twice as thick, or as heavy, or as wet: half as fast.
    for formula in [
        "thickness = 0.0004",
        "thickness = 0.0002, density = 1200",
        "thickness = 0.0002, enthalpy = 1_000_000",
    ] {
        assert_close(still(formula), 0.0005, 1e-8);
    }
    // The scene's own heat has no part in it.
    let own =
        "mesh = \"plane\"\nignition_heat = 0.001\nformula = { thickness = 0.0002 }\ntime_scale = 1";
    let own = scene("buoyancy = 0", own, &["position = [0, 0, 0]"], "");
    assert_close(speeds(&own)[0].1, 0.001, 1e-8);
}
