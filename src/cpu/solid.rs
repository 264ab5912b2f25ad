//! The place of a triangle that is nearest to a place, and on which side of a closed mesh a place is.
//! Twin of `wgsl/lib/solid.wgsl`.

use glam::Vec3;

use crate::cpu::urge::{Surface, sign_of, sphere_surface};
use crate::exact::{
    dot3, inverse_square_root, less, less_equal, normalize_exact, reciprocal, shared_constants,
    square_root,
};
use crate::layout::{Obstacle, ROWS_A_SOLID_FACE};

shared_constants! {
    /// Of a triangle its inside is nearest: the row of its normal from its first one on.
    const NEAR_FACE: u32 = 3;
    /// An edge is.
    const NEAR_AB: u32 = 4;
    const NEAR_BC: u32 = 5;
    const NEAR_CA: u32 = 6;
    /// A corner is.
    const NEAR_A: u32 = 7;
    const NEAR_B: u32 = 8;
    const NEAR_C: u32 = 9;
    /// Farther than anything, squared.
    const FAR_SQUARED: f32 = 1e30;
}

/// The way from the nearest place, its squared length, and what of the triangle it is.
#[derive(Clone, Copy, Debug)]
struct Nearest {
    way: Vec3,
    squared: f32,
    part: u32,
}

/// From a triangle's place: v of the edge ab and w of ac from a.
#[inline]
fn from_place(away: Vec3, [ab, ac]: [Vec3; 2], [v, w]: [f32; 2], part: u32) -> Nearest {
    let way = away - (ab * Vec3::splat(v) + ac * Vec3::splat(w));
    Nearest {
        way,
        squared: dot3(way, way),
        part,
    }
}

/// From the triangle with the edges ab and ac to a place that is `away` from their corner a.
#[inline]
fn nearest_of(away: Vec3, [ab, ac]: [Vec3; 2]) -> Nearest {
    let across = dot3(ab, ac);
    let (ab_squared, ac_squared) = (dot3(ab, ab), dot3(ac, ac));
    // Along both edges from a, from b and from c.
    let (a1, a2) = (dot3(ab, away), dot3(ac, away));
    let (b1, b2) = (a1 - ab_squared, a2 - across);
    let (c1, c2) = (a1 - across, a2 - ac_squared);
    let at = |place: [f32; 2], part: u32| from_place(away, [ab, ac], place, part);
    if less_equal(a1, 0.0) && less_equal(a2, 0.0) {
        return at([0.0, 0.0], NEAR_A);
    }
    if less_equal(0.0, b1) && less_equal(b2, b1) {
        return at([1.0, 0.0], NEAR_B);
    }
    if less_equal(0.0, c2) && less_equal(c1, c2) {
        return at([0.0, 1.0], NEAR_C);
    }
    // Areas of the triangles that the place's foot makes with two corners.
    let to_ab = a1 * b2 - b1 * a2;
    if less_equal(to_ab, 0.0) && less_equal(0.0, a1) && less_equal(b1, 0.0) {
        return at([a1 * reciprocal(ab_squared), 0.0], NEAR_AB);
    }
    let to_ca = c1 * a2 - a1 * c2;
    if less_equal(to_ca, 0.0) && less_equal(0.0, a2) && less_equal(c2, 0.0) {
        return at([0.0, a2 * reciprocal(ac_squared)], NEAR_CA);
    }
    let to_bc = b1 * c2 - c1 * b2;
    if less_equal(to_bc, 0.0) {
        let w = (b2 - b1) * reciprocal((b2 - b1) + (c1 - c2));
        return at([1.0 - w, w], NEAR_BC);
    }
    let inverse = reciprocal(to_ab + to_bc + to_ca);
    at([to_ca * inverse, to_ab * inverse], NEAR_FACE)
}

/// Where the surface of a mesh is, of whose faces these are the stored rows. Far from what boids are to
/// stay out of, the surface of the ball around it is told: nobody turns away from either.
pub fn surface_of_mesh(obstacle: &Obstacle, rows: &[[f32; 4]], position: Vec3) -> Surface {
    let radius = obstacle.place[3];
    let from_center = position - Vec3::from_slice(&obstacle.place);
    let ball = sphere_surface(from_center, radius);
    let [_, keeps_inside, first, count] = obstacle.kinds;
    if keeps_inside == 0 && less_equal(1.0, ball.distance * obstacle.push[0]) {
        return ball;
    }
    let at = from_center * Vec3::splat(obstacle.extent[0]);
    let row = |row: u32| Vec3::from_slice(&rows[row as usize]);
    let mut nearest = Nearest {
        way: Vec3::ZERO,
        squared: FAR_SQUARED,
        part: 0,
    };
    for face in first..first + count {
        let corner = face * ROWS_A_SOLID_FACE;
        let here = nearest_of(at - row(corner), [row(corner + 1), row(corner + 2)]);
        if less(here.squared, nearest.squared) {
            nearest = here;
            nearest.part += corner;
        }
    }
    let normal = row(nearest.part);
    let side = sign_of(dot3(nearest.way, normal));
    let outward = nearest.way * Vec3::splat(inverse_square_root(nearest.squared) * side);
    Surface {
        normal: if less(0.0, nearest.squared) {
            outward
        } else {
            normalize_exact(normal)
        },
        distance: square_root(nearest.squared) * side * radius,
    }
}
