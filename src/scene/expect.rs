//! What would be right for a key, in words, from its row in the [`schema`](super::schema).

use super::schema::{Field, Kind, Limits, MOST_NAME_CHARS, Presence, Variant, parent_of};

/// Keys that a message lists, at most: more are not read to their end.
const MOST_KEYS: usize = 14;

/// The key with a value that is right: `near = 0.1`.
pub(super) fn example(field: &Field) -> String {
    match field.kind {
        Kind::Tables { .. } | Kind::List { .. } => {
            let parent = parent_of(field.key).map_or(String::new(), |parent| format!("{parent}."));
            format!("`[[{parent}{}]]`", field.key)
        }
        _ => format!("`{} = {}`", field.key, field.sample()),
    }
}

/// What the key is and what its value may be: "`near` (nothing nearer is drawn) is a number from
/// 0.000001 to 1_000_000, world units".
pub(super) fn expected(field: &Field) -> String {
    let Field {
        key,
        kind,
        unit,
        about,
        presence,
        ..
    } = field;
    let unit = match *unit {
        "" => String::new(),
        unit => format!(", {unit}"),
    };
    let words = match (kind, presence) {
        (Kind::Tables { fields, max }, Presence::Required(_) | Presence::Optional(_)) => {
            let max = digits(*max as f64);
            format!("1 to {max} tables with {}", keys_in_words(fields))
        }
        _ => kind_in_words(kind),
    };
    format!("`{key}` ({about}) is {words}{unit}")
}

/// How many tables there may be, and how they are written.
pub(super) fn several(field: &Field) -> String {
    let most = match field.kind {
        Kind::Tables { max, .. } | Kind::List { max, .. } => max,
        _ => 1,
    };
    let count = match field.presence {
        Presence::Required(_) | Presence::Optional(_) => "1 to",
        _ => "at most",
    };
    let (key, about, header) = (field.key, field.about, example(field));
    format!(
        "`{key}` ({about}) is {count} {most} tables, each under a header {header} in double brackets"
    )
}

pub(super) fn kind_in_words(kind: &Kind) -> String {
    match *kind {
        Kind::Text { max_chars, lines } => {
            let lines = if lines { "" } else { " in one line" };
            format!(
                "text in quotes of at most {} characters{lines}",
                digits(max_chars as f64)
            )
        }
        Kind::Name { reserved } => {
            let but = match reserved {
                [] => String::new(),
                _ => format!(", but not {}", quoted(reserved)),
            };
            format!(
                "text in quotes: a letter or _, then letters, digits, - and _, at most \
                 {MOST_NAME_CHARS} characters{but}"
            )
        }
        Kind::Whole { min, max } => format!("a whole number {}", range(min as f64, max as f64)),
        Kind::Wholes { min, max, most } => format!(
            "an array of at most {} whole numbers in ascending order, each {}",
            digits(most as f64),
            range(f64::from(min), f64::from(max))
        ),
        Kind::Flag => "true or false".to_owned(),
        Kind::Numbers {
            count,
            limits,
            nonzero,
        } => {
            let but = if nonzero { ", not all 0" } else { "" };
            numbers(count, limits) + but
        }
        Kind::Randomised {
            count,
            mean,
            var,
            rate,
        } => {
            let mean = numbers(count, mean);
            let var = range(var.min, var.max);
            let (key, rate) = match rate {
                Some(rate) => (
                    ", rate, rate_var",
                    format!(", rate {}", range(rate.min, rate.max)),
                ),
                None => ("", String::new()),
            };
            format!("{{ mean, var{key} }}, mean {mean}, var {var}{rate}; or the mean alone")
        }
        Kind::Choice(words) => format!("one of {}", quoted(words)),
        Kind::Table(fields) => format!("a table with {}", keys_in_words(fields)),
        Kind::Tables { fields, max } => {
            format!(
                "at most {} tables with {}",
                digits(max as f64),
                keys_in_words(fields)
            )
        }
        Kind::Variants(variants) => format!("one of {}", kinds(variants)),
        Kind::List { variants, max } => format!(
            "at most {} tables, each one of {}",
            digits(max as f64),
            kinds(variants)
        ),
    }
}

fn kinds(variants: &[Variant]) -> String {
    let shapes = variants.iter().map(|variant| {
        let name = variant.name;
        match variant.fields {
            [] => format!("{{ kind = \"{name}\" }}"),
            fields => format!("{{ kind = \"{name}\", {} }}", keys(fields)),
        }
    });
    shapes.collect::<Vec<_>>().join(", ")
}

fn numbers(count: usize, limits: Limits) -> String {
    let range = range(limits.min, limits.max);
    match count {
        1 => format!("a number {range}"),
        _ => format!("an array of {count} numbers, each {range}"),
    }
}

pub(super) fn range(min: f64, max: f64) -> String {
    format!("from {} to {}", digits(min), digits(max))
}

/// Which keys a table has: their names, or where they are listed if they are many.
pub(super) fn keys_in_words(fields: &[Field]) -> String {
    match fields.len() {
        0..=MOST_KEYS => format!("the keys {}", keys(fields)),
        _ => "keys that `motes schema --markdown` lists".to_owned(),
    }
}

fn keys(fields: &[Field]) -> String {
    let keys: Vec<_> = fields.iter().map(|field| field.key).collect();
    keys.join(", ")
}

pub(super) fn quoted(words: &[&str]) -> String {
    let words: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
    words.join(", ")
}

/// A number as TOML has it, with `_` between thousands.
pub(super) fn digits(number: f64) -> String {
    if number == i64::MAX as f64 {
        return i64::MAX.to_string();
    }
    let plain = number.to_string();
    let (sign, unsigned) = match plain.strip_prefix('-') {
        Some(unsigned) => ("-", unsigned),
        None => ("", plain.as_str()),
    };
    let (whole, fraction) = match unsigned.split_once('.') {
        Some((whole, fraction)) => (whole, format!(".{fraction}")),
        None => (unsigned, String::new()),
    };
    let mut grouped = String::new();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && whole.len() >= 5 && (whole.len() - i).is_multiple_of(3) {
            grouped.push('_');
        }
        grouped.push(digit);
    }
    format!("{sign}{grouped}{fraction}")
}
