// Straight on over faces that have frames of their own.
//
// Perry 1994, 3.3.2: a step that leaves a face is split at the edge, and the rest is turned into the
// next face; in the faces' frames that is a rotation of the plane and a shift.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/walk.rs.
#define_import_path motes::walk

#import motes::exact::{at_least_zero, less, normalize_exact, reciprocal, to_i32}
#import motes::layout::SpreadFace
#import motes::rng::pcg4d

// Farther than any edge.
const FAR: f32 = 1000000000.0f;
// The least cosine towards an edge with which it is approached.
const LEAST_APPROACH: f32 = 0.0000001f;
// How near to its end, as a share of an edge's length, a way through it meets the corner.
const CORNER_SHARE: f32 = 0.00001f;
// Edges that a step crosses, and faces around a corner that it looks at, at most.
const MOST_CROSSINGS: u32 = 64u;
const MOST_AROUND: u32 = 256u;

fn rotated(turn: vec2<f32>, v: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y);
}

// The opposite of `rotated`.
fn rotated_back(turn: vec2<f32>, v: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(turn.x * v.x + turn.y * v.y, turn.x * v.y - turn.y * v.x);
}

fn dot2(a: vec2<f32>, b: vec2<f32>) -> f32 {
    return a.x * b.x + a.y * b.y;
}

// v/|v|; the zero vector stays zero.
fn normalized2(v: vec2<f32>) -> vec2<f32> {
    return normalize_exact(vec3<f32>(v.x, v.y, 0.0f)).xy;
}

// How far it is to an edge along a way; FAR if that does not lead to it.
fn toward(line: vec4<f32>, place: vec2<f32>, way: vec2<f32>, is_skipped: bool) -> f32 {
    let approach = -dot2(line.xy, way);
    let gap = at_least_zero(dot2(line.xy, place) + line.z);
    let is_met = less(LEAST_APPROACH, approach) && !is_skipped;
    return select(FAR, gap * reciprocal(approach), is_met);
}

// Where a way leaves a face.
struct Exit {
    side: u32,
    distance: f32,
}

// The side of the face, by the lines of its edges, that a way leaves through; `skip` has a bit for each
// side that it does not.
fn exit_of(place: vec2<f32>, way: vec2<f32>, skip: u32, line_0: vec4<f32>, line_1: vec4<f32>, line_2: vec4<f32>) -> Exit {
    let to_0 = toward(line_0, place, way, (skip & 1u) != 0u);
    let to_1 = toward(line_1, place, way, (skip & 2u) != 0u);
    let to_2 = toward(line_2, place, way, (skip & 4u) != 0u);
    var exit = Exit(0u, to_0);
    if less(to_1, exit.distance) {
        exit = Exit(1u, to_1);
    }
    if less(to_2, exit.distance) {
        exit = Exit(2u, to_2);
    }
    return exit;
}

// The half-edges of the same face after this one and before it.
fn half_after(half: u32) -> u32 {
    return half - half % 3u + (half + 1u) % 3u;
}

fn half_before(half: u32) -> u32 {
    return half - half % 3u + (half + 2u) % 3u;
}

// A place of a face in its fire's space.
fn position_on(face: SpreadFace, place: vec2<f32>) -> vec3<f32> {
    let x = face.fire_from_face_x;
    let y = face.fire_from_face_y;
    let z = face.fire_from_face_z;
    return vec3<f32>(dot2(x.xy, place) + x.w, dot2(y.xy, place) + y.w, dot2(z.xy, place) + z.w);
}

// A vector of the fire's space in the plane of a face.
fn flattened(face: SpreadFace, v: vec3<f32>) -> vec2<f32> {
    let x = face.fire_from_face_x;
    let y = face.fire_from_face_y;
    let z = face.fire_from_face_z;
    return vec2<f32>(x.x * v.x + y.x * v.y + z.x * v.z, x.y * v.x + y.y * v.y + z.y * v.z);
}

// A vector of a face's plane in the fire's space.
fn raised(face: SpreadFace, v: vec2<f32>) -> vec3<f32> {
    return vec3<f32>(
        dot2(face.fire_from_face_x.xy, v),
        dot2(face.fire_from_face_y.xy, v),
        dot2(face.fire_from_face_z.xy, v),
    );
}

// The cell of a grid that a place is in.
fn crowd_cell(position: vec3<f32>, inverse_size: f32) -> vec3<i32> {
    let scaled = position * inverse_size;
    return vec3<i32>(to_i32(scaled.x), to_i32(scaled.y), to_i32(scaled.z));
}

// Tells cells apart, as far as words do.
fn crowd_hash(cell: vec3<i32>, slot: u32) -> u32 {
    let words = bitcast<vec3<u32>>(cell);
    return pcg4d(vec4<u32>(words.x, words.y, words.z, slot)).x;
}
