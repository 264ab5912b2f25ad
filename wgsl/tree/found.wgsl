// found: the systems that are born in this frame.
//
// Reeves 1983, 2.6: a system is born as a particle of its parent: at a place in its generation
// shape, within its ejection angle, with a speed and a lifetime; or (section 3) on a ring of a
// sphere, anywhere around it, its up away from the sphere.
// One invocation a slot that others bear, for each step of the tree.
// Reads: frame, system_frames, rows, broods, system_offsets, free_slots, tree_counts, mesh_faces, mesh_choices.
// Writes: nodes.
// Invariant: everything is a hash of the parent's key, the frame and the index among its births.

#import motes::emission::{Birthplace, axis_of, basis_of, ejected, in_shape, on_triangle, turned}
#import motes::exact::{bits_of, f32_of_u32, to_i32}
#import motes::layout::{
    BROOD_OUTWARD, Brood, Counts, Frame, NODE_LIVES, NO_SLOT, Node, SHAPE_MESH, SHAPE_RINGS, SystemFrame, SystemRow,
}
#import motes::particle::{
    Identity, STREAM_MOTION, STREAM_PLACE, draw, lifetime_of, row_index,
}
#import motes::rng::{index_below, pcg4d, signed_float, unit_float}
#import motes::transcendental::{cos_turns, sin_turns}
#import motes::tree::{Rows, STREAM_SYSTEM, composed}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether anything is born on meshes.
const MESHES: bool = #{MESHES};

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> broods: array<Brood>;
@group(0) @binding(4) var<storage, read> system_offsets: array<u32>;
@group(0) @binding(5) var<storage, read> free_slots: array<u32>;
@group(0) @binding(6) var<uniform> tree_counts: Counts;
@group(0) @binding(7) var<storage, read_write> nodes: array<Node>;
@group(0) @binding(8) var<storage, read> mesh_faces: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read> mesh_choices: array<vec2<u32>>;

// The slot whose births contain `birth`: the last that begins at or before.
fn parent_of_birth(birth: u32) -> u32 {
    var low = 0u;
    var high = frame.system_count;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if system_offsets[middle] <= birth {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// On the ring that begins now: the sphere touches the parent's x-y plane from below.
fn on_ring(brood: Brood, frames: u32, place: vec4<u32>) -> Birthplace {
    let turns = f32_of_u32(frames) * brood.rings.y * brood.rings.w;
    let around = unit_float(place.y);
    let across = sin_turns(turns);
    let up = cos_turns(turns);
    let axis = vec3<f32>(across * cos_turns(around), across * sin_turns(around), up);
    return Birthplace(axis * brood.rings.x - vec3<f32>(0.0f, 0.0f, brood.rings.x), axis);
}

// Anywhere on the faces of a mesh, as particles are (motes::emission).
fn on_mesh(row: SystemRow, place: vec4<u32>) -> Birthplace {
    let drawn = u32(to_i32(row.shape.y)) + index_below(place.x, u32(to_i32(row.shape.z)));
    let choice = mesh_choices[drawn];
    let at = 3u * select(choice.y, drawn, place.w < choice.x);
    return on_triangle(mesh_faces[at], mesh_faces[at + 1u], mesh_faces[at + 2u], place, row.shape.x);
}

fn bits4(v: vec4<f32>) -> vec4<u32> {
    return vec4<u32>(bits_of(v.x), bits_of(v.y), bits_of(v.z), bits_of(v.w));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn found(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let birth = global_id.x;
    if birth >= min(tree_counts.spare_a, frame.system_count - frame.own_system_count) {
        return;
    }
    let parent_slot = parent_of_birth(birth);
    let index = birth - system_offsets[parent_slot];
    let parent = system_frames[parent_slot];
    let at = free_slots[birth];
    var kind = parent_slot;
    var parent_birth_frame = 0u;
    if parent_slot >= frame.own_system_count {
        let borne = nodes[parent_slot - frame.own_system_count].who;
        kind = borne.z;
        parent_birth_frame = borne.y;
    }
    let brood = broods[kind];
    let child_slot = brood.ties.w;
    let child = broods[child_slot];
    let row = rows[row_index(parent_slot, frame.frame, frame.row_mask)];
    let who = Identity(parent.key, frame.frame, index);
    let place = draw(who, STREAM_PLACE);
    let motion = draw(who, STREAM_MOTION);

    var born = in_shape(row, place);
    if MESHES && row.kinds.x == SHAPE_MESH {
        born = on_mesh(row, place);
    }
    if row.kinds.x == SHAPE_RINGS {
        born = on_ring(brood, frame.frame - parent_birth_frame - brood.spans.x, place);
    }
    let speed = row.speed_and_lifetime.x + signed_float(motion.z) * row.speed_and_lifetime.y;
    let way = ejected(row, axis_of(row, born), motion) * speed;
    let x_row = parent.system_from_birth_x;
    let y_row = parent.system_from_birth_y;
    let z_row = parent.system_from_birth_z;
    let velocity = turned(x_row, y_row, z_row, way);
    // Its up is the parent's, or away from where the parent's offspring is born.
    var up = vec3<f32>(0.0f, 0.0f, 1.0f);
    if (child.ties.z & BROOD_OUTWARD) != 0u {
        up = born.axis;
    }
    let basis = basis_of(up);
    let local = Rows(
        vec4<f32>(basis.across.x, basis.upward.x, up.x, born.position.x),
        vec4<f32>(basis.across.y, basis.upward.y, up.y, born.position.y),
        vec4<f32>(basis.across.z, basis.upward.z, up.z, born.position.z),
    );
    let rows_of_birth = composed(Rows(x_row, y_row, z_row), local);
    let lifetime = lifetime_of(who, row.speed_and_lifetime);
    let bears = min(lifetime, select(child.spans.y, lifetime, child.spans.y == NO_SLOT));
    let key = pcg4d(vec4<u32>(parent.key, frame.frame, index, STREAM_SYSTEM)).x;
    nodes[at] = Node(
        vec4<u32>(key, frame.frame, child_slot, parent_slot),
        vec4<u32>(NODE_LIVES, lifetime, frame.frame + bears + child.spans.z, index),
        bits4(vec4<f32>(velocity, 0.0f)),
        bits4(vec4<f32>(parent.acceleration.xyz, 0.0f)),
        bits4(rows_of_birth.x),
        bits4(rows_of_birth.y),
        bits4(rows_of_birth.z),
    );
}
