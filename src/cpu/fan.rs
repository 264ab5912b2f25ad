//! A flame's particle as it is seen: a fan of triangles whose rim is a regular polygon of 20 corners
//! (Perry 1994, 3.2.1). Twin of `wgsl/lib/fan.wgsl`.

use glam::{Vec3, Vec4};

use crate::exact::{at_least_zero, is_positive, larger, reciprocal, shared_constants, smaller};

shared_constants! {
    /// Corners of the rim.
    pub const CORNERS: u32 = 20;
    const SIDE_A_X: f32 = 1.0;
    const SIDE_A_Y: f32 = 0.158_384_44;
    const SIDE_B_X: f32 = 0.902_113;
    const SIDE_B_Y: f32 = 0.459_649_56;
    const SIDE_C: f32 = 0.715_921;
    const LEAST_DIVISOR: f32 = 0.25;
    /// No half-axis is drawn shorter, in pixels.
    pub const LEAST_HALF_AXIS_PX: f32 = 1.5;
}

/// The share of the centre in the colour at `x`, `y`, in half-axes from the centre; 0 outside.
#[inline]
pub fn center_share(x: f32, y: f32) -> f32 {
    let (a, b) = (x.abs(), y.abs());
    let (major, minor) = (larger(a, b), smaller(a, b));
    let side_a = major * SIDE_A_X + minor * SIDE_A_Y;
    let side_b = major * SIDE_B_X + minor * SIDE_B_Y;
    let side_c = (major + minor) * SIDE_C;
    at_least_zero(1.0 - larger(side_a, larger(side_b, side_c)))
}

/// One over what a place is divided by, so far as it is in sight: in a particle, it is a half at least.
#[inline]
pub fn share_of(divisor: f32) -> f32 {
    reciprocal(larger(divisor, LEAST_DIVISOR))
}

/// The share that the centre of the inner layer has.
#[inline]
pub fn inner_share(share: f32, inverse_radius: f32) -> f32 {
    at_least_zero(1.0 - (1.0 - share) * inverse_radius)
}

/// The light of a particle of these colours and opacities where its centre has that share; none
/// outside. `inner` is the inner layer's opacity as a factor, and the inverse of its radius.
#[inline]
pub fn disc_light(center: Vec4, rim: Vec4, inner: [f32; 2], share: f32) -> Vec3 {
    let here = rim + (center - rim) * share;
    let both = here.w + (center.w * inner[0]) * inner_share(share, inner[1]);
    let alpha = if is_positive(share) { both } else { 0.0 };
    here.truncate() * alpha
}
