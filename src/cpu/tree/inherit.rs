//! What a borne system has of its kind, of its parent and of its own (Reeves 1983, 2.6 and 3). Twin
//! of `wgsl/lib/inherit.wgsl`.

use super::{own_numbers, polynomial};
use crate::cpu::particle::LEAST_SIZE;
use crate::exact::{at_least_zero, clamp_exact, clamp_unit, less, max_exact, snap, to_i32};
use crate::layout::{
    BROOD_BURSTS, BROOD_SHRINKS, Brood, NO_SLOT, SHAPE_CURVE, SHAPE_MESH, SHAPE_RING, SystemRow,
};
use crate::transcendental::cos_turns;

/// What a row is made from.
pub(super) struct Origins<'a> {
    /// The row of those like it.
    pub(super) kind: &'a SystemRow,
    /// Half-widths of what differs among them.
    pub(super) spread: &'a SystemRow,
    /// The row of its parent.
    pub(super) parent: &'a SystemRow,
    /// The row of those like its parent.
    pub(super) parent_kind: &'a SystemRow,
}

/// The row of a kind, with what this system has of its own and from its parent; `scale` is of its
/// generation shape.
pub(super) fn own_row(key: u32, origins: &Origins, scale: f32) -> SystemRow {
    let Origins {
        kind,
        spread,
        parent,
        parent_kind,
    } = *origins;
    let mut row = *kind;
    let shape = kind.kinds[0];
    let is_stored = shape == SHAPE_CURVE || shape == SHAPE_MESH;
    let rest = if is_stored { 1.0 } else { scale };
    let [x, y, z, w] = kind.shape;
    let last = if shape == SHAPE_RING { w * rest } else { w };
    row.shape = [x * scale, y * rest, z * rest, last].map(snap);
    let own = |which: u32| own_numbers(key, which).to_array();
    let light = own(1);
    let [_, turns, distance, size_rate] = kind.ejection_and_light;
    let turns = clamp_exact(turns + spread.ejection_and_light[1] * light[1], 0.0, 0.5);
    row.ejection_and_light = [
        cos_turns(turns),
        turns,
        distance,
        at_least_zero(size_rate + spread.ejection_and_light[3] * light[3]),
    ]
    .map(snap);
    // Of its kind and its own; where it inherits, of its parent too.
    let varied = |of: fn(&SystemRow) -> [f32; 4], which: u32| -> [f32; 4] {
        let (kind, spread, own) = (of(kind), of(spread), own(which));
        std::array::from_fn(|i| kind[i] + spread[i] * own[i])
    };
    let inherited = |of: fn(&SystemRow) -> [f32; 4], which: u32| -> [f32; 4] {
        let (varied, parent, like_parent) = (varied(of, which), of(parent), of(parent_kind));
        std::array::from_fn(|i| varied[i] + (parent[i] - like_parent[i]))
    };
    let [speed, speed_var, life, life_var] = varied(|row| row.speed_and_lifetime, 2);
    row.speed_and_lifetime = [
        speed,
        at_least_zero(speed_var),
        life,
        at_least_zero(life_var),
    ]
    .map(snap);
    let [size, size_var, rate, _] = inherited(|row| row.size_and_threshold, 3);
    row.size_and_threshold = [
        max_exact(size, LEAST_SIZE),
        at_least_zero(size_var),
        rate,
        kind.size_and_threshold[3],
    ]
    .map(snap);
    let [red, green, blue, clear] = inherited(|row| row.color_mean, 4);
    row.color_mean = [
        at_least_zero(red),
        at_least_zero(green),
        at_least_zero(blue),
        clamp_unit(clear),
    ]
    .map(snap);
    row.color_var = inherited(|row| row.color_var, 5).map(|x| snap(at_least_zero(x)));
    row.color_rate = inherited(|row| row.color_rate, 6).map(snap);
    row.color_rate_var = inherited(|row| row.color_rate_var, 7).map(|x| snap(at_least_zero(x)));
    row
}

/// Mean births and their half-width, bursts and theirs, at an age.
pub(super) fn births_at(brood: &Brood, own: [f32; 4], age: u32) -> [f32; 4] {
    let mut births = [0.0; 4];
    let has_ended = brood.spans[1] != NO_SLOT && age >= brood.spans[1];
    if age >= brood.spans[0] && !has_ended {
        let since = age - brood.spans[0];
        let mean = polynomial(brood.mean_parts, since);
        let shrunk = brood.ties[2] & BROOD_SHRINKS != 0 && !less(0.0, mean);
        if !shrunk {
            births[0] = mean + brood.spread[0] * own[0];
            let var_parts = polynomial(brood.var_parts, since) + brood.spread[1] * own[1];
            births[1] = at_least_zero(var_parts);
        }
    }
    if brood.ties[2] & BROOD_BURSTS != 0 && to_i32(brood.burst[2]) as u32 == age {
        births[2] = brood.burst[0];
        births[3] = brood.burst[1];
    }
    births
}
