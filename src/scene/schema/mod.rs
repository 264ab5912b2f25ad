//! Every key of a scene file, once: kind, range, unit, default and what it means.
//!
//! The reader takes its rules from these tables, so what they say is what is enforced. A key is
//! written `--set`-style: `image.width`, `system.0.speed.mean`.

mod fires;
mod flocks;
mod json;
mod keys;
mod kinds;
mod markdown;
mod rows;
mod spread;

pub use fires::{FIRE, FLAME, PROFILE, RAMP, ROOTS};
pub use flocks::{EDGES, FLOCK, GOAL, OBSTACLES, REGION, RELATIONS};
pub use json::json_schema;
pub use keys::{
    BURST, CAMERA, GROUND, IMAGE, INHERIT, LAMP, LAYER, LIGHT, PILLAR, PLANET, SCENE, SURFACE,
    SYSTEM,
};
pub use kinds::{EXTINCTIONS, GENERATION_SHAPES, WINDS};
pub use markdown::reference_page;
pub use spread::{CHAR, FORMULA, GRAIN, IGNITION, LINE, MATERIAL, SMOKE, SPREAD};

/// One key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// As written in the file.
    pub key: &'static str,
    /// What its value must be.
    pub kind: Kind,
    /// Whether it must be written, and what holds if it is not.
    pub presence: Presence,
    /// Unit of its numbers; empty if they have none.
    pub unit: &'static str,
    /// What it does, as a clause without a full stop.
    pub about: &'static str,
    /// Paper and section that it comes from, such as `Reeves 2.1` (1983) or `Perry 3.2.3` (1994);
    /// empty if it is from neither.
    pub source: &'static str,
    /// Whether its value, or each part of a [`Kind::Randomised`], may change with the frame:
    /// `{ keys = [[FRAME, VALUE], ...], interpolation = "linear" }`.
    pub keyed: bool,
}

/// Frames that a key may stand at.
pub const KEY_FRAMES: Limits = Limits {
    min: -65_000.0,
    max: 1e6,
};

/// Keys of one value at most.
pub const MOST_KEYS: usize = 1000;

/// How a value may get from one key to the next; the first is the default.
pub const INTERPOLATIONS: [&str; 3] = ["linear", "smooth", "step"];

/// Most characters of a [`Kind::Name`].
pub const MOST_NAME_CHARS: usize = 64;

/// Whether a key must be written. Each variant holds a value in TOML syntax.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// It must; an example.
    Required(&'static str),
    /// It need not, and then nothing holds in its place; an example.
    Optional(&'static str),
    /// It need not, and then this value holds.
    Default(&'static str),
}

/// An interval that holds both of its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The least value.
    pub min: f64,
    /// The greatest value.
    pub max: f64,
}

/// What a value must be.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Text of at most `max_chars` characters; `lines` says whether it may have more than one.
    Text {
        /// Most characters.
        max_chars: usize,
        /// Whether line breaks are allowed.
        lines: bool,
    },
    /// Text that can stand in a path and in a file name: a letter or `_`, then letters, digits,
    /// `-` and `_`, at most [`MOST_NAME_CHARS`] characters.
    Name {
        /// Names that it cannot be.
        reserved: &'static [&'static str],
    },
    /// A whole number.
    Whole {
        /// The least value.
        min: i64,
        /// The greatest value.
        max: i64,
    },
    /// An array of whole numbers in ascending order.
    Wholes {
        /// The least value.
        min: i32,
        /// The greatest value.
        max: i32,
        /// Most of them.
        most: usize,
    },
    /// `true` or `false`.
    Flag,
    /// A finite number if `count` is 1, else an array of that many.
    Numbers {
        /// How many.
        count: usize,
        /// What each may be.
        limits: Limits,
        /// Whether they may not all be 0, since they are a direction.
        nonzero: bool,
    },
    /// A table of `mean`, `var` (a half-width, by default 0) and, if `rate` is some, `rate` and
    /// `rate_var` (by default 0); or the mean alone. Each is a number if `count` is 1, else an array.
    Randomised {
        /// How many numbers each of mean, var and rate is.
        count: usize,
        /// What a mean may be.
        mean: Limits,
        /// What a half-width may be.
        var: Limits,
        /// What a change a frame may be.
        rate: Option<Limits>,
    },
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A table with these keys.
    Table(&'static [Field]),
    /// An array of such tables, `max` of them at most.
    Tables {
        /// Keys of each.
        fields: &'static [Field],
        /// Most tables.
        max: usize,
    },
    /// A table whose key `kind` says which keys it has besides.
    Variants(&'static [Variant]),
    /// An array of such tables, 0 ..= `max` of them.
    List {
        /// What each can be.
        variants: &'static [Variant],
        /// Most tables.
        max: usize,
    },
}

/// One choice of a [`Kind::Variants`].
#[derive(Clone, Copy, Debug)]
pub struct Variant {
    /// The word that `kind` has.
    pub name: &'static str,
    /// What it is, as a clause without a full stop.
    pub about: &'static str,
    /// The other keys of the table.
    pub fields: &'static [Field],
}

impl Field {
    /// A value in TOML syntax that is right for this key: its default or an example.
    #[must_use]
    pub fn sample(&self) -> &'static str {
        match self.presence {
            Presence::Required(toml) | Presence::Optional(toml) | Presence::Default(toml) => toml,
        }
    }

    /// The keys of a [`Kind::Randomised`]'s table: mean, var and perhaps rate and rate_var. Else empty.
    #[must_use]
    pub fn randomised_fields(&self) -> Vec<Field> {
        let Kind::Randomised {
            count,
            mean,
            var,
            rate,
        } = self.kind
        else {
            return Vec::new();
        };
        let zero = ["0", "[0, 0]", "[0, 0, 0]"][count.clamp(1, 3) - 1];
        let example = ["1", "[1, 1]", "[1, 1, 1]"][count.clamp(1, 3) - 1];
        let field = |key, limits, presence, about| Field {
            key,
            kind: Kind::Numbers {
                count,
                limits,
                nonzero: false,
            },
            presence,
            about,
            ..*self
        };
        // Where the whole has a default, its mean has.
        let required = match self.presence {
            Presence::Default(toml) => Presence::Default(default_mean(toml)),
            _ => Presence::Required(example),
        };
        let default = Presence::Default(zero);
        let mut fields = vec![
            field("mean", mean, required, "the middle of the range"),
            field("var", var, default, "half the width of the range"),
        ];
        if let Some(rate) = rate {
            let limits = Limits { min: 0.0, ..rate };
            let about = "half the width of the range of single particles' rates";
            fields.push(field("rate", rate, default, "what each frame adds"));
            fields.push(field("rate_var", limits, default, about));
        }
        fields
    }
}

/// The mean of a default in the form `{ mean = 0 }`, or of the mean alone.
fn default_mean(toml: &'static str) -> &'static str {
    let inner = toml.strip_prefix("{ mean = ");
    inner
        .and_then(|inner| inner.strip_suffix(" }"))
        .unwrap_or(toml)
}

/// The list of tables that tables of this key stand in, if not in the file itself.
pub(in crate::scene) fn parent_of(key: &str) -> Option<&'static str> {
    let is_it = |field: &Field| {
        let is_table = matches!(
            field.kind,
            Kind::Table(_) | Kind::Tables { .. } | Kind::List { .. }
        );
        is_table && field.key == key
    };
    let has = |fields: &[Field]| fields.iter().any(is_it);
    [
        ("system", SYSTEM),
        ("flock", FLOCK),
        ("fire", FIRE),
        ("fire.spread", SPREAD),
    ]
    .into_iter()
    .find_map(|(parent, fields)| has(fields).then_some(parent))
}

/// The tables around the one with this path, such as `system.jet.speed`, from the outermost on:
/// each with its header, which is empty for the whole file.
pub(super) fn around(path: &str) -> Vec<(String, &'static [Field])> {
    let mut tables = Vec::new();
    let mut fields = SCENE;
    let mut header = String::new();
    let mut parts = path.split('.');
    while let Some(part) = parts.next() {
        tables.push((header.clone(), fields));
        let Some(field) = fields.iter().find(|field| field.key == part) else {
            break;
        };
        let name = header.trim_matches(['[', ']']);
        let dot = if name.is_empty() { "" } else { "." };
        let path = format!("{name}{dot}{part}");
        (fields, header) = match field.kind {
            Kind::Table(fields) => (fields, format!("[{path}]")),
            Kind::Tables { fields, .. } => {
                // Its name or its index.
                parts.next();
                (fields, format!("[[{path}]]"))
            }
            _ => break,
        };
    }
    tables
}

/// The headers of all tables that have such a key, outer ones first.
pub(super) fn tables_with(key: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut below = vec![(String::new(), SCENE)];
    while !below.is_empty() {
        let mut next = Vec::new();
        for (path, fields) in below {
            for field in fields {
                let path = match path.as_str() {
                    "" => field.key.to_owned(),
                    path => format!("{path}.{}", field.key),
                };
                let (header, fields) = match field.kind {
                    Kind::Table(fields) => (format!("[{path}]"), fields),
                    Kind::Tables { fields, .. } => (format!("[[{path}]]"), fields),
                    _ => continue,
                };
                if fields.iter().any(|field| field.key == key) {
                    found.push(header);
                }
                next.push((path, fields));
            }
        }
        below = next;
    }
    found
}
