// emit: this frame's newborns, written behind the living of one page.
//
// Reeves 1983, 2.2: position in the generation shape, direction outward (sphere) or within the
// ejection angle of the local +z axis (circle, rectangle; uniform in solid angle), and speed.
// One invocation a newborn. Reads: frame, system_frames, rows, birth_offsets, counts.
// Writes: particles [counts.live, counts.total) as far as they fall in the page.
// Invariant: every attribute is a hash of the newborn's identity, so nothing depends on where or
// in which order it is stored.

#import motes::dispatch::linear_index
#import motes::exact::{bits_of, max_exact, square_root}
#import motes::layout::{Counts, Frame, Particle, SystemFrame, SystemRow}
#import motes::particle::{Identity, STREAM_MOTION, STREAM_PLACE, draw, row_index}
#import motes::rng::{signed_float, unit_float}
#import motes::transcendental::{cos_turns, cube_root, sin_turns}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

const SHAPE_SPHERE: u32 = 0u;
const SHAPE_CIRCLE: u32 = 1u;
const SHAPE_RECTANGLE: u32 = 2u;

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> birth_offsets: array<u32>;
@group(0) @binding(4) var<storage, read> counts: Counts;
@group(0) @binding(5) var<storage, read_write> particles: array<Particle>;

// The unit vector at height z on the sphere, `turns` around the z axis.
fn on_sphere(z: f32, turns: f32) -> vec3<f32> {
    let ring = square_root(max_exact(1.0f - z * z, 0.0f));
    return vec3<f32>(ring * cos_turns(turns), ring * sin_turns(turns), z);
}

// The system whose births contain the frame's newborn `birth`: the last that begins at or before.
fn slot_of_birth(birth: u32) -> u32 {
    var low = 0u;
    var high = frame.system_count;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if birth_offsets[middle] <= birth {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn emit(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let page_start = pages.page * frame.page_len;
    let first = max(counts.live, page_start);
    let at = first + linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.total, page_start + frame.page_len) {
        return;
    }
    let birth = at - counts.live;
    let slot = slot_of_birth(birth);
    let index = birth - birth_offsets[slot];
    let who = Identity(system_frames[slot].key, frame.frame, index);
    let row = row_index(slot, frame.frame, frame.row_mask);
    let extents = rows[row].shape;
    let speeds = rows[row].speed_and_lifetime;
    let shape = rows[row].kinds.x;

    let place = draw(who, STREAM_PLACE);
    let motion = draw(who, STREAM_MOTION);
    var direction: vec3<f32>;
    var position: vec3<f32>;
    if shape == SHAPE_SPHERE {
        direction = on_sphere(signed_float(place.x), unit_float(place.y));
        position = direction * (cube_root(unit_float(place.z)) * extents.x);
    } else {
        let cosine = 1.0f - unit_float(motion.x) * (1.0f - extents.w);
        direction = on_sphere(cosine, unit_float(motion.y));
        if shape == SHAPE_CIRCLE {
            let distance = square_root(unit_float(place.x)) * extents.x;
            let turns = unit_float(place.y);
            position = vec3<f32>(distance * cos_turns(turns), distance * sin_turns(turns), 0.0f);
        } else {
            position = vec3<f32>(
                signed_float(place.x) * extents.x,
                signed_float(place.y) * extents.y,
                0.0f,
            );
        }
    }
    let speed = speeds.x + signed_float(motion.z) * speeds.y;
    let velocity = direction * speed;
    particles[at - page_start] = Particle(
        vec4<u32>(bits_of(position.x), bits_of(position.y), bits_of(position.z), index),
        vec4<u32>(
            bits_of(velocity.x),
            bits_of(velocity.y),
            bits_of(velocity.z),
            (slot << 16u) | (frame.frame & 0xffffu),
        ),
    );
}
