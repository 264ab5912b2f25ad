// surface: the triangles and pillars that are seen in a pixel, lit.
//
// Reeves 1983, section 3, and Perry 1994, 3.2.4: surfaces reflect light from far away, from lamps and
// from flames, as Lambert has it. A triangle is lit once a pixel, in the middle of its samples; its
// normal is between those of its corners. Samples behind a planet, a ground or a pillar are of none.
// Pillars let some of the light of flames through to their own surface (wax), and cover a pixel as far as
// their outline does. Triangles and pillars hide what is behind their samples.
// One invocation a pixel. Reads: frame, surfaces, surface_corners, surface_light, lamps, flame_lights,
// cluster_lights, pillars. Reads and writes: surface_nearness, surface_faces (0 where nothing shows). Writes:
// surface_pixels (red, green, blue, and what shows of what is behind, as bits).
// Invariant: a pixel depends on its samples, the frame and the lights alone.

#import motes::cluster::{fallen, way_to}
#import motes::dispatch::linear_index
#import motes::exact::{
    at_least_zero, bits_of, clamp_unit, cross3, dot3, f32_of_u32, inverse_square_root, less,
    normalize_exact, reciprocal, square_root,
}
#import motes::grain::grain_at
#import motes::layout::{FlameLight, Frame, Lamp, MOST_LAMPS, Pillar, SurfaceFrame, SurfaceLight}
#import motes::pillar::{Meeting, meeting, passed}
#import motes::raster::{normal_of, rows_times, samples_down, samples_right}

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether there is a planet, a ground or a pillar.
const PLANET: bool = #{PLANET};
const GROUND: bool = #{GROUND};
// Whether there is a pillar, and more than one mesh.
const PILLARS: bool = #{PILLARS};
const MANY_SURFACES: bool = #{MANY_SURFACES};
// Whether particles, lamps and flames throw light.
const CLUSTERS: bool = #{CLUSTERS};
const LAMPS: bool = #{LAMPS};
const LIGHTS: bool = #{LIGHTS};
// Whether there may be more lights of flames than are held.
const MOST_LIGHTS: bool = #{MOST_LIGHTS};
#if MORE_LIGHTS == true
const HELD: u32 = 32u;
#else
const HELD: u32 = 16u;
#endif
// Whether a surface has grain.
const GRAINS: bool = #{GRAINS};
// A ground or a pillar that covers more of its pixel hides.
const HIDES: f32 = 0.5f;
// No pillar.
const NO_PILLAR: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> surfaces: array<SurfaceFrame>;
@group(0) @binding(2) var<storage, read> surface_corners: array<vec4<u32>>;
@group(0) @binding(3) var<uniform> surface_light: SurfaceLight;
@group(0) @binding(4) var<uniform> lamps: array<Lamp, MOST_LAMPS>;
@group(0) @binding(5) var<storage, read> flame_lights: array<FlameLight>;
@group(0) @binding(6) var<storage, read> pillars: array<Pillar>;
@group(0) @binding(7) var<storage, read_write> surface_nearness: array<vec4<u32>>;
@group(0) @binding(8) var<storage, read_write> surface_faces: array<vec4<u32>>;
@group(0) @binding(9) var<storage, read_write> surface_pixels: array<vec4<u32>>;
@group(0) @binding(10) var<storage, read> cluster_lights: array<FlameLight>;

// Lights of flames, loaded before the first branch, where software drivers load what is uniform once.
var<private> held_places: array<vec4<f32>, HELD>;
var<private> held_colors: array<vec3<f32>, HELD>;

fn hold_lights(count: u32) {
    for (var at = 0u; at < HELD; at += 1u) {
        let is_one = at < count;
        let flame = flame_lights[at];
        held_places[at] = select(vec4<f32>(1.0f), bitcast<vec4<f32>>(flame.place), is_one);
        held_colors[at] = select(vec3<f32>(0.0f), bitcast<vec3<f32>>(flame.color.xyz), is_one);
    }
}

// The way from the eye through a place in the picture, as far as depth 1.
fn way_through(right: f32, up: f32) -> vec3<f32> {
    let share = reciprocal(frame.focal_px);
    return frame.view_from_world_z.xyz
        + frame.view_from_world_x.xyz * (right * share)
        + frame.view_from_world_y.xyz * (up * share);
}

// Whether something that is no triangle is met before that depth.
fn is_hidden(light: SurfaceLight, way: vec3<f32>, depth: f32) -> bool {
    var hidden = false;
    if PLANET && light.kinds.w != 0u {
        let along = dot3(way, light.planet.xyz);
        let squared = dot3(way, way);
        let inside = along * along - squared * light.planet.w;
        let far = (along - square_root(at_least_zero(inside))) * reciprocal(squared);
        hidden = less(0.0f, inside) && less(0.0f, far) && less(far, depth);
    }
    if GROUND {
        let far = -light.plane.w * reciprocal(dot3(way, light.plane.xyz));
        let from_middle = light.eye.xyz + way * far - light.middle.xyz;
        let near = at_least_zero(1.0f - dot3(from_middle, from_middle) * light.middle.w);
        let is_met = less(0.0f, light.middle.w) && less(0.0f, far) && less(far, depth);
        hidden = hidden || (is_met && less(HIDES, near * near));
    }
    if PILLARS {
        let pixel = reciprocal(frame.focal_px);
        for (var at = 0u; at < light.kinds.z; at += 1u) {
            let met = meeting(pillars[at], light.eye.xyz, way, pixel);
            hidden = hidden || (less(HIDES, met.covered) && less(met.far, depth));
        }
    }
    return hidden;
}

// A place of a surface, its unit normal, its pillar, and what that lets through: how much, and the
// inverse of the squared distance at which it is half.
struct Spot {
    place: vec3<f32>,
    normal: vec3<f32>,
    pillar: u32,
    through: vec2<f32>,
}

// How much of a point light of that squared extent there is, as a share of what it is a unit away.
fn from_point(light: SurfaceLight, spot: Spot, lamp: vec3<f32>, extent: f32, through: f32) -> f32 {
    let away = lamp - spot.place;
    let squared = dot3(away, away);
    let near = inverse_square_root(squared + extent);
    var seen = at_least_zero(dot3(spot.normal, away) * near);
    if PILLARS {
        for (var at = 0u; at < light.kinds.z; at += 1u) {
            if at != spot.pillar {
                seen *= passed(pillars[at], spot.place, lamp);
            }
        }
        seen += through * reciprocal(1.0f + squared * spot.through.y);
    }
    return seen * near * near;
}

fn light_on(light: SurfaceLight, spot: Spot) -> vec3<f32> {
    let straight = at_least_zero(dot3(spot.normal, light.light_from.xyz));
    var sum = light.ambient.xyz + light.light_color.xyz * straight;
    if LAMPS {
        for (var at = 0u; at < light.kinds.x; at += 1u) {
            let lamp = lamps[at];
            let source = lamp.place.xyz + light.lamps_from.xyz;
            sum += lamp.color.xyz * (lamp.place.w * from_point(light, spot, source, 0.0f, 0.0f));
        }
    }
    if LIGHTS {
        for (var at = 0u; at < HELD; at += 1u) {
            let source = held_places[at];
            let seen = from_point(light, spot, source.xyz, source.w, spot.through.x);
            sum += held_colors[at] * seen;
        }
    }
    if MOST_LIGHTS {
        for (var at = HELD; at < light.kinds.y; at += 1u) {
            let flame = flame_lights[at];
            let source = bitcast<vec4<f32>>(flame.place);
            let color = bitcast<vec3<f32>>(flame.color.xyz);
            sum += color * from_point(light, spot, source.xyz, source.w, spot.through.x);
        }
    }
    if CLUSTERS {
        for (var at = 1u; at <= cluster_lights[0].place.x; at += 1u) {
            let cluster = cluster_lights[at];
            let way = way_to(cluster, spot.place, spot.normal);
            var falls = fallen(way, spot.normal);
            if PILLARS {
                for (var pillar = 0u; pillar < light.kinds.z; pillar += 1u) {
                    if pillar != spot.pillar {
                        falls *= passed(pillars[pillar], spot.place, spot.place + way);
                    }
                }
            }
            sum += bitcast<vec3<f32>>(cluster.color.xyz) * falls;
        }
    }
    return sum;
}

// The surface that a triangle is of.
fn surface_of(light: SurfaceLight, face: u32) -> u32 {
    var surface = 0u;
    while surface + 1u < light.counts.x && surfaces[surface + 1u].faces.z <= face {
        surface += 1u;
    }
    return surface;
}

fn turned(surface: SurfaceFrame, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        dot3(surface.world_from_mesh_x.xyz, v),
        dot3(surface.world_from_mesh_y.xyz, v),
        dot3(surface.world_from_mesh_z.xyz, v),
    );
}

// What a triangle sends back from where the way ends on it.
fn shaded(light: SurfaceLight, lone: SurfaceFrame, face: u32, way: vec3<f32>, depth: f32) -> vec3<f32> {
    var surface = lone;
    if MANY_SURFACES {
        surface = surfaces[surface_of(light, face)];
    }
    let corner = (surface.faces.x + face - surface.faces.z) * 3u;
    let a_words = surface_corners[corner];
    let b_words = surface_corners[corner + 1u];
    let c_words = surface_corners[corner + 2u];
    let a = bitcast<vec3<f32>>(a_words.xyz);
    let place = light.eye.xyz + way * depth;
    // Lengths as parts of an edge's, in which nothing is too small.
    let edge_b = turned(surface, bitcast<vec3<f32>>(b_words.xyz) - a);
    let edge_c = turned(surface, bitcast<vec3<f32>>(c_words.xyz) - a);
    let part = inverse_square_root(dot3(edge_b, edge_b));
    let to_b = edge_b * part;
    let to_c = edge_c * part;
    let world_a = rows_times(
        surface.world_from_mesh_x, surface.world_from_mesh_y, surface.world_from_mesh_z, a,
    );
    let to_place = (place - world_a) * part;
    let across = cross3(to_b, to_c);
    let inverse = reciprocal(dot3(across, across));
    let of_b = clamp_unit(dot3(cross3(to_place, to_c), across) * inverse);
    let of_c = clamp_unit(dot3(cross3(to_b, to_place), across) * inverse);
    let of_a = at_least_zero(1.0f - of_b - of_c);
    let own = normal_of(a_words.w) * of_a + normal_of(b_words.w) * of_b + normal_of(c_words.w) * of_c;
    let front = normalize_exact(turned(surface, own));
    let normal = select(front, -front, less(0.0f, dot3(across, way)));
    var shade = 1.0f;
    if GRAINS {
        let b = bitcast<vec3<f32>>(b_words.xyz);
        let c = bitcast<vec3<f32>>(c_words.xyz);
        let at = a * of_a + b * of_b + c * of_c;
        let kind = surface.grain_kind;
        shade -= grain_at(kind.x, kind.y, surface.grain, surface.grain_shape, at) * surface.grain_shape.x;
    }
    let spot = Spot(place, normal, NO_PILLAR, vec2<f32>(0.0f));
    return surface.color.xyz * shade * light_on(light, spot);
}

// A pillar that a way meets, the nearest, and where.
struct Nearest {
    pillar: u32,
    met: Meeting,
}

// The nearest that covers more of the pixel than that.
fn nearest_pillar(light: SurfaceLight, way: vec3<f32>, least: f32) -> Nearest {
    var nearest = Nearest(NO_PILLAR, Meeting(0.0f, 0.0f, vec3<f32>(0.0f)));
    let pixel = reciprocal(frame.focal_px);
    for (var at = 0u; at < light.kinds.z; at += 1u) {
        let met = meeting(pillars[at], light.eye.xyz, way, pixel);
        if less(least, met.covered) && (nearest.pillar == NO_PILLAR || less(met.far, nearest.met.far)) {
            nearest = Nearest(at, met);
        }
    }
    return nearest;
}

// What a pillar sends back from where the way meets it.
fn pillar_light(light: SurfaceLight, nearest: Nearest, way: vec3<f32>) -> vec3<f32> {
    let pillar = pillars[nearest.pillar];
    let place = light.eye.xyz + way * nearest.met.far;
    let spot = Spot(place, nearest.met.normal, nearest.pillar, pillar.extent.yz);
    return pillar.color.xyz * light_on(light, spot);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn surface(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let light = surface_light;
    let lone = surfaces[0];
    if LIGHTS {
        hold_lights(light.kinds.y);
    }
    let pixel = linear_index(global_id, WORKGROUP_SIZE);
    if pixel >= frame.width * frame.height {
        return;
    }
    var faces = surface_faces[pixel];
    var nearness = surface_nearness[pixel];
    let rights = f32_of_u32(pixel % frame.width) - frame.center_x_px + samples_right();
    let ups = frame.center_y_px - f32_of_u32(pixel / frame.width) - samples_down();
    var left = 0u;
    var is_changed = false;
    for (var sample = 0u; sample < 4u; sample += 1u) {
        if faces[sample] != 0u {
            let way = way_through(rights[sample], ups[sample]);
            let depth = reciprocal(bitcast<f32>(nearness[sample]));
            let hidden = is_hidden(light, way, depth);
            faces[sample] = select(faces[sample], 0u, hidden);
            nearness[sample] = select(nearness[sample], 0u, hidden);
            left |= select(1u << sample, 0u, hidden);
            is_changed = is_changed || hidden;
        }
        if PILLARS && faces[sample] == 0u {
            let before = nearest_pillar(light, way_through(rights[sample], ups[sample]), HIDES);
            nearness[sample] = select(
                bits_of(reciprocal(before.met.far)), 0u, before.pillar == NO_PILLAR,
            );
            is_changed = true;
        }
    }
    if is_changed {
        surface_faces[pixel] = faces;
        surface_nearness[pixel] = nearness;
    }
    var clear = 1.0f - f32_of_u32(countOneBits(left)) * 0.25f;
    var sum = vec3<f32>(0.0f);
    // A loop that looks at its end last: others are gone through once more by software drivers.
    loop {
        if left != 0u {
            let face = faces[firstTrailingBit(left)];
            var count = 0.0f;
            var right = 0.0f;
            var up = 0.0f;
            var near = 0.0f;
            for (var sample = 0u; sample < 4u; sample += 1u) {
                if faces[sample] == face {
                    count += 1.0f;
                    right += rights[sample];
                    up += ups[sample];
                    near += bitcast<f32>(nearness[sample]);
                    left &= ~(1u << sample);
                }
            }
            let share = reciprocal(count);
            let way = way_through(right * share, up * share);
            sum += shaded(light, lone, face - 1u, way, reciprocal(near * share)) * (count * 0.25f);
        }
        continuing {
            break if left == 0u;
        }
    }
    if PILLARS {
        let middle = way_through(
            f32_of_u32(pixel % frame.width) + 0.5f - frame.center_x_px,
            frame.center_y_px - f32_of_u32(pixel / frame.width) - 0.5f,
        );
        let seen = nearest_pillar(light, middle, 0.0f);
        if seen.pillar != NO_PILLAR {
            sum += pillar_light(light, seen, middle) * (seen.met.covered * clear);
            clear *= 1.0f - seen.met.covered;
        }
    }
    surface_pixels[pixel] = vec4<u32>(bits_of(sum.x), bits_of(sum.y), bits_of(sum.z), bits_of(clear));
}
