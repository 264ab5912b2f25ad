//! What `--set` can reach in a scene: its numbers, flags and choices.

use std::rc::Rc;

use super::builtin::SceneText;
use super::check::birth_keys;
use super::expect::{kind_in_words, quoted};
use super::schema::{Field, Kind, Presence, SCENE, Variant};
use super::tracks::is_animated;
use super::tree::{self, Node, Source, Value};
use super::{BirthUnit, SceneError};

/// A value of a scene that can be changed.
#[derive(Clone, Debug)]
pub struct Knob {
    /// As `--set` takes it: `system.jet.speed.mean`.
    pub path: String,
    /// What it is now.
    pub value: KnobValue,
    /// Whether it changes with the frame now.
    pub has_keys: bool,
    /// Its row in the schema; that of a part of a spread has the part's own key and limits, and that
    /// of a `kind` has [`Kind::Variants`], whose names are the choices.
    pub field: Field,
    /// What it does, as a clause without a full stop.
    pub about: String,
}

/// The value of a [`Knob`], in TOML on one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum KnobValue {
    /// The scene says so.
    Written(String),
    /// The scene does not say, and this holds.
    Default(String),
    /// The scene does not say, and nothing holds.
    None,
}

/// The knobs of a scene that is right.
pub(super) fn of_text(scene: SceneText) -> Result<Vec<Knob>, SceneError> {
    let SceneText { text, file, .. } = scene;
    let source = Source {
        file,
        text: text.into_owned(),
        first_line: Some(1),
    };
    of_tree(&tree::document(&Rc::new(source))?)
}

/// The knobs of a scene that is right.
pub(super) fn of_tree(root: &Node) -> Result<Vec<Knob>, SceneError> {
    let mut finder = Finder { found: Vec::new() };
    finder.table("", SCENE, Some(root))?;
    Ok(finder.found)
}

impl Knob {
    /// What its value may be, in words, with the unit.
    #[must_use]
    pub fn right(&self) -> String {
        let words = match self.field.kind {
            Kind::Variants(_) => format!("one of {}", quoted(&self.choices())),
            kind => kind_in_words(&kind),
        };
        match self.field.unit {
            "" => words,
            unit => format!("{words}, {unit}"),
        }
    }

    /// The words that it can be if it is a choice; else none.
    #[must_use]
    pub fn choices(&self) -> Vec<&'static str> {
        match self.field.kind {
            Kind::Choice(words) => words.to_vec(),
            Kind::Variants(variants) => variants.iter().map(|variant| variant.name).collect(),
            _ => Vec::new(),
        }
    }
}

struct Finder {
    found: Vec<Knob>,
}

impl Finder {
    /// Finds the knobs of a table, which may not be written.
    fn table(
        &mut self,
        path: &str,
        fields: &[Field],
        node: Option<&Node>,
    ) -> Result<(), SceneError> {
        for field in fields.iter().filter(|field| is_free(field, node)) {
            let path = match path {
                "" => field.key.to_owned(),
                path => format!("{path}.{}", field.key),
            };
            let entry = node.and_then(|node| node.entry(field.key));
            self.value(path, field, entry.map(|entry| &entry.node))?;
        }
        Ok(())
    }

    fn value(
        &mut self,
        path: String,
        field: &Field,
        node: Option<&Node>,
    ) -> Result<(), SceneError> {
        match (field.kind, node.map(|node| &node.value)) {
            // Not a knob, but a matter of words.
            (Kind::Text { .. } | Kind::Name { .. }, _) => Ok(()),
            // What is not there at all has nothing to turn: it is not its keys' defaults.
            (Kind::Table(_), None) if matches!(field.presence, Presence::Optional(_)) => Ok(()),
            (Kind::Table(fields), _) => self.table(&path, fields, node),
            (Kind::Tables { fields, .. }, Some(Value::Array(items))) => {
                for (at, item) in items.iter().enumerate() {
                    let name = item.entry("name").and_then(|name| name.node.text());
                    let name = name.map_or_else(|| at.to_string(), str::to_owned);
                    self.table(&format!("{path}.{name}"), fields, Some(item))?;
                }
                Ok(())
            }
            (Kind::List { variants, .. }, Some(Value::Array(items))) => {
                for (at, item) in items.iter().enumerate() {
                    self.variant(&format!("{path}.{at}"), field, variants, item)?;
                }
                Ok(())
            }
            (Kind::Variants(variants), _) => match node {
                Some(node) => self.variant(&path, field, variants, node),
                None => Ok(()),
            },
            (Kind::Tables { .. } | Kind::List { .. }, _) => Ok(()),
            (Kind::Randomised { .. }, _) => self.spread(&path, field, node),
            (
                Kind::Whole { .. }
                | Kind::Wholes { .. }
                | Kind::Flag
                | Kind::Numbers { .. }
                | Kind::Choice(_),
                _,
            ) => {
                self.knob(path, *field, field.about.to_owned(), node);
                Ok(())
            }
        }
    }

    fn knob(&mut self, path: String, field: Field, about: String, node: Option<&Node>) {
        let value = match (node, field.presence) {
            (Some(node), _) => KnobValue::Written(node.value.toml()),
            (None, Presence::Default(toml)) => KnobValue::Default(toml.to_owned()),
            (None, _) => KnobValue::None,
        };
        self.found.push(Knob {
            path,
            value,
            has_keys: node.is_some_and(is_animated),
            field,
            about,
        });
    }

    /// The parts of a spread. If nothing stands for it, only its mean can be set by itself.
    fn spread(&mut self, path: &str, field: &Field, node: Option<&Node>) -> Result<(), SceneError> {
        let parts = field.randomised_fields();
        let is_table = |node: &&Node| matches!(node.value, Value::Table(_)) && !is_animated(node);
        let count = match (node, field.presence) {
            (None, Presence::Optional(_)) => 1,
            _ => parts.len(),
        };
        for part in &parts[..count] {
            let own = match node {
                Some(table) if is_table(&table) => table.entry(part.key).map(|entry| &entry.node),
                mean => mean.filter(|_| part.key == "mean"),
            };
            let about = format!("{}: {}", field.about, part.about);
            self.knob(format!("{path}.{}", part.key), *part, about, own);
        }
        Ok(())
    }

    fn variant(
        &mut self,
        path: &str,
        field: &Field,
        variants: &'static [Variant],
        node: &Node,
    ) -> Result<(), SceneError> {
        let Some(kind) = node.entry("kind").map(|entry| &entry.node) else {
            return Ok(());
        };
        let Some(variant) = variants.iter().find(|v| Some(v.name) == kind.text()) else {
            return Ok(());
        };
        let about = format!(
            "{}, by its kind, which its other keys must fit",
            field.about
        );
        let field = Field {
            key: "kind",
            kind: Kind::Variants(variants),
            presence: Presence::Required(variant.name),
            ..*field
        };
        self.knob(format!("{path}.kind"), field, about, Some(kind));
        self.table(path, variant.fields, Some(node))
    }
}

/// Whether the key can be set by itself: all but those of births that the system does not have.
fn is_free(field: &Field, node: Option<&Node>) -> bool {
    let is_written = |key: &&str| node.is_some_and(|node| node.entry(key).is_some());
    let [frame, area] = [BirthUnit::Frame, BirthUnit::ScreenArea].map(birth_keys);
    let (own, other) = if frame.contains(&field.key) {
        (frame, area)
    } else if area.contains(&field.key) {
        (area, frame)
    } else {
        return true;
    };
    match (own.iter().any(&is_written), other.iter().any(is_written)) {
        (written, false) => written || field.key == own[0],
        (_, true) => false,
    }
}
