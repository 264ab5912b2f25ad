//! front_lines: the fronts of fires that spread, as lines from control point to control point (Perry
//! 1994, 3.3.2 and 4.7). Twin of `wgsl/draw/front_lines.wgsl`.

use glam::{Vec2, Vec3, Vec4};

use super::splat::layer_of;
use crate::cpu::emission::turned;
use crate::cpu::projection::project;
use crate::cpu::reach::is_visible;
use crate::cpu::shape::{Look, segment_of};
use crate::exact::{dot3, less, min_exact};
use crate::layout::{Cover, FRAME_ORTHOGRAPHIC, FireFrame, Frame, SpreadFace, SpreadPoint};
use crate::plan::{FrameInputs, SpreadTables};

fn rows_of(fire: &FireFrame) -> [[f32; 4]; 3] {
    [
        fire.world_from_fire_x,
        fire.world_from_fire_y,
        fire.world_from_fire_z,
    ]
}

fn world_of_point(fire: &FireFrame, point: &SpreadPoint) -> Vec3 {
    let rows = rows_of(fire);
    turned(rows, Vec3::from(point.position())) + Vec3::from(rows.map(|row| row[3]))
}

fn facing(frame: &Frame, fire: &FireFrame, face: &SpreadFace, world: Vec3) -> f32 {
    let outward = Vec3::new(
        face.fire_from_face_x[2],
        face.fire_from_face_y[2],
        face.fire_from_face_z[2],
    );
    let normal = turned(rows_of(fire), outward);
    let of = |row: [f32; 4], v: Vec3| dot3(Vec3::from_slice(&row), v);
    let (x, y, z) = (
        frame.view_from_world_x,
        frame.view_from_world_y,
        frame.view_from_world_z,
    );
    let along = of(z, normal);
    let to_point = of(x, normal) * (of(x, world) + x[3])
        + of(y, normal) * (of(y, world) + y[3])
        + along * (of(z, world) + z[3]);
    if frame.flags & FRAME_ORTHOGRAPHIC != 0 {
        -along
    } else {
        -to_point
    }
}

/// The record of the piece from a point to the next.
pub fn front_lines(
    inputs: &FrameInputs,
    tables: &SpreadTables,
    from: &SpreadPoint,
    to: &SpreadPoint,
) -> Cover {
    let frame = &inputs.frame;
    let spread = &inputs.spreads[from.position[3] as usize];
    let fire = &inputs.fires[spread.kinds[0] as usize];
    let [width, ..] = spread.line_shape;
    if !(from.moves() || to.moves()) || !less(0.0, width) {
        return Cover::default();
    }
    let [begin_at, end_at] = [from, to].map(|point| world_of_point(fire, point));
    let [begin, end] = [begin_at, end_at].map(|place| project(frame, place));
    let width_px = width * begin.scale;
    let here = frame.layer == 0 || layer_of(&inputs.layer_planes, begin_at) == frame.layer;
    let faced = |point: &SpreadPoint, place: Vec3| {
        let face = &tables.faces[point.place[2] as usize];
        less(0.0, facing(frame, fire, face, place))
    };
    let is_faced = faced(from, begin_at) || faced(to, end_at);
    if !here || !is_faced || !is_visible(frame, begin, end, width_px) {
        return Cover::default();
    }
    let look = Look {
        depth: min_exact(begin.depth, end.depth) - width,
        color: Vec4::from(spread.line_look),
        lit: Vec3::ZERO,
    };
    let (begin, end) = (Vec2::new(begin.x, begin.y), Vec2::new(end.x, end.y));
    segment_of(begin, end, 0.5 * width_px, &look)
}
