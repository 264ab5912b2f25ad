//! steer: each boid looks at those around it, steers and moves. Twin of `wgsl/flock/steer.wgsl`.

use std::ops::Range;

use glam::Vec3;

use crate::cpu::boid::{Motion, moved};
use crate::cpu::grid::{around, cell_coordinates, cell_index, first_around, nearest_way};
use crate::cpu::steering::{Neighbour, Perceived, answer, perceiving};
use crate::exact::{bits_of, dot3, less};
use crate::layout::{Boid, EDGES_TORUS, FlockFrame, Relation};
use crate::plan::FrameInputs;

/// Who looks, at whom and how.
struct View<'a> {
    own: usize,
    motion: Motion,
    relation: &'a Relation,
    other: &'a FlockFrame,
    starts: &'a [u32],
    sorted: &'a [Boid],
}

/// What is perceived with the boid at that sorted place, if it is near.
fn visited(perceived: Perceived, view: &View, at: usize) -> Perceived {
    let boid = &view.sorted[at];
    let straight = Vec3::from(boid.position()) - view.motion.position;
    let (torus, inverse) = (view.other.torus, view.other.torus_inverse);
    let offset = Vec3::new(
        nearest_way(straight.x, torus[0], inverse[0]),
        nearest_way(straight.y, torus[1], inverse[1]),
        nearest_way(straight.z, torus[2], inverse[2]),
    );
    let squared = dot3(offset, offset);
    if at == view.own || !less(squared, view.relation.reach[0]) {
        return perceived;
    }
    let neighbour = Neighbour {
        offset,
        squared,
        velocity: boid.velocity().into(),
    };
    let own = view.motion.velocity;
    perceiving(perceived, view.relation, view.other, neighbour, own)
}

/// The sorted places of a row's cells with x in first ..= last, cut off at the grid's ends.
fn row_range(view: &View, first: i32, last: i32, y: i32, z: i32) -> Range<usize> {
    let other = view.other;
    let [cells_x, cells_y, cells_z, _] = other.grid.map(u32::cast_signed);
    let low = first.max(0);
    let high = last.min(cells_x - 1);
    if low > high || y < 0 || z < 0 || y >= cells_y || z >= cells_z {
        return 0..0;
    }
    let start = view.starts[cell_index(other, low, y, z) as usize];
    let end = view.starts[cell_index(other, high, y, z) as usize + 1];
    start as usize..end as usize
}

/// All that a boid perceives of a flock: row by row of the cells around it; on a torus, the part of
/// a row beyond an end is a row of its own.
fn look(view: &View) -> Perceived {
    let other = view.other;
    let [cells_x, cells_y, cells_z, _] = other.grid;
    let cell = cell_coordinates(other, view.motion.position);
    let first_x = first_around(cell.x, cells_x);
    let first_y = first_around(cell.y, cells_y);
    let first_z = first_around(cell.z, cells_z);
    let last_x = first_x + cells_x.min(3).cast_signed() - 1;
    let wraps = other.members[3] == EDGES_TORUS;
    let parts = if wraps { 2 } else { 1 };
    let rows_y = cells_y.min(3);
    let rows = rows_y * cells_z.min(3) * parts;
    let mut perceived = Perceived::default();
    for row in 0..rows {
        let line = row / parts;
        let mut y = first_y + (line % rows_y).cast_signed();
        let mut z = first_z + (line / rows_y).cast_signed();
        let (mut x, mut end) = (first_x, last_x);
        if wraps {
            y = around(y, cells_y);
            z = around(z, cells_z);
            if row % 2 == 1 {
                // What is beyond the first end, or else beyond the last.
                let last = cells_x.cast_signed() - 1;
                let beyond = if x < 0 { last } else { 0 };
                let any = x < 0 || end > last;
                (x, end) = (beyond, if any { beyond } else { -1 });
            }
        }
        perceived = row_range(view, x, end, y, z)
            .fold(perceived, |perceived, at| visited(perceived, view, at));
    }
    perceived
}

/// The boid at the sorted place `own`, a frame later.
pub fn steer(inputs: &FrameInputs, starts: &[u32], sorted: &[Boid], own: usize) -> Boid {
    let boid = sorted[own];
    let slot = boid.flock();
    let flock = &inputs.flocks[slot as usize];
    let motion = Motion {
        position: boid.position().into(),
        velocity: boid.velocity().into(),
    };
    let mut acceleration = Vec3::from_slice(&flock.acceleration);
    let [first, count, ..] = flock.ties.map(|word| word as usize);
    for relation in &inputs.relations[first..first + count] {
        let view = View {
            own,
            motion,
            relation,
            other: &inputs.flocks[relation.kinds[1] as usize],
            starts,
            sorted,
        };
        let perceived = look(&view);
        acceleration += answer(&perceived, relation, motion.velocity, flock.acceleration[3]);
    }
    let next = moved(flock, motion, acceleration);
    let [x, y, z] = next.position.to_array().map(bits_of);
    let [vx, vy, vz] = next.velocity.to_array().map(bits_of);
    Boid {
        position_and_flock: [x, y, z, slot],
        velocity_and_index: [vx, vy, vz, boid.index()],
    }
}
