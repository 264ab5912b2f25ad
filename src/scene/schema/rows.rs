//! What the tables are written with: one function a kind of row, one a kind of value.

use super::{Field, Kind, Limits, Presence};

pub(super) const PLACE: Kind = numbers(3, -1e6, 1e6);
pub(super) const DIRECTION: Kind = Kind::Numbers {
    count: 3,
    limits: limits((-1e6, 1e6)),
    nonzero: true,
};

pub(super) const fn text(max_chars: usize, lines: bool) -> Kind {
    Kind::Text { max_chars, lines }
}

pub(super) const fn whole(min: i64, max: i64) -> Kind {
    Kind::Whole { min, max }
}

const fn limits((min, max): (f64, f64)) -> Limits {
    Limits { min, max }
}

pub(super) const fn numbers(count: usize, min: f64, max: f64) -> Kind {
    Kind::Numbers {
        count,
        limits: limits((min, max)),
        nonzero: false,
    }
}

pub(super) const fn spread(mean: (f64, f64), var: (f64, f64)) -> Kind {
    Kind::Randomised {
        count: 1,
        mean: limits(mean),
        var: limits(var),
        rate: None,
    }
}

pub(super) const fn changing(count: usize, mean: (f64, f64), most: f64) -> Kind {
    Kind::Randomised {
        count,
        mean: limits(mean),
        var: limits((0.0, most)),
        rate: Some(limits((-most, most))),
    }
}

type Str = &'static str;

/// The row of a key that must be written.
pub(super) const fn required(
    key: Str,
    kind: Kind,
    example: Str,
    unit: Str,
    about: Str,
    source: Str,
) -> Field {
    Field {
        key,
        kind,
        presence: Presence::Required(example),
        unit,
        about,
        source,
        keyed: false,
    }
}

/// The row of a key that nothing stands for if it is not written.
pub(super) const fn optional(
    key: Str,
    kind: Kind,
    example: Str,
    unit: Str,
    about: Str,
    source: Str,
) -> Field {
    let presence = Presence::Optional(example);
    Field {
        presence,
        ..required(key, kind, example, unit, about, source)
    }
}

/// The row of a key with a default.
pub(super) const fn default(
    key: Str,
    kind: Kind,
    value: Str,
    unit: Str,
    about: Str,
    source: Str,
) -> Field {
    let presence = Presence::Default(value);
    Field {
        presence,
        ..required(key, kind, value, unit, about, source)
    }
}

/// The same row of a key whose value may change with the frame.
pub(super) const fn keyed(row: Field) -> Field {
    Field { keyed: true, ..row }
}
