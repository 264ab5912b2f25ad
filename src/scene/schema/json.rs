//! The tables as JSON Schema, for editors that complete, explain and check scene files.
//!
//! What depends on one key alone is in it; what must hold between keys is for the reader. Only
//! `prefixItems` is newer than draft 7, and where it is not known, nothing right is refused.

use super::{
    Field, INTERPOLATIONS, KEY_FRAMES, Kind, Limits, MOST_KEYS, MOST_NAME_CHARS, Presence, SCENE,
    Variant,
};
use crate::json::Json;
use crate::scene::expect::kind_in_words;
use crate::scene::tree;

/// Text without control characters.
const ONE_LINE: &str = r"^[^\u0000-\u001f\u007f-\u009f]*$";

/// Text without control characters but line breaks.
const LINES: &str = r"^[^\u0000-\u0009\u000b-\u001f\u007f-\u009f]*$";

/// A [`Kind::Name`], but for its length.
const NAME: &str = r"^[\p{Alphabetic}_][\p{Alphabetic}\p{N}_-]*$";

/// JSON Schema (draft 2020-12) of a scene file.
#[must_use]
pub fn json_schema() -> String {
    let head = [
        ("$schema", "https://json-schema.org/draft/2020-12/schema"),
        ("title", "A scene of Motes"),
        (
            "description",
            "Particle systems, a camera and a picture. Lengths are in world units with y up, times \
             in frames, angles in degrees.",
        ),
    ];
    let head = Json::object(head.map(|(key, text)| (key, text.into())));
    // Somebody is in it.
    let list = |key: &str| {
        let filled = Json::object([("minItems", Json::Whole(1))]);
        let properties = Json::Object(vec![(key.to_owned(), filled)]);
        Json::object([("required", Json::texts([key])), ("properties", properties)])
    };
    let somebody = Json::object([(
        "anyOf",
        Json::Array(vec![list("system"), list("flock"), list("fire")]),
    )]);
    joined(joined(head, table(SCENE)), somebody).pretty()
}

/// The entries of two objects.
fn joined(first: Json, second: Json) -> Json {
    match (first, second) {
        (Json::Object(mut entries), Json::Object(more)) => {
            entries.extend(more);
            Json::Object(entries)
        }
        (first, _) => first,
    }
}

fn table(fields: &[Field]) -> Json {
    let properties = fields
        .iter()
        .map(|field| (field.key.to_owned(), property(field)));
    object(properties.collect(), required(fields))
}

fn required(fields: &[Field]) -> Vec<&'static str> {
    let required = fields
        .iter()
        .filter(|field| matches!(field.presence, Presence::Required(_)));
    required.map(|field| field.key).collect()
}

fn object(properties: Vec<(String, Json)>, required: Vec<&str>) -> Json {
    let mut object = Json::object([("type", "object".into())]);
    if !required.is_empty() {
        object = object.with("required", Json::texts(required));
    }
    object
        .with("additionalProperties", Json::Flag(false))
        .with("properties", Json::Object(properties))
}

/// The schema of a key's value, with what people want to know of it.
fn property(field: &Field) -> Json {
    let head = Json::object([
        ("title", field.key.into()),
        ("description", Json::Text(description(field))),
    ]);
    let sample = tree::snippet(field.sample(), field.key);
    let head = match (field.presence, sample) {
        (_, Err(_)) => head,
        (Presence::Default(_), Ok(node)) => head.with("default", node.value.json()),
        (_, Ok(node)) => head.with("examples", Json::Array(vec![node.value.json()])),
    };
    joined(head, value(field))
}

fn description(field: &Field) -> String {
    let mut text = sentence(field.about);
    let is_table = matches!(
        field.kind,
        Kind::Table(_) | Kind::Tables { .. } | Kind::Variants(_) | Kind::List { .. }
    );
    if !is_table {
        let comma = if field.unit.is_empty() { "" } else { ", " };
        let words = format!("{}{comma}{}", kind_in_words(&field.kind), field.unit);
        text += &format!("\n\n{}", sentence(&words));
    }
    if field.keyed {
        text += " It can have keys over frames.";
    }
    match field.presence {
        Presence::Default(value) if !is_table => text += &format!(" Default: {value}."),
        _ => {}
    }
    if !field.source.is_empty() {
        text += &format!(" Source: {}.", field.source);
    }
    text
}

/// A clause as a sentence. Symbols, such as g and k_g, keep their case.
pub(super) fn sentence(clause: &str) -> String {
    let mut letters = clause.chars();
    let (first, rest) = (letters.next(), letters.as_str());
    match first {
        Some(first) if !rest.starts_with([',', '_']) => {
            format!("{}{rest}.", first.to_uppercase())
        }
        _ => format!("{clause}."),
    }
}

fn value(field: &Field) -> Json {
    match field.kind {
        Kind::Text { max_chars, lines } => Json::object([
            ("type", "string".into()),
            ("maxLength", max_chars.into()),
            ("pattern", if lines { LINES } else { ONE_LINE }.into()),
        ]),
        Kind::Name { reserved } => {
            let name = Json::object([
                ("type", "string".into()),
                ("maxLength", MOST_NAME_CHARS.into()),
                ("pattern", NAME.into()),
            ]);
            match reserved {
                [] => name,
                _ => {
                    let words = Json::texts(reserved.iter().copied());
                    name.with("not", Json::object([("enum", words)]))
                }
            }
        }
        Kind::Whole { min, max } => whole(min, max),
        Kind::Wholes { min, max, most } => Json::object([
            ("type", "array".into()),
            ("maxItems", most.into()),
            ("uniqueItems", Json::Flag(true)),
            ("items", whole(min.into(), max.into())),
        ]),
        Kind::Flag => Json::object([("type", "boolean".into())]),
        Kind::Numbers { .. } => {
            let tables = field.keyed.then(|| keys(numbers(field)));
            or_tables(numbers(field), tables.into_iter().collect())
        }
        Kind::Randomised { .. } => {
            let parts = field.randomised_fields();
            let mean = parts.first().map_or(Json::Null, numbers);
            let mut tables = vec![table(&parts)];
            if field.keyed {
                tables.push(keys(mean.clone()));
            }
            or_tables(mean, tables)
        }
        Kind::Choice(words) => words_of(words),
        Kind::Table(fields) => table(fields),
        Kind::Tables { fields, max } => {
            let least = usize::from(!matches!(field.presence, Presence::Default(_)));
            array(least, max, table(fields))
        }
        Kind::Variants(kinds) => variants(kinds),
        Kind::List {
            variants: kinds,
            max,
        } => array(0, max, variants(kinds)),
    }
}

fn words_of(words: &[&str]) -> Json {
    let words = Json::texts(words.iter().copied());
    Json::object([("type", "string".into()), ("enum", words)])
}

fn whole(min: i64, max: i64) -> Json {
    Json::object([
        ("type", "integer".into()),
        ("minimum", Json::Whole(min)),
        ("maximum", Json::Whole(max)),
    ])
}

fn array(least: usize, most: usize, items: Json) -> Json {
    Json::object([
        ("type", "array".into()),
        ("minItems", least.into()),
        ("maxItems", most.into()),
        ("items", items),
    ])
}

/// A [`Kind::Numbers`] without keys.
fn numbers(field: &Field) -> Json {
    let Kind::Numbers {
        count,
        limits,
        nonzero,
    } = field.kind
    else {
        return Json::Null;
    };
    let numbers = match count {
        1 => number(limits),
        _ => array(count, count, number(limits)),
    };
    if nonzero {
        let other = Json::object([("not", Json::object([("const", Json::Whole(0))]))]);
        numbers.with("contains", other)
    } else {
        numbers
    }
}

/// What is no table, or one of these tables. What is said of numbers and arrays does not touch
/// tables, nor the other way round, so all stand side by side: a number out of range is called
/// that, and not a value that is none of several things.
fn or_tables(plain: Json, tables: Vec<Json>) -> Json {
    let (Json::Object(mut entries), false) = (plain.clone(), tables.is_empty()) else {
        return plain;
    };
    if let Some((_, kind)) = entries.iter_mut().find(|(key, _)| key == "type") {
        *kind = Json::Array(vec![kind.clone(), "object".into()]);
    }
    let untyped = |table: Json| match table {
        Json::Object(entries) => entries
            .into_iter()
            .filter(|(key, _)| key != "type")
            .collect(),
        _ => Vec::new(),
    };
    let mut tables: Vec<_> = tables.into_iter().map(untyped).collect();
    match tables.len() {
        1 => entries.extend(tables.swap_remove(0)),
        _ => {
            let tables = tables.into_iter().map(Json::Object).collect();
            entries.push(("anyOf".to_owned(), Json::Array(tables)));
        }
    }
    Json::Object(entries)
}

fn number(Limits { min, max }: Limits) -> Json {
    Json::object([
        ("type", "number".into()),
        ("minimum", Json::Number(min)),
        ("maximum", Json::Number(max)),
    ])
}

/// A value by keys, each of them `[FRAME, VALUE]`.
fn keys(value: Json) -> Json {
    let pair = Json::object([
        ("type", "array".into()),
        ("minItems", 2.into()),
        ("maxItems", 2.into()),
        ("prefixItems", Json::Array(vec![number(KEY_FRAMES), value])),
    ]);
    let about = "[[FRAME, VALUE], ...], in ascending order of frames.";
    let keys = joined(
        Json::object([("title", "keys".into()), ("description", about.into())]),
        array(1, MOST_KEYS, pair),
    );
    let about = "How the value gets from key to key.";
    let interpolation = Json::object([
        ("title", "interpolation".into()),
        ("description", about.into()),
        ("default", INTERPOLATIONS[0].into()),
    ]);
    let interpolation = joined(interpolation, words_of(&INTERPOLATIONS));
    let properties = [("keys", keys), ("interpolation", interpolation)];
    let properties = properties.map(|(key, value)| (key.to_owned(), value));
    object(properties.into(), vec!["keys"])
}

/// A table that goes by its kind. The kinds stand before the tables too, so that a wrong one is
/// called that, and not a table that is none of them.
fn variants(kinds: &[Variant]) -> Json {
    let names: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
    let about = "What it is; its other keys go by this.";
    let kind = Json::object([("title", "kind".into()), ("description", about.into())]);
    let kind = joined(kind, words_of(&names));
    let tables = kinds.iter().map(|variant| {
        let kind = Json::object([
            ("title", "kind".into()),
            ("description", Json::Text(sentence(variant.about))),
            ("const", variant.name.into()),
        ]);
        let mut properties = vec![("kind".to_owned(), kind)];
        let fields = variant.fields.iter();
        properties.extend(fields.map(|field| (field.key.to_owned(), property(field))));
        let mut keys = vec!["kind"];
        keys.extend(required(variant.fields));
        let head = Json::object([
            ("title", variant.name.into()),
            ("description", Json::Text(sentence(variant.about))),
        ]);
        joined(head, object(properties, keys))
    });
    Json::object([
        ("type", "object".into()),
        ("required", Json::texts(["kind"])),
        ("properties", Json::object([("kind", kind)])),
        ("oneOf", Json::Array(tables.collect())),
    ])
}
