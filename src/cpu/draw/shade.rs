//! shade: how much of the light comes to each part of a cloud, through what is before it (Reeves 1983, 5).
//! Twin of `wgsl/draw/deposit.wgsl` and `wgsl/draw/shade.wgsl`.

use std::sync::atomic::{AtomicU32, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use crate::cpu::particle::{appearance_of, identity_of, row_index};
use crate::cpu::projection::world_of;
use crate::cpu::shade::{around, corner_share, depth_of, place_of};
use crate::exact::{bits_of, f32_of_u32, shared_constants, to_i32};
use crate::layout::{Particle, ROW_LIT_CLOUD, ROW_OVER, ROW_SOFTNESS_SHIFT, SystemRow};
use crate::plan::FrameInputs;
use crate::transcendental::exp2_exact;

shared_constants! {
    /// More counts as that.
    const MOST_TAKEN: u32 = 4_194_304;
    /// Half a 65,536th of the logarithm of e to the base 2, below 0.
    const EXPONENT_STEP: f32 = -1.10068895e-05;
}

/// What particles take of the light, in 65,536ths.
pub fn deposit(particles: &[Particle], inputs: &FrameInputs, rows: &[SystemRow]) -> Vec<u32> {
    let shade_box = &inputs.shade_boxes[0];
    let cells = shade_box.kinds[0] as usize;
    let sums: Vec<AtomicU32> = (0..cells.pow(3)).map(|_| AtomicU32::new(0)).collect();
    particles
        .par_iter()
        .with_min_len(1024)
        .for_each(|particle| {
            let (who, age) = identity_of(particle, inputs);
            let row = &rows[row_index(particle.slot(), who.birth_frame, inputs.frame.row_mask)];
            if row.kinds[3] & ROW_OVER == 0 || row.kinds[3] & ROW_LIT_CLOUD == 0 {
                return;
            }
            let look = appearance_of(who, row, age + 1);
            let edge = row.kinds[3] >> ROW_SOFTNESS_SHIFT;
            let depth = depth_of(look.size, 1.0 - look.transparency, edge, shade_box);
            let system = &inputs.systems[particle.slot() as usize];
            let near = around(shade_box, world_of(system, Vec3::from(particle.position())));
            for corner in 0..8 {
                if let Some(at) = place_of(shade_box, near.cell, corner) {
                    let share = depth * corner_share(near.part, corner);
                    let steps = to_i32(share * 65536.0 + 0.5).max(0).cast_unsigned();
                    sums[at].fetch_add(steps, Ordering::Relaxed);
                }
            }
        });
    sums.into_iter().map(AtomicU32::into_inner).collect()
}

/// How much of the light comes to the cells, 0 to 1, as bits.
pub fn shade(sums: &[u32], cells: usize) -> Vec<u32> {
    let mut light = vec![0; sums.len()];
    for column in 0..cells * cells {
        let mut taken = 0;
        for at in (column..sums.len()).step_by(cells * cells) {
            let own = sums[at].min(MOST_TAKEN);
            let twice = (2 * taken + own).min(2 * MOST_TAKEN);
            light[at] = bits_of(exp2_exact(f32_of_u32(twice) * EXPONENT_STEP));
            taken = (taken + own).min(MOST_TAKEN);
        }
    }
    light
}
