// splat: every particle adds its light to the pixels it covers.
//
// Reeves 1983, 2.5: each particle is a point light source, nothing hides anything, and the light
// added depends on colour and transparency, not on distance; motes::footprint says where it falls.
// One invocation a particle of one page; what covers many pixels is left to splat_large.
// Reads: frame, system_frames, rows, counts, particles, layer_planes. Writes, by atomic adds: light_low,
// light_high, where WIDE light_packed before them; large_particles (count, then indices from word 2).
// Invariant: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::exact::{clamp_unit, dot3, f32_of_i32, less, reciprocal, square_root, to_i32}
#import motes::footprint::{
    FEW_CELLS, Footprint, PI, SMALL_DISC, SMALL_SIDE, SQUARE, footprint_of, is_visible, minor_range,
    square_weight_at, weight_at,
}
#import motes::layout::{Counts, Frame, Particle, ROW_OVER, SystemFrame, SystemRow}
#import motes::light::steps_of
#import motes::packed::{channels_of, left_over, packed}
#import motes::particle::{age_of, row_index, slot_of}
#import motes::sprite::{Features, Sprite, next_layer, sprite_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether there are several systems, several parameter rows.
const MANY_SYSTEMS: bool = #{MANY_SYSTEMS};
const MANY_ROWS: bool = #{MANY_ROWS};
// Whether any system has such particles.
const STREAKS: bool = #{STREAKS};
const RECTANGLES: bool = #{RECTANGLES};
const RATE_SPREADS: bool = #{RATE_SPREADS};
const LIGHT_DISTANCES: bool = #{LIGHT_DISTANCES};
// Whether any system's particles cover, which are not of this stage.
const COVERS: bool = #{COVERS};
// Whether the picture has layers.
const LAYERS: bool = #{LAYERS};

// Whether a planet splits the picture.
const PLANET: bool = #{PLANET};

// Which particles: those before the planet's outline or, if `is_behind` is 1, those behind it.
struct Pages {
    page: u32,
    is_behind: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> counts: Counts;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> light_high: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read_write> large_particles: array<atomic<u32>>;
@group(0) @binding(8) var<storage, read> layer_planes: array<vec4<f32>>;
#if WIDE == true
@group(0) @binding(9) var<storage, read_write> light_packed: array<atomic<u64>>;
#endif

// What is the same for all invocations where there is only one of it.
struct Lone {
    system: SystemFrame,
    row: SystemRow,
}

fn system_at(slot: u32, lone: Lone) -> SystemFrame {
    if MANY_SYSTEMS {
        return system_frames[slot];
    }
    return lone.system;
}

fn row_at(index: u32, lone: Lone) -> SystemRow {
    if MANY_ROWS {
        return rows[index];
    }
    return lone.row;
}

// Adds steps to the limbs of a channel; a count with the highest bit set is negative.
fn add_to_limbs(at: u32, steps: u32) {
    let before = atomicAdd(&light_low[at], steps);
    let carry = select(0u, 1u, before > 0xffffffffu - steps);
    let high = carry - (steps >> 31u);
    if high != 0u {
        atomicAdd(&light_high[at], high);
    }
}

fn add_light(x: i32, y: i32, color: vec3<f32>, weight: f32) {
    let pixel = u32(y) * frame.width + u32(x);
    let steps = vec3<u32>(
        steps_of(color.x * weight), steps_of(color.y * weight), steps_of(color.z * weight),
    );
#if WIDE == true
    let word = packed(steps);
    let over = left_over(atomicAdd(&light_packed[pixel], word), word, steps);
    // Drivers that run all branches turn a loop once: it is the one place of three channels.
    var left = channels_of(over);
    while left != 0u {
        let channel = firstTrailingBit(left);
        left &= left - 1u;
        add_to_limbs(pixel * 3u + channel, over[channel]);
    }
#else
    add_to_limbs(pixel * 3u, steps.x);
    add_to_limbs(pixel * 3u + 1u, steps.y);
    add_to_limbs(pixel * 3u + 2u, steps.z);
#endif
}

// One row of pixels across the major axis.
fn draw_row(shape: Footprint, major: i32, color: vec3<f32>) {
    let range = minor_range(shape, major);
    let last = min(range.y, shape.minor_size);
    for (var minor = max(range.x, 0); minor < last; minor += 1) {
        var weight: f32;
        if RECTANGLES && shape.kind == SQUARE {
            weight = square_weight_at(shape, major, minor);
        } else {
            weight = weight_at(shape, major, minor) * shape.gain;
        }
        if less(0.0f, weight) {
            add_light(
                select(major, minor, shape.steep),
                select(minor, major, shape.steep),
                color,
                weight,
            );
        }
    }
}

// How much of a pixel a disc around `center` covers, 0 to 1.
fn disc_weight(center: vec2<f32>, reach: f32, x: i32, y: i32) -> f32 {
    let dx = f32_of_i32(x) + 0.5f - center.x;
    let dy = f32_of_i32(y) + 0.5f - center.y;
    return clamp_unit(reach - square_root(dx * dx + dy * dy));
}

// A small disc at rest. What it covers is found first, a bit a pixel, so that invocations side by
// side then turn a loop as often as they have pixels, wherever these are.
fn draw_small_disc(sprite: Sprite, reach: f32) {
    let center = vec2<f32>(sprite.start.x, sprite.start.y);
    let left = to_i32(center.x - reach + 0.5f);
    let top = to_i32(center.y - reach + 0.5f);
    let columns = min(to_i32(center.x + reach - 0.5f) - left + 1, i32(SMALL_SIDE));
    let lines = min(to_i32(center.y + reach - 0.5f) - top + 1, i32(SMALL_SIDE));
    var covered = 0u;
    var sum = 0.0f;
    for (var column = 0; column < columns; column += 1) {
        let x = left + column;
        for (var line = 0; line < lines; line += 1) {
            let y = top + line;
            let weight = disc_weight(center, reach, x, y);
            let inside = x >= 0 && y >= 0 && x < i32(frame.width) && y < i32(frame.height);
            let bit = 1u << (u32(column) * SMALL_SIDE + u32(line));
            covered |= select(0u, bit, inside && less(0.0f, weight));
            sum += weight;
        }
    }
    let gain = PI * sprite.radius_px * sprite.radius_px * reciprocal(sum);
    while covered != 0u {
        let at = firstTrailingBit(covered);
        covered &= covered - 1u;
        let x = left + i32(at / SMALL_SIDE);
        let y = top + i32(at % SMALL_SIDE);
        add_light(x, y, sprite.color, disc_weight(center, reach, x, y) * gain);
    }
}

// The layer, from 1, that a world place is in.
fn layer_of(world: vec3<f32>) -> u32 {
    var layer = 0u;
    for (var at = 0u; at < frame.layer_plane_count; at += 1u) {
        let plane = layer_planes[at];
        layer = next_layer(layer, at, dot3(plane.xyz, world) - plane.w);
    }
    return select(layer, frame.layer_plane_count + 1u, layer == 0u);
}

// Whether a world place is beyond the plane of the planet's outline.
fn is_beyond(world: vec3<f32>) -> bool {
    return less(dot3(frame.planet_outline.xyz, world), frame.planet_outline.w);
}

fn leave_to_splat_large(at: u32) {
    let place = atomicAdd(&large_particles[0], 1u);
    atomicStore(&large_particles[2u + place], at);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn splat(@builtin(global_invocation_id) global_id: vec3<u32>) {
    // Before the first branch, as software drivers load it lane by lane after that.
    let lone = Lone(system_frames[0], rows[0]);
    let page_start = pages.page * frame.page_len;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.live - min(counts.live, page_start), frame.page_len) {
        return;
    }
    let particle = particles[at];
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    let row = row_at(row_index(slot, frame.frame - age_of(birth, frame.frame), frame.row_mask), lone);
    if COVERS && (row.kinds.w & ROW_OVER) != 0u {
        return;
    }
    let features = Features(STREAKS, RECTANGLES, RATE_SPREADS, LIGHT_DISTANCES);
    let sprite = sprite_of(frame, system_at(slot, lone), row, particle, features);
    if !is_visible(frame, sprite.start, sprite.end, sprite.radius_px) {
        return;
    }
    if LAYERS && frame.layer != 0u && layer_of(sprite.world) != frame.layer {
        return;
    }
    if PLANET && is_beyond(sprite.world) != (pages.is_behind == 1u) {
        return;
    }
    let shape = footprint_of(
        frame, sprite.start, sprite.end, sprite.radius_px, sprite.square, sprite.conserved,
    );
    if shape.kind == SMALL_DISC {
        draw_small_disc(sprite, shape.reach);
    } else if shape.cells <= FEW_CELLS {
        for (var major = shape.first; major < shape.last; major += 1) {
            draw_row(shape, major, sprite.color);
        }
    } else {
        leave_to_splat_large(at);
    }
}
