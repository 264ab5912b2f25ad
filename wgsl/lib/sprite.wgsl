// What a particle looks like in the picture, before its pixels: where, how large, which colour.
//
// Reeves 1983, 2.5: the light a particle adds depends on its colour and transparency; 3: a streak
// goes from its place when the frame begins to that when the shutter closes. Light that falls with
// the square of the distance is the extension that 2.5 names.
// Reads and writes no buffers. Invariant: exact on every driver; twin of src/cpu/sprite.rs.
#define_import_path motes::sprite

#import motes::exact::{inverse_square_root, less, min_exact}
#import motes::reach::MOST_RADIUS_PX
#import motes::layout::{
    Frame, PARTICLE_RECTANGLE, PARTICLE_STREAK, Particle, STREAK_CONSTANT, SystemFrame, SystemRow,
}
#import motes::particle::{Identity, age_of, appearance_of}
#import motes::projection::{Projected, project, project_closing, world_of}

// Which features any system of the plan has.
struct Features {
    streaks: bool,
    rectangles: bool,
    spread_rates: bool,
    light_distances: bool,
}

struct Sprite {
    world: vec3<f32>,
    start: Projected,
    end: Projected,
    radius_px: f32,
    // Light, as far as it is not transparent.
    color: vec3<f32>,
    // Colour, and how opaque it is.
    surface: vec4<f32>,
    square: bool,
    conserved: bool,
}

// The sprite of `particle` in a frame; the row is that of its birth.
fn sprite_of(
    view: Frame, system: SystemFrame, row: SystemRow, particle: Particle, features: Features,
) -> Sprite {
    let birth = particle.velocity_and_birth.w;
    let age = age_of(birth, view.frame);
    let who = Identity(system.key, view.frame - age, particle.position_and_index.w);
    let look = appearance_of(who, row, age + 1u, features.spread_rates);
    let position = bitcast<vec3<f32>>(particle.position_and_index.xyz);
    let world = world_of(system, position);
    let start = project(view, world);
    var end = start;
    if features.streaks && row.kinds.y == PARTICLE_STREAK {
        let velocity = bitcast<vec3<f32>>(particle.velocity_and_birth.xyz);
        end = project_closing(view, system, position + velocity * view.shutter);
    }
    var light = 1.0f - look.transparency;
    let unit_distance = row.ejection_and_light.z;
    if features.light_distances && less(0.0f, unit_distance) {
        let share = unit_distance * inverse_square_root(start.distance_squared);
        light *= share * share;
    }
    return Sprite(
        world,
        start,
        end,
        min_exact(look.size * start.scale, MOST_RADIUS_PX),
        look.color * light,
        vec4<f32>(look.color, 1.0f - look.transparency),
        features.rectangles && row.kinds.y == PARTICLE_RECTANGLE,
        (row.kinds.z & STREAK_CONSTANT) == 0u,
    );
}

// The layer, from 1, that a place is in: the first plane with the place behind it, or one past the
// last plane; `signed_distance` is from the plane `at`, from 0.
// Who asks goes on while there are planes and the layer is 0, both in one expression without a short
// circuit: Mesa's software driver puts the values of uniforms that alone decide about a branch or a loop
// into the kernel, and compiles it anew each time that it is dispatched.
fn next_layer(layer: u32, at: u32, signed_distance: f32) -> u32 {
    let is_behind = less(signed_distance, 0.0f);
    return select(layer, at + 1u, layer == 0u && is_behind);
}
