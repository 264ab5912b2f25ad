// steer: each boid looks at those around it, steers and moves.
//
// Reynolds 1987 as the flocking article has it: separation, alignment and cohesion, avoidance and
// attraction, then Particle.update and the edges. All see the state of the frame before, so that
// the order of the boids does not matter. One invocation a boid of the flock, in sorted order.
// Reads: flocks, relations, cell_starts, sorted_boids. Writes: boids.
// Invariant: whoever is nearer than a relation's radius is in one of the cells around the boid's
// own, for no cell is narrower than any radius that its flock is seen by.

#import motes::boid::{Motion, moved}
#import motes::dispatch::linear_index
#import motes::exact::{bits_of, dot3, less}
#import motes::grid::{around, cell_coordinates, cell_index, first_around, nearest_way}
#import motes::layout::{Boid, EDGES_TORUS, FlockFrame, Relation}
#import motes::steering::{Perceived, answer, nothing, perceiving}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether boids may look at more others than loops of software drivers turn, 65,535.
const CROWDS: bool = #{CROWDS};

struct Which {
    flock: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<storage, read> flocks: array<FlockFrame>;
@group(0) @binding(1) var<storage, read> relations: array<Relation>;
@group(0) @binding(2) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(3) var<storage, read> sorted_boids: array<Boid>;
@group(0) @binding(4) var<storage, read_write> boids: array<Boid>;

// Who looks, at whom and how.
struct View {
    own: u32,
    motion: Motion,
    relation: Relation,
    other: FlockFrame,
}

// What is perceived with the boid at that sorted place, if it is near.
fn visited(perceived: Perceived, view: View, at: u32) -> Perceived {
    let place = bitcast<vec3<f32>>(sorted_boids[at].position_and_flock.xyz);
    let straight = place - view.motion.position;
    let torus = view.other.torus;
    let inverse = view.other.torus_inverse;
    let offset = vec3<f32>(
        nearest_way(straight.x, torus.x, inverse.x),
        nearest_way(straight.y, torus.y, inverse.y),
        nearest_way(straight.z, torus.z, inverse.z),
    );
    let squared = dot3(offset, offset);
    if at == view.own || !less(squared, view.relation.reach.x) {
        return perceived;
    }
    let velocity = bitcast<vec3<f32>>(sorted_boids[at].velocity_and_index.xyz);
    let own = view.motion.velocity;
    return perceiving(perceived, view.relation, view.other, offset, squared, own, velocity);
}

fn visited_four(perceived: Perceived, view: View, at: u32) -> Perceived {
    let two = visited(visited(perceived, view, at), view, at + 1u);
    return visited(visited(two, view, at + 2u), view, at + 3u);
}

// What is perceived with the boids of sorted places from .x up to .y; of crowds, sixteen a turn, for
// a million may be in one cell.
fn visited_all(perceived: Perceived, view: View, range: vec2<u32>) -> Perceived {
    var all = perceived;
    var at = range.x;
    for (; CROWDS && at + 16u <= range.y; at += 16u) {
        let eight = visited_four(visited_four(all, view, at), view, at + 4u);
        all = visited_four(visited_four(eight, view, at + 8u), view, at + 12u);
    }
    for (; at < range.y; at += 1u) {
        all = visited(all, view, at);
    }
    return all;
}

// The sorted places of a row's cells with x in first ..= last, cut off at the grid's ends.
fn row_range(other: FlockFrame, first: i32, last: i32, y: i32, z: i32) -> vec2<u32> {
    let low = max(first, 0i);
    let high = min(last, i32(other.grid.x) - 1i);
    if low > high || y < 0i || z < 0i || y >= i32(other.grid.y) || z >= i32(other.grid.z) {
        return vec2<u32>(0u);
    }
    return vec2<u32>(
        cell_starts[cell_index(other, low, y, z)],
        cell_starts[cell_index(other, high, y, z) + 1u],
    );
}

// All that a boid perceives of a flock: row by row of the cells around it; on a torus, the part of
// a row beyond an end is a row of its own.
fn look(view: View) -> Perceived {
    let other = view.other;
    let cell = cell_coordinates(other, view.motion.position);
    let first = vec3<i32>(
        first_around(cell.x, other.grid.x),
        first_around(cell.y, other.grid.y),
        first_around(cell.z, other.grid.z),
    );
    let last_x = first.x + i32(min(other.grid.x, 3u)) - 1i;
    let wraps = other.members.w == EDGES_TORUS;
    let parts = select(1u, 2u, wraps);
    let rows_y = min(other.grid.y, 3u);
    let rows = rows_y * min(other.grid.z, 3u) * parts;
    var perceived = nothing();
    for (var row = 0u; row < rows; row += 1u) {
        let line = row / parts;
        var y = first.y + i32(line % rows_y);
        var z = first.z + i32(line / rows_y);
        var x = first.x;
        var end = last_x;
        if wraps {
            y = around(y, other.grid.y);
            z = around(z, other.grid.z);
            if row % 2u == 1u {
                // What is beyond the first end, or else beyond the last.
                let beyond = select(0i, i32(other.grid.x) - 1i, x < 0i);
                let any = x < 0i || end >= i32(other.grid.x);
                x = beyond;
                end = select(-1i, beyond, any);
            }
        }
        perceived = visited_all(perceived, view, row_range(other, x, end, y, z));
    }
    return perceived;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn steer(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let flock = flocks[which.flock];
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= flock.members.y {
        return;
    }
    let own = flock.members.x + at;
    let position_bits = sorted_boids[own].position_and_flock;
    let velocity_bits = sorted_boids[own].velocity_and_index;
    let motion = Motion(bitcast<vec3<f32>>(position_bits.xyz), bitcast<vec3<f32>>(velocity_bits.xyz));
    var acceleration = flock.acceleration.xyz;
    for (var tie = 0u; tie < flock.ties.y; tie += 1u) {
        let relation = relations[flock.ties.x + tie];
        let view = View(own, motion, relation, flocks[relation.kinds.y]);
        acceleration += answer(look(view), relation, motion.velocity, flock.acceleration.w);
    }
    let next = moved(flock, motion, acceleration);
    let place = next.position;
    let velocity = next.velocity;
    boids[flock.members.x + velocity_bits.w] = Boid(
        vec4<u32>(bits_of(place.x), bits_of(place.y), bits_of(place.z), which.flock),
        vec4<u32>(bits_of(velocity.x), bits_of(velocity.y), bits_of(velocity.z), velocity_bits.w),
    );
}
