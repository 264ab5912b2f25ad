//! Checks of flocks.

use crate::scene::read::Spot;
use crate::scene::{Corners, Dimensions, Edges, Flock, ObstacleShape, SceneError};

/// Boids of all flocks at most, and boids that one may look at, relation by relation.
const MOST_BOIDS: u64 = 32_000_000;

/// Faces of meshes that a boid looks at, at most.
const MOST_SOLID_FACES: u32 = 10_000;

/// There are not too many boids, and nobody sees a boid twice around a torus.
pub(in crate::scene) fn boids(flocks: &[Flock], spot: &Spot<'_>) -> Result<(), SceneError> {
    let total: u64 = flocks.iter().map(|flock| u64::from(flock.count)).sum();
    if total > MOST_BOIDS {
        let what = format!("the flocks have {total} boids in all, too many");
        let help = format!("`count`s that sum to at most {MOST_BOIDS}");
        return Err(spot.node.at.error(what, help));
    }
    for flock in flocks {
        upright_planes(flock, spot)?;
        enclosing_meshes(flock, spot)?;
        let others = flock
            .relations
            .iter()
            .map(|tie| u64::from(flocks[tie.other].count));
        let seen: u64 = others.sum();
        if seen > MOST_BOIDS {
            let what = format!(
                "a boid of `flock.{}` may look at {seen} boids, relation by relation, too many",
                flock.name
            );
            let help =
                format!("relations to flocks of at most {MOST_BOIDS} boids, each counted anew");
            return Err(spot.node.at.error(what, help));
        }
        for (at, relation) in flock.relations.iter().enumerate() {
            let other = &flocks[relation.other];
            let Edges::Torus(Corners { min, max }) = other.edges else {
                continue;
            };
            let radius = relation.radius.unwrap_or(flock.perception_radius);
            let axes = if other.dimensions == Dimensions::Two {
                2
            } else {
                3
            };
            let least = (0..axes)
                .map(|axis| max[axis] - min[axis])
                .filter(|extent| *extent > 0.0)
                .fold(f32::INFINITY, f32::min);
            if 2.0 * radius > least {
                let what = format!(
                    "`flock.{}.relation.{at}` sees {radius} world units far in the torus of \
                     `flock.{}`, which is {least} across",
                    flock.name, other.name
                );
                let help = format!("a radius of at most half of that, {}", 0.5 * least);
                return Err(spot.node.at.error(what, help));
            }
        }
    }
    Ok(())
}

/// Planes that boids without depth are kept from cross theirs.
fn upright_planes(flock: &Flock, spot: &Spot<'_>) -> Result<(), SceneError> {
    for (at, obstacle) in flock.obstacles.iter().enumerate() {
        let ObstacleShape::Plane {
            normal: [x, y, _], ..
        } = obstacle.shape
        else {
            continue;
        };
        if flock.dimensions == Dimensions::Two && x == 0.0 && y == 0.0 {
            let what = format!(
                "`flock.{}.obstacle.{at}` is a plane that boids without depth never cross",
                flock.name
            );
            let help = "a `normal` with an x or a y, or a flock with `dimensions = 3`";
            return Err(spot.node.at.error(what, help));
        }
    }
    Ok(())
}

/// Meshes among obstacles have an inside, and not too many faces.
fn enclosing_meshes(flock: &Flock, spot: &Spot<'_>) -> Result<(), SceneError> {
    for (at, obstacle) in flock.obstacles.iter().enumerate() {
        let ObstacleShape::Mesh { mesh, surface, .. } = &obstacle.shape else {
            continue;
        };
        let path = format!("`flock.{}.obstacle.{at}`", flock.name);
        if !surface.is_closed() {
            let what = format!(
                "{path}: {} has open edges, so nothing is inside of it",
                mesh.name()
            );
            let help = "a mesh that encloses something, such as cube, cylinder, sphere or torus; or \
                        `kind = \"plane\"`";
            return Err(spot.node.at.error(what, help));
        }
    }
    let faces = flock.solid_faces();
    if faces > MOST_SOLID_FACES {
        let what = format!(
            "the obstacles of `flock.{}` have {faces} faces, too many",
            flock.name
        );
        let help = format!("meshes of at most {MOST_SOLID_FACES} faces together");
        return Err(spot.node.at.error(what, help));
    }
    Ok(())
}

/// The error of a relation to a flock that is not there.
pub(in crate::scene) fn no_such_flock(name: &str, names: &[String], spot: &Spot<'_>) -> SceneError {
    let what = format!(
        "`{}` names a flock that is not there: \"{name}\"",
        spot.path
    );
    let help = format!("one of {}", names.join(", "));
    spot.node.at.error(what, help)
}
