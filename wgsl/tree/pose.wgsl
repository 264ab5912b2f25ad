// pose: where each borne system is in this frame, what it asks for, and the row of its newborn.
//
// Reeves 1983, 2.6: a parent that moves or turns carries its descendants; each child's parameters
// are those of its kind, and differ by what it drew at its birth. What its parent has of colour,
// transparency and size beyond the parent's own kind, it has, too.
// One invocation a slot that others bear, for each step of the tree.
// Reads: frame, broods, row_spreads, nodes. Writes: poses, system_frames, rows.
// Invariant: from nodes and the frame's inputs alone; where nobody is, nothing is born.

#import motes::exact::{at_least_zero, f32_of_u32, snap, snap4}
#import motes::inherit::{births_at, own_row}
#import motes::layout::{
    BROOD_OWN_ACCELERATION, BROOD_WORLD_SPACE, Brood, Frame, NODE_FREE, NODE_LIVES, Node, Pose,
    SystemFrame, SystemRow,
}
#import motes::particle::row_index
#import motes::tree::{Rows, composed, gone_on, own_numbers, rows_unless}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Step {
    level: u32,
}
var<immediate> step: Step;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> broods: array<Brood>;
@group(0) @binding(2) var<storage, read> row_spreads: array<SystemRow>;
@group(0) @binding(3) var<storage, read> nodes: array<Node>;
@group(0) @binding(4) var<storage, read_write> poses: array<Pose>;
@group(0) @binding(5) var<storage, read_write> system_frames: array<SystemFrame>;
@group(0) @binding(6) var<storage, read_write> rows: array<SystemRow>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn pose(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let at = global_id.x;
    let slot = frame.own_system_count + at;
    if slot >= frame.system_count {
        return;
    }
    let node = nodes[at];
    if node.spans.x == NODE_FREE {
        system_frames[slot] = SystemFrame();
        return;
    }
    let like_slot = node.who.z;
    let parent_slot = node.who.w;
    let brood = broods[like_slot];
    if brood.ties.y != step.level + 1u {
        return;
    }
    let own_pose = poses[like_slot];
    let above = poses[parent_slot];
    let parent_brood = broods[brood.ties.x];
    let stays = (parent_brood.ties.z & BROOD_WORLD_SPACE) != 0u;
    let place = Rows(
        bitcast<vec4<f32>>(node.place_x),
        bitcast<vec4<f32>>(node.place_y),
        bitcast<vec4<f32>>(node.place_z),
    );
    let velocity = bitcast<vec4<f32>>(node.velocity);
    let acceleration = bitcast<vec4<f32>>(node.acceleration);
    let age = frame.frame - node.who.y;
    let frames = f32_of_u32(age);
    let now = composed(
        rows_unless(stays, Rows(above.now_x, above.now_y, above.now_z)),
        composed(
            gone_on(place, velocity, acceleration, frames),
            Rows(own_pose.now_x, own_pose.now_y, own_pose.now_z),
        ),
    );
    let earlier = composed(
        rows_unless(stays, Rows(above.earlier_x, above.earlier_y, above.earlier_z)),
        composed(
            gone_on(place, velocity, acceleration, at_least_zero(frames - 1.0f)),
            Rows(own_pose.earlier_x, own_pose.earlier_y, own_pose.earlier_z),
        ),
    );
    let closing = composed(
        rows_unless(stays, Rows(above.closing_x, above.closing_y, above.closing_z)),
        composed(
            gone_on(place, velocity, acceleration, frames + frame.shutter),
            Rows(own_pose.closing_x, own_pose.closing_y, own_pose.closing_z),
        ),
    );
    poses[slot] = Pose(
        now.x, now.y, now.z, earlier.x, earlier.y, earlier.z, closing.x, closing.y, closing.z,
    );

    let key = node.who.x;
    let own = own_numbers(key, 0u);
    let scale = at_least_zero(1.0f + brood.spread.z * own.z);
    let mask = frame.row_mask;
    rows[row_index(slot, frame.frame, mask)] = own_row(
        key,
        rows[row_index(like_slot, frame.frame, mask)],
        row_spreads[like_slot],
        rows[row_index(parent_slot, frame.frame, mask)],
        rows[row_index(brood.ties.x, frame.frame, mask)],
        scale,
    );

    let in_world = (brood.ties.z & BROOD_WORLD_SPACE) != 0u;
    let world = rows_unless(in_world, now);
    let closing_world = rows_unless(in_world, closing);
    let of_birth = rows_unless(!in_world, now);
    let earlier_of_birth = rows_unless(!in_world, earlier);
    // What is given in the world is turned into the space of the particles, or the other way.
    let given = brood.acceleration.xyz;
    let turned_back = world.x.xyz * given.x + world.y.xyz * given.y + world.z.xyz * given.z;
    let turned = vec3<f32>(
        of_birth.x.x * given.x + of_birth.x.y * given.y + of_birth.x.z * given.z,
        of_birth.y.x * given.x + of_birth.y.y * given.y + of_birth.y.z * given.z,
        of_birth.z.x * given.x + of_birth.z.y * given.y + of_birth.z.z * given.z,
    );
    let pull = select(turned_back, turned, (brood.ties.z & BROOD_OWN_ACCELERATION) != 0u);
    let sphere = brood.bounding_sphere;
    let births = births_at(brood, own, age)
        * select(0.0f, 1.0f, node.spans.x == NODE_LIVES);
    var system = system_frames[like_slot];
    system.world_from_system_x = world.x;
    system.world_from_system_y = world.y;
    system.world_from_system_z = world.z;
    system.closing_world_from_system_x = closing_world.x;
    system.closing_world_from_system_y = closing_world.y;
    system.closing_world_from_system_z = closing_world.z;
    system.earlier_system_from_birth_x = earlier_of_birth.x;
    system.earlier_system_from_birth_y = earlier_of_birth.y;
    system.earlier_system_from_birth_z = earlier_of_birth.z;
    system.system_from_birth_x = of_birth.x;
    system.system_from_birth_y = of_birth.y;
    system.system_from_birth_z = of_birth.z;
    system.acceleration = snap4(vec4<f32>(pull, brood.acceleration.w));
    system.key = key;
    system.bounding_sphere = snap4(vec4<f32>(
        now.x.x * sphere.x + now.x.y * sphere.y + now.x.z * sphere.z + now.x.w,
        now.y.x * sphere.x + now.y.y * sphere.y + now.y.z * sphere.z + now.y.w,
        now.z.x * sphere.x + now.z.y * sphere.y + now.z.z * sphere.z + now.z.w,
        sphere.w * scale,
    ));
    system.mean_parts = snap(births.x);
    system.var_parts = snap(births.y);
    system.burst_parts = snap(births.z);
    system.burst_var = snap(births.w);
    system_frames[slot] = system;
}
