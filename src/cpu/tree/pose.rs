//! pose: where a borne system is, what it asks for, and the row of its newborn (Reeves 1983, 2.6).
//! Twin of `wgsl/tree/pose.wgsl`.

use glam::Vec3;

use super::inherit::{Origins, births_at, own_row};
use super::{IDENTITY, Rows, Tree, composed, gone_on, own_numbers};
use crate::cpu::emission::turned;
use crate::cpu::particle::row_index;
use crate::exact::{at_least_zero, f32_of_u32, snap};
use crate::layout::{
    BROOD_OWN_ACCELERATION, BROOD_WORLD_SPACE, Brood, NODE_FREE, NODE_LIVES, Node, Pose,
    SystemFrame, SystemRow,
};
use crate::plan::FrameInputs;

fn rows_unless(is_identity: bool, rows: Rows) -> Rows {
    if is_identity { IDENTITY } else { rows }
}

/// Puts the system at place `at` among those borne where it is in the frame of `inputs`.
pub(super) fn pose(
    tree: &mut Tree,
    at: usize,
    inputs: &FrameInputs,
    rows: &mut [SystemRow],
    level: u32,
) {
    let node = tree.nodes[at];
    let slot = inputs.systems.len() + at;
    if node.spans[0] == NODE_FREE {
        tree.systems[at] = SystemFrame::default();
        return;
    }
    let [key, birth_frame, like_slot, parent_slot] = node.who;
    let brood = &inputs.broods[like_slot as usize];
    if brood.ties[1] != level + 1 {
        return;
    }
    let frame = &inputs.frame;
    let age = frame.frame.wrapping_sub(birth_frame);
    let parent_brood = &inputs.broods[brood.ties[0] as usize];
    let above = tree.poses[parent_slot as usize];
    let pose = posed(
        &node,
        &above,
        &tree.poses[like_slot as usize],
        parent_brood,
        (age, frame.shutter),
    );
    tree.poses[slot] = pose;

    let own = own_numbers(key, 0).to_array();
    let scale = at_least_zero(1.0 + brood.spread[2] * own[2]);
    let row_of = |slot: u32| row_index(slot, frame.frame, frame.row_mask);
    rows[row_of(slot as u32)] = own_row(
        key,
        &Origins {
            kind: &rows[row_of(like_slot)],
            spread: &inputs.row_spreads[like_slot as usize],
            parent: &rows[row_of(parent_slot)],
            parent_kind: &rows[row_of(brood.ties[0])],
        },
        scale,
    );

    let lives = if node.spans[0] == NODE_LIVES {
        1.0
    } else {
        0.0
    };
    let births = births_at(brood, own, age).map(|births| snap(births * lives));
    tree.systems[at] = SystemFrame {
        key,
        mean_parts: births[0],
        var_parts: births[1],
        burst_parts: births[2],
        burst_var: births[3],
        ..placed(&inputs.systems[like_slot as usize], brood, &pose, scale)
    };
}

/// The node's pose under that of its parent; `own` is that of its kind.
fn posed(
    node: &Node,
    above: &Pose,
    own: &Pose,
    parent: &Brood,
    (age, shutter): (u32, f32),
) -> Pose {
    let stays = parent.ties[2] & BROOD_WORLD_SPACE != 0;
    let floats = |bits: [u32; 4]| bits.map(f32::from_bits);
    let place = [node.place_x, node.place_y, node.place_z].map(floats);
    let (velocity, acceleration) = (floats(node.velocity), floats(node.acceleration));
    let frames = f32_of_u32(age);
    let at = |above: Rows, own: Rows, frames: f32| {
        composed(
            rows_unless(stays, above),
            composed(gone_on(place, velocity, acceleration, frames), own),
        )
    };
    let [now_x, now_y, now_z] = at(
        [above.now_x, above.now_y, above.now_z],
        [own.now_x, own.now_y, own.now_z],
        frames,
    );
    let [earlier_x, earlier_y, earlier_z] = at(
        [above.earlier_x, above.earlier_y, above.earlier_z],
        [own.earlier_x, own.earlier_y, own.earlier_z],
        at_least_zero(frames - 1.0),
    );
    let [closing_x, closing_y, closing_z] = at(
        [above.closing_x, above.closing_y, above.closing_z],
        [own.closing_x, own.closing_y, own.closing_z],
        frames + shutter,
    );
    Pose {
        now_x,
        now_y,
        now_z,
        earlier_x,
        earlier_y,
        earlier_z,
        closing_x,
        closing_y,
        closing_z,
    }
}

/// The frame of a system like `kind` at that pose.
fn placed(kind: &SystemFrame, brood: &Brood, pose: &Pose, scale: f32) -> SystemFrame {
    let now = [pose.now_x, pose.now_y, pose.now_z];
    let in_world = brood.ties[2] & BROOD_WORLD_SPACE != 0;
    let world = rows_unless(in_world, now);
    let closing = rows_unless(in_world, [pose.closing_x, pose.closing_y, pose.closing_z]);
    let of_birth = rows_unless(!in_world, now);
    let earlier = rows_unless(!in_world, [pose.earlier_x, pose.earlier_y, pose.earlier_z]);
    let given = Vec3::from_slice(&brood.acceleration);
    let [x, y, z] = world.map(|row| Vec3::from_slice(&row));
    let pull = if brood.ties[2] & BROOD_OWN_ACCELERATION != 0 {
        turned(of_birth, given)
    } else {
        x * given.x + y * given.y + z * given.z
    };
    let [sx, sy, sz, radius] = brood.bounding_sphere;
    let [cx, cy, cz] = now.map(|row| row[0] * sx + row[1] * sy + row[2] * sz + row[3]);
    SystemFrame {
        world_from_system_x: world[0],
        world_from_system_y: world[1],
        world_from_system_z: world[2],
        closing_world_from_system_x: closing[0],
        closing_world_from_system_y: closing[1],
        closing_world_from_system_z: closing[2],
        earlier_system_from_birth_x: earlier[0],
        earlier_system_from_birth_y: earlier[1],
        earlier_system_from_birth_z: earlier[2],
        system_from_birth_x: of_birth[0],
        system_from_birth_y: of_birth[1],
        system_from_birth_z: of_birth[2],
        acceleration: [pull.x, pull.y, pull.z, brood.acceleration[3]].map(snap),
        bounding_sphere: [cx, cy, cz, radius * scale].map(snap),
        ..*kind
    }
}
