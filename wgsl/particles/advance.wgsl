// advance: each survivor moves one frame and takes its compacted place in the other pool.
//
// Reeves 1983, 2.3, in the order of the text: position += velocity, then
// velocity += acceleration. Drag pulls the velocity toward that of the wind where the particle is.
// What is seen as its whole trajectory stays where it was born.
// One invocation a particle of the source page; a particle is written by the dispatch of the one
// target page that its place falls in.
// Reads: frame, system_frames, counts, word_ranks, particles, winds.
// Writes: survivors.
// Invariant: survivors keep their order, so the pool is always sorted by birth frame, system and
// index.

#import motes::dispatch::linear_index
#import motes::exact::bits_of
#import motes::layout::{Counts, Frame, Particle, SYSTEM_STILL, SystemFrame, Wind}
#import motes::particle::{from_words, slot_of, to_words}
#import motes::projection::world_of
#import motes::wind::{Kinds, wind_of}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether there are several systems; whether any has drag; whether the wind has several parts;
// whether any of them flows around or out of a place, is noise, of more than one octave, of absolute
// values, a curl; whether any system with drag is turned, scaled or away from the world's origin.
const MANY_SYSTEMS: bool = #{MANY_SYSTEMS};
const DRAGS: bool = #{DRAGS};
const MANY_WINDS: bool = #{MANY_WINDS};
const FLOWS: bool = #{FLOWS};
const NOISES: bool = #{NOISES};
const OCTAVES: bool = #{OCTAVES};
const FOLDS: bool = #{FOLDS};
const CURLS: bool = #{CURLS};
const PLACED: bool = #{PLACED};
// Whether any particle is seen as its whole trajectory.
const STROKES: bool = #{STROKES};

struct Pages {
    source_page: u32,
    target_page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> counts: Counts;
#if WIDE == true
@group(0) @binding(3) var<storage, read> word_ranks: array<u64>;
@group(0) @binding(4) var<storage, read> particles: array<vec4<u64>>;
@group(0) @binding(5) var<storage, read_write> survivors: array<vec4<u64>>;
#else
@group(0) @binding(3) var<storage, read> word_ranks: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read_write> survivors: array<Particle>;
#endif
@group(0) @binding(6) var<storage, read> winds: array<Wind>;

// The system in that slot; a lone one is loaded once for all invocations.
fn system_at(slot: u32, lone: SystemFrame) -> SystemFrame {
    if MANY_SYSTEMS {
        return system_frames[slot];
    }
    return lone;
}

// What drag adds to a velocity in a frame: a part of what it lacks of the wind's, in the system's
// space. The inverse of a rotation is its transpose.
fn drag_on(
    system: SystemFrame, lone_wind: Wind, wind_count: u32, position: vec3<f32>, velocity: vec3<f32>,
) -> vec3<f32> {
    var world = position;
    if PLACED {
        world = world_of(system, position);
    }
    var flow = vec3<f32>(0.0f);
    let has = Kinds(FLOWS, NOISES, OCTAVES, FOLDS, CURLS);
    if MANY_WINDS {
        for (var at = 0u; at < wind_count; at += 1u) {
            flow += wind_of(winds[at], world, has);
        }
    } else if wind_count == 1u {
        flow = wind_of(lone_wind, world, has);
    }
    if !PLACED {
        return (flow - velocity) * system.acceleration.w;
    }
    let x_row = system.world_from_system_x.xyz;
    let y_row = system.world_from_system_y.xyz;
    let z_row = system.world_from_system_z.xyz;
    let flow_here = x_row * flow.x + y_row * flow.y + z_row * flow.z;
    return (flow_here - velocity) * system.acceleration.w;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn advance(@builtin(global_invocation_id) global_id: vec3<u32>) {
    // Loads of what is the same for all come before the first branch: after it, software drivers
    // load it lane by lane.
    let lone_system = system_frames[0];
    let lone_wind = winds[0];
    let wind_count = frame.wind_count;
    let page_len = frame.page_len;
    let total = counts.total;
    // So do those of what is one's own, of places that are there: after it, each lane takes a branch.
    let at = linear_index(global_id, WORKGROUP_SIZE);
    let here = min(at, page_len - 1u);
    let global_at = pages.source_page * page_len + here;
    let bit = here % 32u;
    let word_at = min(global_at, total - 1u) / 32u;
#if WIDE == true
    let word = word_ranks[word_at];
    let ranks = vec2<u32>(u32(word), u32(word >> 32u));
#else
    let ranks = word_ranks[word_at];
#endif
    let rank = ranks.x + countOneBits(ranks.y & ((1u << bit) - 1u));
    let target_at = rank - pages.target_page * page_len;
#if WIDE == true
    let particle = from_words(particles[here]);
#else
    let particle = particles[here];
#endif
    let lives = ((ranks.y >> bit) & 1u) == 1u;
    if (at >= page_len) | (global_at >= total) | !lives | (target_at >= page_len) {
        return;
    }
    let position_bits = particle.position_and_index;
    let velocity_bits = particle.velocity_and_birth;
    let velocity = bitcast<vec3<f32>>(velocity_bits.xyz);
    let system = system_at(slot_of(velocity_bits.w), lone_system);
    let place = bitcast<vec3<f32>>(position_bits.xyz);
    var acceleration = system.acceleration.xyz;
    if DRAGS {
        acceleration = acceleration + drag_on(system, lone_wind, wind_count, place, velocity);
    }
    let stays = STROKES && (system.flags & SYSTEM_STILL) != 0u;
    let position = select(place + velocity, place, stays);
    let next = select(velocity + acceleration, velocity, stays);
    let survivor = Particle(
        vec4<u32>(bits_of(position.x), bits_of(position.y), bits_of(position.z), position_bits.w),
        vec4<u32>(bits_of(next.x), bits_of(next.y), bits_of(next.z), velocity_bits.w),
    );
#if WIDE == true
    survivors[target_at] = to_words(survivor);
#else
    survivors[target_at] = survivor;
#endif
}
