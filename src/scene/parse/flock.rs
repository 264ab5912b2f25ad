//! `[[flock]]`, with what is in it.

use crate::scene::check;
use crate::scene::files::Files;
use crate::scene::read::{Reader, Spot};
use crate::scene::schema::{FLOCK, GOAL, REGION};
use crate::scene::values::{Quantity, choice, flag, list, text, variant, whole32};
use crate::scene::{
    BoidShape, Corners, Dimensions, Edges, Flock, Goal, Obstacle, ObstacleShape, Relation,
    RelationKind, Rule, SceneError, Side,
};

/// Reads all flocks: a relation may be to one that comes later.
pub(super) fn flocks(spot: &Spot<'_>, files: &Files) -> Result<Vec<Flock>, SceneError> {
    let names = list(spot, |_, spot| {
        let name = spot.node.entry("name").and_then(|name| name.node.text());
        Ok(name.unwrap_or_default().to_owned())
    })?;
    let flocks = list(spot, |index, spot| flock(index, spot, &names, files))?;
    check::boids(&flocks, spot)?;
    Ok(flocks)
}

fn flock(
    index: usize,
    spot: &Spot<'_>,
    names: &[String],
    files: &Files,
) -> Result<Flock, SceneError> {
    let path = match names[index].as_str() {
        name if check::is_name(name) => format!("flock.{name}"),
        _ => format!("flock.{index}"),
    };
    let table = Reader::new(path, FLOCK, spot.node)?;
    let shapes = [
        BoidShape::Triangle,
        BoidShape::Disc,
        BoidShape::Point,
        BoidShape::Cone,
    ];
    Ok(Flock {
        name: table.must("name", text)?,
        count: table.must("count", whole32)?,
        dimensions: match table.must("dimensions", whole32)? {
            2 => Dimensions::Two,
            _ => Dimensions::Three,
        },
        region: table.must("region", |spot| {
            corners(&Reader::new(spot.path.clone(), REGION, spot.node)?)
        })?,
        start_speed: table.must("start_speed", Quantity::read)?,
        max_speed: table.must("max_speed", Quantity::read)?,
        mass: table.must("mass", Quantity::read)?,
        force: table.must("force", Quantity::read)?,
        perception_radius: table.must("perception_radius", Quantity::read)?,
        edges: table.must("edges", edges)?,
        relations: table.must("relation", |spot| {
            list(spot, |_, spot| relation(index, spot, names))
        })?,
        goal: table.may("goal", goal)?,
        obstacles: table.must("obstacle", |spot| {
            list(spot, |_, spot| obstacle(spot, files))
        })?,
        drag: table.must("drag", Quantity::read)?,
        shape: shapes[table.must("shape", choice)?],
        size: table.must("size", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        opacity: table.must("opacity", Quantity::read)?,
        trail_frames: table.must("trail_frames", whole32)?,
        mirrored: table.must("mirrored", flag)?,
    })
}

fn corners(table: &Reader<'_>) -> Result<Corners, SceneError> {
    let corners = Corners {
        min: table.must("min", Quantity::read)?,
        max: table.must("max", Quantity::read)?,
    };
    check::corners(corners.min, corners.max, table)?;
    Ok(corners)
}

fn edges(spot: &Spot<'_>) -> Result<Edges, SceneError> {
    let (kind, table) = variant(spot)?;
    Ok(match kind {
        "none" => Edges::None,
        "wrap" => Edges::Wrap(corners(&table)?),
        "repel" => Edges::Repel {
            corners: corners(&table)?,
            inward: table.must("inward", flag)?,
        },
        "constrain" => Edges::Constrain {
            corners: corners(&table)?,
            factor: table.must("factor", Quantity::read)?,
        },
        _ => Edges::Torus(corners(&table)?),
    })
}

fn goal(spot: &Spot<'_>) -> Result<Goal, SceneError> {
    let table = Reader::new(spot.path.clone(), GOAL, spot.node)?;
    Ok(Goal {
        position: table.must("position", Quantity::read)?,
        weight: table.must("weight", Quantity::read)?,
        speed: table.must("speed", Quantity::read)?,
        limit: table.must("limit", Quantity::read)?,
        slowing_radius: table.must("slowing_radius", Quantity::read)?,
    })
}

fn obstacle(spot: &Spot<'_>, files: &Files) -> Result<Obstacle, SceneError> {
    let (kind, table) = variant(spot)?;
    let stay = || Ok([Side::Outside, Side::Inside][table.must("stay", choice)?]);
    let shape = match kind {
        "sphere" => ObstacleShape::Sphere {
            center: table.must("center", Quantity::read)?,
            radius: table.must("radius", Quantity::read)?,
            stay: stay()?,
        },
        "plane" => ObstacleShape::Plane {
            point: table.must("point", Quantity::read)?,
            normal: table.must("normal", check::direction)?,
        },
        "box" => ObstacleShape::Box {
            corners: corners(&table)?,
            stay: stay()?,
        },
        _ => {
            let (mesh, surface) = table.must("mesh", |spot| {
                let mesh = files.mesh(spot)?;
                let surface = files.surface(spot, &mesh, 1.0)?;
                Ok((mesh, surface))
            })?;
            ObstacleShape::Mesh {
                mesh,
                surface,
                position: table.must("position", Quantity::read)?,
                scale: table.must("scale", Quantity::read)?,
                stay: stay()?,
            }
        }
    };
    Ok(Obstacle {
        shape,
        margin: table.must("margin", Quantity::read)?,
        limit: table.must("limit", Quantity::read)?,
    })
}

/// A relation of the flock `own`.
fn relation(own: usize, spot: &Spot<'_>, names: &[String]) -> Result<Relation, SceneError> {
    let (kind, table) = variant(spot)?;
    if kind != "flock" && !table.has("other") {
        return Err(table.missing_of("other", names));
    }
    let other = table.may("other", |spot| {
        let name = text(spot)?;
        let found = names.iter().position(|other| *other == name);
        found.ok_or_else(|| check::no_such_flock(&name, names, spot))
    })?;
    let rule = |[weight, speed, limit]: [&'static str; 3]| {
        Ok(Rule {
            weight: table.must(weight, Quantity::read)?,
            speed: table.must(speed, Quantity::read)?,
            limit: table.must(limit, Quantity::read)?,
        })
    };
    let kind = match kind {
        "flock" => RelationKind::Flock {
            separation: rule(["separation_weight", "separation_speed", "separation_limit"])?,
            inverse_distance: table.must("separation", choice)? == 1,
            alignment: rule(["alignment_weight", "alignment_speed", "alignment_limit"])?,
            cohesion: rule(["cohesion_weight", "cohesion_speed", "cohesion_limit"])?,
        },
        "avoid" => RelationKind::Avoid {
            limit: table.must("limit", Quantity::read)?,
        },
        _ => RelationKind::Approach {
            limit: table.must("limit", Quantity::read)?,
        },
    };
    Ok(Relation {
        // Only a flock's relation to itself need not say so.
        other: other.unwrap_or(own),
        radius: table.may("radius", Quantity::read)?,
        nearest: table.may("nearest", whole32)?,
        view_angle_degrees: table.must("view_angle_degrees", Quantity::read)?,
        kind,
    })
}
