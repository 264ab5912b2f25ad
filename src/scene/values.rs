//! One function for each kind of value: it checks what the [`schema`](super::schema) says.

use super::error::{did_you_mean, shortened};
use super::expect::expected;
use super::read::{Reader, Spot};
use super::schema::{Field, Kind, Variant};
use super::tree::{Entry, Value};
use super::{Changing, SceneError, Spread};

/// Reads [`Kind::Whole`].
pub(super) fn whole(spot: &Spot<'_>) -> Result<u64, SceneError> {
    let (Kind::Whole { min, max }, Value::Whole(value)) = (spot.field.kind, &spot.node.value)
    else {
        return Err(spot.wrong_kind());
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
        spot.one(spot.node, None, limits)
    }
}

impl<const N: usize> Quantity for [f32; N] {
    fn read(spot: &Spot<'_>) -> Result<Self, SceneError> {
        let (Kind::Numbers { limits, .. }, Value::Array(items)) =
            (spot.field.kind, &spot.node.value)
        else {
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
        let rate = table.must("rate", T::read)?;
        let initial = Spread { mean, var };
        Ok(Changing { initial, rate })
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
        Value::Table(_) => return read(&Reader::new(path.clone(), fields, node)?),
        Value::Whole(_) | Value::Number(_) => count == 1,
        Value::Array(items) => count == items.len() && count > 1,
        _ => false,
    };
    if !is_mean {
        return Err(spot.wrong_kind());
    }
    let node = node.as_only_entry("mean");
    read(&Reader::new(path.clone(), fields, &node)?)
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
    let Variant { name, fields } = variants[one_of(given, &names, &kind_spot)?];
    // Only its key matters: its value has just been read.
    let kind = Field {
        key: "kind",
        kind: Kind::Choice(&[]),
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
        _ => (64, false),
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
    if matches!(spot.field.kind, Kind::Name) && !super::check::is_name(text) {
        return refuse(&format!("cannot be \"{text}\""));
    }
    Ok(text.to_owned())
}
