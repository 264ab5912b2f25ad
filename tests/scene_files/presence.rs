//! Keys that are there and should not be, and the other way round.

use motes::scene::parse;
use motes::scene::schema::{self, Field, Kind, Presence};

use crate::keys::KEYS;
use crate::text::{FILE, FULL, line_of, refused, with, with_line_before, without};

fn fields_of(section: &str) -> &'static [Field] {
    match section {
        "" => schema::SCENE,
        "image" => schema::IMAGE,
        "camera" => schema::CAMERA,
        "system" => schema::SYSTEM,
        _ => {
            let variant = schema::GENERATION_SHAPES
                .iter()
                .find(|shape| shape.name == section);
            variant.expect("a section is a table or a shape").fields
        }
    }
}

#[test]
fn every_sample_of_the_schema_is_right() {
    for &(section, key, ..) in KEYS {
        let field = fields_of(section)
            .iter()
            .find(|field| field.key == key)
            .expect("a field");
        let text = with(section, key, field.sample());
        assert!(
            parse(&text, FILE, "some").is_ok(),
            "{section}.{key} = {}",
            field.sample()
        );
    }
    // Tables' samples are a whole scene together.
    let is_table = |field: &&Field| matches!(field.kind, Kind::Table(_) | Kind::Tables { .. });
    let tables = schema::SCENE.iter().filter(is_table);
    let text: String = tables
        .map(|field| format!("{} = {}\n", field.key, field.sample()))
        .collect();
    assert!(parse(&text, FILE, "some").is_ok(), "{text}");
}

#[test]
fn unknown_keys_are_refused_with_the_nearest() {
    let cases = [
        (
            "",
            "frames",
            "framerate = 3",
            "framerate",
            Some("frame_rate"),
        ),
        ("", "frames", "zebra = 3", "zebra", None),
        ("image", "width", "widht = 3", "widht", Some("width")),
        ("camera", "near", "fov = 3", "fov", None),
        ("camera", "near", "\"Up\" = 3", "Up", Some("up")),
        (
            "system",
            "speed",
            "colour = [1, 1, 1]",
            "colour",
            Some("color"),
        ),
        (
            "system",
            "speed",
            "end_fram = 3",
            "end_fram",
            Some("end_frame"),
        ),
    ];
    for (section, key, line, name, nearest) in cases {
        let error = refused(&with_line_before(section, key, line));
        assert_eq!(error.line(), Some(line_of(section, key)), "{error}");
        assert_eq!(error.column(), Some(1), "{error}");
        assert!(
            error.message().contains(&format!("no key `{name}`")),
            "{error}"
        );
        let guess = nearest.map(|nearest| format!("did you mean `{nearest}`?"));
        assert_eq!(
            error.help().contains("did you mean"),
            guess.is_some(),
            "{error}"
        );
        assert!(error.help().contains(&guess.unwrap_or_default()), "{error}");
        assert!(error.help().contains(key), "{error}");
    }
    let error = refused(&with(
        "system",
        "generation_shape",
        "{ kind = \"circle\", width = 1 }",
    ));
    assert!(error.message().contains("no key `width`"), "{error}");
    assert!(error.help().contains("kind, radius"), "{error}");
}

#[test]
fn only_what_is_required_must_be_written() {
    for &(section, key, ..) in KEYS {
        let fields = match section {
            "sphere" | "circle" | "rectangle" => continue,
            "system" if key.ends_with("_per_area") => continue,
            _ => fields_of(section),
        };
        let field = fields
            .iter()
            .find(|field| field.key == key)
            .expect("checked above");
        let result = parse(&without(section, key), FILE, "some");
        // One of the two ways to give births must be there.
        if matches!(field.presence, Presence::Required(_)) || key == "initial_mean_parts" {
            let error = result.expect_err(key);
            assert!(
                error.message().contains(&format!("{key}` is missing")),
                "{error}"
            );
            assert!(
                error.help().starts_with(&format!("add `{key} = ")),
                "{error}"
            );
            let header = FULL
                .lines()
                .position(|line| line.contains(&format!("[{section}]")));
            assert_eq!(error.line(), header.map(|index| index + 1), "{error}");
        } else {
            assert!(result.is_ok(), "{key}: {result:?}");
        }
    }
    let error = refused("title = \"x\"\n");
    assert!(error.message().contains("`camera` is missing"), "{error}");
    assert_eq!((error.line(), error.column()), (Some(1), Some(1)));
}
