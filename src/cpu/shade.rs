//! Shadows that clouds throw on themselves: a box of cells along the light. Twin of `wgsl/lib/shade.wgsl`,
//! line by line; see there.

use glam::Vec3;

use crate::cpu::reach::PI;
use crate::exact::{dot3, f32_of_i32, f32_of_u32, min_exact, shared_constants, to_i32};
use crate::layout::ShadeBox;

shared_constants! {
    /// A 65,535th.
    const EDGE_STEP: f32 = 0.000_015_259_022;
    /// One particle takes no more of a cell.
    const MOST_DEPTH: f32 = 64.0;
}

/// The first of the eight cells whose middles are around a place, and how far it is from there to the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Around {
    /// Across, aside and along.
    pub cell: [i32; 3],
    /// 0 to 1 each.
    pub part: [f32; 3],
}

/// The cells around a world place.
pub fn around(shade_box: &ShadeBox, world: Vec3) -> Around {
    let rows = [shade_box.across, shade_box.aside, shade_box.along];
    let place = rows.map(|row| dot3(Vec3::from_slice(&row), world) + row[3] - 0.5);
    let cell = place.map(to_i32);
    Around {
        cell,
        part: [0, 1, 2].map(|i| place[i] - f32_of_i32(cell[i])),
    }
}

/// The place of a cell among all, if it is one.
pub fn place_of(shade_box: &ShadeBox, cell: [i32; 3], corner: u32) -> Option<usize> {
    let cells = shade_box.kinds[0] as i32;
    let bits = [corner & 1, (corner >> 1) & 1, corner >> 2];
    let [x, y, z] = [0, 1, 2].map(|i| cell[i].wrapping_add(bits[i] as i32));
    let is_cell = [x, y, z].iter().all(|at| (0..cells).contains(at));
    is_cell.then(|| ((z * cells + y) * cells + x) as usize)
}

/// The share of one of the eight.
pub fn corner_share(part: [f32; 3], corner: u32) -> f32 {
    let share = |axis: usize| {
        if corner >> axis & 1 != 0 {
            part[axis]
        } else {
            1.0 - part[axis]
        }
    };
    share(0) * share(1) * share(2)
}

/// What a disc of that radius and opacity, with an edge of so many 65,535ths of its radius, takes of a
/// cell's cross-section.
pub fn depth_of(size: f32, opacity: f32, edge: u32, shade_box: &ShadeBox) -> f32 {
    let soft = f32_of_u32(edge) * EDGE_STEP;
    let mean = 1.0 - soft + 0.3 * soft * soft;
    let depth = PI * size * size * opacity * mean * shade_box.look[0];
    min_exact(depth, MOST_DEPTH)
}

/// How much of the light comes to a world place: all of it outside the box.
pub fn light_at(shade_box: &ShadeBox, light: &[u32], world: Vec3) -> f32 {
    let near = around(shade_box, world);
    let mut sum = 0.0;
    for corner in 0..8 {
        let here = match place_of(shade_box, near.cell, corner) {
            Some(at) => f32::from_bits(light[at]),
            None => 1.0,
        };
        sum += here * corner_share(near.part, corner);
    }
    sum
}
