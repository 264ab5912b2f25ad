//! One function for each kind of value: it checks what the [`schema`](super::schema) says.

use super::error::{did_you_mean, shortened};
use super::expect::expected;
use super::read::{Reader, Spot};
use super::schema::{Field, Kind, MOST_NAME_CHARS, Presence, Variant};
use super::tracks;
use super::tree::{Entry, Value};
use super::{Changing, SceneError, Spread};

/// Whether a whole number of that value would do.
fn is_within(number: f64, spot: &Spot<'_>) -> bool {
    match spot.field.kind {
        Kind::Whole { min, max } => {
            (min as f64..=max as f64).contains(&number) && number.abs() < 9e15
        }
        _ => false,
    }
}

/// Reads [`Kind::Whole`].
pub(super) fn whole(spot: &Spot<'_>) -> Result<u64, SceneError> {
    let (Kind::Whole { min, max }, Value::Whole(value)) = (spot.field.kind, &spot.node.value)
    else {
        return Err(match spot.node.value {
            Value::Number(number) if number.fract() == 0.0 && is_within(number, spot) => {
                let what = format!("`{}` cannot be {}", spot.path, spot.node.describe());
                let plainly = format!("write {number:.0}, without a point or an exponent");
                let help = format!("{plainly}: {}", expected(&spot.field));
                spot.node.at.error(what, help)
            }
            _ => spot.wrong_kind(),
        });
    };
    if !(min..=max).contains(value) {
        return Err(spot.refuse(spot.node, &spot.path, &format!("is out of range: {value}")));
    }
    Ok(value.unsigned_abs())
}

/// Reads [`Kind::Whole`] with a range inside that of u32.
pub(super) fn whole32(spot: &Spot<'_>) -> Result<u32, SceneError> {
    let value = u32::try_from(whole(spot)?);
    value.map_err(|_| spot.refuse(spot.node, &spot.path, "is too large"))
}

/// What [`Kind::Numbers`] can be read as.
pub(super) trait Quantity: Sized {
    /// Reads the value at a spot whose field is of [`Kind::Numbers`].
    fn read(spot: &Spot<'_>) -> Result<Self, SceneError>;
}

impl Quantity for f32 {
    fn read(spot: &Spot<'_>) -> Result<Self, SceneError> {
        let Kind::Numbers { limits, .. } = spot.field.kind else {
            return Err(spot.wrong_kind());
        };
        first_key(spot, |spot| spot.one(spot.node, None, limits))
    }
}

/// The value, or that of its first key if it changes with the frame; all keys are read.
fn first_key<T>(
    spot: &Spot<'_>,
    read: impl Fn(&Spot<'_>) -> Result<T, SceneError>,
) -> Result<T, SceneError> {
    if !tracks::is_animated(spot.node) {
        return read(spot);
    }
    let Spot { path, field, node } = spot;
    let pairs = tracks::pairs(node, path)?.into_iter().enumerate();
    let values = pairs.map(|(at, (_, node))| {
        let path = format!("{path}.keys.{at}.1");
        let field = *field;
        read(&Spot { path, field, node })
    });
    let mut values = values.collect::<Result<Vec<T>, _>>()?;
    Ok(values.swap_remove(0))
}

impl<const N: usize> Quantity for [f32; N] {
    fn read(spot: &Spot<'_>) -> Result<Self, SceneError> {
        let Kind::Numbers { limits, .. } = spot.field.kind else {
            return Err(spot.wrong_kind());
        };
        first_key(spot, |spot| {
            let Value::Array(items) = &spot.node.value else {
                return Err(spot.wrong_kind());
            };
            if items.len() != N {
                return Err(spot.wrong_kind());
            }
            let mut numbers = [0.0; N];
            for (i, (number, item)) in numbers.iter_mut().zip(items).enumerate() {
                *number = spot.one(item, Some(i), limits)?;
            }
            Ok(numbers)
        })
    }
}

/// Reads [`Kind::Randomised`] without a rate.
pub(super) fn spread<T: Quantity>(spot: &Spot<'_>) -> Result<Spread<T>, SceneError> {
    randomised(spot, |table| {
        let (mean, var) = (table.must("mean", T::read)?, table.must("var", T::read)?);
        Ok(Spread { mean, var })
    })
}

/// Reads [`Kind::Randomised`] with a rate.
pub(super) fn changing<T: Quantity>(spot: &Spot<'_>) -> Result<Changing<T>, SceneError> {
    randomised(spot, |table| {
        let (mean, var) = (table.must("mean", T::read)?, table.must("var", T::read)?);
        let initial = Spread { mean, var };
        Ok(Changing {
            initial,
            rate: table.must("rate", T::read)?,
            rate_var: table.must("rate_var", T::read)?,
        })
    })
}

fn randomised<R>(
    spot: &Spot<'_>,
    read: impl FnOnce(&Reader<'_>) -> Result<R, SceneError>,
) -> Result<R, SceneError> {
    let Spot { path, field, node } = spot;
    let Kind::Randomised { count, .. } = field.kind else {
        return Err(spot.wrong_kind());
    };
    let fields = field.randomised_fields();
    let is_mean = match &node.value {
        Value::Table(_) if tracks::is_animated(node) => true,
        Value::Table(_) => return read(&Reader::new(path.clone(), fields, node)?),
        Value::Whole(_) | Value::Number(_) => count == 1,
        Value::Array(items) => count == items.len() && count > 1,
        _ => false,
    };
    if !is_mean {
        return Err(spot.wrong_kind());
    }
    let node = node.as_only_entry("mean");
    read(&Reader::new(path.clone(), fields, &node)?.all_is("mean"))
}

/// Reads [`Kind::Wholes`].
pub(super) fn wholes(spot: &Spot<'_>) -> Result<Vec<i32>, SceneError> {
    let (Kind::Wholes { min, max, most }, Value::Array(items)) =
        (spot.field.kind, &spot.node.value)
    else {
        return Err(spot.wrong_kind());
    };
    if items.len() > most {
        return Err(spot.refuse(spot.node, &spot.path, "has too many numbers"));
    }
    let mut wholes = Vec::new();
    for (at, item) in items.iter().enumerate() {
        let path = format!("{}.{at}", spot.path);
        let Value::Whole(value) = item.value else {
            return Err(spot.wrong_kind_of(item, &path));
        };
        if !(i64::from(min)..=i64::from(max)).contains(&value) {
            return Err(spot.refuse(item, &path, &format!("is out of range: {value}")));
        }
        let value = value as i32;
        if wholes.last().is_some_and(|last| *last >= value) {
            return Err(spot.refuse(item, &path, "is not greater than the one before"));
        }
        wholes.push(value);
    }
    Ok(wholes)
}

/// Reads [`Kind::Whole`] with a range inside that of i32.
pub(super) fn signed32(spot: &Spot<'_>) -> Result<i32, SceneError> {
    let (Kind::Whole { min, max }, Value::Whole(value)) = (spot.field.kind, &spot.node.value)
    else {
        return Err(spot.wrong_kind());
    };
    if !(min..=max).contains(value) {
        return Err(spot.refuse(spot.node, &spot.path, &format!("is out of range: {value}")));
    }
    i32::try_from(*value).map_err(|_| spot.refuse(spot.node, &spot.path, "is too large"))
}

/// Reads [`Kind::Flag`].
pub(super) fn flag(spot: &Spot<'_>) -> Result<bool, SceneError> {
    match spot.node.value {
        Value::Flag(flag) => Ok(flag),
        _ => Err(spot.wrong_kind()),
    }
}

/// Reads [`Kind::Tables`] or [`Kind::List`]: each table by `read`, which gets its index and spot.
pub(super) fn list<T>(
    spot: &Spot<'_>,
    read: impl Fn(usize, &Spot<'_>) -> Result<T, SceneError>,
) -> Result<Vec<T>, SceneError> {
    let (most, kind) = match spot.field.kind {
        Kind::Tables { max, .. } => (max, spot.field.kind),
        Kind::List { variants, max } => (max, Kind::Variants(variants)),
        _ => return Err(spot.wrong_kind()),
    };
    let Value::Array(nodes) = &spot.node.value else {
        return Err(spot.wrong_kind());
    };
    if nodes.len() > most {
        return Err(spot.wrong_kind());
    }
    let one = |(at, node)| {
        let path = format!("{}.{at}", spot.path);
        let field = Field { kind, ..spot.field };
        read(at, &Spot { path, field, node })
    };
    nodes.iter().enumerate().map(one).collect()
}

/// Reads [`Kind::Choice`]: the position of the word among the choices.
pub(super) fn choice(spot: &Spot<'_>) -> Result<usize, SceneError> {
    let (Kind::Choice(words), Some(given)) = (spot.field.kind, spot.node.text()) else {
        return Err(spot.wrong_kind());
    };
    one_of(given, words, spot)
}

/// Reads [`Kind::Variants`]: which variant, and its table.
pub(super) fn variant<'a>(spot: &Spot<'a>) -> Result<(&'static str, Reader<'a>), SceneError> {
    let (Kind::Variants(variants), Value::Table(_)) = (spot.field.kind, &spot.node.value) else {
        return Err(spot.wrong_kind());
    };
    let names: Vec<&'static str> = variants.iter().map(|variant| variant.name).collect();
    let path = format!("{}.kind", spot.path);
    let Some(Entry { node, .. }) = spot.node.entry("kind") else {
        let what = format!("`{path}` is missing");
        return Err(spot.node.at.error(what, expected(&spot.field)));
    };
    let field = spot.field;
    let kind_spot = Spot { path, field, node };
    let given = node.text().ok_or_else(|| kind_spot.wrong_kind())?;
    let Variant { name, fields, .. } = variants[one_of(given, &names, &kind_spot)?];
    // Only its key matters: its value has just been read.
    let kind = Field {
        key: "kind",
        kind: Kind::Choice(&[]),
        presence: Presence::Required(""),
        ..field
    };
    let fields = [&[kind], fields].concat();
    Ok((name, Reader::new(spot.path.clone(), fields, spot.node)?))
}

fn one_of(given: &str, words: &[&'static str], spot: &Spot<'_>) -> Result<usize, SceneError> {
    words.iter().position(|&word| word == given).ok_or_else(|| {
        let guess = did_you_mean(given, words.iter().copied());
        let given = shortened(given);
        let what = format!("`{}` cannot be \"{given}\"", spot.path);
        spot.node.at.error(what, guess + &expected(&spot.field))
    })
}

/// Reads [`Kind::Text`] and [`Kind::Name`].
pub(super) fn text(spot: &Spot<'_>) -> Result<String, SceneError> {
    let Some(text) = spot.node.text() else {
        return Err(spot.wrong_kind());
    };
    let refuse = |why: &str| Err(spot.refuse(spot.node, &spot.path, why));
    let (max_chars, lines) = match spot.field.kind {
        Kind::Text { max_chars, lines } => (max_chars, lines),
        _ => (MOST_NAME_CHARS, false),
    };
    if text.chars().count() > max_chars {
        return refuse("is too long");
    }
    if text
        .chars()
        .any(|c| c.is_control() && !(lines && c == '\n'))
    {
        return refuse("has a line break or a control character in it");
    }
    if let Kind::Name { reserved } = spot.field.kind
        && (!super::check::is_name(text) || reserved.contains(&text))
    {
        return refuse(&format!("cannot be \"{text}\""));
    }
    Ok(text.to_owned())
}
