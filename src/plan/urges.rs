//! What drives a flock's boids besides each other, and how wide they see.

use glam::Vec3;

use super::solids::SolidTables;
use crate::exact::{dot3, normalize_exact, snap};
use crate::layout;
use crate::scene::{Dimensions, Flock, Goal, Obstacle, ObstacleShape, Side};
use crate::transcendental::cos_turns;

/// Half the depth of a box in the eyes of boids that have none.
const ENDLESS: f32 = 1e7;

/// What tells whether one sees so wide: cos |cos| of half the angle, below -1 for all around.
pub(super) fn sight_of(view_angle_degrees: f32) -> f32 {
    if view_angle_degrees >= 360.0 {
        return -2.0;
    }
    let cos = cos_turns(view_angle_degrees / 720.0);
    snap(cos * cos.abs())
}

/// The goal, with the inverse of the radius where boids slow down; its rule, without a limit if there
/// is none, and the drag.
pub(super) fn goal_of(flock: &Flock) -> [[f32; 4]; 2] {
    let Some(goal) = flock.goal else {
        return [[0.0; 4], [0.0, 0.0, 0.0, snap(flock.drag)]];
    };
    let Goal {
        position,
        weight,
        speed,
        limit,
        slowing_radius,
    } = goal;
    let [x, y, z] = flattened(flock, position);
    let inverse = if slowing_radius > 0.0 {
        1.0 / slowing_radius
    } else {
        0.0
    };
    [
        [x, y, z, inverse].map(snap),
        [weight, speed, limit, flock.drag].map(snap),
    ]
}

/// The vector, without a depth where the flock has none.
pub(super) fn flattened(flock: &Flock, [x, y, z]: [f32; 3]) -> [f32; 3] {
    match flock.dimensions {
        Dimensions::Two => [x, y, 0.0],
        Dimensions::Three => [x, y, z],
    }
}

/// What the flock's boids are kept from.
pub(super) fn obstacle_of(
    flock: &Flock,
    obstacle: &Obstacle,
    solids: &SolidTables,
) -> layout::Obstacle {
    let with = |[x, y, z]: [f32; 3], w: f32| [x, y, z, w].map(snap);
    let keeps = |stay: &Side| u32::from(*stay == Side::Inside);
    let (kinds, place, extent) = match &obstacle.shape {
        ObstacleShape::Sphere {
            center,
            radius,
            stay,
        } => {
            let place = with(flattened(flock, *center), *radius);
            let kinds = [layout::OBSTACLE_SPHERE, keeps(stay), 0, 0];
            (kinds, place, [0.0; 4])
        }
        ObstacleShape::Plane { point, normal } => {
            let normal = normalize_exact(Vec3::from(flattened(flock, *normal)));
            let distance = dot3(normal, Vec3::from(flattened(flock, *point)));
            let place = with(normal.to_array(), distance);
            ([layout::OBSTACLE_PLANE, 0, 0, 0], place, [0.0; 4])
        }
        ObstacleShape::Box { corners, stay } => {
            let (min, max) = (Vec3::from(corners.min), Vec3::from(corners.max));
            let mut half = (max - min) * 0.5;
            if flock.dimensions == Dimensions::Two {
                half.z = ENDLESS;
            }
            let center = flattened(flock, ((min + max) * 0.5).to_array());
            let kinds = [layout::OBSTACLE_BOX, keeps(stay), 0, 0];
            (kinds, with(center, 0.0), with(half.to_array(), 0.0))
        }
        ObstacleShape::Mesh {
            mesh,
            surface,
            position,
            scale,
            stay,
        } => {
            let (first, count) = solids.place_of(surface).unwrap_or((0, 0));
            let (center, radius) = mesh.bounding_sphere();
            let radius = radius * scale;
            let center = [0, 1, 2].map(|axis| position[axis] + scale * center[axis]);
            let kinds = [layout::OBSTACLE_MESH, keeps(stay), first, count];
            (
                kinds,
                with(center, radius),
                with([1.0 / radius, 0.0, 0.0], 0.0),
            )
        }
    };
    layout::Obstacle {
        kinds,
        place,
        extent,
        push: [1.0 / obstacle.margin, obstacle.limit, 0.0, 0.0].map(snap),
    }
}
