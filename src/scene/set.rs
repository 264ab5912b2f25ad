//! `path.to.key=value`: changing one value of a scene's tree before it is checked, be it of the
//! command line or of a recording.

use std::ops::Range;
use std::rc::Rc;

use super::SceneError;
use super::error::{did_you_mean, shortened};
use super::schema::{Field, Kind, SCENE, Variant};
use super::tracks;
use super::tree::{self, At, Entry, Node, Source, Value};

/// What stands before the text in errors.
const PREFIX: &str = "--set ";

/// The value that leaves a key out, as if the scene did not say it.
pub(crate) const UNSET: &str = "unset";

/// Parts of a path at most, so that no command line builds a tree too deep to walk.
const MAX_PARTS: usize = 8;

/// A change of a value, and where its writer will look for it.
#[derive(Clone, Debug)]
pub(crate) struct Set {
    source: Rc<Source>,
    /// Where the path is written in the source; or the path that an argument of its own stands for.
    path: Result<Range<usize>, &'static str>,
    /// Where the value is; `None` if there is no `=` before it.
    value: Option<Range<usize>>,
    /// What errors call it.
    noun: &'static str,
    /// What would be right.
    form: &'static str,
}

impl Set {
    /// `path.to.key=value`, after `--set`.
    pub(crate) fn argument(set: &str) -> Self {
        let source = Source {
            file: "command line".to_owned(),
            text: format!("{PREFIX}{set}"),
            first_line: None,
        };
        let form = "--set path.to.key=value, such as --set image.width=640 or --set \
                    system.0.speed.mean=0.2";
        Self::written(source, PREFIX.len(), "--set", form)
    }

    /// The same from byte `start` of a line of a file; number 0 is none.
    pub(crate) fn line(file: &str, number: usize, line: &str, start: usize) -> Self {
        let source = Source {
            file: file.to_owned(),
            text: line.to_owned(),
            first_line: (number > 0).then_some(number),
        };
        let form = "FRAME path.to.key=value, such as 12 system.0.speed.mean=0.2";
        Self::written(source, start, "change", form)
    }

    fn written(source: Source, start: usize, noun: &'static str, form: &'static str) -> Self {
        let end = source.text.len();
        let equals = source.text[start..].find('=').map(|at| start + at);
        Self {
            path: Ok(start..equals.unwrap_or(end)),
            value: equals.map(|at| at + 1..end),
            source: Rc::new(source),
            noun,
            form,
        }
    }

    /// An argument that stands for a path of its own: what was typed, and the bytes of it that are
    /// the value.
    pub(crate) fn implied(path: &'static str, typed: &str, value: Range<usize>) -> Self {
        let source = Source {
            file: "command line".to_owned(),
            text: typed.to_owned(),
            first_line: None,
        };
        Self {
            source: Rc::new(source),
            path: Err(path),
            value: Some(value),
            noun: "argument",
            form: "",
        }
    }

    fn at(&self, span: Range<usize>) -> At {
        let source = Rc::clone(&self.source);
        At { source, span }
    }

    /// The parts of the path, and where they stand.
    fn parts(&self) -> Result<Vec<(&str, At)>, SceneError> {
        let (path, mut start) = match &self.path {
            Ok(span) => (&self.source.text[span.clone()], span.start),
            Err(path) => (*path, 0),
        };
        let mut parts = Vec::new();
        for part in path.split('.') {
            let at = self.at(match &self.path {
                Ok(_) => start..start + part.len(),
                Err(_) => 0..self.source.text.len(),
            });
            start += part.len() + 1;
            let name = part.trim();
            if name.is_empty() {
                let what = format!("this {} has an empty key", self.noun);
                return Err(at.error(what, self.form));
            }
            if parts.len() == MAX_PARTS {
                let help = format!("no key of a scene has more than {MAX_PARTS} parts");
                let what = format!("the path of this {} is too long", self.noun);
                return Err(at.error(what, help));
            }
            parts.push((name, at));
        }
        Ok(parts)
    }

    /// The value: TOML, or a word that is taken as text.
    fn value(&self, written: &Range<usize>) -> Result<Node, SceneError> {
        let text = &self.source.text[written.clone()];
        let trimmed = text.trim();
        let start = written.start + (text.len() - text.trim_start().len());
        let span = start..start + trimmed.len();
        let Some(first) = trimmed.chars().next() else {
            let what = format!("this {} has no value", self.noun);
            return Err(self.at(span).error(what, self.form));
        };
        match tree::value(&self.source, span.clone()) {
            // Whatever begins as a word or a path does and is not TOML can only be meant as text.
            Err(_) if first.is_alphabetic() || first == '_' || is_path(trimmed) => {
                let value = Value::Text(trimmed.to_owned());
                let at = self.at(span);
                Ok(Node { at, value })
            }
            result => result,
        }
    }
}

/// Whether it begins as only a file's path does.
fn is_path(text: &str) -> bool {
    ["/", "./", "../"]
        .iter()
        .any(|start| text.starts_with(start))
}

/// Makes the change in the tree. Whether the key exists and the value is right is found out when
/// the tree is read, and then points here.
pub(super) fn apply(root: &mut Node, set: &Set) -> Result<(), SceneError> {
    let Some(written) = &set.value else {
        let span = set.path.clone().unwrap_or(0..set.source.text.len());
        let what = format!("this {} has no `=`", set.noun);
        return Err(set.at(span).error(what, set.form));
    };
    let parts = set.parts()?;
    if set.source.text[written.clone()].trim() == UNSET {
        return leave_out(root, &parts, set.noun);
    }
    let value = set.value(written)?;
    refuse_unwritten(root, &parts, set.noun)?;
    let mut node = root;
    for (depth, (name, at)) in parts.iter().enumerate() {
        let parent = parts[..depth].iter().map(|part| shortened(part.0));
        let parent = parent.collect::<Vec<_>>().join(".");
        node = step(node, name, at, &parent)?;
    }
    *node = value;
    Ok(())
}

/// Takes the key away, if it is written: what holds then is what the scene says by not saying it.
fn leave_out(root: &mut Node, parts: &[(&str, At)], noun: &str) -> Result<(), SceneError> {
    refuse_unwritten(root, parts, noun)?;
    let Some((last @ (name, at), above)) = parts.split_last() else {
        return Ok(());
    };
    if !is_key(SCENE, Some(root), parts) {
        let path: Vec<String> = parts.iter().map(|part| shortened(part.0)).collect();
        let what = format!("there is no `{}` to leave out", path.join("."));
        let help = format!("a {noun} leaves out what `motes scenes --knobs` lists");
        return Err(at.error(what, help));
    }
    let Some(parent) = descend(root, above) else {
        return Ok(());
    };
    // A mean may stand for its whole table, and nothing of the table says anything without it.
    let is_mean = *name == "mean";
    let holder = match &parent.value {
        Value::Table(_) if !is_mean => Some((parent, last)),
        Value::Table(entries) if entries.iter().any(|entry| entry.key != "mean") => {
            Some((parent, last))
        }
        Value::Array(items) if !is_mean && find(items, name).is_some() => {
            let what = format!(
                "`{}` is one of a list, and cannot be left out",
                shortened(name)
            );
            let help = "a run has what its lists have: change its keys, or the list as a whole";
            return Err(at.error(what, help));
        }
        _ if is_mean => above
            .split_last()
            .and_then(|(last, above)| Some((descend(root, above)?, last))),
        _ => None,
    };
    if let Some((table, (name, _))) = holder
        && let Value::Table(entries) = &mut table.value
    {
        entries.retain(|entry| entry.key != *name);
    }
    Ok(())
}

/// What the path leads to, if it is written.
fn descend<'a>(root: &'a mut Node, parts: &[(&str, At)]) -> Option<&'a mut Node> {
    parts
        .iter()
        .try_fold(root, |node, (name, _)| match &mut node.value {
            Value::Table(entries) => {
                let entry = entries.iter_mut().find(|entry| entry.key == *name);
                entry.map(|entry| &mut entry.node)
            }
            Value::Array(items) => {
                let index = find(items, name)?;
                items.get_mut(index)
            }
            _ => None,
        })
}

/// Whether a table of these fields, or what is in it, has the key, written or not.
fn is_key(fields: &[Field], node: Option<&Node>, parts: &[(&str, At)]) -> bool {
    let Some(((name, _), rest)) = parts.split_first() else {
        return true;
    };
    let Some(field) = fields.iter().find(|field| field.key == *name) else {
        return false;
    };
    let node = node
        .and_then(|node| node.entry(name))
        .map(|entry| &entry.node);
    let variant = |variants: &'static [Variant], node: Option<&Node>| {
        let kind = node.and_then(|node| node.entry("kind")?.node.text());
        let variant = variants.iter().find(|variant| Some(variant.name) == kind);
        variant.map_or(&[][..], |variant| variant.fields)
    };
    // Of a list, the item; an item that is not there has been told.
    let item = || match (node.map(|node| &node.value), rest.first()) {
        (Some(Value::Array(items)), Some((name, _))) => find(items, name).map(|at| &items[at]),
        _ => None,
    };
    let below = rest.get(1..).unwrap_or_default();
    match field.kind {
        _ if rest.is_empty() => true,
        Kind::Table(fields) => is_key(fields, node, rest),
        Kind::Variants(variants) => is_key(variant(variants, node), node, rest),
        Kind::Tables { fields, .. } => item().is_some_and(|item| is_key(fields, Some(item), below)),
        Kind::List { variants, .. } => {
            item().is_some_and(|item| is_key(variant(variants, Some(item)), Some(item), below))
        }
        Kind::Randomised { .. } => is_key(&field.randomised_fields(), None, rest),
        _ => false,
    }
}

/// Refuses a path into a list that is not written: it has nothing that could be changed.
fn refuse_unwritten(root: &Node, parts: &[(&str, At)], noun: &str) -> Result<(), SceneError> {
    let (mut node, mut fields) = (root, SCENE);
    for (depth, (name, at)) in parts.iter().enumerate() {
        if let Value::Array(items) = &node.value {
            let Some(item) = find(items, name) else { break };
            node = &items[item];
            continue;
        }
        let Some(field) = fields.iter().find(|field| field.key == *name) else {
            break;
        };
        let path: Vec<String> = parts[..=depth].iter().map(|it| shortened(it.0)).collect();
        let path = path.join(".");
        match (node.entry(name), parts.get(depth + 1)) {
            (Some(entry), _) => node = &entry.node,
            (None, None) => break,
            (None, Some((item, _))) => match field.kind {
                Kind::Tables { .. } | Kind::List { .. } => {
                    let item = shortened(item);
                    let what = format!("the scene has no `{path}`, and so no `{item}` of them");
                    let help = format!(
                        "a {noun} changes what the scene has: give it one first, in its file; \
                         `motes scenes --knobs` lists what can be changed"
                    );
                    return Err(at.error(what, help));
                }
                Kind::Numbers { count: 2.., .. } | Kind::Wholes { .. } => {
                    let what = format!("`{path}` is not written in the scene, so it has no parts");
                    let help = format!("set it whole, e.g. {path}={}", field.sample());
                    return Err(at.error(what, help));
                }
                _ => break,
            },
        }
        fields = match field.kind {
            Kind::Table(fields) | Kind::Tables { fields, .. } => fields,
            _ => break,
        };
    }
    Ok(())
}

/// The node that `name` leads to from `node`, which errors call `parent`; made if there is none.
fn step<'a>(
    node: &'a mut Node,
    name: &str,
    at: &At,
    parent: &str,
) -> Result<&'a mut Node, SceneError> {
    let is_mean = match node.value {
        Value::Whole(_) | Value::Number(_) | Value::Array(_) => true,
        _ => tracks::is_animated(node),
    };
    if is_mean && ["mean", "var", "rate", "rate_var"].contains(&name) {
        // `speed = 0.1` stands for `speed = { mean = 0.1 }`, so it has a var to be set.
        *node = node.as_only_entry("mean");
    }
    let kind = node.describe();
    match &mut node.value {
        Value::Table(entries) => {
            let found = entries.iter().position(|entry| entry.key == name);
            let index = found.unwrap_or_else(|| {
                let value = Value::Table(Vec::new());
                let node = Node {
                    at: at.clone(),
                    value,
                };
                entries.push(Entry {
                    key: name.to_owned(),
                    at: at.clone(),
                    node,
                });
                entries.len() - 1
            });
            Ok(&mut entries[index].node)
        }
        Value::Array(items) => {
            let index = find(items, name);
            let index = index.ok_or_else(|| no_such_item(items, name, at, parent))?;
            Ok(&mut items[index])
        }
        _ => Err(at.error(
            format!("`{parent}` is {kind} and has no key `{}`", shortened(name)),
            format!("end the path at `{parent}`"),
        )),
    }
}

/// Where the value of that path stands, or the deepest one on the way to it; `None` if there is no
/// first step.
pub(super) fn place_of<'a>(root: &'a Node, path: &str) -> Option<&'a At> {
    let mut here = None;
    let mut node = root;
    for name in path.split('.') {
        let next = match &node.value {
            Value::Array(items) => find(items, name).map(|at| &items[at]),
            _ => node.entry(name).map(|entry| &entry.node),
        };
        let Some(next) = next else { break };
        node = next;
        // A list is nowhere in particular; its items are.
        if !matches!(node.value, Value::Array(_)) || here.is_some() {
            here = Some(&node.at);
        }
    }
    here
}

/// The item with this index or, in an array of tables, with this name.
fn find(items: &[Node], name: &str) -> Option<usize> {
    let named = |item: &Node| item.entry("name").and_then(|entry| entry.node.text()) == Some(name);
    let index = name.parse().ok().filter(|&index| index < items.len());
    index.or_else(|| items.iter().position(named))
}

fn no_such_item(items: &[Node], name: &str, at: &At, parent: &str) -> SceneError {
    let names = items
        .iter()
        .filter_map(|item| item.entry("name")?.node.text());
    let names: Vec<&str> = names.collect();
    let guess = did_you_mean(name, names.iter().copied());
    let mut help = match items.len() {
        0 => format!("`{parent}` is empty"),
        1 => format!("{guess}Its only item is 0"),
        count => format!("{guess}Its items are 0 to {}", count - 1),
    };
    if !names.is_empty() {
        let some: Vec<_> = names.iter().take(20).map(|name| shortened(name)).collect();
        help += &format!(", or by name {}", some.join(", "));
    }
    let name = shortened(name);
    at.error(format!("there is no `{name}` in `{parent}`"), help)
}
