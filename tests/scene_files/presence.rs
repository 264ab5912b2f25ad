//! Keys that are there and should not be, and the other way round.

use motes::scene::parse;
use motes::scene::schema::{self, Field, Kind, Presence};

use crate::keys::KEYS;
use crate::text::{
    FILE, MINIMAL, accepted, fields_of, header_of, line_of, refused, with, with_line_before,
    without,
};

#[test]
fn every_sample_of_the_schema_is_right() {
    for &(section, key, ..) in KEYS {
        let field = fields_of(section)
            .iter()
            .find(|field| field.key == key)
            .expect("a field");
        let text = with(section, key, field.sample());
        accepted(&text);
    }
    // Tables' samples are a whole scene together.
    let is_table = |field: &&Field| {
        let kind = field.kind;
        matches!(
            kind,
            Kind::Table(_) | Kind::Tables { .. } | Kind::List { .. }
        )
    };
    let tables = schema::SCENE.iter().filter(is_table);
    let text: String = tables
        .map(|field| format!("{} = {}\n", field.key, field.sample()))
        .collect();
    accepted(&text);
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
        ("burst", "frame", "part = 3", "part", Some("parts")),
        (
            "extinction.sphere",
            "radius",
            "centre = 1",
            "centre",
            Some("center"),
        ),
        (
            "wind.noise",
            "octaves",
            "octave = 1",
            "octave",
            Some("octaves"),
        ),
        ("wind.vortex", "axis", "velocity = 1", "velocity", None),
        ("layer", "normal", "norml = 1", "norml", Some("normal")),
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
        // Long lists are not read to their end.
        let is_listed = [key, "`motes schema --markdown`"]
            .iter()
            .any(|it| error.help().contains(it));
        assert!(is_listed, "{error}");
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
            // All on one line.
            _ if section.starts_with("generation_shape.") => continue,
            _ if section.starts_with("edges.") => continue,
            _ if section.starts_with("roots.") => continue,
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
            assert_eq!(error.line(), Some(header_of(section, key)), "{error}");
        } else if key == "parent" {
            // What differs among systems of a kind needs one that bears them.
            let error = result.expect_err(key);
            assert!(error.help().contains("a `parent`"), "{error}");
        } else {
            assert!(result.is_ok(), "{key}: {result:?}");
        }
    }
    // Each kind of shape has keys of its own, and each shape a kind.
    for shape in schema::GENERATION_SHAPES {
        let required = |field: &&Field| matches!(field.presence, Presence::Required(_));
        for left_out in shape.fields.iter().filter(required) {
            let others = shape
                .fields
                .iter()
                .filter(|field| field.key != left_out.key);
            let others = others.map(|field| format!(", {} = {}", field.key, field.sample()));
            let others: String = others.collect();
            let value = format!("{{ kind = \"{}\"{others} }}", shape.name);
            let error = refused(&with("system", "generation_shape", &value));
            let what = format!(
                "`system.first.generation_shape.{}` is missing",
                left_out.key
            );
            assert!(error.message().contains(&what), "{error}");
            let line = line_of("system", "generation_shape");
            assert_eq!(error.line(), Some(line), "{error}");
        }
    }
    let error = refused("title = \"x\"\n");
    assert_eq!(error.message(), "`camera` and `system` are missing");
    assert_eq!((error.line(), error.column()), (Some(1), Some(1)));
}

#[test]
fn all_that_is_missing_from_a_table_is_named_at_once() {
    let error = refused("[camera]\ntarget = [0, 0, 0]\n[[system]]\nname = \"jet\"\n");
    assert_eq!(error.message(), "`camera.position` is missing");
    let text = MINIMAL
        .replace("speed = 0.1\n", "")
        .replace("size = 0.02\n", "");
    let error = refused(&text.replace("color = [0.4, 0.1, 0.02]\n", ""));
    let what = "`system.only.speed`, `system.only.color` and `system.only.size` are missing";
    assert_eq!(error.message(), what);
    let help = "add `speed = { mean = 0.1, var = 0.02 }`, `color = { mean = [0.4, 0.1, 0.02] }` and \
                `size = { mean = 0.02 }`";
    assert_eq!(error.help(), help);
    let header = MINIMAL.lines().position(|line| line == "[[system]]");
    assert_eq!(error.line(), header.map(|index| index + 1), "{error}");
    let wind = MINIMAL.to_owned() + "[[wind]]\nkind = \"vortex\"\n";
    let error = refused(&wind);
    assert_eq!(
        error.message(),
        "`wind.0.position` and `wind.0.speed` are missing"
    );
}

#[test]
fn a_key_of_an_outer_table_is_said_to_be_one() {
    // A line below the header of a table inside belongs to that table.
    let table = MINIMAL.replace("speed = 0.1\n", "[system.speed]\nmean = 0.1\n");
    let last = MINIMAL.to_owned() + "[system.transparency]\nmean = 0.1\ndrag = 0.5\n";
    let system = "[[system]]\nname = \"only\"\n";
    let plane = "[[system.extinction]]\nkind = \"plane\"\ndrag = 0.5\n";
    #[rustfmt::skip]
    let cases = [
        (last, "drag", "`system.only.transparency`", "in `[[system]]`"),
        // Those that must be written are looked for.
        (table, "color", "`system.only.speed`", "in `[[system]]`"),
        (MINIMAL.replace("color", "[[system.burst]]\nframe = 1\nparts = 1\ncolor"), "color", "`system.only.burst.0`", "in `[[system]]`"),
        (MINIMAL.to_owned() + plane, "drag", "`system.only.extinction.0`", "in `[[system]]`"),
        (MINIMAL.to_owned() + "frames = 3\n", "frames", "`system.only`", "at the top of a scene"),
        (MINIMAL.replace(system, &format!("seed = 3\n{system}")), "seed", "`camera`", "at the top of a scene"),
        (MINIMAL.to_owned() + "[image]\nwind = []\n", "wind", "`image`", "at the top of a scene"),
    ];
    for (text, key, table, place) in cases {
        let error = refused(&text);
        let what = format!("there is no key `{key}` in {table}");
        assert_eq!(error.message(), what);
        let help = format!("`{key}` is a key {place}: write it there, ");
        assert!(error.help().starts_with(&help), "{error}");
        let is_it = |line: &str| line.starts_with(&format!("{key} = "));
        let line = text.lines().position(is_it);
        assert_eq!(error.line(), line.map(|index| index + 1), "{error}");
    }
    // What is a key nowhere around gets no such hint.
    let error = refused(&(MINIMAL.to_owned() + "[image]\nspeed = 1\n"));
    assert!(!error.help().contains("write it there"), "{error}");
    // It is told where else there is one, and no more than that of what is nowhere.
    for (text, told) in [
        (
            MINIMAL.to_owned() + "[image]\nspeed = 1\n",
            "`speed` is a key in `[[system]]`, `[[fire]]`, ",
        ),
        (
            format!("background = [0, 0, 0]\n{MINIMAL}"),
            "`background` is a key in `[image]`. The table has",
        ),
        (
            format!("radius = 1\n{MINIMAL}"),
            "`radius` is a key in `[planet]`, `[ground]`, `[[pillar]]`. The",
        ),
        (
            MINIMAL.to_owned() + "[image]\nqwertz = 1\n",
            "The table has",
        ),
    ] {
        let error = refused(&text);
        assert!(error.help().starts_with(told), "{error}");
    }
}

#[test]
fn every_table_with_a_kind_must_have_a_known_one() {
    // A key of such a table, its path, a word near a kind, and that kind.
    let cases = [
        ("wind.curl", "strength", "wind.8", "crul", "curl"),
        ("wind.sink", "position", "wind.5", "sinc", "sink"),
        (
            "extinction.plane",
            "point",
            "system.first.extinction.1",
            "plain",
            "plane",
        ),
    ];
    for (section, key, path, word, kind) in cases {
        let header = header_of(section, key);
        let mut lines: Vec<String> = with_line_before(section, key, "#")
            .lines()
            .map(str::to_owned)
            .collect();
        assert_eq!(lines[header], format!("kind = \"{kind}\""));
        lines[header] = format!("kind = \"{word}\"");
        let error = refused(&lines.join("\n"));
        let what = format!("`{path}.kind` cannot be \"{word}\"");
        assert!(error.message().contains(&what), "{error}");
        assert!(
            error.help().contains(&format!("did you mean `{kind}`?")),
            "{error}"
        );
        assert_eq!(
            (error.line(), error.column()),
            (Some(header + 1), Some(8)),
            "{error}"
        );
        lines[header] = String::new();
        let error = refused(&lines.join("\n"));
        assert!(
            error
                .message()
                .contains(&format!("`{path}.kind` is missing")),
            "{error}"
        );
        assert!(
            error.help().contains(&format!("{{ kind = \"{kind}\", ")),
            "{error}"
        );
        assert_eq!(error.line(), Some(header), "{error}");
    }
}

#[test]
fn births_that_slipped_into_a_table_below_are_told_with_their_place() {
    let text = r#"[camera]
position = [0, 0, 5]
target = [0, 0, 0]
[[system]]
name = "jet"
generation_shape = { kind = "sphere", radius = 1 }
speed = 0.1
lifetime = 9
color = [0.1, 0.1, 0.1]
size = 0.1
[[system.extinction]]
kind = "distance"
distance = 3
direction = [0, 1, 0]
initial_mean_parts = 100
"#;
    let error = parse(text, FILE, "test").expect_err("nothing is born");
    assert_eq!(error.line(), Some(15), "{error}");
    assert!(error.help().contains("[[system]]"), "{error}");
    assert!(error.help().contains("above the headers"), "{error}");
}
