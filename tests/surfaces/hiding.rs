//! What surfaces hide: light of particles and flames, and what covers.

use crate::support::*;

/// One particle at that place; `more` may make it cover, or larger.
fn point([x, y, z]: [f64; 3], more: &str) -> String {
    format!(
        "[[system]]
         name = \"point\"
         position = [{x}, {y}, {z}]
         initial_mean_parts = 1
         birth_rounding = \"nearest\"
         generation_shape = {{ kind = \"sphere\", radius = 0 }}
         color = [0.25, 0.25, 0.25]
         {more}\n"
    )
}

fn light_of(rest: &str) -> f64 {
    drawn(&scene_with(rest)).light.iter().sum()
}

#[test]
fn light_behind_a_surface_is_hidden_and_light_before_it_is_not() {
    let cube = surface("cube", "scale = 0.8");
    for more in [
        "lifetime = 2\nspeed = 0\nsize = 0.02",
        "lifetime = 2\nspeed = 0\nsize = 0.2",
        "lifetime = 2\nspeed = 0\nsize = 0.2\nparticle_shape = \"rectangle\"",
        "lifetime = 2\nspeed = 0.2\nrotation_degrees = [0, 90]\nejection_angle_degrees = 0\nsize = 0.03\nparticle_shape = \"streak\"\nejection_axis = \"up\"",
    ] {
        let open = |place| light_of(&point(place, more));
        let with = |place| light_of(&format!("{}{cube}", point(place, more)));
        for behind in [[0.1, 0.0, -1.5], [-0.2, 0.1, -3.0], [0.0, 0.0, 0.0]] {
            assert!(open(behind) > 0.01, "{more}");
            assert_eq!(with(behind), 0.0, "{behind:?} {more}");
        }
        for before in [[0.1, 0.0, 2.0], [1.9, 0.0, -1.5], [0.0, 1.4, 0.0]] {
            let (open, with) = (open(before), with(before));
            assert!(
                (with / open - 1.0).abs() < 1e-9,
                "{before:?} {more}: {with} of {open}"
            );
        }
    }
}

#[test]
fn half_of_what_is_half_behind_is_seen() {
    // The cube's edge, seen from the eye, goes through the middle of a disc far behind it.
    let mesh = motes::mesh::builtin("cube")
        .expect("it is built in")
        .expect("it is right");
    let half = f64::from(mesh.positions().iter().map(|p| p[0]).fold(0.0, f32::max));
    let [front, depth] = [half, 4.0 - half];
    let behind = front / depth * 8.0;
    let disc = point([behind, 0.0, -4.0], "lifetime = 2\nspeed = 0\nsize = 0.8");
    let share = light_of(&format!("{disc}{}", surface("cube", ""))) / light_of(&disc);
    assert!((share - 0.5).abs() < 0.02, "{share}");
}

#[test]
fn what_is_born_on_a_surface_is_seen_on_this_side_of_it() {
    let born = "lifetime = 2\nspeed = 0\nsize = 0.004";
    let count = |rest: &str| light_of(rest);
    let balls = format!(
        "[[system]]\nname = \"dust\"\ninitial_mean_parts = 4000\nbirth_rounding = \"nearest\"\n\
         generation_shape = {{ kind = \"mesh\", mesh = \"sphere\" }}\ncolor = [0.01, 0.01, 0.01]\n{born}\n"
    );
    let share = count(&format!("{balls}{}", surface("sphere", ""))) / count(&balls);
    // From 4 radii away, 3/8 of a ball is seen; what is seen of the rest is beside its outline.
    assert!((0.33..0.42).contains(&share), "{share}");
}

#[test]
fn r84_what_covers_is_behind_or_before_surfaces_as_it_is_deep() {
    let over = "lifetime = 2\nspeed = 0\nsize = 0.5\nblend = \"over\"";
    let red = |rest: &str| drawn(&scene_with(rest)).bytes[Drawn::at(80, 60)];
    let wall = surface("sphere", "scale = 0.9\ncolor = [0, 1, 0]");
    let wall = wall.replacen("color = [0.5, 0.5, 0.5]\n", "", 1);
    let quarter = [64, 64, 64];
    assert_eq!(red(&point([0.0, 0.0, 2.0], over)), quarter);
    assert_eq!(
        red(&format!("{}{wall}", point([0.0, 0.0, 2.0], over))),
        quarter
    );
    assert_eq!(
        red(&format!("{}{wall}", point([0.0, 0.0, -2.0], over))),
        [0, 255, 0]
    );
    // Half clear before it: half of each.
    let half = format!("{over}\ntransparency = 0.5");
    let [r, g, b] = red(&format!("{}{wall}", point([0.0, 0.0, 2.0], &half)));
    assert!((31..=33).contains(&r) && (158..=161).contains(&g) && (31..=33).contains(&b));
}

#[test]
fn an_outline_before_what_covers_is_no_gap() {
    // White before white: along the outline, too, all is white.
    let white = point(
        [0.0, 0.0, -2.0],
        "lifetime = 2\nspeed = 0\nsize = 30\nblend = \"over\"",
    )
    .replace("[0.25, 0.25, 0.25]", "[1, 1, 1]");
    let ball = surface("sphere", "").replace("[0.5, 0.5, 0.5]", "[1, 1, 1]");
    let drawn = drawn(&scene_with(&format!("{white}{ball}")));
    assert!(
        drawn
            .surfaces
            .iter()
            .any(|pixel| pixel[3] > 0.0 && pixel[3] < 1.0)
    );
    for (at, pixel) in drawn.bytes.iter().enumerate() {
        assert!(pixel.iter().all(|byte| *byte >= 254), "{at}: {pixel:?}");
    }
}

#[test]
fn flames_behind_a_surface_are_hidden() {
    let fire = |z: f64| {
        format!(
            "[[fire]]\nname = \"fire\"\nnoisiness = 0\nheight = 0.5\nwidth = 0.2\n[[fire.flame]]\nposition = [0, -0.3, {z}]\n"
        )
    };
    let cube = surface("cube", "scale = 0.8");
    for (z, is_seen) in [(-1.5, false), (2.0, true)] {
        let (open, with) = (light_of(&fire(z)), light_of(&format!("{}{cube}", fire(z))));
        assert!(open > 1.0);
        assert!(
            (with - if is_seen { open } else { 0.0 }).abs() < 1e-3 * open,
            "{z}: {with} of {open}"
        );
    }
}
