// strokes: whole trajectories of particles, as pieces that cover, and their shadows on the ground.
//
// Reeves 1983, 4.3: the time-domain motion of a particle makes a static shape, a blade of grass. Colour,
// opacity and width along it are those of the particle at each moment; its width falls by the taper, too.
// One invocation a particle of one page. Reads: frame, stroke_light, system_frames, rows, counts, particles,
// layer_planes, lamps. Writes: covers, cover_counts (word 0: how many records are of something, by atomic
// adds; word 6: how many there are of strokes).
// Invariant: a particle has as many records as any other, those of its shadow first; all that is not a
// stroke's piece is of nothing, and so is what is below the ground. What is written depends on the particle, its system and the view alone.

#import motes::dispatch::linear_index
#import motes::exact::{
    at_least_zero, dot3, f32_of_u32, inverse_square_root, less, min_exact, normalize_exact, reciprocal, to_i32,
}
#import motes::layout::{
    COVERS_OF_BOIDS, COVERS_OF_FRONTS, COVERS_OF_MARKS, COVERS_OF_PARTICLES, COVERS_OF_SMOKE, COVERS_OF_STROKES,
    COVERS_SEEN, COVER_NONE, Counts, Cover, FRAME_ORTHOGRAPHIC, Frame, Lamp, PARTICLE_STROKE, Particle, STROKE_PIECES_MASK,
    STROKE_SHADOW_SHIFT, STROKE_SHARE_MASK, STROKE_TAPER_SHIFT, STROKE_UNCUT, StrokeLight, SystemFrame,
    SystemRow,
}
#import motes::particle::{Identity, age_of, appearance_of, lifetime_of, row_index, slot_of}
#import motes::projection::{Projected, project}
#import motes::reach::{MOST_RADIUS_PX, is_visible}
#import motes::shape::{Look, nothing_of, stroke_of}
#import motes::sprite::next_layer
#import motes::stroke::{Way, as_light_has_it, cut_of, lit_along, motion_at, pieces_of, place_at, shadow_of, way_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
const RATE_SPREADS: bool = #{RATE_SPREADS};
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};
// A 4,095th.
const SHARE_STEP: f32 = 0.00024420026f;

struct Work {
    page: u32,
    // Records of a stroke, and of a particle: of its shadow, if there are any, and of itself.
    pieces: u32,
    records: u32,
}
var<immediate> work: Work;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> stroke_light: StrokeLight;
@group(0) @binding(2) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(3) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(4) var<storage, read> counts: Counts;
@group(0) @binding(5) var<storage, read> particles: array<Particle>;
@group(0) @binding(6) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read> lamps: array<Lamp>;
@group(0) @binding(8) var<storage, read_write> covers: array<Cover>;
@group(0) @binding(9) var<storage, read_write> cover_counts: array<atomic<u32>>;

// A particle as a stroke: for how many frames it goes on, and what of its row says how it is drawn.
struct Stroke {
    who: Identity,
    row: SystemRow,
    frames: f32,
    taper: f32,
    shadow: f32,
}

// Where the stroke is seen at a moment, and half how wide it is there.
struct Joint {
    seen: Projected,
    at: vec2<f32>,
    half_px: f32,
}

fn layer_of(world: vec3<f32>) -> u32 {
    var layer = 0u;
    for (var at = 0u; (at < frame.layer_plane_count) & (layer == 0u); at += 1u) {
        let plane = layer_planes[at];
        layer = next_layer(layer, at, dot3(plane.xyz, world) - plane.w);
    }
    return select(layer, frame.layer_plane_count + 1u, layer == 0u);
}

fn joint_at(stroke: Stroke, way: Way, part: f32) -> Joint {
    let frames = stroke.frames * part;
    let seen = project(frame, place_at(way, frames));
    let look = appearance_of(stroke.who, stroke.row, u32(to_i32(frames)), RATE_SPREADS);
    let half_px = look.size * seen.scale * (1.0f - stroke.taper * part * part);
    return Joint(seen, vec2<f32>(seen.x, seen.y), min_exact(half_px, MOST_RADIUS_PX));
}

// What falls on a piece there that goes along there.
fn light_on(place: vec3<f32>, motion: vec3<f32>) -> vec3<f32> {
    let along = as_light_has_it(frame, normalize_exact(motion));
    let z_row = frame.view_from_world_z;
    let from_eye = vec3<f32>(
        dot3(frame.view_from_world_x.xyz, place) + frame.view_from_world_x.w,
        dot3(frame.view_from_world_y.xyz, place) + frame.view_from_world_y.w,
        -(dot3(z_row.xyz, place) + z_row.w),
    );
    let orthographic = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u;
    let to_eye = select(-normalize_exact(from_eye), vec3<f32>(0.0f, 0.0f, 1.0f), orthographic);
    var sum = frame.ambient_color.xyz + frame.light_color.xyz * lit_along(along, frame.light_from.xyz, to_eye);
    for (var at = 0u; at < stroke_light.kinds.x; at += 1u) {
        let lamp = lamps[at];
        let away = as_light_has_it(frame, lamp.place.xyz + stroke_light.lamps_from.xyz - place);
        let near = inverse_square_root(dot3(away, away));
        sum += lamp.color.xyz * (lamp.place.w * near * near * lit_along(along, away * near, to_eye));
    }
    return sum;
}

// The colour and opacity of a piece at that moment.
fn look_at(stroke: Stroke, way: Way, frames: f32, is_shadow: bool) -> vec4<f32> {
    let own = appearance_of(stroke.who, stroke.row, u32(to_i32(frames)), RATE_SPREADS);
    let place = place_at(way, frames);
    if !is_shadow {
        return vec4<f32>(own.color * light_on(place, motion_at(way, frames)), 1.0f - own.transparency);
    }
    // The ground fades away.
    let away = place - stroke_light.middle.xyz;
    let near = at_least_zero(1.0f - dot3(away, away) * stroke_light.middle.w);
    return vec4<f32>(stroke_light.shade_color.xyz, stroke.shadow * (1.0f - own.transparency) * near * near);
}

// The direction that pieces are cut off across where one goes on as another.
fn cut_between(a: vec2<f32>, b: vec2<f32>, c: vec2<f32>) -> f32 {
    let before = b - a;
    let behind = c - b;
    let turns = before.x * behind.x + before.y * behind.y;
    let share = inverse_square_root(before.x * before.x + before.y * before.y);
    let other = inverse_square_root(behind.x * behind.x + behind.y * behind.y);
    return select(STROKE_UNCUT, cut_of(before * share + behind * other), less(0.0f, turns));
}

// Writes the pieces of a stroke or of its shadow; how many are of something.
fn put_pieces(stroke: Stroke, own: Way, first: u32, is_shadow: bool) -> u32 {
    var way = own;
    if is_shadow {
        way = shadow_of(own, stroke_light);
    }
    let most = min(work.pieces, stroke.row.kinds.z & STROKE_PIECES_MASK);
    let count = pieces_of(frame, way, stroke.frames, most);
    let step = reciprocal(f32_of_u32(count));
    var begin = joint_at(stroke, way, 0.0f);
    var end = joint_at(stroke, way, step);
    var cut = STROKE_UNCUT;
    var seen = 0u;
    for (var at = 0u; at < work.pieces; at += 1u) {
        var cover = nothing_of();
        if at < count {
            let next = joint_at(stroke, way, f32_of_u32(at + 2u) * step);
            let next_cut = select(cut_between(begin.at, end.at, next.at), STROKE_UNCUT, at + 1u == count);
            let frames = stroke.frames * ((f32_of_u32(at) + 0.5f) * step);
            let color = look_at(stroke, way, frames, is_shadow);
            let here = !LAYERS || ((frame.layer == 0u) | (layer_of(place_at(way, frames)) == frame.layer));
            let halves = vec2<f32>(begin.half_px, end.half_px);
            let is_high = stroke_light.kinds.z == 0u
                || less(stroke_light.ground.w, dot3(stroke_light.ground.xyz, place_at(own, frames)));
            if here && less(0.0f, color.w) && less(0.0f, halves.x + halves.y) && is_high
                && is_visible(frame, begin.seen, end.seen, begin.half_px + end.half_px) {
                let depth = 0.5f * (begin.seen.depth + end.seen.depth);
                let look = Look(depth, color, vec3<f32>(0.0f));
                cover = stroke_of(begin.at, end.at, halves, vec2<f32>(cut, next_cut), look);
                seen += 1u;
            }
            begin = end;
            end = next;
            cut = next_cut;
        }
        covers[first + at] = cover;
    }
    return seen;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn strokes(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let page_start = work.page * frame.page_len;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.live - min(counts.live, page_start), frame.page_len) {
        return;
    }
    if page_start + at == 0u {
        atomicStore(&cover_counts[COVERS_OF_STROKES], counts.live * work.records);
    }
    let particle = particles[at];
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    let birth_frame = frame.frame - age_of(birth, frame.frame);
    let row = rows[row_index(slot, birth_frame, frame.row_mask)];
    let system = system_frames[slot];
    let who = Identity(system.key, birth_frame, particle.position_and_index.w);
    let first = atomicLoad(&cover_counts[COVERS_OF_PARTICLES]) + atomicLoad(&cover_counts[COVERS_OF_BOIDS])
        + atomicLoad(&cover_counts[COVERS_OF_MARKS]) + atomicLoad(&cover_counts[COVERS_OF_FRONTS])
        + atomicLoad(&cover_counts[COVERS_OF_SMOKE]) + (page_start + at) * work.records;
    if row.kinds.y != PARTICLE_STROKE {
        for (var nth = 0u; nth < work.records; nth += 1u) {
            covers[first + nth] = nothing_of();
        }
        return;
    }
    var stroke = Stroke(
        who,
        row,
        f32_of_u32(lifetime_of(who, row.speed_and_lifetime)),
        f32_of_u32((row.kinds.z >> STROKE_TAPER_SHIFT) & STROKE_SHARE_MASK) * SHARE_STEP,
        f32_of_u32(row.kinds.z >> STROKE_SHADOW_SHIFT) * SHARE_STEP,
    );
    stroke.shadow = select(0.0f, stroke.shadow, stroke_light.kinds.y != 0u);
    let way = way_of(system, particle);
    let of_shadow = work.records - work.pieces;
    var seen = put_pieces(stroke, way, first + of_shadow, false);
    if of_shadow != 0u {
        seen += put_pieces(stroke, way, first, true);
    }
    atomicAdd(&cover_counts[COVERS_SEEN], seen);
}
