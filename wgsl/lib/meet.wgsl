// Where a piece of a flame's way goes through a face.
//
// Perry 1994, 4.6.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/meet.rs.
#define_import_path motes::meet

#import motes::exact::{dot3, less, reciprocal}
#import motes::layout::{SpreadFace, SpreadPiece}
#import motes::walk::{dot2, flattened}

// How far beyond its edges a face is met, as a share of their lengths: nothing slips through between two.
const MEETING_SLACK: f32 = 0.00001f;

struct Meeting {
    // In the face's frame.
    place: vec2<f32>,
    // How much of the way is before it.
    share: f32,
    is_met: bool,
}

// A place of world space in the space of the piece's fire: a rotation's inverse is its transpose.
fn within_fire(piece: SpreadPiece, place: vec3<f32>) -> vec3<f32> {
    let x = piece.world_from_fire_x;
    let y = piece.world_from_fire_y;
    let z = piece.world_from_fire_z;
    let away = place - vec3<f32>(x.w, y.w, z.w);
    return x.xyz * away.x + y.xyz * away.y + z.xyz * away.z;
}

// From either side; `line_0` and so on are those of the face's edges.
fn meeting(face: SpreadFace, line_0: vec4<f32>, line_1: vec4<f32>, line_2: vec4<f32>, from_here: vec3<f32>, to_there: vec3<f32>) -> Meeting {
    let x = face.fire_from_face_x;
    let y = face.fire_from_face_y;
    let z = face.fire_from_face_z;
    let origin = vec3<f32>(x.w, y.w, z.w);
    let normal = vec3<f32>(x.z, y.z, z.z);
    let above = dot3(normal, from_here - origin);
    let beyond = dot3(normal, to_there - origin);
    if less(0.0f, above) == less(0.0f, beyond) {
        return Meeting(vec2<f32>(0.0f), 0.0f, false);
    }
    let share = above * reciprocal(above - beyond);
    let place = flattened(face, from_here + (to_there - from_here) * share - origin);
    let is_inside = less(-MEETING_SLACK * line_0.w, dot2(line_0.xy, place) + line_0.z)
        && less(-MEETING_SLACK * line_1.w, dot2(line_1.xy, place) + line_1.z)
        && less(-MEETING_SLACK * line_2.w, dot2(line_2.xy, place) + line_2.z);
    return Meeting(place, share, is_inside);
}
