// splat: small discs at rest add their light to the pixels they cover.
//
// Reeves 1983, 2.5: each particle is a point light source, nothing hides anything, and the light
// added depends on colour and transparency, not on distance; motes::disc says where it falls.
// One invocation a particle of one page. What covers more, moves or is square is left to
// splat_large: drivers that run all branches would run that for every particle.
// Reads: frame, system_frames, rows, counts, particles, layer_planes, surface_nearness. Writes, by atomic adds: light_low,
// light_high, where WIDE light_packed before them; large_particles (motes::footprint).
// Invariant: the image does not depend on the order of particles.

#import motes::dispatch::linear_index
#import motes::disc::{Disc, SMALL_REACH_PX, covered_of, disc_at, place_of, reach_of, weight_at}
#import motes::exact::{dot3, f32_of_u32, less}
#import motes::footprint::{LIST_START, is_for_one}
#import motes::layout::{Counts, Frame, Particle, ROW_OVER, SystemFrame, SystemRow}
#import motes::light::steps_for
#import motes::packed::{UNFIT, channels_of, left_over, packed, rest_of}
#import motes::particle::{age_of, from_words, row_index, slot_of}
#import motes::reach::{is_visible, moves}
#import motes::veil::{front_of, open_share}
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

// Whether surfaces hide what is behind them.
const SURFACES: bool = #{SURFACES};
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
@group(0) @binding(3) var<uniform> counts: Counts;
@group(0) @binding(5) var<storage, read_write> light_low: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> light_high: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read_write> large_particles: array<atomic<u32>>;
@group(0) @binding(8) var<storage, read> layer_planes: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read> surface_nearness: array<vec4<u32>>;
#if WIDE == true
@group(0) @binding(4) var<storage, read> particles: array<vec4<u64>>;
@group(0) @binding(10) var<storage, read_write> light_packed: array<atomic<u64>>;
#else
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
#endif

// Adds to a pixel what its packed fields take, and tells what is left (motes::packed): all of it
// where there are none.
fn add_packed(pixel: u32, steps: vec3<u32>) -> u32 {
#if WIDE == true
    let word = packed(steps);
    return rest_of(atomicAdd(&light_packed[pixel], word), word, steps);
#else
    return UNFIT;
#endif
}

// Adds what is left to the limbs; a count with the highest bit set is negative. Drivers that run
// all branches turn a loop once: it is the one place of three channels.
fn add_left(pixel: u32, rest: u32, steps: vec3<u32>) {
#if WIDE == true
    let over = left_over(rest, steps);
#else
    let over = steps;
#endif
    var left = channels_of(over);
    while left != 0u {
        let channel = firstTrailingBit(left);
        left &= left - 1u;
        let at = pixel * 3u + channel;
        let before = atomicAdd(&light_low[at], over[channel]);
        let carry = select(0u, 1u, before > 0xffffffffu - over[channel]);
        let high = carry - (over[channel] >> 31u);
        if high != 0u {
            atomicAdd(&light_high[at], high);
        }
    }
}

// A small disc at rest. What it covers is found first, a bit a pixel, so that invocations side by
// side then turn a loop as often as they have pixels, wherever these are. What a packed pixel does
// not take is rare: the loop is left for it, so that those that run all branches do so once a disc.
fn draw(disc: Disc, radius_px: f32, color: vec3<f32>, front: u32) {
    let covered = covered_of(disc, radius_px, vec2<i32>(i32(frame.width), i32(frame.height)));
    var bits = covered.bits;
    while bits != 0u {
        var pixel = 0u;
        var steps = vec3<u32>(0u);
        var rest = 0u;
        while (bits != 0u) & (rest == 0u) {
            let place = place_of(firstTrailingBit(bits));
            bits &= bits - 1u;
            let to = vec2<u32>(disc.first) + place;
            pixel = to.y * frame.width + to.x;
            let center = disc.first_center + vec2<f32>(f32_of_u32(place.x), f32_of_u32(place.y));
            var weight = weight_at(disc, center) * covered.gain;
            if SURFACES {
                weight *= open_share(surface_nearness[pixel], front);
            }
            steps = steps_for(color, weight);
            rest = add_packed(pixel, steps);
        }
        add_left(pixel, rest, steps);
    }
}

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

// Whether a world place is beyond the plane of the planet's outline.
fn is_beyond(world: vec3<f32>) -> bool {
    return less(dot3(frame.planet_outline.xyz, world), frame.planet_outline.w);
}

// Lists what one invocation of splat_large draws from the front, what many share from the back.
fn leave_to_splat_large(at: u32, is_for_one: bool) {
    let place = atomicAdd(&large_particles[select(1u, 0u, is_for_one)], 1u);
    let listed = LIST_START + select(frame.page_len - 1u - place, place, is_for_one);
    atomicStore(&large_particles[listed], at);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn splat(@builtin(global_invocation_id) global_id: vec3<u32>) {
    // Before the first branch, as software drivers load it lane by lane after that.
    var system = system_frames[0];
    var row = rows[0];
    let page_start = pages.page * frame.page_len;
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.live - min(counts.live, page_start), frame.page_len) {
        return;
    }
#if WIDE == true
    let particle = from_words(particles[at]);
#else
    let particle = particles[at];
#endif
    let birth = particle.velocity_and_birth.w;
    let slot = slot_of(birth);
    if MANY_ROWS {
        row = rows[row_index(slot, frame.frame - age_of(birth, frame.frame), frame.row_mask)];
    }
    if COVERS && (row.kinds.w & ROW_OVER) != 0u {
        return;
    }
    if MANY_SYSTEMS {
        system = system_frames[slot];
    }
    let features = Features(STREAKS, RECTANGLES, RATE_SPREADS, LIGHT_DISTANCES);
    let sprite = sprite_of(frame, system, row, particle, features);
    if !is_visible(frame, sprite.start, sprite.end, sprite.radius_px) {
        return;
    }
    if LAYERS && ((frame.layer != 0u) & (layer_of(sprite.world) != frame.layer)) {
        return;
    }
    if PLANET && is_beyond(sprite.world) != (pages.is_behind == 1u) {
        return;
    }
    let rests = !(STREAKS && moves(sprite.start, sprite.end)) && !(RECTANGLES && sprite.square);
    let reach = reach_of(sprite.radius_px);
    if rests && less(reach, SMALL_REACH_PX) {
        let disc = disc_at(vec2<f32>(sprite.start.x, sprite.start.y), reach);
        let front = front_of(frame, sprite.start.depth, sprite.radius_px);
        draw(disc, sprite.radius_px, sprite.color, front);
    } else {
        leave_to_splat_large(at, is_for_one(sprite.start, sprite.end, sprite.radius_px));
    }
}
