//! Finding the values with keys in a scene file's tree.

use super::form::{is_animated, pairs};
use super::places::numbers_of;
use super::{Interpolation, Key, Owner, Track};
use crate::scene::schema::{CAMERA, FIRE, FLOCK, Field, IMAGE, Kind, LAMP, SURFACE, SYSTEM, WINDS};
use crate::scene::tree::{Node, Value};
use crate::scene::{Scene, SceneError};

/// Finds every value with keys in a scene file that has been read into `scene`.
pub(in crate::scene) fn collect(root: &Node, scene: &mut Scene) -> Result<(), SceneError> {
    let mut tracks = Vec::new();
    let Value::Table(entries) = &root.value else {
        return Ok(());
    };
    for entry in entries {
        let kind = entry.key.as_str();
        let mut visit = |node: &Node, owner: Option<Owner>, path: String| {
            let kind = node.entry("kind").and_then(|entry| entry.node.text());
            let is_sink = kind == Some("sink");
            let place = Place {
                owner,
                path,
                is_sink,
            };
            place.visit(node, "", scene, &mut tracks)
        };
        match (kind, &entry.node.value) {
            ("image", _) => visit(&entry.node, Some(Owner::Image), kind.to_owned())?,
            ("camera", _) => visit(&entry.node, Some(Owner::Camera), kind.to_owned())?,
            ("light" | "planet" | "ground", _) => visit(&entry.node, None, kind.to_owned())?,
            (_, Value::Array(nodes)) => {
                for (at, node) in nodes.iter().enumerate() {
                    let owner = match kind {
                        "system" => Some(Owner::System(at)),
                        "flock" => Some(Owner::Flock(at)),
                        "wind" => Some(Owner::Wind(at)),
                        "lamp" => Some(Owner::Lamp(at)),
                        "fire" => Some(Owner::Fire(at)),
                        "surface" => Some(Owner::Surface(at)),
                        _ => None,
                    };
                    let name = match (kind, node.entry("name")) {
                        ("system" | "flock" | "fire", Some(name)) => {
                            name.node.text().map(str::to_owned)
                        }
                        _ => None,
                    };
                    let name = name.unwrap_or_else(|| at.to_string());
                    visit(node, owner, format!("{kind}.{name}"))?;
                }
            }
            _ => {}
        }
    }
    scene.tracks = tracks;
    Ok(())
}

/// A table that values with keys may be in.
struct Place {
    /// `None` if nothing in it can change.
    owner: Option<Owner>,
    /// What errors call it.
    path: String,
    /// A sink is a source of negative strength.
    is_sink: bool,
}

impl Place {
    /// Finds the tracks in `node`, which has this `key` in the table; empty for the table itself.
    fn visit(
        &self,
        node: &Node,
        key: &str,
        scene: &mut Scene,
        tracks: &mut Vec<Track>,
    ) -> Result<(), SceneError> {
        let below = |part: &str| match key {
            "" => part.to_owned(),
            key => format!("{key}.{part}"),
        };
        match &node.value {
            Value::Table(_) if is_animated(node) => {
                let track = self.track(node, key, scene)?;
                tracks.push(track);
            }
            Value::Table(entries) => {
                for entry in entries {
                    self.visit(&entry.node, &below(&entry.key), scene, tracks)?;
                }
            }
            Value::Array(items) => {
                for (at, item) in items.iter().enumerate() {
                    self.visit(item, &below(&at.to_string()), scene, tracks)?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn track(&self, node: &Node, key: &str, scene: &mut Scene) -> Result<Track, SceneError> {
        let path = format!("{}.{key}", self.path);
        let mean = format!("{key}.mean");
        let found = self.owner.and_then(|owner| {
            let known = |key: &&str| numbers_of(scene, owner, key).is_some();
            let key = [key, &mean].into_iter().find(known)?;
            Some((owner, key.to_owned()))
        });
        let Some((owner, key)) = found else {
            let what = format!("`{path}` cannot change with the frame");
            let able = self.owner.map_or_else(Vec::new, |owner| able(owner, scene));
            let mut help = "one value for all frames, without `keys`".to_owned();
            if !able.is_empty() {
                help += &format!(
                    "; what can have keys in `{}` is {}",
                    self.path,
                    able.join(", ")
                );
            }
            return Err(node.at.error(what, help));
        };
        let word = node.entry("interpolation");
        let interpolation = match word.and_then(|entry| entry.node.text()) {
            Some("smooth") => Interpolation::Smooth,
            Some("step") => Interpolation::Step,
            _ => Interpolation::Linear,
        };
        let sign = if self.is_sink && key == "strength" {
            -1.0
        } else {
            1.0
        };
        let pairs = pairs(node, &path)?.into_iter();
        let keys = pairs.map(|(frame, node)| Key {
            frame,
            value: numbers(node).map(|number| number * sign),
        });
        let keys = keys.collect();
        Ok(Track {
            owner,
            key,
            interpolation,
            keys,
        })
    }
}

/// The numbers of a key, which were checked when the scene was read.
fn numbers(node: &Node) -> [f32; 3] {
    let number = |node: &Node| match node.value {
        Value::Whole(whole) => whole as f32,
        Value::Number(number) => number as f32,
        _ => 0.0,
    };
    let mut numbers = [0.0; 3];
    match &node.value {
        Value::Array(items) => {
            for (slot, item) in numbers.iter_mut().zip(items) {
                *slot = number(item);
            }
        }
        _ => numbers[0] = number(node),
    }
    numbers
}

/// The keys of this owner whose values can change.
fn able(owner: Owner, scene: &Scene) -> Vec<String> {
    let mut scene = scene.clone();
    // Of what goes by its kind, only the keys of its own.
    let mut is_here = |key: &str| numbers_of(&mut scene, owner, key).is_some();
    let fields: Vec<&Field> = match owner {
        Owner::Image => IMAGE.iter().collect(),
        Owner::Camera => CAMERA.iter().collect(),
        Owner::Wind(_) => WINDS.iter().flat_map(|wind| wind.fields).collect(),
        Owner::Lamp(_) => LAMP.iter().collect(),
        Owner::Surface(_) => SURFACE.iter().collect(),
        Owner::System(_) => SYSTEM.iter().collect(),
        Owner::Fire(_) => FIRE.iter().collect(),
        Owner::Flock(_) => FLOCK.iter().collect(),
    };
    let is_wind = matches!(owner, Owner::Wind(_));
    let mut able: Vec<String> = Vec::new();
    for field in fields {
        let below = |part: &Field| format!("{}.{}", field.key, part.key);
        let keys = match field.kind {
            Kind::Randomised { .. } if field.keyed => {
                field.randomised_fields().iter().map(below).collect()
            }
            Kind::Table(fields) => {
                let keys = fields.iter().filter(|part| part.keyed).map(below);
                keys.filter(|key| is_here(key)).collect()
            }
            Kind::Variants(variants) => {
                let parts = variants.iter().flat_map(|variant| variant.fields);
                let keys = parts.filter(|part| part.keyed).map(below);
                keys.filter(|key| is_here(key)).collect()
            }
            _ if !field.keyed || (is_wind && !is_here(field.key)) => Vec::new(),
            _ => vec![field.key.to_owned()],
        };
        for key in keys {
            if !able.contains(&key) {
                able.push(key);
            }
        }
    }
    able
}

/// Where a track has a key at this time, or else where all its keys are: path and node.
pub(in crate::scene) fn find<'a>(
    track: &Track,
    path: &str,
    owner: &'a Node,
    time: f64,
) -> (String, &'a Node) {
    let (mut path, mut node) = (path.to_owned(), owner);
    for part in track.key.split('.') {
        // Keys of the mean may stand for the whole.
        if let Some(entry) = node.entry(part) {
            path = format!("{path}.{part}");
            node = &entry.node;
        }
    }
    if let Some(entry) = node.entry("keys") {
        path += ".keys";
        node = &entry.node;
    }
    let here = track.keys.iter().position(|key| key.frame == time);
    match (&node.value, here) {
        (Value::Array(items), Some(at)) if at < items.len() => (format!("{path}.{at}"), &items[at]),
        _ => (path, node),
    }
}
