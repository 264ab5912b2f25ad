// bear: how many systems each system asks for in this frame.
//
// Reeves 1983, 2.6: as many as its births say (motes::births). Section 3: rings that run over a
// sphere bear one ring each so many frames, as many systems as its density and circumference say.
// One invocation a slot, for each step of the tree.
// Reads: frame, system_frames, broods, nodes. Writes: system_births.
// Invariant: a count depends on the system, the view and the frame alone; those at other steps of
// the tree, and those that stand for their kind, bear none.

#import motes::births::{MOST_BIRTHS, births_of}
#import motes::exact::{f32_of_u32, less, to_i32}
#import motes::layout::{
    BROOD_BURSTS, Brood, Frame, NODE_LIVES, NO_SLOT, Node, SYSTEM_BEARS_SYSTEMS, SystemFrame,
}
#import motes::transcendental::sin_turns

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Step {
    level: u32,
}
var<immediate> step: Step;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> broods: array<Brood>;
@group(0) @binding(3) var<storage, read> nodes: array<Node>;
@group(0) @binding(4) var<storage, read_write> system_births: array<u32>;

// Systems of the ring that begins `frames` frames after its parent: none between rings, nor where
// the rings have met on the other side.
fn of_ring(brood: Brood, frames: u32) -> u32 {
    let distance = f32_of_u32(frames) * brood.rings.y;
    let turns = distance * brood.rings.w;
    if frames % brood.spans.w != 0u || less(0.5f, turns) {
        return 0u;
    }
    // The circumference is 2 pi radius sin(distance / radius).
    let circumference = sin_turns(turns) * 6.2831855f * brood.rings.x;
    return u32(min(max(to_i32(brood.rings.z * circumference + 0.5f), 0), MOST_BIRTHS));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn bear(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let slot = global_id.x;
    if slot >= frame.system_count {
        return;
    }
    let is_own = slot < frame.own_system_count;
    var like_slot = slot;
    var birth_frame = 0u;
    var state = NODE_LIVES;
    if !is_own {
        let node = nodes[slot - frame.own_system_count];
        like_slot = min(node.who.z, frame.own_system_count - 1u);
        birth_frame = node.who.y;
        state = node.spans.x;
    }
    let brood = broods[like_slot];
    var count = 0u;
    // Of the scene's own, only those without a parent bear: others stand for those that are born.
    let bears = (system_frames[slot].flags & SYSTEM_BEARS_SYSTEMS) != 0u
        && state == NODE_LIVES
        && brood.ties.y == step.level
        && is_own == (brood.ties.x == NO_SLOT);
    if bears {
        count = births_of(frame, system_frames[slot]);
        let since = frame.frame - birth_frame - brood.spans.x;
        let has_begun = bitcast<i32>(since) >= 0;
        let has_ended = brood.spans.y != NO_SLOT
            && bitcast<i32>(frame.frame - birth_frame - brood.spans.y) >= 0;
        if brood.spans.w != 0u && has_begun && !has_ended {
            count += of_ring(brood, since);
        }
    }
    system_births[slot] = count;
}
