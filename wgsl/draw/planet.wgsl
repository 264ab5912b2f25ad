// planet: the ball with a surface in every pixel.
//
// Reeves 1983, section 3: a barren, moonlike planet with a strong light of its own above the rings
// of fire, between the particles behind its outline and those before it.
// One invocation a pixel: the line of sight meets the ball or misses it; how much of a pixel the
// ball covers is how far its centre is inside the outline, in pixels.
// Reads: frame, planets, lamps, cluster_lights. Writes: planet_pixels (red, green, blue and what shows of what is
// behind, as bits).
// Invariant: a pixel depends on the frame, the planet and the lights alone.

#import motes::cluster::{fallen, way_to}
#import motes::dispatch::linear_index
#import motes::exact::{
    at_least_zero, bits_of, clamp_unit, dot3, f32_of_u32, inverse_square_root, less,
    normalize_exact, reciprocal, square_root,
}
#import motes::layout::{FlameLight, Frame, Lamp, Planet}
#import motes::noise::noise

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether particles throw light.
const CLUSTERS: bool = #{CLUSTERS};
// Those that are higher than a part of this above the horizon are seen in full.
const HORIZON: f32 = 32.0f;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> planets: array<Planet>;
@group(0) @binding(2) var<storage, read> lamps: array<Lamp>;
@group(0) @binding(3) var<storage, read_write> planet_pixels: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read> cluster_lights: array<FlameLight>;

// The way from the eye through a place in the picture, as far as depth 1.
fn way_through(x: f32, y: f32) -> vec3<f32> {
    let share = reciprocal(frame.focal_px);
    return frame.view_from_world_z.xyz
        + frame.view_from_world_x.xyz * ((x - frame.center_x_px) * share)
        + frame.view_from_world_y.xyz * ((frame.center_y_px - y) * share);
}

// Above 0 where the way meets the ball, 0 on its outline.
fn depth_in(planet: Planet, way: vec3<f32>) -> f32 {
    let along = dot3(way, planet.place.xyz);
    return along * along - dot3(way, way) * planet.eye.w;
}

// The ground's light, and its slope: octaves of noise, each half as high as the one before.
fn ground_at(planet: Planet, place: vec3<f32>) -> vec4<f32> {
    var sum = vec4<f32>(0.0f);
    var scale = planet.ground.x;
    var weight = 1.0f;
    for (var octave = 0u; octave < planet.kinds.x; octave += 1u) {
        let here = noise(place * scale, planet.kinds.y + octave);
        sum += here * weight;
        scale *= 2.0f;
        weight *= 0.6f;
    }
    return sum;
}

// The light that falls on a place of the surface, from the centre, of that unit normal.
fn light_on(planet: Planet, place: vec3<f32>, normal: vec3<f32>, up: vec3<f32>) -> vec3<f32> {
    let straight = at_least_zero(dot3(normal, planet.light_from.xyz));
    // Where the ball itself is in the way, slopes of the ground catch no light.
    let day = clamp_unit(8.0f * dot3(up, planet.light_from.xyz));
    var light = planet.ambient.xyz + planet.light_color.xyz * (straight * day);
    for (var at = 0u; at < planet.kinds.z; at += 1u) {
        let lamp = lamps[at];
        let away = lamp.place.xyz - place;
        let near = inverse_square_root(dot3(away, away));
        let falls = at_least_zero(dot3(normal, away) * near);
        let above = clamp_unit(8.0f * dot3(up, away) * near);
        light += lamp.color.xyz * (falls * above * lamp.place.w * near * near);
    }
    if CLUSTERS {
        // They are counted from the world's origin.
        let in_world = place + (planet.eye.xyz + planet.place.xyz);
        for (var at = 1u; at <= cluster_lights[0].place.x; at += 1u) {
            let cluster = cluster_lights[at];
            let way = way_to(cluster, in_world, up);
            let near = inverse_square_root(dot3(way, way));
            let above = clamp_unit(HORIZON * at_least_zero(dot3(up, way)) * near);
            light += bitcast<vec3<f32>>(cluster.color.xyz) * (fallen(way, normal) * above);
        }
    }
    return light;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn planet(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let planet = planets[0];
    let pixel = linear_index(global_id, WORKGROUP_SIZE);
    if pixel >= frame.width * frame.height {
        return;
    }
    let x = f32_of_u32(pixel % frame.width) + 0.5f;
    let y = f32_of_u32(pixel / frame.width) + 0.5f;
    let way = way_through(x, y);
    let inside = depth_in(planet, way);
    let right = depth_in(planet, way_through(x + 0.5f, y)) - depth_in(planet, way_through(x - 0.5f, y));
    let down = depth_in(planet, way_through(x, y + 0.5f)) - depth_in(planet, way_through(x, y - 0.5f));
    let pixels = inside * inverse_square_root(right * right + down * down);
    let along = dot3(way, planet.place.xyz);
    let covered = select(0.0f, clamp_unit(pixels + 0.5f), less(0.0f, along));
    if !less(0.0f, covered) {
        planet_pixels[pixel] = vec4<u32>(0u, 0u, 0u, bits_of(1.0f));
        return;
    }
    let far = (along - square_root(at_least_zero(inside))) * reciprocal(dot3(way, way));
    let up = normalize_exact(way * far - planet.place.xyz);
    let place = up * planet.place.w;
    let ground = ground_at(planet, place);
    let slope = ground.xyz - up * dot3(ground.xyz, up);
    let normal = normalize_exact(up - slope * planet.color.w);
    let albedo = planet.color.xyz * at_least_zero(1.0f + planet.ground.y * ground.w);
    let light = albedo * light_on(planet, place, normal, up) * covered;
    planet_pixels[pixel] = vec4<u32>(
        bits_of(light.x), bits_of(light.y), bits_of(light.z), bits_of(1.0f - covered),
    );
}
