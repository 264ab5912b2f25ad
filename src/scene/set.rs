//! `--set path.to.key=value`: changing one value of a scene's tree before it is checked.

use std::rc::Rc;

use super::SceneError;
use super::error::{did_you_mean, shortened};
use super::tracks;
use super::tree::{self, At, Entry, Node, Source, Value};

/// What stands before the text in errors.
const PREFIX: &str = "--set ";

/// Parts of a path at most, so that no command line builds a tree too deep to walk.
const MAX_PARTS: usize = 8;

/// Puts one `path=value` into the tree. Whether the key exists and the value is right is found
/// out when the tree is read, and then points here.
pub(super) fn apply(root: &mut Node, set: &str) -> Result<(), SceneError> {
    let source = Rc::new(Source {
        file: "command line".to_owned(),
        text: format!("{PREFIX}{set}"),
        numbered: false,
    });
    let at = |start: usize, end: usize| At {
        source: Rc::clone(&source),
        span: PREFIX.len() + start..PREFIX.len() + end,
    };
    let form = "--set path.to.key=value, such as --set image.width=640 or --set \
                system.0.speed.mean=0.2";
    let Some(equals) = set.find('=') else {
        return Err(at(0, set.len()).error("this --set has no `=`", form));
    };
    let mut parts = Vec::new();
    let mut start = 0;
    for part in set[..equals].split('.') {
        let at = at(start, start + part.len());
        start += part.len() + 1;
        let name = part.trim();
        if name.is_empty() {
            return Err(at.error("this --set has an empty key", form));
        }
        if parts.len() == MAX_PARTS {
            let help = format!("no key of a scene has more than {MAX_PARTS} parts");
            return Err(at.error("the path of this --set is too long", help));
        }
        parts.push((name, at));
    }
    let value = value(&source, PREFIX.len() + equals + 1, form)?;
    let mut node = root;
    for (depth, (name, at)) in parts.iter().enumerate() {
        let parent = parts[..depth].iter().map(|part| shortened(part.0));
        let parent = parent.collect::<Vec<_>>().join(".");
        node = step(node, name, at, &parent)?;
    }
    *node = value;
    Ok(())
}

/// The value from byte `start` of the source: TOML, or a word that is taken as text.
fn value(source: &Rc<Source>, start: usize, form: &str) -> Result<Node, SceneError> {
    let text = &source.text[start..];
    let trimmed = text.trim();
    let start = start + (text.len() - text.trim_start().len());
    let span = start..start + trimmed.len();
    let source = Rc::clone(source);
    let Some(first) = trimmed.chars().next() else {
        return Err(At { source, span }.error("this --set has no value", form));
    };
    match tree::value(&source, span.clone()) {
        // Whatever begins with a letter and is not TOML can only be meant as text.
        Err(_) if first.is_alphabetic() || first == '_' => {
            let value = Value::Text(trimmed.to_owned());
            let at = At { source, span };
            Ok(Node { at, value })
        }
        result => result,
    }
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
        count => format!("{guess}Its items are 0 to {}", count - 1),
    };
    if !names.is_empty() {
        let some: Vec<_> = names.iter().take(20).map(|name| shortened(name)).collect();
        help += &format!(", or by name {}", some.join(", "));
    }
    let name = shortened(name);
    at.error(format!("there is no `{name}` in `{parent}`"), help)
}
