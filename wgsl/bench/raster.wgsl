// raster: what the device's own rasteriser needs to add up light, to hold the splat against.
//
// Particles at random places of the picture, each told from its number, so that nothing is read
// from memory: that favours the rasteriser. Points cover one pixel; quads, two triangles each, carry
// an antialiased disc, whose weights are the splat's: 1 within the radius, falling to 0 over a pixel.
// Reads: parameters. Writes: the colour target, by additive blending.
// Invariant: three channels of light, the same for every particle.

struct Parameters {
    size_px: vec2<f32>,
    radius_px: f32,
    spare: f32,
}
@group(0) @binding(0) var<uniform> parameters: Parameters;

struct Corner {
    @builtin(position) position: vec4<f32>,
    // From the centre, pixels.
    @location(0) offset_px: vec2<f32>,
}

const LIGHT: vec3<f32> = vec3<f32>(0.0011, 0.0007, 0.0003);

fn mixed(word: u32) -> u32 {
    let a = (word ^ (word >> 16u)) * 0x7feb352du;
    let b = (a ^ (a >> 15u)) * 0x846ca68bu;
    return b ^ (b >> 16u);
}

// Where particle number `at` is in clip space.
fn place_of(at: u32) -> vec2<f32> {
    let x = mixed(2u * at);
    let y = mixed(2u * at + 1u);
    return vec2<f32>(f32(x >> 8u), f32(y >> 8u)) * (2.0 / 16777216.0) - 1.0;
}

@vertex
fn point_vertex(@builtin(vertex_index) at: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(place_of(at), 0.0, 1.0);
}

@fragment
fn point_light() -> @location(0) vec4<f32> {
    return vec4<f32>(LIGHT, 0.0);
}

@vertex
fn quad_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) at: u32) -> Corner {
    // Corners 0 1 2 and 2 1 3 of a square, two bits each.
    let corner = (0xda4u >> (2u * vertex)) & 3u;
    let sides = vec2<f32>(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    let offset_px = sides * (parameters.radius_px + 0.5);
    let place = place_of(at) + offset_px * 2.0 / parameters.size_px;
    return Corner(vec4<f32>(place, 0.0, 1.0), offset_px);
}

@fragment
fn quad_light(corner: Corner) -> @location(0) vec4<f32> {
    let weight = clamp(parameters.radius_px + 0.5 - length(corner.offset_px), 0.0, 1.0);
    return vec4<f32>(LIGHT * weight, 0.0);
}
