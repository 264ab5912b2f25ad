//! Where in its generation shape a particle is born, and which way it leaves (Reeves 1983, 2.2).
//! Twin of `wgsl/lib/emission.wgsl`.

use glam::{UVec4, Vec3};

use crate::exact::{at_least_zero, cross3, dot3, less, normalize_exact, reciprocal, square_root};
use crate::layout::{
    ROW_ANGLE_UNIFORM, ROW_AROUND, ROW_OUTWARD, SHAPE_CIRCLE, SHAPE_CONE, SHAPE_RING, SHAPE_SPHERE,
    SystemRow,
};
use crate::rng::{signed_float, unit_float};
use crate::transcendental::{cos_turns, cube_root, sin_turns};

/// A place to be born at, and what is outward there (on a curve, onward).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Birthplace {
    pub(crate) position: Vec3,
    pub(crate) axis: Vec3,
}

/// The unit vector at height z on the sphere, `turns` around the z axis.
#[inline]
fn on_sphere(z: f32, turns: f32) -> Vec3 {
    let ring = square_root(at_least_zero(1.0 - z * z));
    Vec3::new(ring * cos_turns(turns), ring * sin_turns(turns), z)
}

/// A place in the generation shape, uniform; not on a curve, for those are stored.
#[inline]
pub(crate) fn in_shape(row: &SystemRow, place: UVec4) -> Birthplace {
    let kind = row.kinds[0];
    let shape = row.shape;
    let u = unit_float(place.x);
    if kind == SHAPE_SPHERE {
        let outward = on_sphere(signed_float(place.x), unit_float(place.y));
        return Birthplace {
            position: outward * (cube_root(unit_float(place.z)) * shape[0]),
            axis: outward,
        };
    }
    let mut position = Vec3::new(
        signed_float(place.x) * shape[0],
        signed_float(place.y) * shape[1],
        signed_float(place.z) * shape[2],
    );
    if kind == SHAPE_CIRCLE || kind == SHAPE_RING || kind == SHAPE_CONE {
        let height = cube_root(unit_float(place.z)) * shape[2];
        let inner = shape[3] * shape[3];
        let distance = if kind == SHAPE_CONE {
            square_root(u) * shape[3] * height
        } else {
            square_root(inner + u * (shape[0] * shape[0] - inner))
        };
        let turns = unit_float(place.y);
        position = Vec3::new(
            distance * cos_turns(turns),
            distance * sin_turns(turns),
            height,
        );
    }
    Birthplace {
        position,
        axis: normalize_exact(position),
    }
}

/// The place `part` of the way from one stored point of a curve to the next.
#[inline]
pub(crate) fn on_curve(here: Vec3, next: Vec3, part: f32, scale: f32) -> Birthplace {
    let step = next - here;
    Birthplace {
        position: (here + step * part) * scale,
        axis: normalize_exact(step),
    }
}

/// A place in a triangle, uniform: a corner and the edges from it, with the normal in their w.
#[inline]
pub(crate) fn on_triangle(face: [[f32; 4]; 3], place: UVec4, scale: f32) -> Birthplace {
    let [corner, to_next, to_last] = face.map(|row| Vec3::from_slice(&row));
    let (u, v) = (unit_float(place.y), unit_float(place.z));
    // The other half of the parallelogram is turned onto this one.
    let (along, across) = if less(1.0, u + v) {
        (1.0 - u, 1.0 - v)
    } else {
        (u, v)
    };
    Birthplace {
        position: (corner + to_next * along + to_last * across) * scale,
        axis: Vec3::from(face.map(|row| row[3])),
    }
}

/// Two directions across a unit vector and each other: across and upward.
#[inline]
pub(crate) fn basis_of(axis: Vec3) -> (Vec3, Vec3) {
    let side = if less(axis.z, 0.0) { -1.0 } else { 1.0 };
    let a = -reciprocal(side + axis.z);
    let b = axis.x * axis.y * a;
    (
        Vec3::new(1.0 + side * axis.x * axis.x * a, side * b, -side * axis.x),
        Vec3::new(b, side + axis.y * axis.y * a, -axis.y),
    )
}

/// A unit vector within the ejection angle of the unit vector `axis`.
#[inline]
pub(crate) fn ejected(row: &SystemRow, axis: Vec3, motion: UVec4) -> Vec3 {
    let limits = row.ejection_and_light;
    let u = unit_float(motion.x);
    let cosine = if row.kinds[3] & ROW_ANGLE_UNIFORM != 0 {
        cos_turns(u * limits[1])
    } else {
        1.0 - u * (1.0 - limits[0])
    };
    let local = on_sphere(cosine, unit_float(motion.y));
    let (across, upward) = basis_of(axis);
    across * local.x + upward * local.y + axis * local.z
}

/// The axis that ejection angles are counted from; up where there is no outward or around.
#[inline]
pub(crate) fn axis_of(row: &SystemRow, born: &Birthplace) -> Vec3 {
    let up = Vec3::Z;
    let flags = row.kinds[3];
    let mut axis = up;
    if flags & ROW_OUTWARD != 0 {
        axis = born.axis;
    }
    if flags & ROW_AROUND != 0 {
        axis = normalize_exact(cross3(up, born.axis));
    }
    if less(0.0, dot3(axis, axis)) {
        axis
    } else {
        up
    }
}

/// A vector that turns with the rows of a transform.
#[inline]
pub(crate) fn turned([x_row, y_row, z_row]: [[f32; 4]; 3], v: Vec3) -> Vec3 {
    let along = |row: [f32; 4]| row[0] * v.x + row[1] * v.y + row[2] * v.z;
    Vec3::new(along(x_row), along(y_row), along(z_row))
}

/// The row `share` of the way back from now.
#[inline]
pub(crate) fn mixed(now: [f32; 4], earlier: [f32; 4], share: f32) -> [f32; 4] {
    std::array::from_fn(|i| now[i] + (earlier[i] - now[i]) * share)
}
