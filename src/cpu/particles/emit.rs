//! emit: the attributes of one newborn (Reeves 1983, 2.2). Twin of `wgsl/particles/emit.wgsl`.

use glam::{UVec4, Vec3};

use crate::cpu::emission::{
    Birthplace, axis_of, ejected, in_shape, mixed, on_curve, on_triangle, turned,
};
use crate::cpu::particle::{Identity, STREAM_MOMENT, STREAM_MOTION, STREAM_PLACE, draw};
use crate::exact::{bits_of, f32_of_u32, normalize_exact, to_i32};
use crate::layout::{
    Particle, ROW_WITHIN_FRAME, SHAPE_CURVE, SHAPE_MESH, SYSTEM_PARABOLIC, SystemFrame, SystemRow,
};
use crate::plan::MeshTables;
use crate::rng::{index_below, signed_float, unit_float};

/// What stands in buffers and does not change in a run.
#[derive(Clone, Copy, Debug)]
pub struct Stored<'a> {
    /// Points of the curves that particles are born on.
    pub curve_points: &'a [[f32; 4]],
    /// Faces of the meshes that they are born on.
    pub meshes: &'a MeshTables,
}

/// Where something is born in the generation shape of the row.
#[inline]
pub(crate) fn birthplace(row: &SystemRow, stored: Stored, place: UVec4) -> Birthplace {
    if row.kinds[0] == SHAPE_CURVE {
        let along = unit_float(place.x) * row.shape[2];
        let before = to_i32(along) as u32;
        let first = to_i32(row.shape[1]) as u32 + before;
        let part = along - f32_of_u32(before);
        let point = |at: u32| Vec3::from_slice(&stored.curve_points[at as usize]);
        return on_curve(point(first), point(first + 1), part, row.shape[0]);
    }
    if row.kinds[0] == SHAPE_MESH {
        let count = to_i32(row.shape[2]) as u32;
        let drawn = to_i32(row.shape[1]) as u32 + index_below(place.x, count);
        let [below, other] = stored.meshes.choices[drawn as usize];
        let face = if place.w < below { drawn } else { other };
        let corner = |at: usize| stored.meshes.faces[3 * face as usize + at];
        return on_triangle([corner(0), corner(1), corner(2)], place, row.shape[0]);
    }
    in_shape(row, place)
}

/// The newborn `who` of the system in `slot`, in the system's space.
#[inline]
pub fn emit(
    who: Identity,
    slot: u32,
    system: &SystemFrame,
    row: &SystemRow,
    stored: Stored,
) -> Particle {
    let motion = draw(who, STREAM_MOTION);
    let born = birthplace(row, stored, draw(who, STREAM_PLACE));
    let speed = row.speed_and_lifetime[0] + signed_float(motion.z) * row.speed_and_lifetime[1];
    let leaving = ejected(row, axis_of(row, &born), motion);

    let is_spread = row.kinds[3] & ROW_WITHIN_FRAME != 0;
    let random = unit_float(draw(who, STREAM_MOMENT).x);
    let (gone, to_come) = if is_spread {
        (random, 1.0 - random)
    } else {
        (0.0, 0.0)
    };
    let rows = [
        mixed(
            system.system_from_birth_x,
            system.earlier_system_from_birth_x,
            to_come,
        ),
        mixed(
            system.system_from_birth_y,
            system.earlier_system_from_birth_y,
            to_come,
        ),
        mixed(
            system.system_from_birth_z,
            system.earlier_system_from_birth_z,
            to_come,
        ),
    ];
    // Between two turned frames is no turned frame: it would shorten what it turns.
    let mixed_way = turned(rows, leaving);
    let way = if is_spread {
        normalize_exact(mixed_way)
    } else {
        mixed_way
    };
    let initial = way * speed;
    let origin = Vec3::from(rows.map(|row| row[3]));
    let mut position = turned(rows, born.position) + origin - initial * gone;
    let mut velocity = initial;
    if system.flags & SYSTEM_PARABOLIC != 0 {
        // The velocity halfway through the frame makes each step end on the parabola.
        let acceleration = Vec3::from_slice(&system.acceleration);
        position += acceleration * (0.5 * gone * gone);
        velocity += acceleration * (0.5 - gone);
    }
    Particle {
        position_and_index: [
            bits_of(position.x),
            bits_of(position.y),
            bits_of(position.z),
            who.index,
        ],
        velocity_and_birth: [
            bits_of(velocity.x),
            bits_of(velocity.y),
            bits_of(velocity.z),
            (slot << 16) | (who.birth_frame & 0xffff),
        ],
    }
}
