//! steer: each boid looks at those around it, steers and moves. Twin of `wgsl/flock/steer.wgsl`.

use std::ops::Range;

use glam::Vec3;

use crate::cpu::boid::{Motion, moved};
use crate::cpu::grid::{around, cell_index, gap_to, half_row, nearest_way, place_in_cells, span};
use crate::cpu::steering::{Neighbour, Perceived, answer, perceiving, sees};
use crate::cpu::urge::{kept_out, sought, surface_of, turned_away};
use crate::cpu::wind::wind_at;
use crate::exact::{bits_of, dot3, less, normalize_exact};
use crate::layout::{Boid, EDGES_TORUS, FlockFrame, Relation, Wind};
use crate::plan::FrameInputs;

/// Who looks, at whom and how.
struct View<'a> {
    own: usize,
    motion: Motion,
    heading: Vec3,
    relation: &'a Relation,
    other: &'a FlockFrame,
    starts: &'a [u32],
    sorted: &'a [Boid],
}

/// The boid at that sorted place, and the way to it, if it is near and seen.
fn noticed(view: &View, at: usize) -> Option<Neighbour> {
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
        return None;
    }
    let seen = sees(view.heading, offset, squared, view.relation);
    seen.then(|| Neighbour {
        offset,
        squared,
        velocity: boid.velocity().into(),
    })
}

/// The sorted places of a row's cells from x = first on, so many.
fn row_range(
    other: &FlockFrame,
    starts: &[u32],
    first: i32,
    count: i32,
    [y, z]: [i32; 2],
) -> Range<usize> {
    let start = cell_index(other, first, y, z) as usize;
    let end = start + count.cast_unsigned() as usize;
    starts[start] as usize..starts[end] as usize
}

/// Hands over the sorted places of all whom one at `position` may see of a flock, and some more: row
/// by row of the cells in reach; on a torus, the part of a row beyond its end is a row of its own.
pub fn each_range(
    other: &FlockFrame,
    starts: &[u32],
    position: Vec3,
    reach: f32,
    mut visit: impl FnMut(Range<usize>),
) {
    let wraps = other.members[3] == EDGES_TORUS;
    let place = place_in_cells(other, position);
    let [cells_x, cells_y, cells_z, _] = other.grid;
    let [per_unit_x, per_unit_y, per_unit_z, _] = other.cells_per_unit;
    let [_, extent_y, extent_z, _] = other.cell_extent;
    let along_y = span(place.y, reach * per_unit_y, cells_y, wraps);
    let along_z = span(place.z, reach * per_unit_z, cells_z, wraps);
    for z in along_z.first..along_z.first + along_z.count {
        let gap_z = gap_to(z, place.z, extent_z, along_z.count, cells_z, wraps);
        for y in along_y.first..along_y.first + along_y.count {
            let gap_y = gap_to(y, place.y, extent_y, along_y.count, cells_y, wraps);
            let half = half_row(reach, gap_y * gap_y + gap_z * gap_z);
            if !less(0.0, half) {
                continue;
            }
            let along_x = span(place.x, half * per_unit_x, cells_x, wraps);
            if !wraps {
                let row = [y, z];
                visit(row_range(other, starts, along_x.first, along_x.count, row));
                continue;
            }
            let row = [around(y, cells_y), around(z, cells_z)];
            let first = around(along_x.first, cells_x);
            let within = along_x.count.min(cells_x.cast_signed() - first);
            visit(row_range(other, starts, first, within, row));
            if within < along_x.count {
                let beyond = along_x.count - within;
                visit(row_range(other, starts, 0, beyond, row));
            }
        }
    }
}

/// All that a boid perceives of a flock.
fn look(view: &View) -> Perceived {
    let reach = view.relation.cohesion[3];
    let with = |perceived, neighbour| {
        let own = view.motion.velocity;
        perceiving(perceived, view.relation, view.other, neighbour, own)
    };
    let most = view.relation.kinds[3] as usize;
    let position = view.motion.position;
    let mut perceived = Perceived::default();
    if most == 0 {
        each_range(view.other, view.starts, position, reach, |range| {
            for neighbour in range.filter_map(|at| noticed(view, at)) {
                perceived = with(perceived, neighbour);
            }
        });
        return perceived;
    }
    let mut all = Vec::new();
    each_range(view.other, view.starts, position, reach, |range| {
        let near = range.filter_map(|at| {
            let neighbour = noticed(view, at)?;
            let rank = (bits_of(neighbour.squared), view.sorted[at].index());
            Some((rank, neighbour))
        });
        all.extend(near);
    });
    if all.len() > most {
        all.select_nth_unstable_by_key(most - 1, |(rank, _)| *rank);
        all.truncate(most);
    }
    all.into_iter()
        .fold(perceived, |perceived, (_, neighbour)| {
            with(perceived, neighbour)
        })
}

/// What the wind adds to a velocity in a frame: a part of what it lacks of the wind's, in a plane
/// without depth.
fn dragged(flock: &FlockFrame, winds: &[Wind], motion: Motion) -> Vec3 {
    let mut flow = wind_at(winds, motion.position);
    if flock.ties[2] != 1 {
        flow.z = 0.0;
    }
    (flow - motion.velocity) * Vec3::splat(flock.goal_rule[3])
}

/// The boid at the sorted place `own`, a frame later; `solid_faces` are the stored rows of meshes.
pub fn steer(
    inputs: &FrameInputs,
    starts: &[u32],
    sorted: &[Boid],
    solid_faces: &[[f32; 4]],
    own: usize,
) -> Boid {
    let boid = sorted[own];
    let slot = boid.flock();
    let flock = &inputs.flocks[slot as usize];
    let motion = Motion {
        position: boid.position().into(),
        velocity: boid.velocity().into(),
    };
    let heading = normalize_exact(motion.velocity);
    let mut acceleration = Vec3::from_slice(&flock.acceleration);
    let [first, count, ..] = flock.ties.map(|word| word as usize);
    for relation in &inputs.relations[first..first + count] {
        let view = View {
            own,
            motion,
            heading,
            relation,
            other: &inputs.flocks[relation.kinds[1] as usize],
            starts,
            sorted,
        };
        let perceived = look(&view);
        acceleration += answer(&perceived, relation, motion.velocity, flock.acceleration[3]);
    }
    if less(0.0, flock.goal_rule[2]) {
        acceleration += sought(flock, motion);
    }
    let [_, _, first, count] = flock.drawn.map(|word| word as usize);
    let obstacles = &inputs.obstacles[first..first + count];
    for obstacle in obstacles {
        let surface = surface_of(obstacle, solid_faces, motion.position);
        acceleration += turned_away(obstacle, &surface);
    }
    // Without drag there is nothing to add.
    if flock.goal_rule[3] != 0.0 {
        acceleration += dragged(flock, &inputs.winds, motion);
    }
    // In a plane there is no depth to go to, wherever others are.
    if flock.ties[2] != 1 {
        acceleration.z = 0.0;
    }
    let mut next = moved(flock, motion, acceleration);
    for obstacle in obstacles {
        next = kept_out(&surface_of(obstacle, solid_faces, next.position), next);
    }
    let [x, y, z] = next.position.to_array().map(bits_of);
    let [vx, vy, vz] = next.velocity.to_array().map(bits_of);
    Boid {
        position_and_flock: [x, y, z, slot],
        velocity_and_index: [vx, vy, vz, boid.index()],
    }
}
