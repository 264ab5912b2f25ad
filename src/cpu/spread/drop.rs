//! drop: the flames that a control point drops on its way (Perry 1994, 3.4). Twin of
//! `wgsl/spread/drop.wgsl`.

use glam::UVec4;

use super::walk::vec2;
use crate::cpu::walk::{exit_of, position_on};
use crate::exact::{bits_of, min_exact, shared_constants, snap};
use crate::layout::{DroppedFlame, SPREAD_CARRIES, SpreadPoint};
use crate::plan::{FrameInputs, SpreadTables};
use crate::rng::pcg4d;

shared_constants! {
    const DROPPED_TAG: u32 = 0x6472_6f70;
}

/// The flames that a point drops, so many; the first has that number.
pub fn drop(
    inputs: &FrameInputs,
    tables: &SpreadTables,
    point: &SpreadPoint,
    number: u32,
    drops: u32,
) -> impl Iterator<Item = DroppedFlame> {
    let frame = inputs.frame.frame;
    let spread = &inputs.spreads[point.position[3] as usize];
    let carries = spread.kinds[1] & SPREAD_CARRIES != 0;
    let slot = spread.kinds[0];
    let lifetime = inputs.fires[slot as usize].times[2];
    let [x, y, face_at, _] = point.place;
    let face = &tables.faces[face_at as usize];
    let lifetime = match face.material[2] {
        0 => lifetime,
        own => own,
    };
    let here = vec2(x, y);
    let back = -vec2(point.course[0], point.course[1]);
    let first = 3 * face_at as usize;
    let (_, exit) = exit_of(here, back, 0, &tables.edges[first..first + 3]);
    let mut far = f32::from_bits(point.path[0]);
    (0..drops).map(move |nth| {
        far = if carries {
            snap(far - spread.distances[1])
        } else {
            0.0
        };
        let root = position_on(face, here + back * min_exact(far, exit));
        let key = pcg4d(UVec4::new(point.course[2], frame, nth, DROPPED_TAG)).x;
        let [nx, ny, nz] = [
            face.fire_from_face_x[2],
            face.fire_from_face_y[2],
            face.fire_from_face_z[2],
        ];
        DroppedFlame {
            root_and_fire: [bits_of(root.x), bits_of(root.y), bits_of(root.z), slot],
            normal_and_birth: [bits_of(nx), bits_of(ny), bits_of(nz), frame],
            identity: [key, number + nth, lifetime, 0],
        }
    })
}
