// boid_shapes: what boids look like: triangles or cones along their headings, or discs.
//
// The flocking article's render: a triangle whose pivot is a corner of its base, or an ellipse, and
// for its Rorschach patterns each a second time, mirrored at the picture's upright middle line. One
// invocation a boid of the flock.
// Reads: frame, flocks, counts, boids, layer_planes. Writes: covers, cover_counts (word 0: how many
// records are of something, by atomic adds; word 2: how many there are of boids).
// Invariant: records are in the order of identities, so that of equal depth who comes later is in
// front.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, cross3, dot3, less, normalize_exact}
#import motes::reach::is_visible
#import motes::layout::{
    BOID_CONE, BOID_POINT, BOID_TRIANGLE, Boid, COVERS_OF_BOIDS, COVERS_SEEN, COVER_NONE, Counts,
    Cover, FlockFrame, Frame,
}
#import motes::projection::project
#import motes::shape::{Look, cone_of, disc_of, mirrored, nothing_of, triangle_of}
#import motes::sprite::next_layer

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether the picture has layers; whether any flock is drawn as triangles, as cones; whether any is
// mirrored.
const LAYERS: bool = #{LAYERS};
const TRIANGLES: bool = #{TRIANGLES};
const MIRRORS: bool = #{MIRRORS};
const CONES: bool = #{CONES};
// How far a cone's base and its apex are from its middle, in sizes: with a radius of half a size, as
// motes::cover has its angle.
const BASE_BEHIND: f32 = 0.75f;
const APEX_AHEAD: f32 = 1.25f;

struct Which {
    flock: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> flocks: array<FlockFrame>;
@group(0) @binding(2) var<storage, read> counts: Counts;
@group(0) @binding(3) var<storage, read> boids: array<Boid>;
@group(0) @binding(4) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> covers: array<Cover>;
@group(0) @binding(6) var<storage, read_write> cover_counts: array<atomic<u32>>;

// The layer, from 1, that a world place is in. No branch and no loop asks uniforms alone, see
// motes::sprite::next_layer.
fn layer_of(world: vec3<f32>) -> u32 {
    var layer = 0u;
    for (var at = 0u; (at < frame.layer_plane_count) & (layer == 0u); at += 1u) {
        let plane = layer_planes[at];
        layer = next_layer(layer, at, dot3(plane.xyz, world) - plane.w);
    }
    return select(layer, frame.layer_plane_count + 1u, layer == 0u);
}

// Where a boid heads; who does not move, along x.
fn forward_of(velocity: vec3<f32>) -> vec3<f32> {
    let heading = normalize_exact(velocity);
    let stands = bits_of(heading.x) | bits_of(heading.y) | bits_of(heading.z);
    return select(heading, vec3<f32>(1.0f, 0.0f, 0.0f), stands == 0u);
}

// The cone of a boid; of nothing if an end is too near.
fn cone(size: f32, position: vec3<f32>, velocity: vec3<f32>, look: Look) -> Cover {
    let forward = forward_of(velocity);
    let base = project(frame, position - forward * (BASE_BEHIND * size));
    let apex = project(frame, position + forward * (APEX_AHEAD * size));
    if less(base.depth, frame.near) || less(apex.depth, frame.near) {
        return nothing_of();
    }
    let ahead = -dot3(frame.view_from_world_z.xyz, forward);
    let surface = look.color;
    let ambient = vec4<f32>(surface.xyz * frame.ambient_color.xyz, surface.w);
    let lit = Look(look.depth, ambient, surface.xyz * frame.light_color.xyz);
    let radius_px = 0.5f * size * base.scale;
    return cone_of(vec2<f32>(base.x, base.y), vec2<f32>(apex.x, apex.y), radius_px, ahead, lit);
}

// The triangle of a boid; of nothing if a corner is too near.
fn triangle(size: f32, position: vec3<f32>, velocity: vec3<f32>, look: Look) -> Cover {
    let forward = forward_of(velocity);
    let side = normalize_exact(cross3(forward, frame.view_from_world_z.xyz));
    let a = project(frame, position);
    let b = project(frame, position + side * size);
    let c = project(frame, position + side * (0.5f * size) + forward * (1.2f * size));
    if less(b.depth, frame.near) || less(c.depth, frame.near) {
        return nothing_of();
    }
    return triangle_of(vec2<f32>(a.x, a.y), vec2<f32>(b.x, b.y), vec2<f32>(c.x, c.y), look);
}

fn cover_of(flock: FlockFrame, boid: Boid) -> Cover {
    let position = bitcast<vec3<f32>>(boid.position_and_flock.xyz);
    let velocity = bitcast<vec3<f32>>(boid.velocity_and_index.xyz);
    let seen = project(frame, position);
    let size = flock.cells_per_unit.w;
    let shape = flock.ties.w;
    let size_px = select(size * seen.scale, size, shape == BOID_POINT);
    let here = !LAYERS || ((frame.layer == 0u) | (layer_of(position) == frame.layer));
    if !here || !is_visible(frame, seen, seen, 2.0f * size_px) {
        return nothing_of();
    }
    let look = Look(seen.depth, flock.color, vec3<f32>(0.0f));
    if TRIANGLES && shape == BOID_TRIANGLE {
        return triangle(size, position, velocity, look);
    }
    if CONES && shape == BOID_CONE {
        return cone(size, position, velocity, look);
    }
    return disc_of(seen.x, seen.y, 0.5f * size_px, 0.0f, look);
}

fn put(at: u32, cover: Cover) {
    if cover.shape.z != COVER_NONE {
        atomicAdd(&cover_counts[COVERS_SEEN], 1u);
    }
    covers[at] = cover;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn boid_shapes(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let flock = flocks[which.flock];
    let faces = flock.drawn.y;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= flock.members.y {
        return;
    }
    if at == 0u {
        atomicAdd(&cover_counts[COVERS_OF_BOIDS], flock.members.y * faces);
    }
    if faces == 0u {
        return;
    }
    let cover = cover_of(flock, boids[flock.members.x + at]);
    let first = counts.live + flock.drawn.x + at * faces;
    if MIRRORS && faces == 2u {
        let both = mirrored(cover, frame);
        put(first, both[0]);
        put(first + 1u, both[1]);
    } else {
        put(first, cover);
    }
}
