//! Reading one table of a scene file by its rows in the [`schema`](super::schema).
//!
//! A [`Reader`] refuses unknown keys when it opens a table; its `must` and `may` hand a key's
//! value, or its default, to one of the functions in [`values`](super::values).

use std::borrow::Cow;

use super::SceneError;
use super::error::{did_you_mean_one_of, shortened};
use super::expect::{example, expected, keys_in_words, several};
use super::schema::{self, Field, Kind, Limits, Presence};
use super::tracks;
use super::tree::{self, At, Entry, Node, Value};

/// A table whose keys are all known.
pub(super) struct Reader<'a> {
    path: String,
    fields: Cow<'a, [Field]>,
    node: &'a Node,
    /// The key whose value stands in place of the whole table, if one does.
    all: Option<&'static str>,
}

/// A value with its row in the schema and its path, such as `camera.position`.
pub(super) struct Spot<'a> {
    pub(super) path: String,
    pub(super) field: Field,
    pub(super) node: &'a Node,
}

impl<'a> Reader<'a> {
    /// Opens the table `node`, called `path` (empty for the whole file).
    pub(super) fn new(
        path: String,
        fields: impl Into<Cow<'a, [Field]>>,
        node: &'a Node,
    ) -> Result<Self, SceneError> {
        let fields = fields.into();
        let keys = || fields.iter().map(|field| field.key);
        let place = match path.as_str() {
            "" => "at the top of a scene".to_owned(),
            path => format!("in `{path}`"),
        };
        let Value::Table(entries) = &node.value else {
            let what = format!("`{path}` must be a table, found {}", node.describe());
            let once = match &node.value {
                Value::Array(items)
                    if items.iter().all(|it| matches!(it.value, Value::Table(_))) =>
                {
                    "one table, so its header has single brackets: "
                }
                _ => "",
            };
            let help = format!("{once}a table with {}", keys_in_words(&fields));
            return Err(node.at.error(what, help));
        };
        if let Some(Entry { key, at, .. }) = entries.iter().find(|e| !keys().any(|k| k == e.key)) {
            let guess = match outer_table(&path, key) {
                outer if !outer.is_empty() => outer,
                _ => did_you_mean_one_of(key, keys()) + &other_tables(key),
            };
            let help = format!("{guess}The table has {}", keys_in_words(&fields));
            let key = shortened(key);
            return Err(at.error(format!("there is no key `{key}` {place}"), help));
        }
        Ok(Self {
            path,
            fields,
            node,
            all: None,
        })
    }

    /// The error of all keys that must be written and are not, `key` among them.
    fn all_missing(&self, key: &str) -> SceneError {
        let is_missing = |field: &&Field| {
            matches!(field.presence, Presence::Required(_)) && !self.has(field.key)
        };
        let missing: Vec<&Field> = self.fields.iter().filter(is_missing).collect();
        if let Some(error) = missing.iter().find_map(|field| self.inside(field.key)) {
            return error;
        }
        match missing.as_slice() {
            [] | [_] => self.missing(key),
            [fields @ .., last] => {
                let list = |of: &dyn Fn(&Field) -> String| {
                    let first: Vec<String> = fields.iter().map(|field| of(field)).collect();
                    format!("{} and {}", first.join(", "), of(last))
                };
                let paths = list(&|field| format!("`{}`", self.path_of(field.key)));
                let help = format!("add {}", list(&example));
                self.node.at.error(format!("{paths} are missing"), help)
            }
        }
    }

    /// The error of a key that is missing here, and stands in a table inside below whose header it
    /// has been written.
    fn inside(&self, key: &str) -> Option<SceneError> {
        let Value::Table(entries) = &self.node.value else {
            return None;
        };
        for Entry {
            key: inner, node, ..
        } in entries
        {
            let path = self.path_of(inner);
            let tables = match &node.value {
                Value::Array(items) => {
                    let numbered = items.iter().enumerate();
                    let path = |(at, item)| (format!("{path}.{at}"), item);
                    numbered.map(path).collect()
                }
                _ => vec![(path, node)],
            };
            for (path, table) in tables {
                if let Some(entry) = table.entry(key) {
                    let what = format!("there is no key `{key}` in `{path}`");
                    return Some(entry.at.error(what, outer_table(&path, key)));
                }
            }
        }
        None
    }

    /// The same where the key's value is written in place of the table, so that it has its path.
    pub(super) fn all_is(self, key: &'static str) -> Self {
        let all = Some(key);
        Self { all, ..self }
    }

    /// Reads a key that has a value even if it is not written.
    pub(super) fn must<T>(
        &self,
        key: &str,
        read: impl FnOnce(&Spot<'_>) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        match self.may(key, read)? {
            Some(value) => Ok(value),
            None => Err(self.missing(key)),
        }
    }

    /// Reads a key; `None` if it is not written and has no default.
    pub(super) fn may<T>(
        &self,
        key: &str,
        read: impl FnOnce(&Spot<'_>) -> Result<T, SceneError>,
    ) -> Result<Option<T>, SceneError> {
        let field = *self.field(key);
        let path = self.path_of(key);
        if let Some(Entry { node, .. }) = self.node.entry(key) {
            if tracks::is_animated(node) && never_changes(&field, node) {
                let what = format!("`{path}` cannot change with the frame");
                let help = format!("one value for all frames: {}", expected(&field));
                return Err(node.at.error(what, help));
            }
            return read(&Spot { path, field, node }).map(Some);
        }
        let Presence::Default(text) = field.presence else {
            return match field.presence {
                Presence::Required(_) => Err(self.all_missing(key)),
                _ => Ok(None),
            };
        };
        let mut node = tree::snippet(text, &format!("the default of `{path}`"))?;
        if let Value::Table(_) = node.value {
            // Whatever is missing in a table that is not written is missing from this one.
            node.at = self.node.at.clone();
        }
        let node = &node;
        read(&Spot { path, field, node }).map(Some)
    }

    /// A key that may be missing elsewhere is needed here.
    pub(super) fn needs(mut self, key: &str) -> Self {
        let fields = self.fields.to_mut().iter_mut();
        for field in fields.filter(|field| field.key == key) {
            if let Presence::Optional(example) = field.presence {
                field.presence = Presence::Required(example);
            }
        }
        self
    }

    /// Whether the key is written.
    pub(super) fn has(&self, key: &str) -> bool {
        self.node.entry(key).is_some()
    }

    /// Whether a value of these keys, or one in its table, changes with the frame.
    pub(super) fn changes(&self, keys: &[&str]) -> bool {
        let entries = keys.iter().filter_map(|key| self.node.entry(key));
        entries
            .map(|entry| &entry.node)
            .any(|node| match &node.value {
                Value::Table(_) if tracks::is_animated(node) => true,
                Value::Table(parts) => parts.iter().any(|part| tracks::is_animated(&part.node)),
                _ => false,
            })
    }

    /// Whether the key is written, and is an array that is not empty.
    pub(super) fn has_items(&self, key: &str) -> bool {
        let entry = self.node.entry(key);
        entry.is_some_and(
            |entry| matches!(&entry.node.value, Value::Array(items) if !items.is_empty()),
        )
    }

    /// Where the key's value stands, or the table if it is not written.
    pub(super) fn at(&self, key: &str) -> &At {
        let entry = self.node.entry(key);
        entry.map_or(&self.node.at, |entry| &entry.node.at)
    }

    /// The key with the table's path before it.
    pub(super) fn path_of(&self, key: &str) -> String {
        match self.path.as_str() {
            "" => key.to_owned(),
            path if self.all == Some(key) => path.to_owned(),
            path => format!("{path}.{key}"),
        }
    }

    /// The table's own path; empty for the whole file.
    pub(super) fn path(&self) -> &str {
        &self.path
    }

    /// The error of a key that is not written.
    pub(super) fn missing(&self, key: &str) -> SceneError {
        self.missing_of(key, &[])
    }

    /// The error of a key that is not written, whose value is one of these names, if there are any.
    pub(super) fn missing_of(&self, key: &str, names: &[String]) -> SceneError {
        let field = self.field(key);
        let what = format!("`{}` is missing", self.path_of(field.key));
        let help = match names.first() {
            None => format!("add {}: {}", example(field), expected(field)),
            Some(name) => format!(
                "add `{key} = \"{name}\"`: {}; there are {}",
                expected(field),
                names.join(", ")
            ),
        };
        self.node.at.error(what, help)
    }

    fn field(&self, key: &str) -> &Field {
        let found = self.fields.iter().find(|field| field.key == key);
        found.expect("keys are asked for by the names in the schema")
    }
}

/// A hint if a key is right in a table around this one: TOML counts all lines below a table's
/// header to that table, so what is meant for an outer one must stand above it.
fn outer_table(path: &str, key: &str) -> String {
    let mut headers = schema::around(path);
    headers.retain(|(_, fields)| fields.iter().any(|field| field.key == key));
    match headers.last() {
        None => String::new(),
        Some((header, _)) => {
            let place = match header.as_str() {
                "" => "at the top of a scene".to_owned(),
                header => format!("in `{header}`"),
            };
            format!(
                "`{key}` is a key {place}: write it there, above the headers of the tables that \
                 follow, for what stands below a header belongs to it. "
            )
        }
    }
}

/// A hint where tables elsewhere have a key of just that name.
fn other_tables(key: &str) -> String {
    let headers = schema::tables_with(key);
    match headers.as_slice() {
        [] => String::new(),
        headers => format!("`{key}` is a key in `{}`. ", headers.join("`, `")),
    }
}

/// Whether a table with `keys` in it can only be meant as a value that changes, where none can.
fn never_changes(field: &Field, node: &Node) -> bool {
    match field.kind {
        Kind::Numbers { .. } | Kind::Randomised { .. } => false,
        Kind::Table(_) | Kind::Tables { .. } | Kind::List { .. } => false,
        Kind::Variants(_) => node.entry("kind").is_none(),
        Kind::Text { .. } | Kind::Name { .. } | Kind::Whole { .. } => true,
        Kind::Wholes { .. } | Kind::Flag | Kind::Choice(_) => true,
    }
}

impl Spot<'_> {
    /// The error of a value of another kind than the schema says.
    pub(super) fn wrong_kind(&self) -> SceneError {
        self.wrong_kind_of(self.node, &self.path)
    }

    /// The same of a part of it, with its own path.
    pub(super) fn wrong_kind_of(&self, node: &Node, path: &str) -> SceneError {
        let what = format!("`{path}` cannot be {}", node.describe());
        let help = match self.field.kind {
            Kind::Tables { .. } | Kind::List { .. } => several(&self.field),
            _ => format!("{}, as in {}", expected(&self.field), example(&self.field)),
        };
        node.at.error(what, help)
    }

    /// The error of a value of the right kind that is none the less not right.
    pub(super) fn refuse(&self, node: &Node, path: &str, why: &str) -> SceneError {
        let what = format!("`{path}` {why}");
        node.at.error(what, expected(&self.field))
    }

    /// A number and its place: this value, or the item `index` of it.
    pub(super) fn one(
        &self,
        node: &Node,
        index: Option<usize>,
        limits: Limits,
    ) -> Result<f32, SceneError> {
        let path = match index {
            Some(index) => format!("{}.{index}", self.path),
            None => self.path.clone(),
        };
        let value = match node.value {
            Value::Whole(whole) => whole as f64,
            Value::Number(number) => number,
            _ => return Err(self.wrong_kind_of(node, &path)),
        };
        if !value.is_finite() {
            return Err(self.refuse(node, &path, &format!("is {value}, not a finite number")));
        }
        if value < limits.min || value > limits.max {
            let why = format!("is out of range: {}", tree::plain(value));
            return Err(self.refuse(node, &path, &why));
        }
        Ok(value as f32)
    }
}
