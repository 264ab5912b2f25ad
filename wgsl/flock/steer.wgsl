// steer and steer_again: each boid looks at those around it, steers and moves.
//
// Reynolds 1987 as the flocking article has it: separation, alignment and cohesion, avoidance and
// attraction, what drives boids besides each other, then Particle.update and the edges. All see the
// state of the frame before, so that the order of the boids does not matter. One invocation a boid of
// the flock, in sorted order. Where there are throngs, steer_again does it once more if a driver has ended
// a loop of anybody in steer, with more boids a turn: for few, turns of few are faster.
// Reads: frame, flocks, relations, obstacles, solid_faces, winds, cell_starts, sorted_boids. Writes:
// boids, boid_trails; overlooked on devices with 64-bit integers, as software ones that end loops have.
// Invariant: whoever is nearer than a relation's radius is looked at, and everybody at most once; boids for
// which a driver has ended a loop before its end are counted. Where only the nearest count (Ballerini et
// al. 2008), who they are depends on distances and identities alone.

#import motes::boid::{Motion, boid_of, halves, moved}
#import motes::dispatch::linear_index
#import motes::exact::{bits_of, dot3, less, less_equal, normalize_exact}
#import motes::grid::{around, cell_index, gap_to, half_row, nearest_way, place_in_cells, span}
#import motes::layout::{
    Boid, EDGES_TORUS, FlockFrame, Frame, MOST_NEAREST, MOST_WINDS, OBSTACLE_MESH, Obstacle, ROWS_A_SOLID_FACE, Relation, Wind,
}
#import motes::solid::{Nearest, nearest_of, solid_surface}
#import motes::steering::{Perceived, Sum, all_carried, answer, nothing, perceiving, sees}
#import motes::urge::{Surface, facing, kept_out, sought, sphere_surface, surface_of, turned_away}
#import motes::wind::{Kinds, wind_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether boids may look at more others than loops of software drivers turn, 65,535; at more than four
// times as many.
const CROWDS: bool = #{CROWDS};
const THRONGS: bool = #{THRONGS};
// Whether sixteen others are looked at a turn.
const SIXTEENS: bool = #{SIXTEENS};
// Whether any flock has depth.
const DEPTHS: bool = #{DEPTHS};
// Whether opposite edges of any flock are the same.
const TORUS: bool = #{TORUS};
// Whether any boids do not see all around; whether any see but the nearest; whether any have a goal,
// obstacles, meshes among them, drag; what parts of the wind there are.
const VIEWS: bool = #{VIEWS};
const NEAREST: bool = #{NEAREST};
const GOALS: bool = #{GOALS};
const OBSTACLES: bool = #{OBSTACLES};
const SOLIDS: bool = #{SOLIDS};
const BLOWN: bool = #{BLOWN};
const MANY_WINDS: bool = #{MANY_WINDS};
const FLOWS: bool = #{FLOWS};
const NOISES: bool = #{NOISES};
const OCTAVES: bool = #{OCTAVES};
const FOLDS: bool = #{FOLDS};
const CURLS: bool = #{CURLS};
// Whether any flock has trails.
const TRAILS: bool = #{TRAILS};

struct Which {
    flock: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<storage, read> flocks: array<FlockFrame>;
@group(0) @binding(1) var<storage, read> relations: array<Relation>;
@group(0) @binding(2) var<storage, read> cell_starts: array<u32>;
#if WIDE == true
@group(0) @binding(3) var<storage, read> sorted_boids: array<vec4<u64>>;
#else
@group(0) @binding(3) var<storage, read> sorted_boids: array<Boid>;
#endif
@group(0) @binding(4) var<storage, read_write> boids: array<Boid>;
@group(0) @binding(5) var<storage, read> obstacles: array<Obstacle>;
@group(0) @binding(6) var<uniform> winds: array<Wind, MOST_WINDS>;
@group(0) @binding(7) var<uniform> frame: Frame;
@group(0) @binding(8) var<storage, read_write> boid_trails: array<vec4<u32>>;
@group(0) @binding(9) var<storage, read> solid_faces: array<vec4<f32>>;
#if WIDE == true
// How many boids are overlooked, and one past the last frame in which steer has been cut. Other devices have
// no binding left for it.
@group(0) @binding(10) var<storage, read_write> overlooked: array<atomic<u32>>;
#endif

// Whether a loop has been ended before its end: software drivers do so after 65,535 turns of all loops of
// an invocation.
var<private> is_cut: bool;

// After a loop that may be the one.
fn cut_unless(done: bool) {
    if CROWDS && !done {
        is_cut = true;
    }
}

// Farther than anything, squared.
const FAR_SQUARED: f32 = 1e30f;

// Who looks, at whom and how.
struct View {
    own: u32,
    motion: Motion,
    heading: vec3<f32>,
    relation: Relation,
    other: FlockFrame,
}

// The nearest so far, from near to far: squared distance as bits, index in its flock, sorted place.
// All ones for nobody. Straight code keeps them in order: software drivers count the turns of all loops.
var<private> nearest: array<vec3<u32>, MOST_NEAREST>;

// Who has to leave that place of the list, one place farther, where `who` is nearer than who stands there.
fn placed(slot: u32, who: vec3<u32>) -> vec3<u32> {
    let here = nearest[slot];
    let is_nearer = who.x < here.x || (who.x == here.x && who.y < here.y);
    nearest[slot] = select(here, who, is_nearer);
    return select(who, here, is_nearer);
}

fn placed_in_four(first: u32, who: vec3<u32>) -> vec3<u32> {
    let second = placed(first + 1u, placed(first, who));
    return placed(first + 3u, placed(first + 2u, second));
}

fn keep_nearest(who: vec3<u32>, count: u32) {
    let after_eight = placed_in_four(4u, placed_in_four(0u, who));
    if count > 8u {
        placed_in_four(12u, placed_in_four(8u, after_eight));
    }
}

#if WIDE == true
fn sorted_boid(at: u32) -> Boid {
    return boid_of(sorted_boids[at]);
}

fn place_of(at: u32) -> vec3<f32> {
    let xy = halves(sorted_boids[at].x);
    if !DEPTHS {
        return bitcast<vec3<f32>>(vec3<u32>(xy, 0u));
    }
    return bitcast<vec3<f32>>(vec3<u32>(xy, u32(sorted_boids[at].y)));
}

fn velocity_of(at: u32) -> vec3<f32> {
    let xy = halves(sorted_boids[at].z);
    if !DEPTHS {
        return bitcast<vec3<f32>>(vec3<u32>(xy, 0u));
    }
    return bitcast<vec3<f32>>(vec3<u32>(xy, u32(sorted_boids[at].w)));
}
#else
fn sorted_boid(at: u32) -> Boid {
    return sorted_boids[at];
}

fn place_of(at: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(sorted_boids[at].position_and_flock.xyz);
}

fn velocity_of(at: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(sorted_boids[at].velocity_and_index.xyz);
}
#endif

// The way to the boid at that sorted place.
fn way_to(view: View, at: u32) -> vec3<f32> {
    let straight = place_of(at) - view.motion.position;
    if !TORUS {
        return straight;
    }
    let torus = view.other.torus;
    let inverse = view.other.torus_inverse;
    let x = nearest_way(straight.x, torus.x, inverse.x);
    let y = nearest_way(straight.y, torus.y, inverse.y);
    if !DEPTHS {
        return vec3<f32>(x, y, 0.0f);
    }
    return vec3<f32>(x, y, nearest_way(straight.z, torus.z, inverse.z));
}

// The sum, of nothing in depth where there is none.
fn within_depth(sum: Sum) -> Sum {
    if DEPTHS {
        return sum;
    }
    return Sum(
        vec3<i32>(sum.high.xy, 0i), vec3<i32>(sum.coarse.xy, 0i), vec3<i32>(sum.fine.xy, 0i),
    );
}

// What is perceived with one more, whose velocity is that.
fn perceiving_one(perceived: Perceived, view: View, offset: vec3<f32>, squared: f32, velocity: vec3<f32>) -> Perceived {
    let own = view.motion.velocity;
    let more = perceiving(perceived, view.relation, view.other, offset, squared, own, velocity);
    return Perceived(more.count, within_depth(more.away), within_depth(more.along), within_depth(more.toward));
}

// What is perceived with the boid at that sorted place, if it is near and its place before `end`.
fn visited(perceived: Perceived, view: View, place: u32, end: u32) -> Perceived {
    // Who looks does not see itself.
    let at = select(view.own, place, place < end);
    let offset = way_to(view, at);
    // Loads that only some lanes make cost software drivers more than those of all.
    let velocity = velocity_of(at);
    let squared = dot3(offset, offset);
    if at == view.own || !less(squared, view.relation.reach.x) {
        return perceived;
    }
    if VIEWS && !sees(view.heading, offset, squared, view.relation) {
        return perceived;
    }
    if NEAREST && view.relation.kinds.w > 0u {
        let index = sorted_boid(at).velocity_and_index.w;
        keep_nearest(vec3<u32>(bits_of(squared), index, at), view.relation.kinds.w);
        return perceived;
    }
    return perceiving_one(perceived, view, offset, squared, velocity);
}

fn visited_four(perceived: Perceived, view: View, at: u32, end: u32) -> Perceived {
    let two = visited(visited(perceived, view, at, end), view, at + 1u, end);
    return visited(visited(two, view, at + 2u, end), view, at + 3u, end);
}

fn visited_sixteen(perceived: Perceived, view: View, at: u32, end: u32) -> Perceived {
    let eight = visited_four(visited_four(perceived, view, at, end), view, at + 4u, end);
    return visited_four(visited_four(eight, view, at + 8u, end), view, at + 12u, end);
}

// What is perceived with the boids of sorted places from .x up to .y; of crowds several a turn, for a
// million may be in one cell. Loops that look at their end first are gone through once more by software
// drivers, when all lanes have reached it.
fn visited_all(perceived: Perceived, view: View, range: vec2<u32>) -> Perceived {
    var all = perceived;
    var at = range.x;
    loop {
        if SIXTEENS {
            all = all_carried(visited_sixteen(all, view, at, range.y));
            at += 16u;
        } else if CROWDS {
            all = all_carried(visited_four(all, view, at, range.y));
            at += 4u;
        } else {
            all = visited(all, view, at, range.y);
            at += 1u;
        }
        continuing {
            break if at >= range.y;
        }
    }
    cut_unless(at >= range.y);
    return all;
}

// The sorted places of a row's cells from x = first on, so many.
fn row_range(other: FlockFrame, first: i32, count: i32, y: i32, z: i32) -> vec2<u32> {
    let start = cell_index(other, first, y, z);
    return vec2<u32>(cell_starts[start], cell_starts[start + u32(count)]);
}

// The nth of the rows that are visited, from `first` on: that whose number is nth modulo so many.
fn nth_row(nth: i32, first: i32, slots: i32) -> i32 {
    let beyond = (nth - first) % slots;
    return first + select(beyond, beyond + slots, beyond < 0i);
}

// All that a boid perceives of a flock: row by row of the cells in reach; on a torus, the part of a
// row beyond its end is a row of its own. Neighbours visit the same row at the same time, wherever
// their own is: the loops of several turn together on software drivers, as often as the longest.
fn look(view: View) -> Perceived {
    let other = view.other;
    let wraps = TORUS && other.members.w == EDGES_TORUS;
    let reach = view.relation.cohesion.w;
    let place = place_in_cells(other, view.motion.position);
    let along_y = span(place.y, reach * other.cells_per_unit.y, other.grid.y, wraps);
    let along_z = span(place.z, reach * other.cells_per_unit.z, other.grid.z, wraps);
    var perceived = nothing();
    if NEAREST {
        for (var slot = 0u; slot < MOST_NEAREST; slot += 1u) {
            nearest[slot] = vec3<u32>(0xffffffffu);
        }
    }
    // Three rows are in reach along an axis, but at the ends of the grid.
    let slots_y = max(along_y.count, 3i);
    let slots_z = select(max(along_z.count, 3i), 1i, other.grid.z == 1u);
    var row = slots_y * slots_z;
    for (; row > 0i; row -= 1i) {
        let y = nth_row(row % slots_y, along_y.first, slots_y);
        let z = nth_row(row / slots_y, along_z.first, slots_z);
        let is_there = y < along_y.first + along_y.count && z < along_z.first + along_z.count;
        let gap_y = gap_to(y, place.y, other.cell_extent.y, along_y.count, other.grid.y, wraps);
        let gap_z = gap_to(z, place.z, other.cell_extent.z, along_z.count, other.grid.z, wraps);
        let half = half_row(reach, gap_y * gap_y + gap_z * gap_z);
        if is_there && less(0.0f, half) {
            let along_x = span(place.x, half * other.cells_per_unit.x, other.grid.x, wraps);
            var first = along_x.first;
            var row_y = y;
            var row_z = z;
            if wraps {
                first = around(first, other.grid.x);
                row_y = around(y, other.grid.y);
                row_z = around(z, other.grid.z);
            }
            // One turn, but for what is beyond the end of a torus.
            var left = along_x.count;
            while left > 0i {
                let within = min(left, i32(other.grid.x) - first);
                let range = row_range(other, first, within, row_y, row_z);
                perceived = visited_all(perceived, view, range);
                left -= within;
                first = 0i;
            }
            cut_unless(left <= 0i);
        }
    }
    cut_unless(row <= 0i);
    var slot = 0u;
    for (; NEAREST && slot < view.relation.kinds.w; slot += 1u) {
        let at = nearest[slot].z;
        if at != 0xffffffffu {
            let offset = way_to(view, at);
            let squared = dot3(offset, offset);
            perceived = perceiving_one(perceived, view, offset, squared, velocity_of(at));
        }
    }
    cut_unless(!NEAREST || slot >= view.relation.kinds.w);
    return perceived;
}

// What the wind adds to a velocity in a frame: a part of what it lacks of the wind's, in a plane
// without depth.
fn dragged(flock: FlockFrame, lone_wind: Wind, motion: Motion) -> vec3<f32> {
    var flow = vec3<f32>(0.0f);
    let has = Kinds(FLOWS, NOISES, OCTAVES, FOLDS, CURLS);
    if MANY_WINDS {
        for (var at = 0u; at < frame.wind_count; at += 1u) {
            flow += wind_of(winds[at], motion.position, has);
        }
    } else if frame.wind_count == 1u {
        flow = wind_of(lone_wind, motion.position, has);
    }
    flow.z = select(0.0f, flow.z, flock.ties.z == 1u);
    return (flow - motion.velocity) * flock.goal_rule.w;
}

// The surface of a mesh. Far from what boids are to stay out of, that of the ball around it: nobody
// turns away from either.
fn surface_of_mesh(obstacle: Obstacle, position: vec3<f32>) -> Surface {
    let from_center = position - obstacle.place.xyz;
    let ball = sphere_surface(from_center, obstacle.place.w);
    if obstacle.kinds.y == 0u && less_equal(1.0f, ball.distance * obstacle.push.x) {
        return ball;
    }
    let at = from_center * obstacle.extent.x;
    var nearest = Nearest(vec3<f32>(0.0f), FAR_SQUARED, 0u);
    let end = obstacle.kinds.z + obstacle.kinds.w;
    var face = obstacle.kinds.z;
    for (; face < end; face += 1u) {
        let corner = face * ROWS_A_SOLID_FACE;
        let away = at - solid_faces[corner].xyz;
        var here = nearest_of(away, solid_faces[corner + 1u].xyz, solid_faces[corner + 2u].xyz);
        if less(here.squared, nearest.squared) {
            here.part += corner;
            nearest = here;
        }
    }
    cut_unless(face >= end);
    return solid_surface(nearest, solid_faces[nearest.part].xyz, obstacle.place.w);
}

fn surface_at(obstacle: Obstacle, position: vec3<f32>) -> Surface {
    if SOLIDS && obstacle.kinds.x == OBSTACLE_MESH {
        return facing(obstacle, surface_of_mesh(obstacle, position));
    }
    return surface_of(obstacle, position);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn steer(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let flock = flocks[which.flock];
    let lone_wind = winds[0];
    let at = linear_index(global_id, WORKGROUP_SIZE);
    var is_idle = at >= flock.members.y;
#if WIDE == true
    if SIXTEENS {
        is_idle |= atomicLoad(&overlooked[1]) != frame.frame + 1u;
    }
#endif
    if is_idle {
        return;
    }
    let own = flock.members.x + at;
    let boid = sorted_boid(own);
    let position_bits = boid.position_and_flock;
    let velocity_bits = boid.velocity_and_index;
    let motion = Motion(bitcast<vec3<f32>>(position_bits.xyz), bitcast<vec3<f32>>(velocity_bits.xyz));
    let heading = normalize_exact(motion.velocity);
    var acceleration = flock.acceleration.xyz;
    var tie = 0u;
    for (; tie < flock.ties.y; tie += 1u) {
        let relation = relations[flock.ties.x + tie];
        let view = View(own, motion, heading, relation, flocks[relation.kinds.y]);
        acceleration += answer(look(view), relation, motion.velocity, flock.acceleration.w);
    }
    cut_unless(tie >= flock.ties.y);
    if GOALS && less(0.0f, flock.goal_rule.z) {
        acceleration += sought(flock, motion);
    }
    let obstacles_end = flock.drawn.z + flock.drawn.w;
    var ahead = flock.drawn.z;
    for (; OBSTACLES && ahead < obstacles_end; ahead += 1u) {
        let before = obstacles[ahead];
        acceleration += turned_away(before, surface_at(before, motion.position));
    }
    cut_unless(!OBSTACLES || ahead >= obstacles_end);
    if BLOWN {
        acceleration += dragged(flock, lone_wind, motion);
    }
    // In a plane there is no depth to go to, wherever others are.
    acceleration.z = select(0.0f, acceleration.z, flock.ties.z == 1u);
    var next = moved(flock, motion, acceleration);
    var behind = flock.drawn.z;
    for (; OBSTACLES && behind < obstacles_end; behind += 1u) {
        next = kept_out(surface_at(obstacles[behind], next.position), next);
    }
    cut_unless(!OBSTACLES || behind >= obstacles_end);
#if WIDE == true
    if CROWDS && is_cut {
        if THRONGS && !SIXTEENS {
            atomicStore(&overlooked[1], frame.frame + 1u);
        } else {
            atomicAdd(&overlooked[0], 1u);
        }
    }
#endif
    if TRAILS && flock.trail.z > 0u {
        let ring = flock.trail.x + velocity_bits.w * (flock.trail.y + 1u);
        boid_trails[ring + (frame.frame & flock.trail.y)] = vec4<u32>(position_bits.xyz, 0u);
    }
    let place = next.position;
    let velocity = next.velocity;
    boids[flock.members.x + velocity_bits.w] = Boid(
        vec4<u32>(bits_of(place.x), bits_of(place.y), bits_of(place.z), which.flock),
        vec4<u32>(bits_of(velocity.x), bits_of(velocity.y), bits_of(velocity.z), velocity_bits.w),
    );
}
