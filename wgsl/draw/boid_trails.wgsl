// boid_trails: where boids have been in the last frames, as segments that fade and narrow.
//
// One invocation a boid of a flock that has trails. Reads: frame, flocks, counts, boids, boid_trails,
// layer_planes. Writes: covers, cover_counts (word 0: how many records are of something, by atomic
// adds; word 2: how many there are of boids).
// Invariant: a flock's trails stand before its boids, so that of equal depth they are behind them; who
// jumps across the world leaves no segment.

#import motes::dispatch::linear_index
#import motes::exact::{dot3, f32_of_u32, less, max_exact}
#import motes::layout::{
    BOID_POINT, Boid, COVERS_OF_BOIDS, COVERS_SEEN, COVER_NONE, Counts, Cover, FlockFrame, Frame,
}
#import motes::projection::project
#import motes::reach::is_visible
#import motes::shape::{Look, mirrored, nothing_of, segment_of}
#import motes::sprite::next_layer

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether the picture has layers; whether any flock is mirrored.
const LAYERS: bool = #{LAYERS};
const MIRRORS: bool = #{MIRRORS};

struct Which {
    flock: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> flocks: array<FlockFrame>;
@group(0) @binding(2) var<storage, read> counts: Counts;
@group(0) @binding(3) var<storage, read> boids: array<Boid>;
@group(0) @binding(4) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> boid_trails: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read_write> covers: array<Cover>;
@group(0) @binding(7) var<storage, read_write> cover_counts: array<atomic<u32>>;

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

// What is drawn between two places, `newer` after `older`, with that part of the boid's opacity and of
// the trail's width.
fn segment(flock: FlockFrame, newer: vec3<f32>, older: vec3<f32>, part: f32) -> Cover {
    let way = newer - older;
    let squared = dot3(way, way);
    let start = project(frame, newer);
    let end = project(frame, older);
    let size = flock.cells_per_unit.w;
    let size_px = select(size * start.scale, size, flock.ties.w == BOID_POINT);
    let width_px = size_px * flock.trail_look.y * part;
    let here = !LAYERS || ((frame.layer == 0u) | (layer_of(newer) == frame.layer));
    let stays = !less(0.0f, squared) || !less(squared, flock.trail_look.z);
    if !here || stays || !is_visible(frame, start, end, width_px) {
        return nothing_of();
    }
    let color = vec4<f32>(flock.color.xyz, flock.color.w * part);
    let look = Look(max_exact(start.depth, end.depth), color, vec3<f32>(0.0f));
    return segment_of(vec2<f32>(start.x, start.y), vec2<f32>(end.x, end.y), 0.5f * width_px, look);
}

fn put(at: u32, cover: Cover) {
    if cover.shape.z != COVER_NONE {
        atomicAdd(&cover_counts[COVERS_SEEN], 1u);
    }
    covers[at] = cover;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn boid_trails_seen(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let flock = flocks[which.flock];
    let faces = flock.drawn.y;
    let count = flock.trail.z;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= flock.members.y {
        return;
    }
    if at == 0u {
        atomicAdd(&cover_counts[COVERS_OF_BOIDS], flock.members.y * faces * count);
    }
    if faces == 0u {
        return;
    }
    let ring = flock.trail.x + at * (flock.trail.y + 1u);
    var newer = bitcast<vec3<f32>>(boids[flock.members.x + at].position_and_flock.xyz);
    var place = counts.live + flock.trail.w + (at + 1u) * count * faces;
    for (var age = 0u; age < count; age += 1u) {
        let older = bitcast<vec3<f32>>(boid_trails[ring + ((frame.frame - age) & flock.trail.y)].xyz);
        let cover = segment(flock, newer, older, 1.0f - f32_of_u32(age + 1u) * flock.trail_look.x);
        newer = older;
        // The newest is the last.
        place -= faces;
        if MIRRORS && faces == 2u {
            let both = mirrored(cover, frame);
            put(place, both[0]);
            put(place + 1u, both[1]);
        } else {
            put(place, cover);
        }
    }
}
