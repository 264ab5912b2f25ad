//! Rules that hold between keys.

use motes::scene::BirthUnit;
use motes::scene::parse;
use motes::scene::schema::{self, Kind};

use crate::text::{FILE, FULL, MINIMAL, accepted, line_of, refused, with};

#[test]
fn keys_that_do_not_go_together_are_refused() {
    #[rustfmt::skip]
    let cases = [
        ("system", "end_frame", "3", "births begin at frame 3", "at least 4"),
        ("system", "lifetime", "{ mean = 65_000, var = 1 }", "reaches 65001 frames", "at most 65000"),
        ("image", "height", "4096", "", ""),
        ("camera", "target", "[0, 1, 5]", "the camera looks nowhere", "0.00000"),
        ("camera", "target", "[0, 1.000001, 5]", "the camera looks nowhere", "0.00000"),
        ("camera", "up", "[0, 0, 0]", "`camera.up` is zero", "up = [0, 1, 0]"),
        ("camera", "up", "[0, 2, 10]", "parallel to the view", "up = [0, 1, 0]"),
        ("camera", "up", "[0, -0.2, -1]", "parallel to the view", "up = [0, 1, 0]"),
        ("system", "trigger_frames", "[0, 5, 5]", "`system.first.trigger_frames.2` is not greater", "ascending order"),
        ("system", "trigger_frames", "[0, -1]", "`system.first.trigger_frames.1` is not greater", "ascending order"),
        ("system", "trigger_frames", "[0, 0.5]", "`system.first.trigger_frames.1` cannot be the number 0.5", "whole numbers"),
        ("system", "generation_shape", "{ kind = \"ring\", inner_radius = 2, outer_radius = 1.5 }", "`system.first.generation_shape.inner_radius` is 2, more than", "at most outer_radius, which is 1.5"),
        ("system", "generation_shape", "{ kind = \"ring\", inner_radius = 2, outer_radius = 2 }", "", ""),
        ("extinction.box", "max", "[1, -2.5, 0]", "`system.first.extinction.3.max` is less than `min` along y: -2.5, and min is -2", "min at most max"),
        ("extinction.box", "max", "[-1, -2, -3]", "", ""),
        ("extinction.distance", "direction", "[0, -1e-7, 0]", "`system.first.extinction.0.direction` is zero", "3 numbers"),
        ("extinction.plane", "normal", "[0, 0, 0]", "`system.first.extinction.1.normal` is zero", "3 numbers"),
        ("wind.vortex", "axis", "[0, 0, 0]", "`wind.3.axis` is zero, which is no direction", "3 numbers"),
        ("layer", "normal", "[0, 0, 0]", "`layer.0.normal` is zero, which is no direction", "3 numbers"),
    ];
    for (section, key, value, message, help) in cases {
        let text = with(section, key, value);
        if message.is_empty() {
            assert!(parse(&text, FILE, "s").is_ok(), "{text}");
            continue;
        }
        let error = refused(&text);
        assert!(error.message().contains(message), "{error}");
        assert!(error.help().contains(help), "{error}");
        assert_eq!(error.line(), Some(line_of(section, key)), "{error}");
    }
    let size = |height| FULL.replace("= 640", "= 4096").replace("= 360", height);
    assert!(parse(&size("= 2160"), FILE, "s").is_ok());
    let error = refused(&size("= 2161"));
    assert!(error.message().contains("8851456 pixels"), "{error}");
    assert_eq!(error.line(), Some(line_of("image", "height")), "{error}");
    // Straight down with the default up is the case that a person meets.
    let error = refused(&MINIMAL.replace("[0, 1, 5]", "[0, 9, 0]"));
    assert!(error.message().contains("parallel"), "{error}");
    assert!(error.help().contains("up = [0, 0, -1]"), "{error}");
    let error = refused(&FULL.replace("\"far\"", "\"smoke\""));
    assert!(
        error
            .message()
            .contains("`layer.smoke.name` is already that of another layer"),
        "{error}"
    );
    let first = format!("on line {}", line_of("layer", "name"));
    assert!(error.help().contains(&first), "{error}");
    let error = refused(&FULL.replace("\"second\"", "\"first\""));
    assert!(
        error.message().contains("`system.first.name` is already"),
        "{error}"
    );
    let line = FULL
        .lines()
        .position(|line| line.contains("second"))
        .map(|index| index + 1);
    assert_eq!(error.line(), line, "{error}");
    let first = format!("on line {}", line_of("system", "name"));
    assert!(error.help().contains(&first), "{error}");
}

#[test]
fn r10_schema_rejects_both_or_neither_birth_triples() {
    let frame = ["initial_mean_parts", "delta_mean_parts", "var_parts"];
    let area = frame.map(|key| format!("{key}_per_area"));
    for key in frame {
        for other in &area {
            let text = MINIMAL.replace("initial_mean_parts", &format!("{other} = 1\n{key}"));
            let error = refused(&text);
            assert!(
                error.message().contains("has both births a frame"),
                "{error}"
            );
            for name in frame.iter().copied().chain(area.iter().map(String::as_str)) {
                assert!(error.message().contains(&format!("`{name}`")), "{error}");
            }
            assert_eq!(error.line(), Some(7), "{error}");
        }
    }
    let error = refused(&MINIMAL.replace("initial_mean_parts = 100\n", ""));
    assert!(
        error.message().contains("has neither births a frame"),
        "{error}"
    );
    for name in frame.iter().copied().chain(area.iter().map(String::as_str)) {
        assert!(error.message().contains(&format!("`{name}`")), "{error}");
    }
    assert_eq!(error.line(), Some(5), "{error}");
    let by_area = MINIMAL.replace("initial_mean_parts", "initial_mean_parts_per_area");
    assert_eq!(
        accepted(&by_area).systems[0].births.per,
        BirthUnit::ScreenArea
    );
    // Bursts may be all, but not an excuse for both, nor for a set without its first.
    let burst = "[[system.burst]]\nframe = 0\nparts = 9\n";
    let alone = MINIMAL.replace("initial_mean_parts = 100\n", "") + burst;
    let births = accepted(&alone).systems[0].births;
    assert_eq!(
        (births.per, births.initial_mean_parts),
        (BirthUnit::Frame, 0.0)
    );
    let both = MINIMAL.replace(
        "initial_mean_parts",
        "var_parts_per_area = 1\ninitial_mean_parts",
    );
    let error = refused(&(both + burst));
    assert!(
        error.message().contains("has both births a frame"),
        "{error}"
    );
    for key in ["cubic_mean_parts", "delta_var_parts_per_area"] {
        let error = refused(&(MINIMAL.replace("initial_mean_parts", key) + burst));
        assert!(
            error.message().contains("`system.only.initial_mean_parts"),
            "{error}"
        );
        assert!(error.message().contains("is missing"), "{error}");
    }
}

#[test]
fn r11_schema_has_mean_and_var_for_all_seven_attributes() {
    let kind = |key: &str| {
        let field = schema::SYSTEM.iter().find(|field| field.key == key);
        *field.unwrap_or_else(|| panic!("{key} is no key of a system"))
    };
    // Velocity is speed and ejection angle; the angle's mean is the axis and its half-width is the key.
    for (key, with_rate) in [
        ("speed", false),
        ("lifetime", false),
        ("size", true),
        ("color", true),
        ("transparency", true),
    ] {
        let parts: Vec<_> = kind(key)
            .randomised_fields()
            .iter()
            .map(|field| field.key)
            .collect();
        assert_eq!(parts[..2], ["mean", "var"], "{key}");
        let rates: &[&str] = if with_rate {
            &["rate", "rate_var"]
        } else {
            &[]
        };
        assert_eq!(parts[2..], *rates, "{key}");
    }
    assert!(matches!(
        kind("ejection_angle_degrees").kind,
        Kind::Numbers { count: 1, .. }
    ));
    // Position's mean is the origin and its spread the generation shape; shape is one for all.
    assert!(matches!(
        kind("position").kind,
        Kind::Numbers { count: 3, .. }
    ));
    let Kind::Variants(shapes) = kind("generation_shape").kind else {
        panic!("generation_shape has no variants")
    };
    assert_eq!(
        shapes.iter().map(|shape| shape.name).collect::<Vec<_>>(),
        [
            "sphere",
            "circle",
            "rectangle",
            "ring",
            "box",
            "cone",
            "line",
            "attractor",
            "rings",
            "mesh"
        ]
    );
    assert!(matches!(
        kind("particle_shape").kind,
        Kind::Choice(["sphere", "rectangle", "streak", "stroke"])
    ));
}

#[test]
fn lists_have_an_end() {
    let many = |count, one: &str| MINIMAL.to_owned() + &one.repeat(count);
    #[rustfmt::skip]
    let lists = [
        ("wind", 16, "[[wind]]\nkind = \"uniform\"\nvelocity = [0, 0, 0]\n"),
        ("system.only.burst", 64, "[[system.burst]]\nframe = 0\nparts = 1\n"),
        ("system.only.extinction", 16, "[[system.extinction]]\nkind = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n"),
    ];
    for (path, most, one) in lists {
        accepted(&many(most, one));
        let error = refused(&many(most + 1, one));
        let what = format!("`{path}` cannot be an array of {}", most + 1);
        assert!(error.message().contains(&what), "{error}");
        assert!(
            error.help().contains(&format!("at most {most} tables")),
            "{error}"
        );
    }
    let layers = |count| {
        let one =
            |i| format!("[[layer]]\nname = \"l{i}\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n");
        MINIMAL.to_owned() + &(0..count).map(one).collect::<String>()
    };
    assert_eq!(accepted(&layers(8)).layers.len(), 8);
    assert!(refused(&layers(9)).help().contains("at most 8 tables"));
    let triggers = |count| {
        let frames: Vec<String> = (0..count).map(|i: u32| i.to_string()).collect();
        with(
            "system",
            "trigger_frames",
            &format!("[{}]", frames.join(", ")),
        )
    };
    assert_eq!(
        accepted(&triggers(256)).systems[0].trigger_frames.len(),
        256
    );
    let error = refused(&triggers(257));
    assert!(
        error
            .message()
            .contains("`system.first.trigger_frames` has too many"),
        "{error}"
    );
    assert!(error.help().contains("at most 256"), "{error}");
}

#[test]
fn a_system_may_begin_before_the_scene() {
    let triggered = with("system", "first_frame", "-65_000");
    let error = refused(&triggered);
    assert!(
        error
            .message()
            .contains("`system.first.first_frame` is at frame -65000 before the trigger"),
        "{error}"
    );
    assert_eq!(error.line(), Some(line_of("system", "first_frame")));
    let begun = triggered.replace("trigger_frames = [-5, 0, 40]\n", "");
    let system = &accepted(&begun).systems[0];
    assert_eq!((system.first_frame, system.end_frame), (-65_000, Some(9)));
    let error = refused(&with("system", "first_frame", "9"));
    assert!(
        error
            .message()
            .contains("`system.first.end_frame` is 9, but births begin at frame 9"),
        "{error}"
    );
    assert_eq!(
        error.line(),
        Some(line_of("system", "end_frame")),
        "{error}"
    );
    let ended = begun.replace("end_frame = 9", "end_frame = -64_999");
    assert_eq!(accepted(&ended).systems[0].end_frame, Some(-64_999));
}
