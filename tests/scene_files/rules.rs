//! What a right scene is read as, and rules that hold between keys.

use motes::scene::schema::{self, Kind};
use motes::scene::{
    BirthRounding, BirthUnit, Births, Camera, Changing, GenerationShape, Image, ParticleShape,
    Spread, StreakLight, parse,
};

use crate::text::{FILE, FULL, MINIMAL, line_of, refused, with};

#[test]
fn every_key_reaches_its_place() {
    let scene = parse(FULL, FILE, "some").expect("the full scene is right");
    assert_eq!(scene.name, "some");
    assert_eq!(scene.title, "All of it");
    assert_eq!(scene.description, "Two lines:\nof text.");
    assert_eq!((scene.frames, scene.frame_rate), (10, 30));
    assert_eq!((scene.seed, scene.capacity), (0xfeed, Some(200_000)));
    let image = Image {
        width: 640,
        height: 360,
        background: [0.0, 0.5, 1.0],
        shutter: 0.48,
    };
    assert_eq!(scene.image, image);
    let camera = Camera {
        position: [0.0, 1.0, 5.0],
        target: [0.0; 3],
        up: [0.5, 1.0, 0.0],
        vertical_fov_degrees: 60.0,
        near: 0.01,
    };
    assert_eq!(scene.camera, camera);
    let [first, second] = &scene.systems[..] else {
        panic!("there are two systems");
    };
    assert_eq!(
        (first.name.as_str(), second.name.as_str()),
        ("first", "second")
    );
    assert_eq!(first.position, [1.0, 2.0, 3.0]);
    assert_eq!(first.rotation_degrees, [-90.0, 45.5]);
    assert_eq!((first.first_frame, first.end_frame), (3, Some(9)));
    let births = Births {
        per: BirthUnit::Frame,
        initial_mean_parts: 100.5,
        delta_mean_parts: -2.0,
        var_parts: 20.0,
    };
    assert_eq!(first.births, births);
    assert_eq!(first.birth_rounding, BirthRounding::Nearest);
    let rectangle = GenerationShape::Rectangle {
        length: 2.0,
        width: 0.5,
    };
    assert_eq!(first.generation_shape, rectangle);
    assert_eq!(first.ejection_angle_degrees, 30.0);
    assert_eq!(
        first.speed,
        Spread {
            mean: -0.1,
            var: 0.02
        }
    );
    assert_eq!(
        first.lifetime,
        Spread {
            mean: 60.0,
            var: 10.0
        }
    );
    let color = Changing {
        initial: Spread {
            mean: [0.4, 0.1, 0.02],
            var: [0.1, 0.0, 0.0],
        },
        rate: [0.0, -0.01, 0.01],
    };
    assert_eq!(first.color, color);
    let number = |mean, var, rate| Changing {
        initial: Spread { mean, var },
        rate,
    };
    assert_eq!(first.transparency, number(0.25, 0.125, 0.5));
    assert_eq!(first.size, number(0.02, 0.01, -0.001));
    assert_eq!(first.acceleration, [0.0, -0.01, 0.0]);
    assert_eq!(first.particle_shape, ParticleShape::Streak);
    assert_eq!(first.streak_light, StreakLight::Constant);
    assert_eq!(first.intensity_threshold, Some(0.01));
    let births = Births {
        per: BirthUnit::ScreenArea,
        initial_mean_parts: 0.5,
        delta_mean_parts: 0.1,
        var_parts: 0.25,
    };
    assert_eq!(second.births, births);
    assert_eq!(
        second.generation_shape,
        GenerationShape::Circle { radius: 3.0 }
    );
}

#[test]
fn what_is_not_written_has_the_documented_default() {
    let scene = parse(MINIMAL, FILE, "some").expect("the minimal scene is right");
    assert_eq!(
        (scene.title.as_str(), scene.description.as_str()),
        ("some", "")
    );
    assert_eq!((scene.frames, scene.frame_rate), (120, 24));
    assert_eq!((scene.seed, scene.capacity), (1, None));
    let image = Image {
        width: 1280,
        height: 720,
        background: [0.0; 3],
        shutter: 0.5,
    };
    assert_eq!(scene.image, image);
    assert_eq!(scene.camera.up, [0.0, 1.0, 0.0]);
    assert_eq!(
        (scene.camera.vertical_fov_degrees, scene.camera.near),
        (45.0, 0.1)
    );
    let system = &scene.systems[0];
    assert_eq!(
        (system.position, system.rotation_degrees),
        ([0.0; 3], [0.0; 2])
    );
    assert_eq!((system.first_frame, system.end_frame), (0, None));
    let births = Births {
        per: BirthUnit::Frame,
        initial_mean_parts: 100.0,
        delta_mean_parts: 0.0,
        var_parts: 0.0,
    };
    assert_eq!(system.births, births);
    assert_eq!(system.birth_rounding, BirthRounding::Stochastic);
    assert_eq!(
        system.generation_shape,
        GenerationShape::Sphere { radius: 1.0 }
    );
    assert_eq!(system.ejection_angle_degrees, 0.0);
    // A mean alone has no spread and no rate.
    assert_eq!(
        system.speed,
        Spread {
            mean: 0.1,
            var: 0.0
        }
    );
    let number = |mean| Changing {
        initial: Spread { mean, var: 0.0 },
        rate: 0.0,
    };
    assert_eq!(
        (system.size, system.transparency),
        (number(0.02), number(0.0))
    );
    let color = Spread {
        mean: [0.4, 0.1, 0.02],
        var: [0.0; 3],
    };
    assert_eq!(
        system.color,
        Changing {
            initial: color,
            rate: [0.0; 3]
        }
    );
    assert_eq!(system.acceleration, [0.0; 3]);
    assert_eq!(system.particle_shape, ParticleShape::Sphere);
    assert_eq!(system.streak_light, StreakLight::Conserved);
    assert_eq!(system.intensity_threshold, None);
}

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
    assert!(
        parse(&by_area, FILE, "s").is_ok_and(|s| s.systems[0].births.per == BirthUnit::ScreenArea)
    );
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
        assert_eq!(parts.contains(&"rate"), with_rate, "{key}");
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
        ["sphere", "circle", "rectangle"]
    );
    assert!(matches!(
        kind("particle_shape").kind,
        Kind::Choice(["sphere", "rectangle", "streak"])
    ));
}
