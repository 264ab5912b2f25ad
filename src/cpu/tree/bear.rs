//! bear: how many systems each system asks for (Reeves 1983, 2.6 and 3). Twin of
//! `wgsl/tree/bear.wgsl`.

use crate::cpu::systems::births::{MOST_BIRTHS, births_of};
use crate::exact::{f32_of_u32, less, to_i32};
use crate::layout::{Brood, NO_SLOT, NODE_LIVES, Node, SYSTEM_BEARS_SYSTEMS, SystemFrame};
use crate::plan::FrameInputs;
use crate::transcendental::sin_turns;

/// Systems of the ring that begins `frames` frames after its parent.
fn of_ring(brood: &Brood, frames: u32) -> u32 {
    let [radius, speed, density, turns_a_unit] = brood.rings;
    let distance = f32_of_u32(frames) * speed;
    let turns = distance * turns_a_unit;
    if !frames.is_multiple_of(brood.spans[3]) || less(0.5, turns) {
        return 0;
    }
    let circumference = sin_turns(turns) * std::f32::consts::TAU * radius;
    to_i32(density * circumference + 0.5).clamp(0, MOST_BIRTHS) as u32
}

/// Births of systems by slot, of those that stand `level` steps from a root.
pub(super) fn bear(
    inputs: &FrameInputs,
    borne: &[SystemFrame],
    nodes: &[Node],
    level: u32,
) -> Vec<u32> {
    let frame = &inputs.frame;
    let own = inputs.systems.iter().zip(&inputs.broods);
    let own = own.map(|(system, brood)| (system, brood, 0, brood.ties[0] == NO_SLOT));
    let others = borne.iter().zip(nodes).map(|(system, node)| {
        let brood = &inputs.broods[(node.who[2] as usize).min(inputs.broods.len() - 1)];
        (system, brood, node.who[1], node.spans[0] == NODE_LIVES)
    });
    own.chain(others)
        .map(|(system, brood, birth_frame, may)| {
            if system.flags & SYSTEM_BEARS_SYSTEMS == 0 || !may || brood.ties[1] != level {
                return 0;
            }
            let mut count = births_of(system, frame);
            let age = frame.frame.wrapping_sub(birth_frame);
            let since = age.wrapping_sub(brood.spans[0]);
            let has_begun = since.cast_signed() >= 0;
            let has_ended =
                brood.spans[1] != NO_SLOT && age.wrapping_sub(brood.spans[1]).cast_signed() >= 0;
            if brood.spans[3] != 0 && has_begun && !has_ended {
                count += of_ring(brood, since);
            }
            count
        })
        .collect()
}
