//! The knobs of a scene: what `--set` can reach.

use std::collections::BTreeSet;

use motes::scene::{BUILTIN, Knob, KnobValue, knobs, load, load_with};

use crate::text::{FULL, KEYED, MINIMAL};

#[track_caller]
fn of(scene: &str) -> Vec<Knob> {
    knobs(scene).unwrap_or_else(|error| panic!("{error}"))
}

/// What `--set` gets for the value that is shown, if there is one.
fn set(knob: &Knob) -> Option<String> {
    match &knob.value {
        KnobValue::Written(toml) | KnobValue::Default(toml) => {
            Some(format!("{}={toml}", knob.path))
        }
        KnobValue::None => None,
    }
}

/// Values just outside of what is listed: the ends are read from the words.
fn beyond(knob: &Knob) -> Vec<String> {
    let words = knob.right();
    if words.starts_with("one of") || words.starts_with("true") {
        return vec!["nothing-of-the-kind".to_owned(), "[1]".to_owned()];
    }
    let (_, range) = words.split_once("from ").expect("a range");
    let (min, max) = range.split_once(" to ").expect("both ends");
    let max = max.split([',', ' ']).next().expect("a number");
    let number = |end: &str| -> f64 { end.replace('_', "").parse().expect("a number") };
    let size = match words.split_once("array of ") {
        None => 0,
        Some((_, count)) if count.starts_with("at most") => 1,
        Some((_, count)) => count[..1].parse().expect("a count"),
    };
    // Past the ends by a bit, and what is whole by one.
    let (bit, whole) = (1e-7, words.contains("whole number"));
    let [low, high] = [(number(min), -1.0), (number(max), 1.0)].map(|(end, sign)| {
        if whole {
            return format!("{:.0}", end + sign);
        }
        let number = format!("{}", end + sign * f64::max(bit, end.abs() * bit));
        if size == 0 {
            number
        } else {
            format!("[{}]", vec![number; size].join(", "))
        }
    });
    let array = |one: String| {
        if whole && size == 1 {
            format!("[{one}]")
        } else {
            one
        }
    };
    vec![array(low), array(high)]
}

/// The path without names and indices, so that it says which row of the schema it is.
fn row(knob: &Knob) -> String {
    let mut parts = knob.path.split('.');
    let mut row = Vec::new();
    while let Some(part) = parts.next() {
        row.push(part);
        if ["system", "wind", "layer", "burst", "extinction"].contains(&part) {
            parts.next();
        }
    }
    row.join(".")
}

#[test]
fn p7_every_scene_lists_at_least_eight_knobs_with_what_they_do() {
    for scene in BUILTIN {
        let knobs = of(scene.name);
        assert!(knobs.len() >= 8, "{}: {}", scene.name, knobs.len());
        let paths: BTreeSet<&str> = knobs.iter().map(|knob| knob.path.as_str()).collect();
        assert_eq!(paths.len(), knobs.len(), "{}: a path twice", scene.name);
        for knob in &knobs {
            assert!(knob.about.len() > 3, "{knob:?}");
            assert!(!knob.right().is_empty(), "{knob:?}");
        }
    }
}

#[test]
fn p7_setting_a_knob_to_what_it_shows_changes_nothing() {
    for builtin in BUILTIN {
        let scene = load(builtin.name).expect("a built-in scene");
        let knobs = of(builtin.name);
        let all: Vec<String> = knobs.iter().filter_map(set).collect();
        let reset = load_with(builtin.name, &all).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(reset, scene, "{}", builtin.name);
        // Each alone, once a row of the schema and origin: whether it can be set without the others.
        let mut rows = BTreeSet::new();
        for knob in &knobs {
            let Some(set) = set(knob).filter(|_| {
                rows.insert((
                    row(knob),
                    matches!(knob.value, KnobValue::Written(_)),
                    knob.has_keys,
                ))
            }) else {
                continue;
            };
            match load_with(builtin.name, std::slice::from_ref(&set)) {
                Ok(reset) => assert!(reset == scene, "{}: {set} changes it", builtin.name),
                Err(error) => panic!("{}: {error}", builtin.name),
            }
        }
    }
}

#[test]
fn p7_a_knob_refuses_what_is_beyond_its_range() {
    let mut rows = BTreeSet::new();
    for builtin in BUILTIN {
        for knob in of(builtin.name) {
            if !rows.insert(row(&knob)) {
                continue;
            }
            for value in beyond(&knob) {
                let set = format!("{}={value}", knob.path);
                let error = match load_with(builtin.name, std::slice::from_ref(&set)) {
                    Ok(_) => panic!("{}: {set} was accepted: {}", builtin.name, knob.right()),
                    Err(error) => error,
                };
                assert_eq!(error.file(), Some("command line"), "{set}: {error}");
            }
        }
    }
    // The scenes have knobs of all kinds.
    assert!(rows.len() > 90, "{}: {rows:?}", rows.len());
}

#[test]
fn p7_knobs_say_where_their_values_come_from() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let knobs_of = |text: &str| {
        let path = folder.path().join("some.toml");
        std::fs::write(&path, text).expect("a file");
        of(&path.to_string_lossy())
    };
    let find = |knobs: &[Knob], path: &str| {
        let found = knobs.iter().find(|knob| knob.path == path);
        found.map(|knob| (knob.value.clone(), knob.has_keys))
    };
    let written = |toml: &str| Some((KnobValue::Written(toml.to_owned()), false));
    let default = |toml: &str| Some((KnobValue::Default(toml.to_owned()), false));
    let by_keys = |toml: &str| Some((KnobValue::Written(toml.to_owned()), true));
    let minimal = knobs_of(MINIMAL);
    let full = knobs_of(FULL);
    let keyed = knobs_of(KEYED);
    #[rustfmt::skip]
    let cases = [
        (&minimal, "camera.position", written("[0, 1, 5]")),
        (&minimal, "camera.near", default("0.1")),
        (&minimal, "image.width", default("1280")),
        (&minimal, "capacity", Some((KnobValue::None, false))),
        (&minimal, "system.only.speed.mean", written("0.1")),
        (&minimal, "system.only.speed.var", default("0")),
        (&minimal, "system.only.color.var", default("[0, 0, 0]")),
        (&minimal, "system.only.transparency.mean", default("0")),
        (&minimal, "system.only.generation_shape.kind", written("\"sphere\"")),
        (&minimal, "system.only.generation_shape.radius", written("1")),
        (&minimal, "system.only.delta_mean_parts", default("0")),
        // Births an area cannot be set beside births a frame.
        (&minimal, "system.only.initial_mean_parts_per_area", None),
        (&minimal, "system.only.name", None),
        (&full, "system.second.initial_mean_parts", None),
        (&full, "system.second.initial_mean_parts_per_area", written("0.5")),
        (&full, "system.first.burst.1.parts.mean", written("7")),
        (&full, "system.first.burst.1.parts.var", default("0")),
        (&full, "system.first.extinction.3.kills", written("\"outside\"")),
        (&full, "system.first.trigger_frames", written("[-5, 0, 40]")),
        (&full, "wind.7.absolute", written("true")),
        (&full, "wind.5.kind", written("\"sink\"")),
        (&full, "layer.far.point", written("[0, 0, -4]")),
        (&keyed, "system.only.lifetime.mean", written("60")),
        (&keyed, "system.only.lifetime.var", by_keys("{ keys = [[0, 0], [10, 30]] }")),
        (&keyed, "system.only.speed.mean", by_keys("{ keys = [[0, 0.1], [12, 0.2]], interpolation = \"step\" }")),
        (&keyed, "system.only.speed.var", default("0")),
        (&keyed, "image.exposure", by_keys("{ keys = [[0, 1], [30, 0.5]] }")),
    ];
    for (knobs, path, wanted) in cases {
        assert_eq!(find(knobs, path), wanted, "{path}");
    }
}
