// shapes: what of the particles covers, as it is seen.
//
// Reeves 1983, 5: particles as single objects that reflect light. One invocation a particle of one
// page; those that only glow, are strokes, out of sight or in another layer leave a record of nothing.
// Reads: frame, shade_box, system_frames, rows, counts, particles, layer_planes, shade_light. Writes: covers, cover_counts
// (word 0: how many records are of something, by atomic adds; word 1: how many there are).
// Invariant: record i is that of particle i, so records are in the order of identities.

#import motes::dispatch::linear_index
#import motes::exact::{dot3, f32_of_u32, less}
#import motes::reach::is_visible
#import motes::layout::{
    COVERS_OF_PARTICLES, COVERS_SEEN, COVER_NONE, Counts, Cover, Frame, PARTICLE_STROKE, Particle, ROW_LIT_CLOUD,
    ROW_LIT_SPHERE, ROW_OVER, ROW_SOFTNESS_SHIFT, ShadeBox, SystemFrame, SystemRow,
}
#import motes::particle::{age_of, row_index, slot_of}
#import motes::shade::{around, corner_share, is_cell}
#import motes::shape::{Look, disc_of, segment_of, square_of}
#import motes::sprite::{Features, Sprite, next_layer, sprite_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether any system has such particles.
const STREAKS: bool = #{STREAKS};
const RECTANGLES: bool = #{RECTANGLES};
const RATE_SPREADS: bool = #{RATE_SPREADS};
// Whether any is seen as its whole trajectory.
const STROKES: bool = #{STROKES};
// Whether clouds throw shadows on themselves.
const SHADES: bool = #{SHADES};
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};

// A 65,535th.
const SOFTNESS_STEP: f32 = 0.000015259022f;

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> counts: Counts;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> covers: array<Cover>;
@group(0) @binding(7) var<storage, read_write> cover_counts: array<atomic<u32>>;
@group(0) @binding(8) var<uniform> shade_box: ShadeBox;
@group(0) @binding(9) var<storage, read> shade_light: array<u32>;

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

// How much of the light comes to a world place: all of it outside the box.
fn light_at(world: vec3<f32>) -> f32 {
    let near = around(shade_box, world);
    var sum = 0.0f;
    for (var corner = 0u; corner < 8u; corner += 1u) {
        let cell = near.cell + vec3<i32>(vec3<u32>(corner, corner >> 1u, corner >> 2u) & vec3<u32>(1u));
        var here = 1.0f;
        if is_cell(shade_box, cell) {
            let place = (u32(cell.z) * shade_box.kinds.x + u32(cell.y)) * shade_box.kinds.x + u32(cell.x);
            here = bitcast<f32>(shade_light[place]);
        }
        sum += here * corner_share(near.part, corner);
    }
    return sum;
}

fn cover_of(sprite: Sprite, flags: u32) -> Cover {
    let begin = vec2<f32>(sprite.start.x, sprite.start.y);
    let end = vec2<f32>(sprite.end.x, sprite.end.y);
    let way = end - begin;
    var look = Look(sprite.start.depth, sprite.surface, vec3<f32>(0.0f));
    if (flags & ROW_LIT_CLOUD) != 0u {
        var part = 1.0f;
        if SHADES {
            part = light_at(sprite.world);
        }
        let light = frame.ambient_color.xyz + frame.light_color.xyz * part;
        look.color = vec4<f32>(sprite.surface.xyz * light, sprite.surface.w);
    }
    if RECTANGLES && sprite.square {
        return square_of(begin.x, begin.y, sprite.radius_px, look);
    }
    if STREAKS && less(0.0001f, way.x * way.x + way.y * way.y) {
        return segment_of(begin, end, sprite.radius_px, look);
    }
    if (flags & ROW_LIT_SPHERE) != 0u {
        look.color = vec4<f32>(sprite.surface.xyz * frame.ambient_color.xyz, sprite.surface.w);
        look.lit = sprite.surface.xyz * frame.light_color.xyz;
    }
    let softness = f32_of_u32(flags >> ROW_SOFTNESS_SHIFT) * SOFTNESS_STEP;
    return disc_of(begin.x, begin.y, sprite.radius_px, softness, look);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn shapes(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let page_start = pages.page * frame.page_len;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.live - min(counts.live, page_start), frame.page_len) {
        return;
    }
    if page_start + at == 0u {
        atomicStore(&cover_counts[COVERS_OF_PARTICLES], counts.live);
    }
    let particle = particles[at];
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    let row = rows[row_index(slot, frame.frame - age_of(birth, frame.frame), frame.row_mask)];
    let features = Features(STREAKS, RECTANGLES, RATE_SPREADS, false);
    let sprite = sprite_of(frame, system_frames[slot], row, particle, features);
    let here = !LAYERS || ((frame.layer == 0u) | (layer_of(sprite.world) == frame.layer));
    let is_stroke = STROKES && row.kinds.y == PARTICLE_STROKE;
    let is_seen = (row.kinds.w & ROW_OVER) != 0u && !is_stroke && here && less(0.0f, sprite.surface.w)
        && is_visible(frame, sprite.start, sprite.end, sprite.radius_px);
    var cover = Cover(vec4<u32>(0u), vec4<u32>(0u, 0u, COVER_NONE, 0u), vec4<u32>(0u), vec4<u32>(0u));
    if is_seen {
        cover = cover_of(sprite, row.kinds.w);
        atomicAdd(&cover_counts[COVERS_SEEN], 1u);
    }
    covers[page_start + at] = cover;
}
