//! dropped: a flame that a control point has dropped, as it is in a frame (Perry 1994, 3.4). Twin of
//! `wgsl/flames/dropped.wgsl`.

use glam::Vec3;

use crate::cpu::emission::turned;
use crate::cpu::flame::{burns_at, extents_of, growth_of};
use crate::exact::{bits_of, normalize_exact};
use crate::layout::{DroppedFlame, Flame};
use crate::plan::FrameInputs;

/// The flame of that record in this frame.
pub fn dropped(inputs: &FrameInputs, own: &DroppedFlame) -> Flame {
    let [x, y, z, slot] = own.root_and_fire;
    let mut fire = inputs.fires[slot as usize];
    fire.times[2] = own.identity[2];
    let fire = &fire;
    let place = Vec3::from([x, y, z].map(f32::from_bits));
    let rows = [
        fire.world_from_fire_x,
        fire.world_from_fire_y,
        fire.world_from_fire_z,
    ];
    let earlier = [
        fire.earlier_world_from_fire_x,
        fire.earlier_world_from_fire_y,
        fire.earlier_world_from_fire_z,
    ];
    let placed = |rows: [[f32; 4]; 3]| turned(rows, place) + Vec3::from(rows.map(|row| row[3]));
    let root = placed(rows);
    let motion = root - placed(earlier);
    let [x, y, z, birth] = own.normal_and_birth;
    let outward = Vec3::from([x, y, z].map(f32::from_bits));
    let normal = normalize_exact(turned(rows, outward));
    let age = inputs.frame.frame.wrapping_sub(birth).cast_signed();
    let burns = burns_at(fire, age);
    let growth = growth_of(fire, if burns { age } else { 0 });
    let [key, ..] = own.identity;
    let extents = extents_of(fire, key);
    let with = |v: Vec3, w: u32| [bits_of(v.x), bits_of(v.y), bits_of(v.z), w];
    Flame {
        root_and_fire: with(root, slot),
        normal_and_birth: with(normal, birth),
        motion_and_index: with(motion, key),
        look: [
            bits_of(extents.x * growth),
            bits_of(extents.y * growth),
            bits_of(fire.look[0]),
            u32::from(burns),
        ],
    }
}
