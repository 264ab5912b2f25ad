//! settle: which slots newborn systems get, and which are free again. Plain Rust, so that it is no
//! translation of `wgsl/tree/settle.wgsl`.

use crate::layout::{Counts, NODE_FREE, NODE_LINGERS, NODE_LIVES, Node};

/// A system that is to be founded: its place among those borne, its parent's slot, and its index
/// among the parent's births.
#[derive(Clone, Copy, Debug)]
pub(super) struct Newborn {
    pub(super) at: usize,
    pub(super) parent_slot: u32,
    pub(super) index: u32,
}

/// Ends and frees what is over, once a frame, and finds room for the births by slot.
pub(super) fn settle(
    nodes: &mut [Node],
    counts: &mut Counts,
    births: &[u32],
    frame: u32,
    level: u32,
) -> Vec<Newborn> {
    if level == 0 {
        let has_come = |at: u32| frame.wrapping_sub(at).cast_signed() >= 0;
        let mut died = 0;
        for node in nodes.iter_mut() {
            if node.spans[0] == NODE_LIVES && has_come(node.who[1].wrapping_add(node.spans[1])) {
                node.spans[0] = NODE_LINGERS;
                died += 1;
            }
            if node.spans[0] != NODE_FREE && has_come(node.spans[2]) {
                *node = Node::default();
            }
        }
        *counts = Counts {
            live: counts.live - died,
            died,
            ..Counts::default()
        };
    }
    let wanted = births
        .iter()
        .zip(0..)
        .flat_map(|(count, parent_slot)| (0..*count).map(move |index| (parent_slot, index)));
    let free = (0..nodes.len()).filter(|at| nodes[*at].spans[0] == NODE_FREE);
    let newborn: Vec<Newborn> = free
        .zip(wanted)
        .map(|(at, (parent_slot, index))| Newborn {
            at,
            parent_slot,
            index,
        })
        .collect();
    let requested = births
        .iter()
        .fold(0u32, |sum, count| sum.saturating_add(*count));
    let born = newborn.len() as u32;
    counts.requested += requested;
    counts.born += born;
    counts.dropped += requested - born;
    counts.live += born;
    counts.total = counts.live;
    counts.spare_a = born;
    newborn
}
