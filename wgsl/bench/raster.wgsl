// raster: what the device's own rasteriser needs to add up light, to hold the splat against.
//
// Particles at random places of the picture, each told from its number, so that nothing is read
// from memory: that favours the rasteriser. Points cover one pixel; quads, two triangles each, carry
// an antialiased disc, whose weights are the splat's: 1 within the radius, falling to 0 over a pixel.
// Fans, twenty triangles each, are the particles along flames (Perry 1994, 3.2.1 and 3.2.2): red, green,
// blue and alpha are linear in each triangle, and light is their product.
// Reads: parameters. Writes: the colour target, by additive blending.
// Invariant: three channels of light, the same for every particle.

struct Parameters {
    size_px: vec2<f32>,
    radius_px: f32,
    // Of flames, from the root to the tip.
    height_px: f32,
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

struct FanCorner {
    @builtin(position) position: vec4<f32>,
    @location(0) color: vec4<f32>,
}

const PI: f32 = 3.14159265;
// Particles a flame, and corners of each.
const STEPS: u32 = 25u;
const CORNERS: u32 = 20u;
// Half-axes of the ellipse that flames stand in, pixels.
const FIELD_PX: vec2<f32> = vec2<f32>(500.0, 353.553);

// Where the root of flame number `at` is, pixels from the picture's middle, y up.
fn root_of(at: u32) -> vec2<f32> {
    let turn = f32(mixed(2u * at) >> 8u) * (2.0 * PI / 16777216.0);
    let distance = sqrt(f32(mixed(2u * at + 1u) >> 8u) / 16777216.0);
    return FIELD_PX * distance * vec2<f32>(cos(turn), sin(turn));
}

@vertex
fn fan_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) at: u32) -> FanCorner {
    let age = f32(at % STEPS);
    let half = parameters.radius_px * vec2<f32>(0.67 + 0.4 * sin(PI * age / 24.0), 0.3 + 0.032 * age);
    let corner = vertex % 3u;
    let angle = f32(vertex / 3u + corner / 2u) * (2.0 * PI / f32(CORNERS));
    let rim = select(vec2<f32>(cos(angle), sin(angle)), vec2<f32>(0.0), corner == 0u);
    let middle = root_of(at / STEPS) + vec2<f32>(0.0, parameters.height_px * age / 24.0);
    let place = (middle + half * rim) * 2.0 / parameters.size_px;
    let color = select(vec4<f32>(1.0, 0.3, 0.05, 0.0), vec4<f32>(1.0, 0.7, 0.3, 0.02), corner == 0u);
    return FanCorner(vec4<f32>(place, 0.0, 1.0), color);
}

@fragment
fn fan_light(@location(0) color: vec4<f32>) -> @location(0) vec4<f32> {
    return vec4<f32>(color.xyz * color.w, 0.0);
}
