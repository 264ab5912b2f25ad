//! cull: who lives on (Reeves 1983, 2.4). Twin of `wgsl/particles/cull.wgsl`.

use crate::cpu::particle::{appearance_of, identity_of, intensity_of, lifetime_of, row_index};
use crate::exact::less;
use crate::layout::{Particle, SystemRow};
use crate::plan::FrameInputs;

/// Whether the particle lives through the frame of `inputs`.
#[inline]
pub fn survives(particle: &Particle, inputs: &FrameInputs, rows: &[SystemRow]) -> bool {
    let (who, age) = identity_of(particle, inputs);
    let row = &rows[row_index(particle.slot(), who.birth_frame, inputs.frame.row_mask)];
    if age >= lifetime_of(who, row.speed_and_lifetime) {
        return false;
    }
    let threshold = row.size_and_threshold[3];
    if less(threshold, 0.0) {
        return true;
    }
    !less(intensity_of(&appearance_of(who, row, age + 1)), threshold)
}
