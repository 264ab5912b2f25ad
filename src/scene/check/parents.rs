//! Checks of systems that bear systems.

use crate::scene::error::did_you_mean;
use crate::scene::read::Spot;
use crate::scene::tree::{At, Value};
use crate::scene::{Extinction, GenerationShape, Inherit, SceneError, System};

/// Steps from the root of a tree of systems at most.
const MOST_LEVELS: usize = 8;

/// Systems with a parent have one that bears nothing else, and none has what those that are born
/// by others cannot have.
pub(in crate::scene) fn parents(systems: &[System], spot: &Spot<'_>) -> Result<(), SceneError> {
    for (at, system) in systems.iter().enumerate() {
        let refuse = |key: &str, what: String, help: &str| {
            let path = format!("`system.{}.{key}`", system.name);
            Err(at_key(spot, at, key).error(format!("{path} {what}"), help))
        };
        let bears = systems
            .iter()
            .any(|other| other.parent.as_deref() == Some(&system.name));
        if bears {
            bearing(system, &refuse)?;
        }
        let Some(parent) = &system.parent else {
            if system.inherit != Inherit::default() {
                let what = "is for systems that another one bears".into();
                return refuse("inherit", what, "a `parent`, or no `inherit`");
            }
            continue;
        };
        if !systems.iter().any(|other| other.name == *parent) {
            let names = systems.iter().map(|other| other.name.as_str());
            let help = did_you_mean(parent, names) + "The name of another system";
            return refuse("parent", format!("names no system: \"{parent}\""), &help);
        }
        let mut siblings = systems[..at].iter();
        if siblings.any(|other| other.parent.as_ref() == Some(parent)) {
            let what = format!("is \"{parent}\", which bears systems of another kind already");
            return refuse(
                "parent",
                what,
                "a parent for each kind: systems at one place, if need be",
            );
        }
        if levels(systems, system).is_none() {
            let what = format!("leads to no root within {MOST_LEVELS} steps");
            return refuse(
                "parent",
                what,
                "a parent that does not descend from this one",
            );
        }
        borne(system, &refuse)?;
    }
    Ok(())
}

type Refuse<'a> = &'a dyn Fn(&str, String, &str) -> Result<(), SceneError>;

/// What a system that bears systems cannot have.
fn bearing(system: &System, refuse: Refuse<'_>) -> Result<(), SceneError> {
    if matches!(
        system.generation_shape,
        GenerationShape::Attractor { .. } | GenerationShape::Mesh { .. }
    ) {
        let what = "bears systems, which are not born on attractors and meshes".into();
        return refuse("generation_shape", what, "another shape");
    }
    if system.drag != 0.0 {
        let what = "is that of a system that bears systems, which feel no wind".into();
        return refuse("drag", what, "0");
    }
    if !system.extinctions.is_empty() {
        let what = "is that of a system that bears systems, which end by their lifetime".into();
        return refuse(
            "extinction",
            what,
            "none here; those of what they bear end particles",
        );
    }
    Ok(())
}

/// What a system that another one bears cannot have.
fn borne(system: &System, refuse: Refuse<'_>) -> Result<(), SceneError> {
    if !system.trigger_frames.is_empty() {
        let what = "is that of systems which count their frames from their birth".into();
        return refuse("trigger_frames", what, "none");
    }
    if system.births.mean_parts_wander != 0.0 {
        let what = "is that of systems that another one bears, which do not stray".into();
        return refuse("mean_parts_wander", what, "0");
    }
    if system.first_frame < 0 {
        let what = "is before the birth of the systems, which it is counted from".into();
        return refuse("first_frame", what, "0 or more");
    }
    if system.bursts.len() > 1 || system.bursts.iter().any(|burst| burst.frame < 0) {
        let what = "is that of systems that another one bears".into();
        return refuse("burst", what, "one at most, at a frame from their birth on");
    }
    let from_origin = |one: &Extinction| matches!(one, Extinction::Distance { .. });
    if system.extinctions.iter().any(from_origin) {
        let what = "is at a distance from systems that another one bears".into();
        return refuse(
            "extinction",
            what,
            "planes, spheres or boxes, which are the world's",
        );
    }
    Ok(())
}

/// Steps from the system up to its root, if it has one within reach.
fn levels(systems: &[System], system: &System) -> Option<usize> {
    let mut here = system;
    for level in 0..=MOST_LEVELS {
        let Some(parent) = &here.parent else {
            return Some(level);
        };
        here = systems.iter().find(|other| other.name == *parent)?;
    }
    None
}

/// Where that key of a system stands, or the system if it is not written.
fn at_key<'a>(spot: &'a Spot<'_>, index: usize, key: &str) -> &'a At {
    let Value::Array(nodes) = &spot.node.value else {
        return &spot.node.at;
    };
    let Some(node) = nodes.get(index) else {
        return &spot.node.at;
    };
    node.entry(key).map_or(&node.at, |entry| &entry.node.at)
}
