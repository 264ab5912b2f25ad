//! Winds of scenes, as the processor knows them, and places to ask for them.

use glam::{DVec3, Vec3};
use motes::cpu::wind::wind_at;
use motes::layout::Wind;
use motes::plan::Plan;

use crate::common::hash;
use crate::support::scene;

/// The winds of a scene, frame by frame.
pub(crate) struct Winds(Plan);

impl Winds {
    /// Of these parts, each an inline table of TOML.
    pub(crate) fn new(parts: &[&str]) -> Self {
        let scene = scene(&format!("wind = [{}]", parts.join(", ")), &["drag = 0.5"]);
        Self(Plan::new(&scene, 1).expect("the scene can be planned"))
    }

    /// Its parts at a frame.
    pub(crate) fn at(&self, frame: u32) -> Vec<Wind> {
        self.0.inputs(frame).winds
    }

    /// The wind at a frame and a place.
    pub(crate) fn flow(&self, frame: u32, place: Vec3) -> Vec3 {
        wind_at(&self.at(frame), place)
    }
}

/// The velocity field of winds at one frame.
pub(crate) fn field(winds: &Winds, frame: u32) -> impl Fn(Vec3) -> DVec3 + Sync {
    let winds = winds.at(frame);
    move |place| wind_at(&winds, place).as_dvec3()
}

/// A uniform number in [0, 1), of two indices.
pub(crate) fn unit(index: u32, stream: u32) -> f64 {
    f64::from(hash(index.wrapping_mul(64).wrapping_add(stream))) / 4_294_967_296.0
}

/// A place in the cube from -half to half, uniform.
pub(crate) fn place(index: u32, half: f64) -> Vec3 {
    let along = |axis: u32| (half * (2.0 * unit(index, axis) - 1.0)) as f32;
    Vec3::new(along(0), along(1), along(2))
}

/// A place whose coordinates are multiples of 1/64, so that small sums of them are exact.
pub(crate) fn dyadic_place(index: u32, half: f64) -> Vec3 {
    (place(index, half) * 64.0).floor() / 64.0
}

/// A unit vector, uniform on the sphere.
pub(crate) fn direction(index: u32) -> DVec3 {
    let z = 2.0 * unit(index, 8) - 1.0;
    let turn = std::f64::consts::TAU * unit(index, 9);
    let ring = (1.0 - z * z).sqrt();
    DVec3::new(ring * turn.cos(), ring * turn.sin(), z)
}

/// Mean of the scalar product of two fields at the same indices, over the root of the product of
/// their mean squares.
pub(crate) fn correlation(count: u32, pair: impl Fn(u32) -> (DVec3, DVec3)) -> f64 {
    let (mut product, mut one, mut other) = (0.0, 0.0, 0.0);
    for (a, b) in (0..count).map(pair) {
        product += a.dot(b);
        one += a.length_squared();
        other += b.length_squared();
    }
    product / f64::sqrt(one * other)
}
