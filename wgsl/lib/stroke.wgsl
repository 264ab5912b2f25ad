// Strokes: what a particle does in its whole life, as a static shape.
//
// Reeves 1983, 4.3: instead of little streaks, the parabolic trajectory of each particle over its
// entire lifetime is drawn; it is shaded on the basis of the scene's light sources. A stroke is a thin
// cylinder along the trajectory, as Lambert has it: its light is the mean over the half that is seen.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/stroke.rs.
#define_import_path motes::stroke

#import motes::emission::turned
#import motes::exact::{
    at_least_zero, dot3, f32_of_u32, inverse_square_root, length3, less, max_exact, min_exact, reciprocal,
    square_root, to_i32,
}
#import motes::layout::{FRAME_ORTHOGRAPHIC, Frame, Particle, StrokeLight, SystemFrame}
#import motes::projection::{project, world_of}

// Pieces of a stroke are at most this long, so that colours and widths change softly.
const MOST_PIECE_PX: f32 = 24.0f;
// The fewest pieces.
const LEAST_PIECES: u32 = 3u;
// The mean light of a thin cylinder's visible half, in powers of the cosine between the light and the
// eye around its axis: that of ((pi - a) cos a + sin a) / 4, within 0.005.
const HALF_LIT: f32 = 0.25f;
const HALF_LIT_BY_COSINE: f32 = 0.39269908f;
const HALF_LIT_BY_SQUARE: f32 = 0.14269908f;

// A particle's trajectory in world space: where it is born, what it moves by in its first frame, and
// by how much more in each that follows.
struct Way {
    birth: vec3<f32>,
    first: vec3<f32>,
    bend: vec3<f32>,
}

fn way_of(system: SystemFrame, particle: Particle) -> Way {
    let x_row = system.world_from_system_x;
    let y_row = system.world_from_system_y;
    let z_row = system.world_from_system_z;
    return Way(
        world_of(system, bitcast<vec3<f32>>(particle.position_and_index.xyz)),
        turned(x_row, y_row, z_row, bitcast<vec3<f32>>(particle.velocity_and_birth.xyz)),
        turned(x_row, y_row, z_row, system.acceleration.xyz),
    );
}

// Where the light that falls on the way would fall on the ground.
fn shadow_of(way: Way, light: StrokeLight) -> Way {
    let normal = light.ground.xyz;
    let by = light.shade_from.xyz;
    return Way(
        way.birth - by * (dot3(normal, way.birth) - light.ground.w),
        way.first - by * dot3(normal, way.first),
        way.bend - by * dot3(normal, way.bend),
    );
}

// Where it is after so many frames; the parabola through the places of all whole ones.
fn place_at(way: Way, frames: f32) -> vec3<f32> {
    return way.birth + way.first * frames + way.bend * (0.5f * frames * (frames - 1.0f));
}

// How fast it is then.
fn motion_at(way: Way, frames: f32) -> vec3<f32> {
    return way.first + way.bend * (frames - 0.5f);
}

// How many chords of equal times keep within a quarter of a pixel of the way for so many frames, and
// are short; `most` at most. A chord of n strays by bend frames^2 / 8 n^2.
fn pieces_of(view: Frame, way: Way, frames: f32, most: u32) -> u32 {
    var nearest = project(view, way.birth).depth;
    for (var at = 1u; at <= 4u; at += 1u) {
        nearest = min_exact(nearest, project(view, place_at(way, frames * (0.25f * f32_of_u32(at)))).depth);
    }
    let bent = length3(way.bend) * frames * frames * 0.125f;
    // Between the five it may be nearer by as much as chords of a quarter stray.
    let nearness = reciprocal(max_exact(nearest - bent * 0.0625f, view.near));
    let orthographic = (view.flags & FRAME_ORTHOGRAPHIC) != 0u;
    let scale = select(view.focal_px * nearness, view.focal_px, orthographic);
    // What goes away from the eye moves across the picture, too, most of all in its corners.
    let corner = view.center_x_px * view.center_x_px + view.center_y_px * view.center_y_px;
    let of_corner = corner * reciprocal(view.focal_px) * reciprocal(view.focal_px);
    let slant = square_root(1.0f + select(of_corner, 0.0f, orthographic));
    let by_bend = to_i32(square_root(4.0f * bent * scale * slant));
    let long = length3(place_at(way, frames) - way.birth) + bent;
    let by_length = to_i32(long * scale * reciprocal(MOST_PIECE_PX));
    return min(max(u32(max(by_bend, by_length)) + 1u, LEAST_PIECES), most);
}

// A world vector as the light has it: right, up, towards the viewer.
fn as_light_has_it(view: Frame, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        dot3(view.view_from_world_x.xyz, v),
        dot3(view.view_from_world_y.xyz, v),
        -dot3(view.view_from_world_z.xyz, v),
    );
}

// How much of a light from there a thin cylinder along there sends to the eye; unit vectors.
fn lit_along(along: vec3<f32>, light_from: vec3<f32>, to_eye: vec3<f32>) -> f32 {
    let light_aside = light_from - along * dot3(along, light_from);
    let eye_aside = to_eye - along * dot3(along, to_eye);
    let squared = dot3(light_aside, light_aside);
    let inverse = inverse_square_root(squared);
    let cosine = dot3(light_aside, eye_aside) * inverse * inverse_square_root(dot3(eye_aside, eye_aside));
    let seen = HALF_LIT + cosine * (HALF_LIT_BY_COSINE + cosine * HALF_LIT_BY_SQUARE);
    return squared * inverse * at_least_zero(seen);
}

// The number in -2 .. 2 of a direction in the picture: which edge of a square it points to, and where.
fn cut_of(way: vec2<f32>) -> f32 {
    let part = way.x * reciprocal(abs(way.x) + abs(way.y));
    return select(1.0f - part, part - 1.0f, less(way.y, 0.0f));
}
