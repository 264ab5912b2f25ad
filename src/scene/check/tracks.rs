//! What must hold between values holds while they change, too.

use super::{Fault, camera_fault, lifetime_fault, ring_fault};
use crate::scene::tracks::find;
use crate::scene::tree::{Node, Value};
use crate::scene::{GenerationShape, Interpolation, Owner, Scene, SceneError, Track};

/// Parts of a smooth change between two keys that are looked at.
const SMOOTH_PARTS: i32 = 32;

/// Frames of a camera's path that are looked at; of longer ones, as many, evenly spread.
const MOST_FRAMES: usize = 4096;

/// What is checked of values that do not change holds of those that do.
pub(in crate::scene) fn tracks(scene: &Scene, root: &Node) -> Result<(), SceneError> {
    if scene.tracks.is_empty() {
        return Ok(());
    }
    let mut now = scene.clone();
    // All tracks of an owner are neighbours.
    for tracks in scene.tracks.chunk_by(|a, b| a.owner == b.owner) {
        match tracks[0].owner {
            Owner::Camera => camera(tracks, &mut now, root)?,
            Owner::System(at) => system(tracks, at, &mut now, root)?,
            Owner::Image
            | Owner::Flock(_)
            | Owner::Wind(_)
            | Owner::Lamp(_)
            | Owner::Fire(_)
            | Owner::Surface(_) => {}
        }
    }
    Ok(())
}

/// The camera sees something at all its keys, and in whole frames between them: whoever flies
/// through what they look at is there in one frame. A change may come in each line of a recording,
/// so there is an end to looking.
fn camera(tracks: &[Track], now: &mut Scene, root: &Node) -> Result<(), SceneError> {
    let tracks = those(tracks, &["target", "up", "position"]);
    let Some((first, last)) = span(&tracks) else {
        return Ok(());
    };
    let open = f64::from(now.image.shutter);
    let frames = first.floor() as i32..=last.ceil() as i32;
    let apart = frames.clone().count().div_ceil(MOST_FRAMES);
    let frames = frames
        .step_by(apart.max(1))
        .map(f64::from)
        .flat_map(|frame| [frame, frame + open]);
    let keys = moments(&tracks);
    for time in keys.into_iter().chain(frames) {
        put(&tracks, now, time);
        if let Some(fault) = camera_fault(&now.camera) {
            let node = root.entry("camera").map_or(root, |entry| &entry.node);
            return Err(error(fault, &tracks, time, "camera", node));
        }
    }
    Ok(())
}

fn system(tracks: &[Track], at: usize, now: &mut Scene, root: &Node) -> Result<(), SceneError> {
    let node = match root.entry("system").map(|entry| &entry.node.value) {
        Some(Value::Array(nodes)) => nodes.get(at),
        _ => None,
    };
    let node = node.unwrap_or(root);
    let path = format!("system.{}", now.systems[at].name);
    let lifetimes = those(tracks, &["lifetime.mean", "lifetime.var"]);
    for time in moments(&lifetimes) {
        put(&lifetimes, now, time);
        let lifetime = now.systems[at].lifetime;
        let fault = lifetime.and_then(|life| lifetime_fault(life, &format!("{path}.lifetime")));
        if let Some(fault) = fault {
            return Err(error(fault, &lifetimes, time, &path, node));
        }
    }
    let radii = [
        "generation_shape.inner_radius",
        "generation_shape.outer_radius",
    ];
    let radii_path = format!("{path}.{}", radii[0]);
    let radii = those(tracks, &radii);
    for time in moments(&radii) {
        put(&radii, now, time);
        let GenerationShape::Ring {
            inner_radius,
            outer_radius,
        } = now.systems[at].generation_shape
        else {
            break;
        };
        if let Some(fault) = ring_fault(inner_radius, outer_radius, &radii_path) {
            return Err(error(fault, &radii, time, &path, node));
        }
    }
    Ok(())
}

/// The tracks of these keys, in their order.
fn those<'a>(tracks: &'a [Track], keys: &[&str]) -> Vec<&'a Track> {
    let track = |key: &&str| tracks.iter().find(|track| track.key == *key);
    keys.iter().filter_map(track).collect()
}

fn put(tracks: &[&Track], now: &mut Scene, time: f64) {
    for track in tracks {
        track.put(now, time);
    }
}

/// The first and the last key of all.
fn span(tracks: &[&Track]) -> Option<(f64, f64)> {
    let frames = tracks.iter().flat_map(|track| &track.keys);
    let frames = frames.map(|key| key.frame);
    frames.clone().reduce(f64::min).zip(frames.reduce(f64::max))
}

/// The times that decide whether something holds at all times: every key, the whole frames next
/// to it, and some between two keys that a smooth track connects.
fn moments(tracks: &[&Track]) -> Vec<f64> {
    let keys = tracks.iter().flat_map(|track| &track.keys);
    let mut keys: Vec<f64> = keys.map(|key| key.frame).collect();
    keys.sort_by(f64::total_cmp);
    keys.dedup();
    let is_smooth = |track: &&Track| track.interpolation == Interpolation::Smooth;
    let parts = if tracks.iter().any(is_smooth) {
        SMOOTH_PARTS
    } else {
        1
    };
    let mut moments = keys.clone();
    for pair in keys.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let between = |part| from + (to - from) * f64::from(part) / f64::from(parts);
        moments.extend((1..parts).map(between));
        moments.extend(
            [from.ceil(), to.ceil() - 1.0]
                .iter()
                .filter(|time| (from..to).contains(time)),
        );
    }
    moments
}

/// The fault at a time, located at a key of that time if there is one, and at keys of the value to
/// blame if they may be.
fn error(fault: Fault, tracks: &[&Track], time: f64, path: &str, node: &Node) -> SceneError {
    let to_blame = |track: &&&Track| {
        let is_now = track.keys.iter().any(|key| key.frame == time);
        (is_now, track.key.ends_with(fault.key))
    };
    let Some(track) = tracks.iter().rev().max_by_key(to_blame) else {
        return node.at.error(fault.what, fault.help);
    };
    let (path, node) = find(track, path, node, time);
    let what = format!("`{path}`: at frame {time}, {}", fault.what);
    node.at.error(what, fault.help)
}
