//! `[[flock]]`, with what is in it.

use crate::scene::check;
use crate::scene::read::{Reader, Spot};
use crate::scene::schema::{FLOCK, REGION};
use crate::scene::values::{Quantity, choice, flag, list, text, variant, whole32};
use crate::scene::{
    BoidShape, Corners, Dimensions, Edges, Flock, Relation, RelationKind, Rule, SceneError,
};

/// Reads all flocks: a relation may be to one that comes later.
pub(super) fn flocks(spot: &Spot<'_>) -> Result<Vec<Flock>, SceneError> {
    let names = list(spot, |_, spot| {
        let name = spot.node.entry("name").and_then(|name| name.node.text());
        Ok(name.unwrap_or_default().to_owned())
    })?;
    let flocks = list(spot, |index, spot| flock(index, spot, &names))?;
    check::boids(&flocks, spot)?;
    Ok(flocks)
}

fn flock(index: usize, spot: &Spot<'_>, names: &[String]) -> Result<Flock, SceneError> {
    let path = match names[index].as_str() {
        name if check::is_name(name) => format!("flock.{name}"),
        _ => format!("flock.{index}"),
    };
    let table = Reader::new(path, FLOCK, spot.node)?;
    let shapes = [BoidShape::Triangle, BoidShape::Disc, BoidShape::Point];
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
        shape: shapes[table.must("shape", choice)?],
        size: table.must("size", Quantity::read)?,
        color: table.must("color", Quantity::read)?,
        opacity: table.must("opacity", Quantity::read)?,
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
        kind,
    })
}
