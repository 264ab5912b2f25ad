// planet: the ball with a surface in every pixel.
//
// Reeves 1983, section 3: a barren, moonlike planet with a strong light of its own above the rings
// of fire, between the particles behind its outline and those before it.
// The line of sight meets the ball or misses it; how much of a pixel the ball covers is how far its
// centre is inside the outline, in pixels. One invocation four pixels in a row: a light of particles is
// loaded once for all of them, and not looked at again if none of them has it above its horizon.
// Reads: frame, planets, lamps, cluster_lights. Writes: planet_pixels (red, green, blue and what shows of what is
// behind, as bits).
// Invariant: a pixel depends on the frame, the planet and the lights alone.

#import motes::cluster::MOST_LIFT
#import motes::dispatch::linear_index
#import motes::exact::{
    at_least_zero, bits_of, clamp_unit, dot3, f32_of_u32, inverse_square_root, less, min_exact,
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

// The ground's light, and its slope: so many octaves of noise, each half as high as the one before.
fn ground_at(planet: Planet, place: vec3<f32>, octaves: u32) -> vec4<f32> {
    var sum = vec4<f32>(0.0f);
    var scale = planet.ground.x;
    var weight = 1.0f;
    for (var octave = 0u; octave < octaves; octave += 1u) {
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
    return light;
}

// Where a pixel sees the ball: the place in the world, the way up, the slope's normal, the light that falls there,
// the share of each colour that is sent back, and how much of the pixel the ball covers.
struct Spot {
    place: vec3<f32>,
    up: vec3<f32>,
    normal: vec3<f32>,
    light: vec3<f32>,
    albedo: vec3<f32>,
    covered: f32,
}

fn spot_of(planet: Planet, pixel: u32) -> Spot {
    let x = f32_of_u32(pixel % frame.width) + 0.5f;
    let y = f32_of_u32(pixel / frame.width) + 0.5f;
    let way = way_through(x, y);
    let inside = depth_in(planet, way);
    let right = depth_in(planet, way_through(x + 0.5f, y)) - depth_in(planet, way_through(x - 0.5f, y));
    let down = depth_in(planet, way_through(x, y + 0.5f)) - depth_in(planet, way_through(x, y - 0.5f));
    let pixels = inside * inverse_square_root(right * right + down * down);
    let along = dot3(way, planet.place.xyz);
    let covered = select(0.0f, clamp_unit(pixels + 0.5f), less(0.0f, along));
    let far = (along - square_root(at_least_zero(inside))) * reciprocal(dot3(way, way));
    let up = normalize_exact(way * far - planet.place.xyz);
    let place = up * planet.place.w;
    let ground = ground_at(planet, place, select(0u, planet.kinds.x, less(0.0f, covered)));
    let slope = ground.xyz - up * dot3(ground.xyz, up);
    let normal = normalize_exact(up - slope * planet.color.w);
    let albedo = planet.color.xyz * at_least_zero(1.0f + planet.ground.y * ground.w);
    let light = light_on(planet, place, normal, up);
    // Lights of particles are counted from the world's origin.
    return Spot(place + (planet.eye.xyz + planet.place.xyz), up, normal, light, albedo, covered);
}

fn is_above(light: vec3<f32>, spot: Spot) -> bool {
    return less(0.0f, dot3(spot.up, light - spot.place));
}

// How much falls of what a light of that squared extent sends out, lifted over the ball as by way_to of lib/cluster:
// its distance squared grows by as much as its height squared.
fn fallen_on(spot: Spot, light: vec4<f32>) -> f32 {
    let away = light.xyz - spot.place;
    let height = at_least_zero(dot3(spot.up, away));
    let high = height * height;
    let more = min_exact(light.w, MOST_LIFT * high);
    let lifted = square_root(high + more);
    let near = inverse_square_root(dot3(away, away) + more);
    let slant = dot3(spot.normal, away) + dot3(spot.normal, spot.up) * (lifted - height);
    let above = clamp_unit(HORIZON * lifted * near);
    return at_least_zero(slant * near) * near * near * above;
}

fn pixel_of(spot: Spot) -> vec4<u32> {
    if !less(0.0f, spot.covered) {
        return vec4<u32>(0u, 0u, 0u, bits_of(1.0f));
    }
    let light = spot.albedo * spot.light * spot.covered;
    return vec4<u32>(bits_of(light.x), bits_of(light.y), bits_of(light.z), bits_of(1.0f - spot.covered));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn planet(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let planet = planets[0];
    var light_count = 0u;
    if CLUSTERS {
        // Before the first branch, where software drivers load what is uniform once.
        light_count = cluster_lights[0].place.x;
    }
    let first = linear_index(global_id, WORKGROUP_SIZE) * 4u;
    if first >= frame.width * frame.height {
        return;
    }
    var one = spot_of(planet, first);
    var two = spot_of(planet, first + 1u);
    var three = spot_of(planet, first + 2u);
    var four = spot_of(planet, first + 3u);
    let is_seen = less(0.0f, one.covered + two.covered + three.covered + four.covered);
    let end = 1u + select(0u, light_count, is_seen);
    // Lights are looked at by 32, a bit each.
    for (var begin = 1u; begin < end; begin += 32u) {
        var left = 0u;
        let turn = min(32u, end - begin);
        for (var at = 0u; at < turn; at += 1u) {
            let light = bitcast<vec3<f32>>(cluster_lights[begin + at].place.xyz);
            let above = is_above(light, one) || is_above(light, two) || is_above(light, three)
                || is_above(light, four);
            left |= select(0u, 1u << at, above);
        }
        while left != 0u {
            let cluster = cluster_lights[begin + firstTrailingBit(left)];
            left &= left - 1u;
            let light = bitcast<vec4<f32>>(cluster.place);
            let color = bitcast<vec3<f32>>(cluster.color.xyz);
            one.light += color * fallen_on(one, light);
            two.light += color * fallen_on(two, light);
            three.light += color * fallen_on(three, light);
            four.light += color * fallen_on(four, light);
        }
    }
    planet_pixels[first] = pixel_of(one);
    planet_pixels[first + 1u] = pixel_of(two);
    planet_pixels[first + 2u] = pixel_of(three);
    planet_pixels[first + 3u] = pixel_of(four);
}
