//! catch and caught: which step of which flame is the first that meets a piece that does not burn, and
//! where (Perry 1994, 4.6). Twins of `wgsl/spread/catch.wgsl` and `wgsl/spread/caught.wgsl`.

use glam::Vec3;

use crate::cpu::meet::{meeting, within_fire};
use crate::exact::{bits_of, dot3, length3, less};
use crate::layout::{FLAME_STEPS, SpreadPiece};
use crate::plan::SpreadTables;

/// Ends of the step `at` of all flames, in the space of the piece's fire.
fn step_of(piece: &SpreadPiece, steps: &[[u32; 4]], at: u32) -> [Vec3; 2] {
    let first = at / (FLAME_STEPS - 1) * FLAME_STEPS + at % (FLAME_STEPS - 1);
    [first, first + 1].map(|step| {
        let [x, y, z, _] = steps[step as usize].map(f32::from_bits);
        within_fire(piece, Vec3::new(x, y, z))
    })
}

/// Whether the step meets a face of the piece.
pub fn meets(tables: &SpreadTables, piece: &SpreadPiece, steps: &[[u32; 4]], at: u32) -> bool {
    let [from, to] = step_of(piece, steps, at);
    let [x, y, z, radius] = piece.ball;
    let away = to - Vec3::new(x, y, z);
    let reach = radius + length3(to - from);
    if less(reach * reach, dot3(away, away)) {
        return false;
    }
    let [first, count, ..] = piece.faces.map(|word| word as usize);
    (first..first + count).any(|face| {
        let edges = &tables.edges[3 * face..3 * face + 3];
        meeting(&tables.faces[face], edges, from, to).is_some()
    })
}

/// The record of a piece whose first is the step `at`.
pub fn caught(tables: &SpreadTables, piece: &SpreadPiece, steps: &[[u32; 4]], at: u32) -> [u32; 4] {
    let [from, to] = step_of(piece, steps, at);
    let mut record = [u32::MAX - at, 0, 0, 0];
    let mut best = 2.0;
    let [first, count, ..] = piece.faces;
    for face in first..first + count {
        let edges = &tables.edges[3 * face as usize..3 * face as usize + 3];
        if let Some((place, share)) = meeting(&tables.faces[face as usize], edges, from, to)
            && less(share, best)
        {
            best = share;
            record = [record[0], face, bits_of(place.x), bits_of(place.y)];
        }
    }
    record
}
