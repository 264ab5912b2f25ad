//! What drives boids besides each other: a goal, and obstacles that they turn away from and never
//! enter. Twin of `wgsl/lib/urge.wgsl`.

use glam::Vec3;

use crate::cpu::boid::Motion;
use crate::cpu::grid::nearest_way;
use crate::cpu::solid::surface_of_mesh;
use crate::cpu::steering::steering;
use crate::exact::{
    clamp_unit, dot3, inverse_square_root, less, less_equal, max3, min_exact, square_root,
};
use crate::layout::{FlockFrame, OBSTACLE_MESH, OBSTACLE_PLANE, OBSTACLE_SPHERE, Obstacle};

/// What a boid accelerates by to get to its flock's goal; on a torus, by the nearest way.
#[inline]
pub fn sought(flock: &FlockFrame, motion: Motion) -> Vec3 {
    let straight = Vec3::from_slice(&flock.goal) - motion.position;
    let (torus, inverse) = (flock.torus, flock.torus_inverse);
    let way = Vec3::new(
        nearest_way(straight.x, torus[0], inverse[0]),
        nearest_way(straight.y, torus[1], inverse[1]),
        nearest_way(straight.z, torus[2], inverse[2]),
    );
    // Within the radius where it slows down, which is none if its inverse is 0.
    let arrival = if less(0.0, flock.goal[3]) {
        min_exact(square_root(dot3(way, way)) * flock.goal[3], 1.0)
    } else {
        1.0
    };
    let [weight, speed, limit, _] = flock.goal_rule;
    steering([weight, speed * arrival, limit, 0.0], way, motion.velocity)
}

/// The way to where boids may be, and how far a place is on that side, below 0 on the other one.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Of length 1.
    pub normal: Vec3,
    /// World units.
    pub distance: f32,
}

#[inline]
pub(super) fn sign_of(x: f32) -> f32 {
    if less(x, 0.0) { -1.0 } else { 1.0 }
}

/// Of a ball, from outside; from its very middle along x.
#[inline]
pub(super) fn sphere_surface(from_center: Vec3, radius: f32) -> Surface {
    let squared = dot3(from_center, from_center);
    let normal = if less(0.0, squared) {
        from_center * Vec3::splat(inverse_square_root(squared))
    } else {
        Vec3::X
    };
    Surface {
        normal,
        distance: square_root(squared) - radius,
    }
}

/// Of a box, from outside; inside, its nearest face.
#[inline]
fn box_surface(from_center: Vec3, half: Vec3) -> Surface {
    let signs = Vec3::new(
        sign_of(from_center.x),
        sign_of(from_center.y),
        sign_of(from_center.z),
    );
    let beyond = from_center.abs() - half;
    let outside = max3(beyond, Vec3::ZERO);
    let squared = dot3(outside, outside);
    let (normal, distance) = if less(0.0, squared) {
        let unit = outside * Vec3::splat(inverse_square_root(squared));
        (unit * signs, square_root(squared))
    } else if less_equal(beyond.y, beyond.x) && less_equal(beyond.z, beyond.x) {
        (Vec3::new(signs.x, 0.0, 0.0), beyond.x)
    } else if less_equal(beyond.z, beyond.y) {
        (Vec3::new(0.0, signs.y, 0.0), beyond.y)
    } else {
        (Vec3::new(0.0, 0.0, signs.z), beyond.z)
    };
    Surface { normal, distance }
}

/// Where the surface of an obstacle is from a place; `solid_faces` are the stored rows of all meshes.
#[inline]
pub fn surface_of(obstacle: &Obstacle, solid_faces: &[[f32; 4]], position: Vec3) -> Surface {
    let place = Vec3::from_slice(&obstacle.place);
    let [kind, keeps_inside, ..] = obstacle.kinds;
    let surface = match kind {
        OBSTACLE_PLANE => {
            return Surface {
                normal: place,
                distance: dot3(place, position) - obstacle.place[3],
            };
        }
        OBSTACLE_SPHERE => sphere_surface(position - place, obstacle.place[3]),
        OBSTACLE_MESH => surface_of_mesh(obstacle, solid_faces, position),
        _ => box_surface(position - place, Vec3::from_slice(&obstacle.extent)),
    };
    if keeps_inside == 1 {
        return Surface {
            normal: -surface.normal,
            distance: -surface.distance,
        };
    }
    surface
}

/// What a boid accelerates by to turn away: nothing beyond the margin, the more the nearer.
#[inline]
pub fn turned_away(obstacle: &Obstacle, surface: &Surface) -> Vec3 {
    let nearness = clamp_unit(1.0 - surface.distance * obstacle.push[0]);
    surface.normal * Vec3::splat(obstacle.push[1] * nearness)
}

/// Who would be inside is put on the surface, and goes on along it.
#[inline]
pub fn kept_out(surface: &Surface, motion: Motion) -> Motion {
    if !less(surface.distance, 0.0) {
        return motion;
    }
    let outward = min_exact(dot3(motion.velocity, surface.normal), 0.0);
    Motion {
        position: motion.position - surface.normal * Vec3::splat(surface.distance),
        velocity: motion.velocity - surface.normal * Vec3::splat(outward),
    }
}
