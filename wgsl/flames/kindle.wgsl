// kindle: where the flames of a fire stand in this frame, and how large they are.
//
// Perry 1994, 3.4 and 1.2: roots are points of a surface with its normals, and some flames are told
// one by one. One invocation a flame of the fire.
// Reads: frame, fires, listed_flames, mesh_faces, mesh_choices. Writes: flames.
// Invariant: a flame is a hash of its fire and index and of this frame's inputs alone, so that any
// frame can be entered.

#import motes::dispatch::linear_index
#import motes::emission::{on_triangle, turned}
#import motes::exact::{bits_of, less, normalize_exact}
#import motes::flame::{STREAM_ROOT, burns_at, extents_of, flame_draw, growth_of, root_on}
#import motes::layout::{FireFrame, Flame, Frame, LISTED_FIRST_FRAME, ListedFlame, ROOTS_MESH}
#import motes::rng::index_below

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

struct Which {
    fire: u32,
}
var<immediate> which: Which;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> fires: array<FireFrame>;
@group(0) @binding(2) var<storage, read> listed_flames: array<ListedFlame>;
@group(0) @binding(3) var<storage, read> mesh_faces: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> mesh_choices: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read_write> flames: array<Flame>;

// What a flame is before its fire moves.
struct Rooted {
    position: vec3<f32>,
    normal: vec3<f32>,
    extents: vec2<f32>,
    brightness: f32,
    birth: u32,
}

fn listed(fire: FireFrame, at: u32) -> Rooted {
    let own = listed_flames[fire.members.z + at];
    let general = extents_of(fire, at);
    return Rooted(
        own.position.xyz,
        own.normal.xyz,
        vec2<f32>(
            select(own.position.w, general.x, less(own.position.w, 0.0f)),
            select(own.normal.w, general.y, less(own.normal.w, 0.0f)),
        ),
        own.look.x,
        select(fire.times.x, own.kinds.x, (own.kinds.y & LISTED_FIRST_FRAME) != 0u),
    );
}

// whole * part / count for numbers below 2^20, part below count: the product may pass 2^32, so it is divided
// in two halves of part.
fn share_of(whole: u32, part: u32, count: u32) -> u32 {
    let rest = whole % count;
    let upper = (part >> 10u) * rest;
    let lower = (part & 1023u) * rest;
    let between = ((upper % count) << 10u) + lower;
    return part * (whole / count) + ((upper / count) << 10u) + between / count;
}

fn scattered(fire: FireFrame, at: u32) -> Rooted {
    let nth = at - fire.members.w;
    let count = fire.members.y - fire.members.w;
    let place = flame_draw(fire, at, STREAM_ROOT);
    var position = root_on(fire, nth, place);
    var normal = vec3<f32>(0.0f, 1.0f, 0.0f);
    if fire.kinds.x == ROOTS_MESH {
        let drawn = fire.faces.x + index_below(place.x, fire.faces.y);
        // A share of the draws of a small face goes to a large one (Walker 1977).
        let choice = mesh_choices[drawn];
        let first = 3u * select(choice.y, drawn, place.w < choice.x);
        let born = on_triangle(
            mesh_faces[first], mesh_faces[first + 1u], mesh_faces[first + 2u], place, fire.roots.x,
        );
        position = born.position;
        normal = born.axis;
    }
    let birth = fire.times.x + share_of(fire.times.y, nth, count);
    return Rooted(position, normal, extents_of(fire, at), 1.0f, birth);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn kindle(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let fire = fires[which.fire];
    let at = linear_index(global_id, WORKGROUP_SIZE);
    if at >= fire.members.y {
        return;
    }
    var own: Rooted;
    if at < fire.members.w {
        own = listed(fire, at);
    } else {
        own = scattered(fire, at);
    }
    let x_row = fire.world_from_fire_x;
    let y_row = fire.world_from_fire_y;
    let z_row = fire.world_from_fire_z;
    let x_before = fire.earlier_world_from_fire_x;
    let y_before = fire.earlier_world_from_fire_y;
    let z_before = fire.earlier_world_from_fire_z;
    let origin = vec3<f32>(x_row.w, y_row.w, z_row.w);
    let root = turned(x_row, y_row, z_row, own.position) + origin;
    let before = turned(x_before, y_before, z_before, own.position)
        + vec3<f32>(x_before.w, y_before.w, z_before.w);
    let motion = root - before;
    let normal = normalize_exact(turned(x_row, y_row, z_row, own.normal));
    let age = bitcast<i32>(frame.frame - own.birth);
    let burns = burns_at(fire, age);
    let growth = growth_of(fire, select(0, age, burns));
    flames[fire.members.x + at] = Flame(
        vec4<u32>(bits_of(root.x), bits_of(root.y), bits_of(root.z), which.fire),
        vec4<u32>(bits_of(normal.x), bits_of(normal.y), bits_of(normal.z), own.birth),
        vec4<u32>(bits_of(motion.x), bits_of(motion.y), bits_of(motion.z), at),
        vec4<u32>(
            bits_of(own.extents.x * growth),
            bits_of(own.extents.y * growth),
            bits_of(own.brightness * fire.look.x),
            select(0u, 1u, burns),
        ),
    );
}
