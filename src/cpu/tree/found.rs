//! found: a system that is born (Reeves 1983, 2.6 and 3). Twin of `wgsl/tree/found.wgsl`.

use glam::{UVec4, Vec3};

use super::settle::Newborn;
use super::{STREAM_SYSTEM, composed};
use crate::cpu::emission::{Birthplace, axis_of, basis_of, ejected, turned};
use crate::cpu::particle::{Identity, STREAM_MOTION, STREAM_PLACE, draw, lifetime_of, row_index};
use crate::cpu::particles::emit::{Stored, birthplace};
use crate::exact::{bits_of, f32_of_u32};
use crate::layout::{
    BROOD_OUTWARD, Brood, NO_SLOT, NODE_LIVES, Node, SHAPE_RINGS, SystemFrame, SystemRow,
};
use crate::plan::FrameInputs;
use crate::rng::{pcg4d, signed_float, unit_float};
use crate::transcendental::{cos_turns, sin_turns};

/// On the ring that begins now: the sphere touches the parent's x-y plane from below.
fn on_ring(brood: &Brood, frames: u32, place: UVec4) -> Birthplace {
    let [radius, speed, _, turns_a_unit] = brood.rings;
    let turns = f32_of_u32(frames) * speed * turns_a_unit;
    let around = unit_float(place.y);
    let across = sin_turns(turns);
    let axis = Vec3::new(
        across * cos_turns(around),
        across * sin_turns(around),
        cos_turns(turns),
    );
    Birthplace {
        position: axis * radius - Vec3::new(0.0, 0.0, radius),
        axis,
    }
}

/// The newborn system; `borne` and `nodes` are of those from the first borne slot on.
pub(super) fn found(
    inputs: &FrameInputs,
    stored: Stored<'_>,
    borne: &[SystemFrame],
    rows: &[SystemRow],
    nodes: &[Node],
    newborn: &Newborn,
) -> Node {
    let frame = inputs.frame.frame;
    let parent_slot = newborn.parent_slot;
    let own = inputs.systems.len();
    let (parent, kind, birth_frame) = match (parent_slot as usize).checked_sub(own) {
        None => (&inputs.systems[parent_slot as usize], parent_slot, 0),
        Some(at) => (&borne[at], nodes[at].who[2], nodes[at].who[1]),
    };
    let brood = &inputs.broods[kind as usize];
    let child_slot = brood.ties[3];
    let child = &inputs.broods[child_slot as usize];
    let row = &rows[row_index(parent_slot, frame, inputs.frame.row_mask)];
    let who = Identity {
        key: parent.key,
        birth_frame: frame,
        index: newborn.index,
    };
    let place = draw(who, STREAM_PLACE);
    let motion = draw(who, STREAM_MOTION);

    let born = if row.kinds[0] == SHAPE_RINGS {
        let since = frame.wrapping_sub(birth_frame).wrapping_sub(brood.spans[0]);
        on_ring(brood, since, place)
    } else {
        birthplace(row, stored, place)
    };
    let speed = row.speed_and_lifetime[0] + signed_float(motion.z) * row.speed_and_lifetime[1];
    let way = ejected(row, axis_of(row, &born), motion) * speed;
    let birth_rows = [
        parent.system_from_birth_x,
        parent.system_from_birth_y,
        parent.system_from_birth_z,
    ];
    let velocity = turned(birth_rows, way);
    let up = if child.ties[2] & BROOD_OUTWARD != 0 {
        born.axis
    } else {
        Vec3::Z
    };
    let (across, upward) = basis_of(up);
    let local = [0, 1, 2].map(|i| [across[i], upward[i], up[i], born.position[i]]);
    let rows_of_birth = composed(birth_rows, local);
    let lifetime = lifetime_of(who, row.speed_and_lifetime);
    let bears = if child.spans[1] == NO_SLOT {
        lifetime
    } else {
        lifetime.min(child.spans[1])
    };
    let bits = |row: [f32; 4]| row.map(bits_of);
    let [a0, a1, a2, _] = parent.acceleration;
    Node {
        who: [
            pcg4d(UVec4::new(parent.key, frame, newborn.index, STREAM_SYSTEM)).x,
            frame,
            child_slot,
            parent_slot,
        ],
        spans: [
            NODE_LIVES,
            lifetime,
            frame.wrapping_add(bears).wrapping_add(child.spans[2]),
            newborn.index,
        ],
        velocity: bits([velocity.x, velocity.y, velocity.z, 0.0]),
        acceleration: bits([a0, a1, a2, 0.0]),
        place_x: bits(rows_of_birth[0]),
        place_y: bits(rows_of_birth[1]),
        place_z: bits(rows_of_birth[2]),
    }
}
