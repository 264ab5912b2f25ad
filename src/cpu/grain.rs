//! How much of its grain is at a place of wood, or of what else has some (Perry 1994, 4.4). Twin of
//! `wgsl/lib/grain.wgsl`.

use glam::Vec3;

use crate::exact::{dot3, floor_exact, less, square_root};
use crate::layout::{GRAIN_NONE, GRAIN_RINGS};
use crate::noise::noise;

/// 0 where there is none, 1 where it is densest.
#[inline]
pub fn grain_at([kind, key]: [u32; 2], grain: &[f32; 4], shape: &[f32; 4], place: Vec3) -> f32 {
    if kind == GRAIN_NONE {
        return 0.0;
    }
    let direction = Vec3::from_slice(grain);
    let along = dot3(place, direction);
    let across = place - direction * along;
    let is_ring = kind == GRAIN_RINGS;
    let far = if is_ring {
        square_root(dot3(across, across))
    } else {
        along
    };
    let phase = far * grain[3] + noise(place * shape[2], key).w * shape[1];
    let part = phase - floor_exact(phase);
    if is_ring {
        (part * 2.0 - 1.0).abs()
    } else if less(part, 0.5) {
        0.0
    } else {
        1.0
    }
}
