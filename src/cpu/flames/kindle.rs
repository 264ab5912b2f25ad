//! kindle: where a flame stands in a frame, and how large it is. Twin of `wgsl/flames/kindle.wgsl`.

use glam::{Vec2, Vec3};

use crate::cpu::emission::{on_triangle, turned};
use crate::cpu::flame::{STREAM_ROOT, burns_at, extents_of, flame_draw, growth_of, root_on};
use crate::exact::{bits_of, less, normalize_exact};
use crate::layout::{FireFrame, Flame, LISTED_FIRST_FRAME, ROOTS_MESH};
use crate::plan::{FrameInputs, MeshTables};
use crate::rng::index_below;

/// What a flame is before its fire moves.
struct Rooted {
    position: Vec3,
    normal: Vec3,
    extents: Vec2,
    brightness: f32,
    birth: u32,
}

fn listed(inputs: &FrameInputs, fire: &FireFrame, at: u32) -> Rooted {
    let own = &inputs.listed_flames[(fire.members[2] + at) as usize];
    let general = extents_of(fire, at);
    let chosen = |own: f32, general: f32| if less(own, 0.0) { general } else { own };
    Rooted {
        position: Vec3::from_slice(&own.position),
        normal: Vec3::from_slice(&own.normal),
        extents: Vec2::new(
            chosen(own.position[3], general.x),
            chosen(own.normal[3], general.y),
        ),
        brightness: own.look[0],
        birth: if own.kinds[1] & LISTED_FIRST_FRAME != 0 {
            own.kinds[0]
        } else {
            fire.times[0]
        },
    }
}

fn scattered(fire: &FireFrame, meshes: &MeshTables, at: u32) -> Rooted {
    let [_, all, _, listed] = fire.members;
    let (nth, count) = (at - listed, all - listed);
    let place = flame_draw(fire, at, STREAM_ROOT);
    let mut position = root_on(fire, nth, place);
    let mut normal = Vec3::Y;
    if fire.kinds[0] == ROOTS_MESH {
        let [first_face, face_count, ..] = fire.faces;
        let drawn = first_face + index_below(place.x, face_count);
        let [below, other] = meshes.choices[drawn as usize];
        let face = if place.w < below { drawn } else { other } as usize;
        let rows = [0, 1, 2].map(|row| meshes.faces[3 * face + row]);
        let born = on_triangle(rows, place, fire.roots[0]);
        position = born.position;
        normal = born.axis;
    }
    let [first_frame, kindling, ..] = fire.times;
    let later = u64::from(nth) * u64::from(kindling) / u64::from(count);
    Rooted {
        position,
        normal,
        extents: extents_of(fire, at),
        brightness: 1.0,
        birth: first_frame.wrapping_add(later as u32),
    }
}

/// The flame of that index of the fire in that slot.
pub fn kindle(inputs: &FrameInputs, meshes: &MeshTables, slot: u32, at: u32) -> Flame {
    let fire = &inputs.fires[slot as usize];
    let own = if at < fire.members[3] {
        listed(inputs, fire, at)
    } else {
        scattered(fire, meshes, at)
    };
    let rows = [
        fire.world_from_fire_x,
        fire.world_from_fire_y,
        fire.world_from_fire_z,
    ];
    let rows_before = [
        fire.earlier_world_from_fire_x,
        fire.earlier_world_from_fire_y,
        fire.earlier_world_from_fire_z,
    ];
    let origin = |rows: [[f32; 4]; 3]| Vec3::from(rows.map(|row| row[3]));
    let root = turned(rows, own.position) + origin(rows);
    let before = turned(rows_before, own.position) + origin(rows_before);
    let normal = normalize_exact(turned(rows, own.normal));
    let age = inputs.frame.frame.wrapping_sub(own.birth).cast_signed();
    let burns = burns_at(fire, age);
    let growth = growth_of(fire, if burns { age } else { 0 });
    let with = |v: Vec3, w: u32| {
        let [x, y, z] = v.to_array().map(bits_of);
        [x, y, z, w]
    };
    Flame {
        root_and_fire: with(root, slot),
        normal_and_birth: with(normal, own.birth),
        motion_and_index: with(root - before, at),
        look: [
            bits_of(own.extents.x * growth),
            bits_of(own.extents.y * growth),
            bits_of(own.brightness * fire.look[0]),
            u32::from(burns),
        ],
    }
}
