//! TOML as a tree whose every key and value knows where it was written.

use std::ops::Range;
use std::rc::Rc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::SceneError;
use crate::json::{Json, quoted};

/// Tables and arrays inside each other, at most. The deepest value of a scene lies at 8.
const MAX_DEPTH: usize = 16;

/// A text that values come from.
#[derive(Debug)]
pub(super) struct Source {
    /// What errors call it.
    pub(super) file: String,
    /// All of it.
    pub(super) text: String,
    /// The line of the file that it begins on; `None` for what is no file's.
    pub(super) first_line: Option<usize>,
}

/// A place in a [`Source`].
#[derive(Clone, Debug)]
pub(super) struct At {
    pub(super) source: Rc<Source>,
    /// Bytes of the source's text.
    pub(super) span: Range<usize>,
}

/// A value and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) at: At,
    pub(super) value: Value,
}

/// A key, where it stands, and its value.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) at: At,
    pub(super) node: Node,
}

/// What TOML can say, as far as a scene has use for it.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Text(String),
    Whole(i64),
    Number(f64),
    Flag(bool),
    Date,
    Array(Vec<Node>),
    Table(Vec<Entry>),
}

impl At {
    /// An error about this place.
    pub(super) fn error(&self, what: impl Into<String>, help: impl Into<String>) -> SceneError {
        let Source {
            file,
            text,
            first_line,
        } = &*self.source;
        SceneError::located(what, (file, text, *first_line), self.span.clone(), help)
    }

    /// The place as errors name it: file, line and column.
    pub(super) fn shown(&self) -> String {
        self.error("", "").location()
    }

    /// The line that this place is on, from 1.
    pub(super) fn line(&self) -> usize {
        let before = self.source.text.bytes().take(self.span.start);
        before.filter(|&byte| byte == b'\n').count() + 1
    }
}

impl Node {
    /// The text if this is one.
    pub(super) fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The entry of a table with this key.
    pub(super) fn entry(&self, key: &str) -> Option<&Entry> {
        match &self.value {
            Value::Table(entries) => entries.iter().find(|entry| entry.key == key),
            _ => None,
        }
    }

    /// A table, where this stands, with this as its only entry.
    pub(super) fn as_only_entry(&self, key: &str) -> Self {
        let entry = Entry {
            key: key.to_owned(),
            at: self.at.clone(),
            node: self.clone(),
        };
        Self {
            at: self.at.clone(),
            value: Value::Table(vec![entry]),
        }
    }

    /// What this is, for "found …".
    pub(super) fn describe(&self) -> String {
        match &self.value {
            Value::Text(_) => "text".into(),
            Value::Whole(number) => format!("the whole number {number}"),
            Value::Number(number) => format!("the number {}", plain(*number)),
            Value::Flag(flag) => format!("{flag}"),
            Value::Date => "a date".into(),
            Value::Array(items) => format!("an array of {}", items.len()),
            Value::Table(_) => "a table".into(),
        }
    }
}

impl Value {
    /// The same in JSON; dates are null, as nothing takes one.
    pub(super) fn json(&self) -> Json {
        match self {
            Self::Text(text) => Json::from(text.as_str()),
            Self::Whole(whole) => Json::Whole(*whole),
            Self::Number(number) => Json::Number(*number),
            Self::Flag(flag) => Json::Flag(*flag),
            Self::Date => Json::Null,
            Self::Array(items) => Json::Array(items.iter().map(|item| item.value.json()).collect()),
            Self::Table(entries) => {
                let entry = |entry: &Entry| (entry.key.clone(), entry.node.value.json());
                Json::Object(as_written(entries).into_iter().map(entry).collect())
            }
        }
    }

    /// The same in TOML, on one line.
    pub(super) fn toml(&self) -> String {
        match self {
            Self::Text(text) => quoted(text),
            Self::Whole(whole) => whole.to_string(),
            Self::Number(number) => plain(*number),
            Self::Flag(flag) => flag.to_string(),
            Self::Date => "a date".into(),
            Self::Array(items) => {
                let items: Vec<String> = items.iter().map(|item| item.value.toml()).collect();
                format!("[{}]", items.join(", "))
            }
            Self::Table(entries) => {
                let entry = |entry: &Entry| format!("{} = {}", entry.key, entry.node.value.toml());
                let entries = as_written(entries).into_iter().map(entry);
                format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
            }
        }
    }
}

/// Entries in the order of the text, and not by name.
fn as_written(entries: &[Entry]) -> Vec<&Entry> {
    let mut entries: Vec<&Entry> = entries.iter().collect();
    entries.sort_by_key(|entry| entry.at.span.start);
    entries
}

/// The value that a piece of TOML is.
pub(super) fn snippet(toml: &str, called: &str) -> Result<Node, SceneError> {
    let source = Source {
        file: called.to_owned(),
        text: toml.to_owned(),
        first_line: None,
    };
    value(&Rc::new(source), 0..toml.len())
}

/// The root table of a TOML document.
pub(super) fn document(source: &Rc<Source>) -> Result<Node, SceneError> {
    let (table, errors) = DeTable::parse_recoverable(&source.text);
    let span = table.span();
    let whole = 0..source.text.len();
    build(
        source,
        whole,
        span,
        DeValue::Table(table.into_inner()),
        &errors,
    )
}

/// One TOML value: these bytes of the source's text.
pub(super) fn value(source: &Rc<Source>, bytes: Range<usize>) -> Result<Node, SceneError> {
    let (value, errors) = DeValue::parse_recoverable(&source.text[bytes.clone()]);
    let span = value.span();
    build(source, bytes, span, value.into_inner(), &errors)
}

fn build(
    source: &Rc<Source>,
    bytes: Range<usize>,
    span: Range<usize>,
    value: DeValue<'_>,
    errors: &[toml::de::Error],
) -> Result<Node, SceneError> {
    let offset = bytes.start;
    let result = match errors.first() {
        Some(error) => Err(syntax_error(source, offset, error)),
        None => Builder { source, offset }.node(span, &value, 0),
    };
    dismantle(value);
    result
}

/// Drops a value level by level. TOML can nest thousands of tables (dotted keys in inline
/// tables), and dropping them inside each other would need a stack as deep.
fn dismantle(value: DeValue<'_>) {
    let mut values = vec![value];
    while let Some(value) = values.pop() {
        match value {
            DeValue::Array(items) => values.extend(items.into_iter().map(Spanned::into_inner)),
            DeValue::Table(table) => {
                values.extend(table.into_iter().map(|(_, value)| value.into_inner()));
            }
            _ => {}
        }
    }
}

fn syntax_error(source: &Rc<Source>, offset: usize, error: &toml::de::Error) -> SceneError {
    let (what, help) = match error.message() {
        deep if deep.contains("recurs") => (TOO_DEEP.to_owned(), too_deep_help()),
        "duplicate key" => (
            "duplicate key: this key or table is already there".to_owned(),
            "keep one: a table has each of its keys once, and only `[[…]]` begins another of a kind"
                .to_owned(),
        ),
        message => (
            format!("this is not TOML: {message}"),
            "a scene is TOML 1.0: `key = value` lines under `[table]` headers, text in double quotes"
                .to_owned(),
        ),
    };
    // Only a key of more than 80 parts has no place.
    let Some(span) = error.span() else {
        return SceneError::general(what, Some(&source.file), help);
    };
    let span = span.start + offset..span.end + offset;
    let source = Rc::clone(source);
    At { source, span }.error(what, help)
}

const TOO_DEEP: &str = "tables or arrays are nested too deep";

fn too_deep_help() -> String {
    format!("no key of a scene lies deeper than {MAX_DEPTH} levels")
}

struct Builder<'a> {
    source: &'a Rc<Source>,
    offset: usize,
}

impl Builder<'_> {
    fn at(&self, span: Range<usize>) -> At {
        At {
            source: Rc::clone(self.source),
            span: span.start + self.offset..span.end + self.offset,
        }
    }

    fn node(
        &self,
        span: Range<usize>,
        value: &DeValue<'_>,
        depth: usize,
    ) -> Result<Node, SceneError> {
        let at = self.at(span);
        if depth > MAX_DEPTH {
            return Err(at.error(TOO_DEEP, too_deep_help()));
        }
        let value = match value {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(digits) => {
                let whole = i64::from_str_radix(digits.as_str(), digits.radix());
                Value::Whole(whole.map_err(|_| {
                    at.error(
                        "this whole number does not fit into 64 bits",
                        format!("TOML's whole numbers end at {}", i64::MAX),
                    )
                })?)
            }
            DeValue::Float(digits) => {
                let number: Result<f64, _> = digits.as_str().parse();
                Value::Number(
                    number.map_err(|_| at.error("this is not a number", "a number such as 0.5"))?,
                )
            }
            DeValue::Boolean(flag) => Value::Flag(*flag),
            DeValue::Datetime(_) => Value::Date,
            DeValue::Array(items) => {
                let items = items
                    .iter()
                    .map(|item| self.node(item.span(), item.get_ref(), depth + 1));
                Value::Array(items.collect::<Result<_, _>>()?)
            }
            DeValue::Table(entries) => {
                let entries = entries.iter().map(|(key, value)| {
                    Ok(Entry {
                        key: key.get_ref().to_string(),
                        at: self.at(Spanned::span(key)),
                        node: self.node(value.span(), value.get_ref(), depth + 1)?,
                    })
                });
                Value::Table(entries.collect::<Result<_, SceneError>>()?)
            }
        };
        Ok(Node { at, value })
    }
}

/// A number as a person would write it: without hundreds of zeros.
pub(super) fn plain(number: f64) -> String {
    if number == 0.0 || (1e-6..1e15).contains(&number.abs()) {
        format!("{number}")
    } else {
        format!("{number:?}")
    }
}
