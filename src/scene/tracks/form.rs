//! The form of a value with keys in a scene file.

use crate::scene::SceneError;
use crate::scene::error::{did_you_mean, shortened};
use crate::scene::schema::{INTERPOLATIONS, KEY_FRAMES, MOST_KEYS};
use crate::scene::tree::{Node, Value, plain};

/// What a table of keys must be.
const FORM: &str = "{ keys = [[FRAME, VALUE], ...], interpolation = \"linear\" }: 1 to 1000 keys in \
                    ascending order of frames, each from -65_000 to 1_000_000; interpolation is \
                    linear, smooth or step, and linear if left out";

/// Whether a table of keys stands where a value could.
pub(in crate::scene) fn is_animated(node: &Node) -> bool {
    node.entry("keys").is_some()
}

/// The pairs of frame and value in such a table, which errors call `path`, checked but for the
/// values.
pub(in crate::scene) fn pairs<'a>(
    node: &'a Node,
    path: &str,
) -> Result<Vec<(f64, &'a Node)>, SceneError> {
    let Value::Table(entries) = &node.value else {
        let what = format!("`{path}` must be a table, found {}", node.describe());
        return Err(node.at.error(what, FORM));
    };
    for entry in entries {
        match entry.key.as_str() {
            "keys" => {}
            "interpolation" => interpolation(&entry.node, path)?,
            key => {
                let mut help = did_you_mean(key, ["keys", "interpolation"]);
                if ["mean", "var", "rate", "rate_var"].contains(&key) {
                    help +=
                        "keys of the mean alone are `mean = { keys = [[FRAME, VALUE], ...] }`. ";
                }
                let what = format!("there is no key `{}` in `{path}`", shortened(key));
                return Err(entry
                    .at
                    .error(what, format!("{help}A value with keys is {FORM}")));
            }
        }
    }
    let path = format!("{path}.keys");
    let refuse = |node: &Node, part: &str, why: &str| {
        Err(node.at.error(format!("`{path}{part}` {why}"), FORM))
    };
    let cannot =
        |node: &Node, part: &str| refuse(node, part, &format!("cannot be {}", node.describe()));
    let Some(entry) = node.entry("keys") else {
        return refuse(node, "", "is missing");
    };
    let Value::Array(items) = &entry.node.value else {
        return cannot(&entry.node, "");
    };
    if items.is_empty() {
        return refuse(&entry.node, "", "is empty");
    }
    if items.len() > MOST_KEYS {
        return refuse(
            &entry.node,
            "",
            &format!("has {} keys, too many", items.len()),
        );
    }
    let mut pairs: Vec<(f64, &Node)> = Vec::new();
    for (at, item) in items.iter().enumerate() {
        let part = format!(".{at}");
        let Value::Array(pair) = &item.value else {
            return cannot(item, &part);
        };
        let [frame, value] = pair.as_slice() else {
            return cannot(item, &part);
        };
        let part = format!(".{at}.0");
        let number = match frame.value {
            Value::Whole(whole) => whole as f64,
            Value::Number(number) => number,
            _ => return cannot(frame, &part),
        };
        if !(KEY_FRAMES.min..=KEY_FRAMES.max).contains(&number) {
            return refuse(frame, &part, &format!("is out of range: {}", plain(number)));
        }
        if let Some((last, _)) = pairs.last().filter(|(last, _)| number <= *last) {
            let [number, last] = [number, *last].map(plain);
            return refuse(
                frame,
                &part,
                &format!("is {number}, but the key before is at {last}"),
            );
        }
        pairs.push((number, value));
    }
    Ok(pairs)
}

fn interpolation(node: &Node, path: &str) -> Result<(), SceneError> {
    let path = format!("{path}.interpolation");
    let Some(word) = node.text() else {
        let what = format!("`{path}` cannot be {}", node.describe());
        return Err(node.at.error(what, FORM));
    };
    if INTERPOLATIONS.contains(&word) {
        return Ok(());
    }
    let what = format!("`{path}` cannot be \"{}\"", shortened(word));
    Err(node
        .at
        .error(what, did_you_mean(word, INTERPOLATIONS) + FORM))
}
