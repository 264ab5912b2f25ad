// cull: who lives on, one bit a particle.
//
// Reeves 1983, 2.4: a particle dies when its lifetime is over, when its intensity, from colour
// and transparency, falls below its system's threshold, or when it comes where its system's bounds
// forbid. What is seen as its whole trajectory does not die of age. Intensity and place are those that it would be drawn with in this frame, so nothing
// dimmer than the threshold and nothing out of bounds is drawn.
// One invocation a word of 32 particles of one page. Reads: frame, system_frames, rows, counts,
// particles, bounds. Writes: alive_bits, deaths (atomic adds).
// The pool is sorted by birth frame: where the first of a word is too young to die of age, so are
// all, and where nothing else can kill, none is looked at.
// Invariant: bits at and above counts.total are zero; each death has one cause, the first of age,
// intensity and bounds that holds.

#import motes::dispatch::linear_index
#import motes::exact::{dot3, less}
#import motes::layout::{
    BOUND_BOX, BOUND_PLANE, Bound, Counts, Frame, PARTICLE_STROKE, Particle, SystemFrame, SystemRow,
}
#import motes::particle::{
    Identity, age_of, appearance_of, intensity_of, lifetime_of, row_index, slot_of,
}
#import motes::projection::world_of

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether there are several systems, several parameter rows.
const MANY_SYSTEMS: bool = #{MANY_SYSTEMS};
const MANY_ROWS: bool = #{MANY_ROWS};
// Whether any system kills by intensity.
const THRESHOLDS: bool = #{THRESHOLDS};
// Whether any system has bounds.
const BOUNDS: bool = #{BOUNDS};
// Whether rates differ from particle to particle in any system.
const RATE_SPREADS: bool = #{RATE_SPREADS};
// Whether any particle is seen as its whole trajectory.
const STROKES: bool = #{STROKES};

// What becomes of a particle.
const LIVES: u32 = 0u;
const DIES_OF_AGE: u32 = 1u;
const DIES_OF_INTENSITY: u32 = 2u;
const DIES_OF_BOUNDS: u32 = 3u;

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> counts: Counts;
@group(0) @binding(4) var<storage, read> particles: array<Particle>;
@group(0) @binding(5) var<storage, read> bounds: array<Bound>;
@group(0) @binding(6) var<storage, read_write> alive_bits: array<u32>;
@group(0) @binding(7) var<storage, read_write> deaths: array<atomic<u32>>;

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

// Whether a world place is beyond the plane, outside what must hold it, or inside what must not.
fn is_forbidden(bound: Bound, world: vec3<f32>) -> bool {
    let low = bound.place;
    let high = bound.extent;
    let away = world - low.xyz;
    let distance_squared = dot3(away, away);
    let outside_kills = bound.kinds.y == 1u;
    let beyond_plane = less(low.w, dot3(low.xyz, world));
    let beyond_sphere = select(
        less(distance_squared, low.w), less(low.w, distance_squared), outside_kills,
    );
    let beyond_box = outside_kills == (less(world.x, low.x) || less(high.x, world.x)
        || less(world.y, low.y) || less(high.y, world.y)
        || less(world.z, low.z) || less(high.z, world.z));
    let kind = bound.kinds.x;
    return select(
        select(beyond_sphere, beyond_box, kind == BOUND_BOX), beyond_plane, kind == BOUND_PLANE,
    );
}

fn is_out_of_bounds(system: SystemFrame, world: vec3<f32>) -> bool {
    var is_out = false;
    for (var at = 0u; at < system.bound_count; at += 1u) {
        is_out = is_forbidden(bounds[system.first_bound + at], world) || is_out;
    }
    return is_out;
}

fn fate_of(at: u32, lone: Lone) -> u32 {
    let index = particles[at].position_and_index.w;
    let birth = particles[at].velocity_and_birth.w;
    let slot = slot_of(birth);
    let age = age_of(birth, frame.frame);
    let birth_frame = frame.frame - age;
    let system = system_at(slot, lone);
    let who = Identity(system.key, birth_frame, index);
    let row = row_at(row_index(slot, birth_frame, frame.row_mask), lone);
    let ages = !STROKES || row.kinds.y != PARTICLE_STROKE;
    if ages && age >= lifetime_of(who, row.speed_and_lifetime) {
        return DIES_OF_AGE;
    }
    let threshold = row.size_and_threshold.w;
    if THRESHOLDS && !less(threshold, 0.0f) {
        let look = appearance_of(who, row, age + 1u, RATE_SPREADS);
        if less(intensity_of(look, row.kinds.w), threshold) {
            return DIES_OF_INTENSITY;
        }
    }
    if BOUNDS {
        let position = bitcast<vec3<f32>>(particles[at].position_and_index.xyz);
        let velocity = bitcast<vec3<f32>>(particles[at].velocity_and_birth.xyz);
        if is_out_of_bounds(system, world_of(system, position + velocity)) {
            return DIES_OF_BOUNDS;
        }
    }
    return LIVES;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn cull(@builtin(global_invocation_id) global_id: vec3<u32>) {
    // Before the first branch, as software drivers load it lane by lane after that.
    let lone = Lone(system_frames[0], rows[0]);
    let page_start = pages.page * frame.page_len;
    let first = linear_index(global_id, WORKGROUP_SIZE) * 32u;
    let page_end = min(counts.total - min(counts.total, page_start), frame.page_len);
    if first >= page_end {
        return;
    }
    let end = min(first + 32u, page_end);
    let oldest = age_of(particles[first].velocity_and_birth.w, frame.frame);
    let all_live = !THRESHOLDS && !BOUNDS && oldest < frame.least_lifetime;
    var bits = select(0u, 0xffffffffu >> (32u - (end - first)), all_live);
    var of_intensity = 0u;
    var of_bounds = 0u;
    for (var at = select(first, end, all_live); at < end; at += 1u) {
        let fate = fate_of(at, lone);
        bits |= select(0u, 1u, fate == LIVES) << (at - first);
        of_intensity += select(0u, 1u, fate == DIES_OF_INTENSITY);
        of_bounds += select(0u, 1u, fate == DIES_OF_BOUNDS);
    }
    alive_bits[(page_start + first) / 32u] = bits;
    if THRESHOLDS && of_intensity > 0u {
        atomicAdd(&deaths[0], of_intensity);
    }
    if BOUNDS && of_bounds > 0u {
        atomicAdd(&deaths[1], of_bounds);
    }
}
