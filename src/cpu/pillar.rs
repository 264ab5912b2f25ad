//! Upright cylinders: where a line of sight meets one, and what one leaves of a light. Twin of
//! `wgsl/lib/pillar.wgsl`.

use glam::Vec3;

use crate::exact::{
    at_least_zero, clamp_unit, inverse_square_root, less, max_exact, min_exact, normalize_exact,
    reciprocal, shared_constants, square_root,
};
use crate::layout::Pillar;

shared_constants! {
    /// How wide its rounded rim is, as a share of the radius.
    pub const RIM: f32 = 0.14;
}

/// Where a line of sight meets a pillar.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meeting {
    /// How far that is, in lengths of the way.
    pub far: f32,
    /// How much of the pixel is covered, 0 ..= 1.
    pub covered: f32,
    /// Unit vector.
    pub normal: Vec3,
}

/// Where the way from the eye meets the pillar; `pixel` is the width of a pixel a way's length away.
pub fn meeting(pillar: &Pillar, eye: Vec3, way: Vec3, pixel: f32) -> Meeting {
    let from_axis = eye - Vec3::from_slice(&pillar.place);
    let radius = pillar.place[3];
    let top = pillar.extent[0] - eye.y;
    let across = way.x * way.x + way.z * way.z;
    let inverse = inverse_square_root(across);
    let beside = (from_axis.x * way.z - from_axis.z * way.x).abs() * inverse;
    let middle = -(from_axis.x * way.x + from_axis.z * way.z) * inverse * inverse;
    let half = square_root(at_least_zero(radius * radius - beside * beside)) * inverse;
    let mut far = middle - half;
    let mut covered = clamp_unit(0.5 + (radius - beside) * reciprocal(middle * pixel));
    let height = way.y * far;
    let is_side = !less(top, height) && less(-from_axis.y, height);
    let place = from_axis + way * far;
    let outward = Vec3::new(place.x, 0.0, place.z) * pillar.extent[3];
    let rim = RIM * radius;
    let rim_share = reciprocal(rim);
    let mut normal = outward + Vec3::Y * clamp_unit((rim - (top - height)) * rim_share);
    if !is_side {
        // The top, seen from above: its front edge is the side's.
        far = top * reciprocal(way.y);
        let on_top = from_axis + way * far;
        let squared = on_top.x * on_top.x + on_top.z * on_top.z;
        let inside = (radius - square_root(squared)) * way.y.abs() * reciprocal(far * pixel);
        let edge = if !less(on_top.x * way.x + on_top.z * way.z, 0.0) {
            clamp_unit(0.5 + inside)
        } else if less(0.0, inside) {
            1.0
        } else {
            0.0
        };
        covered = if less(top, 0.0) && less(way.y, 0.0) {
            min_exact(covered, edge)
        } else {
            0.0
        };
        let tilt = clamp_unit((rim - (radius - square_root(squared))) * rim_share);
        let slope = tilt * pillar.extent[3];
        normal = Vec3::new(on_top.x * slope, 1.0, on_top.z * slope);
    }
    let is_met = less(0.0, far) && less(0.0, across);
    Meeting {
        far,
        covered: if is_met { covered } else { 0.0 },
        normal: normalize_exact(normal),
    }
}

/// What the pillar leaves of a light at `light` for a place: 0 in its shade, 1 outside, and between
/// where the light passes near its edges.
pub fn passed(pillar: &Pillar, place: Vec3, light: Vec3) -> f32 {
    let way = light - place;
    let from_axis = place - Vec3::from_slice(&pillar.place);
    let radius = pillar.place[3];
    let across = way.x * way.x + way.z * way.z;
    let inverse = inverse_square_root(across);
    let beside = (from_axis.x * way.z - from_axis.z * way.x) * inverse;
    let middle = -(from_axis.x * way.x + from_axis.z * way.z) * inverse * inverse;
    let half = square_root(at_least_zero(radius * radius - beside * beside)) * inverse;
    let first = max_exact(middle - half, 0.0);
    let last = min_exact(middle + half, 1.0);
    let a = place.y + way.y * first;
    let b = place.y + way.y * last;
    let soft = 2.0 * pillar.extent[3];
    let below = clamp_unit((pillar.extent[0] - min_exact(a, b)) * pillar.extent[3]);
    let above = clamp_unit((max_exact(a, b) - pillar.place[1]) * soft);
    let through = clamp_unit((last - first) * across * inverse * soft);
    1.0 - below * above * through
}
