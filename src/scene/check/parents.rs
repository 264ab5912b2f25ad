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
        match lineage(systems, system) {
            Lineage::Rooted => {}
            Lineage::Cycle(names) => {
                let what = format!("leads back to where it begins: {}", names.join(" -> "));
                let help = "a parent that does not descend from this one";
                return refuse("parent", what, help);
            }
            Lineage::Deep(levels) => {
                let what = format!("puts it {levels} levels below its root, too deep");
                return refuse("parent", what, &format!("at most {MOST_LEVELS} levels"));
            }
            // It is that of an ancestor that is named.
            Lineage::Lost => {}
        }
        borne(system, &refuse)?;
    }
    Ok(())
}

type Refuse<'a> = &'a dyn Fn(&str, String, &str) -> Result<(), SceneError>;

/// What a system that bears systems cannot have.
fn bearing(system: &System, refuse: Refuse<'_>) -> Result<(), SceneError> {
    if matches!(system.generation_shape, GenerationShape::Attractor { .. }) {
        let what = "bears systems, which are not born on attractors".into();
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

/// Where the parents of a system lead.
enum Lineage<'a> {
    /// To a root that is near enough.
    Rooted,
    /// Round these systems, the first of which is the last, too.
    Cycle(Vec<&'a str>),
    /// To a root that is so many levels above it, more than may be.
    Deep(usize),
    /// To a name that is none.
    Lost,
}

fn lineage<'a>(systems: &'a [System], system: &'a System) -> Lineage<'a> {
    let mut names = vec![system.name.as_str()];
    let mut here = system;
    while let Some(parent) = &here.parent {
        if let Some(at) = names.iter().position(|name| name == parent) {
            names.drain(..at);
            names.push(parent);
            return Lineage::Cycle(names);
        }
        let Some(next) = systems.iter().find(|other| other.name == *parent) else {
            return Lineage::Lost;
        };
        names.push(parent);
        here = next;
    }
    match names.len() - 1 {
        0..=MOST_LEVELS => Lineage::Rooted,
        levels => Lineage::Deep(levels),
    }
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
