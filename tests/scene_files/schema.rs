//! The JSON Schema and the reader say the same of a scene file.
//!
//! What differs is listed in the tests: rules between keys, which are the reader's, and what JSON
//! cannot tell apart.

use std::sync::OnceLock;

use jsonschema::{Validator, draft7, draft202012};
use serde_json::Value;
use toml::de::{DeTable, DeValue};

use motes::scene::schema::{self, Field, Kind, json_schema};
use motes::scene::{BUILTIN, parse};

use crate::keyed::CHANGING;
use crate::keys::KEYS;
use crate::text::{FILE, FULL, KEYED, MINIMAL, fields_of, with, with_line_before};

fn schema() -> Value {
    serde_json::from_str(&json_schema()).expect("the schema is JSON")
}

/// A scene file as editors give it to a validator; what JSON cannot say is null.
fn json(text: &str) -> Value {
    fn value(toml: &DeValue<'_>) -> Value {
        match toml {
            DeValue::String(text) => Value::from(text.as_ref()),
            DeValue::Integer(digits) => {
                let number = i64::from_str_radix(digits.as_str(), digits.radix());
                Value::from(number.expect("a whole number"))
            }
            DeValue::Float(digits) => {
                Value::from(digits.as_str().parse::<f64>().expect("a number"))
            }
            DeValue::Boolean(flag) => Value::from(*flag),
            DeValue::Datetime(_) => Value::Null,
            DeValue::Array(items) => items.iter().map(|item| value(item.get_ref())).collect(),
            DeValue::Table(entries) => table(entries),
        }
    }
    fn table(entries: &DeTable<'_>) -> Value {
        let entries = entries.iter();
        let entries =
            entries.map(|(key, entry)| (key.get_ref().to_string(), value(entry.get_ref())));
        Value::Object(entries.collect())
    }
    table(DeTable::parse(text).expect("TOML").get_ref())
}

pub(crate) fn schema_takes(text: &str) -> bool {
    static VALIDATOR: OnceLock<Validator> = OnceLock::new();
    let validator = VALIDATOR.get_or_init(|| draft202012::new(&schema()).expect("a schema"));
    validator.is_valid(&json(text))
}

pub(crate) fn reader_takes(text: &str) -> bool {
    parse(text, FILE, "some").is_ok()
}

/// Both take it.
#[track_caller]
pub(crate) fn both_take(text: &str, what: &str) {
    assert!(reader_takes(text), "the reader refuses {what}:\n{text}");
    assert!(schema_takes(text), "the schema refuses {what}:\n{text}");
}

/// Both refuse it.
#[track_caller]
pub(crate) fn both_refuse(text: &str, what: &str) {
    assert!(!reader_takes(text), "the reader takes {what}:\n{text}");
    assert!(!schema_takes(text), "the schema takes {what}:\n{text}");
}

#[test]
fn the_schema_is_one() {
    assert!(draft202012::meta::is_valid(&schema()));
    // Nothing that the tables say is lost: as many keys as they have.
    let text = json_schema();
    for &(_, key, ..) in KEYS {
        assert!(text.contains(&format!("\"title\": \"{key}\"")), "{key}");
    }
    for source in ["Reeves 2.1", "Perry 3.2.3"] {
        assert!(text.contains(&format!("Source: {source}.")), "{source}");
    }
}

/// Every default and example in a schema, with the part of the schema that it stands in.
fn samples<'a>(schema: &'a Value, found: &mut Vec<(&'a Value, &'a Value)>) {
    // Under `properties`, these words would be keys of scene files.
    for value in schema.get("default").into_iter() {
        found.push((schema, value));
    }
    for value in schema
        .get("examples")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
    {
        found.push((schema, value));
    }
    let lists = ["anyOf", "oneOf", "prefixItems"].into_iter();
    for part in lists.filter_map(|key| schema[key].as_array()).flatten() {
        samples(part, found);
    }
    for part in schema["properties"]
        .as_object()
        .into_iter()
        .flat_map(|keys| keys.values())
    {
        samples(part, found);
    }
    if schema["items"].is_object() {
        samples(&schema["items"], found);
    }
}

#[test]
fn every_default_and_example_in_it_is_valid_there() {
    let schema = schema();
    let mut found = Vec::new();
    samples(&schema, &mut found);
    assert!(found.len() > 150, "{}", found.len());
    for (schema, value) in found {
        let validator = draft202012::new(schema).expect("a schema");
        assert!(
            validator.is_valid(value),
            "{value}: {}",
            schema["description"]
        );
    }
}

#[test]
fn every_scene_is_valid() {
    // Editors that know older drafts alone refuse nothing right.
    let older = draft7::new(&schema()).expect("a schema");
    let texts = BUILTIN.iter().map(|scene| (scene.name, scene.text));
    for (name, text) in texts.chain([("full", FULL), ("keyed", KEYED), ("minimal", MINIMAL)]) {
        both_take(text, name);
        assert!(older.is_valid(&json(text)), "{name}");
    }
}

#[test]
fn every_sample_is_valid_and_nothing_wrong_is() {
    // JSON makes no difference between 640.0 and 640.
    let same_in_json = [("image", "width"), ("", "seed")];
    for &(section, key, wrong_kind, out_of_range, _) in KEYS {
        let fields = fields_of(section);
        let field = fields
            .iter()
            .find(|field| field.key == key)
            .expect("a key of the schema");
        let what = format!("{section}.{key}");
        both_take(&with(section, key, field.sample()), &what);
        both_refuse(&with(section, key, out_of_range), &what);
        let wrong_kind = with(section, key, wrong_kind);
        if same_in_json.contains(&(section, key)) {
            assert!(
                !reader_takes(&wrong_kind) && schema_takes(&wrong_kind),
                "{what}"
            );
        } else {
            both_refuse(&wrong_kind, &what);
        }
        both_refuse(
            &with_line_before(section, key, "zebra = 1"),
            &format!("zebra by {what}"),
        );
    }
}

#[test]
fn the_ends_of_every_range_are_valid_and_what_is_past_them_is_not() {
    for &(section, key, ..) in KEYS {
        let fields = fields_of(section);
        let field = fields
            .iter()
            .find(|field| field.key == key)
            .expect("a key of the schema");
        for (part, text) in parts(section, field) {
            let Kind::Numbers { count, limits, .. } = part.kind else {
                continue;
            };
            let value = |number: f64| match count {
                1 => format!("{number}"),
                _ => format!("[{}]", vec![format!("{number}"); count].join(", ")),
            };
            let what = format!("{section}.{key} {}", part.key);
            for (end, past) in [(limits.min, -1.0), (limits.max, 1.0)] {
                // Rules between keys are the reader's alone.
                assert!(schema_takes(&text(&value(end))), "{what} {end}");
                let past = end + past * f64::max(end.abs() * 1e-9, 1e-9);
                both_refuse(&text(&value(past)), &format!("{what} {past}"));
            }
            if count > 1 {
                let numbers = vec![format!("{}", limits.max / 2.0); count + 1];
                both_refuse(&text(&format!("[{}]", numbers.join(", "))), &what);
                both_refuse(&text(&numbers[0]), &what);
            }
        }
    }
}

/// The scene that has this value at some place.
type WithValue = Box<dyn Fn(&str) -> String>;

/// A key's rows, those of its parts if it is a spread, each with the scene that has a value there.
fn parts(section: &'static str, field: &'static Field) -> Vec<(Field, WithValue)> {
    let Kind::Randomised { count, .. } = field.kind else {
        let text = move |value: &str| with(section, field.key, value);
        return vec![(*field, Box::new(text))];
    };
    let mean = if count == 1 {
        "mean = 1, "
    } else {
        "mean = [1, 1, 1], "
    };
    let parts = field.randomised_fields().into_iter();
    let text = move |part: &'static str| {
        let mean = if part == "mean" { "" } else { mean };
        move |value: &str| with(section, field.key, &format!("{{ {mean}{part} = {value} }}"))
    };
    parts
        .map(|part| (part, Box::new(text(part.key)) as WithValue))
        .collect()
}

#[test]
fn keys_over_frames_are_valid_where_the_reader_takes_them_and_nowhere_else() {
    for &(section, key, ..) in KEYS {
        let fields = fields_of(section);
        let field = fields
            .iter()
            .find(|field| field.key == key)
            .expect("a key of the schema");
        let changing = CHANGING.iter().find(|row| (row.0, row.1) == (section, key));
        assert_eq!(field.keyed, changing.is_some(), "{section}.{key}");
        let Some(&(_, _, from, to)) = changing else {
            let value = match field.kind {
                Kind::Randomised { .. } => "1",
                _ => field.sample(),
            };
            let value = format!("{{ keys = [[0, {value}]] }}");
            both_refuse(
                &with(section, key, &value),
                &format!("keys of {section}.{key}"),
            );
            continue;
        };
        let right = format!("[[2.5, {from}], [7, {to}]]");
        for interpolation in schema::INTERPOLATIONS {
            let value = format!("{{ keys = {right}, interpolation = \"{interpolation}\" }}");
            both_take(&with(section, key, &value), &value);
        }
        #[rustfmt::skip]
        let wrong = [
            "{ keys = [] }".to_owned(),
            format!("{{ keys = {from} }}"),
            format!("{{ keys = [[0]], interpolation = \"{}\" }}", "linear"),
            format!("{{ keys = [[0, {from}, {to}]] }}"),
            format!("{{ keys = [[-65_001, {from}]] }}"),
            format!("{{ keys = [[1_000_001, {from}]] }}"),
            format!("{{ keys = [[\"0\", {from}]] }}"),
            "{ keys = [[0, \"x\"]] }".to_owned(),
            "{ keys = [[0, [1, 2, 3, 4]]] }".to_owned(),
            format!("{{ keys = {right}, interpolation = \"cubic\" }}"),
            format!("{{ keys = {right}, zebra = 1 }}"),
            "{ interpolation = \"step\" }".to_owned(),
            format!("{{ keys = [{}] }}", vec![format!("[0, {from}]"); 1001].join(", ")),
        ];
        for value in wrong {
            both_refuse(&with(section, key, &value), &format!("{section}.{key}"));
        }
    }
    for key in ["speed", "lifetime", "color", "transparency", "size"] {
        let field = fields_of("system").iter().find(|field| field.key == key);
        for (part, text) in parts("system", field.expect("a key of a system")) {
            let value = if key == "color" { "[1, 1, 1]" } else { "1" };
            both_take(&text(&format!("{{ keys = [[0, {value}]] }}")), part.key);
            both_refuse(&text("{ keys = [[0, 1e9]] }"), part.key);
        }
    }
    let burst = with("burst", "parts", "{ mean = { keys = [[0, 1]] } }");
    both_refuse(&burst, "keys in a burst");
}
