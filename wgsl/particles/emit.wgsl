// emit: this frame's newborns, written behind the living of one page.
//
// Reeves 1983, 2.2: a place in the generation shape, a direction within the ejection angle of an
// axis, and a speed. Those of a
// moving system that are spread over the frame begin where it was at their moment, and have gone
// on since.
// One invocation a newborn. Reads: frame, system_frames, rows, birth_offsets, counts, curve_points,
// mesh_faces, mesh_choices.
// Writes: particles [counts.live, counts.total) as far as they fall in the page.
// Invariant: every attribute is a hash of the newborn's identity, so nothing depends on where or
// in which order it is stored.

#import motes::dispatch::linear_index
#import motes::emission::{
    Birthplace, axis_of, ejected, in_shape, mixed, on_curve, on_triangle, turned,
}
#import motes::exact::{bits_of, f32_of_u32, normalize_exact, to_i32}
#import motes::layout::{
    Counts, Frame, Particle, ROW_WITHIN_FRAME, SHAPE_CURVE, SHAPE_MESH, SYSTEM_PARABOLIC, SystemFrame,
    SystemRow,
}
#import motes::particle::{Identity, STREAM_MOMENT, STREAM_MOTION, STREAM_PLACE, draw, row_index, to_words}
#import motes::rng::{index_below, signed_float, unit_float}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether there are several systems, several parameter rows; whether any is born on a mesh.
const MANY_SYSTEMS: bool = #{MANY_SYSTEMS};
const MANY_ROWS: bool = #{MANY_ROWS};
const MESHES: bool = #{MESHES};

struct Pages {
    page: u32,
}
var<immediate> pages: Pages;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> system_frames: array<SystemFrame>;
@group(0) @binding(2) var<storage, read> rows: array<SystemRow>;
@group(0) @binding(3) var<storage, read> birth_offsets: array<u32>;
@group(0) @binding(4) var<storage, read> counts: Counts;
#if WIDE == true
@group(0) @binding(5) var<storage, read_write> particles: array<vec4<u64>>;
#else
@group(0) @binding(5) var<storage, read_write> particles: array<Particle>;
#endif
@group(0) @binding(6) var<storage, read> curve_points: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read> mesh_faces: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read> mesh_choices: array<vec2<u32>>;

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

fn birthplace(row: SystemRow, place: vec4<u32>) -> Birthplace {
    if row.kinds.x == SHAPE_CURVE {
        let along = unit_float(place.x) * row.shape.z;
        let before = u32(to_i32(along));
        let first = u32(to_i32(row.shape.y)) + before;
        let part = along - f32_of_u32(before);
        return on_curve(curve_points[first].xyz, curve_points[first + 1u].xyz, part, row.shape.x);
    }
    if MESHES && row.kinds.x == SHAPE_MESH {
        let drawn = u32(to_i32(row.shape.y)) + index_below(place.x, u32(to_i32(row.shape.z)));
        // A share of the draws of a small face goes to a large one (Walker 1977).
        let choice = mesh_choices[drawn];
        let at = 3u * select(choice.y, drawn, place.w < choice.x);
        return on_triangle(
            mesh_faces[at], mesh_faces[at + 1u], mesh_faces[at + 2u], place, row.shape.x,
        );
    }
    return in_shape(row, place);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn emit(@builtin(global_invocation_id) global_id: vec3<u32>) {
    // Before the first branch, as software drivers load it lane by lane after that.
    var system = system_frames[0];
    var row = rows[0];
    let page_start = pages.page * frame.page_len;
    let first = max(counts.live, page_start);
    let at = first + linear_index(global_id, WORKGROUP_SIZE);
    if at >= min(counts.total, page_start + frame.page_len) {
        return;
    }
    let birth = at - counts.live;
    let slot = slot_of_birth(birth);
    let index = birth - birth_offsets[slot];
    if MANY_SYSTEMS {
        system = system_frames[slot];
    }
    if MANY_ROWS {
        row = rows[row_index(slot, frame.frame, frame.row_mask)];
    }
    let who = Identity(system.key, frame.frame, index);

    let motion = draw(who, STREAM_MOTION);
    let born = birthplace(row, draw(who, STREAM_PLACE));
    let speed = row.speed_and_lifetime.x + signed_float(motion.z) * row.speed_and_lifetime.y;
    let leaving = ejected(row, axis_of(row, born), motion);

    // How much of the frame had gone by at the moment of birth, and how much was then to come.
    let is_spread = (row.kinds.w & ROW_WITHIN_FRAME) != 0u;
    let gone = select(0.0f, unit_float(draw(who, STREAM_MOMENT).x), is_spread);
    let to_come = select(0.0f, 1.0f - gone, is_spread);
    let x_row = mixed(system.system_from_birth_x, system.earlier_system_from_birth_x, to_come);
    let y_row = mixed(system.system_from_birth_y, system.earlier_system_from_birth_y, to_come);
    let z_row = mixed(system.system_from_birth_z, system.earlier_system_from_birth_z, to_come);
    // Between two turned frames is no turned frame: it would shorten what it turns.
    let mixed_way = turned(x_row, y_row, z_row, leaving);
    let way = select(mixed_way, normalize_exact(mixed_way), is_spread);
    let initial = way * speed;
    let origin = vec3<f32>(x_row.w, y_row.w, z_row.w);
    var position = turned(x_row, y_row, z_row, born.position) + origin - initial * gone;
    var velocity = initial;
    if (system.flags & SYSTEM_PARABOLIC) != 0u {
        // The velocity halfway through the frame makes each step end on the parabola.
        let acceleration = system.acceleration.xyz;
        position = position + acceleration * (0.5f * gone * gone);
        velocity = velocity + acceleration * (0.5f - gone);
    }
    let newborn = Particle(
        vec4<u32>(bits_of(position.x), bits_of(position.y), bits_of(position.z), index),
        vec4<u32>(
            bits_of(velocity.x),
            bits_of(velocity.y),
            bits_of(velocity.z),
            (slot << 16u) | (frame.frame & 0xffffu),
        ),
    );
#if WIDE == true
    particles[at - page_start] = to_words(newborn);
#else
    particles[at - page_start] = newborn;
#endif
}
