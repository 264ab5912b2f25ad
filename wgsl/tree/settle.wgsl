// settle: which slots the systems get that are born in this frame, and which are free again.
//
// One invocation in all, for each step of the tree: systems are few. A slot never moves; it is freed
// when nothing that its system has borne can live any more.
// Reads: frame, system_births. Writes: nodes, system_offsets, free_slots, tree_counts.
// Invariant: born + dropped = requested; the k-th that is born gets the k-th free slot, so slots
// depend on what is born alone; what does not fit are the last ones, and they are counted.

#import motes::layout::{Counts, Frame, NODE_FREE, NODE_LINGERS, NODE_LIVES, Node}

struct Step {
    level: u32,
}
var<immediate> step: Step;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_births: array<u32>;
@group(0) @binding(2) var<storage, read_write> nodes: array<Node>;
@group(0) @binding(3) var<storage, read_write> system_offsets: array<u32>;
@group(0) @binding(4) var<storage, read_write> free_slots: array<u32>;
@group(0) @binding(5) var<storage, read_write> tree_counts: Counts;

@compute @workgroup_size(1)
fn settle() {
    let room = frame.system_count - frame.own_system_count;
    if step.level == 0u {
        var died = 0u;
        for (var at = 0u; at < room; at += 1u) {
            let spans = nodes[at].spans;
            let age = frame.frame - nodes[at].who.y;
            if spans.x == NODE_LIVES && age >= spans.y {
                nodes[at].spans.x = NODE_LINGERS;
                died += 1u;
            }
            if spans.x != NODE_FREE && bitcast<i32>(frame.frame - spans.z) >= 0 {
                nodes[at] = Node();
            }
        }
        tree_counts.live -= died;
        tree_counts.died = died;
        tree_counts.requested = 0u;
        tree_counts.born = 0u;
        tree_counts.dropped = 0u;
    }
    var requested = 0u;
    for (var slot = 0u; slot < frame.system_count; slot += 1u) {
        system_offsets[slot] = requested;
        let next = requested + system_births[slot];
        requested = select(next, 0xffffffffu, next < requested);
    }
    system_offsets[frame.system_count] = requested;
    var born = 0u;
    for (var at = 0u; at < room && born < requested; at += 1u) {
        if nodes[at].spans.x == NODE_FREE {
            free_slots[born] = at;
            born += 1u;
        }
    }
    // What is born at this step of the tree, for the kernel that founds it.
    tree_counts.spare_a = born;
    tree_counts.requested += requested;
    tree_counts.born += born;
    tree_counts.dropped += requested - born;
    tree_counts.live += born;
    tree_counts.total = tree_counts.live;
}
