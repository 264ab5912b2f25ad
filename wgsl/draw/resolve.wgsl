// resolve: the sums of light become pixels.
//
// Reeves 1983, 2.5: red, green and blue are clamped at the frame buffer's maximum.
// Byte = floor(clamp(v) 255 + 0.5) of the light times the exposure, plus the background; where
// something covers, plus its colour times the exposure and what shows of the background.
// One invocation four pixels, so that loads and stores are of four words; buffers are padded to
// whole fours, and what is past the picture's end is written as 0, for the digest.
// Reads: frame, light_low, light_high, light_packed, ground_pixels, planet_pixels,
// surface_pixels, cover_rg, cover_bt.
// Writes: image (RGBA, red in the low byte, rows from the top).
// Invariant: each pixel depends on its own sums alone.

#import motes::dispatch::linear_index
#import motes::exact::{clamp_unit, to_i32}
#import motes::layout::Frame
#import motes::light::light_of
#import motes::packed::unpacked

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;
// Whether anything covers.
const COVERS: bool = #{COVERS};
// Whether there is a planet behind that.
const PLANET: bool = #{PLANET};
// Whether there is a ground behind that.
const GROUND: bool = #{GROUND};
// Whether there are surfaces before that.
const SURFACES: bool = #{SURFACES};

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> light_low: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> light_high: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> cover_rg: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> cover_bt: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read_write> image: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read> planet_pixels: array<vec4<u32>>;
@group(0) @binding(7) var<storage, read> ground_pixels: array<vec4<u32>>;
@group(0) @binding(8) var<storage, read> surface_pixels: array<vec4<u32>>;
#if WIDE == true
@group(0) @binding(9) var<storage, read> light_packed: array<vec4<u64>>;
#endif

fn byte_of(low: u32, high: u32, behind: f32) -> u32 {
    let light = light_of(low, high) * frame.exposure + behind;
    return u32(to_i32(clamp_unit(light) * 255.0f + 0.5f));
}

// The limbs and what else there is.
struct Sums {
    low: vec3<u32>,
    high: vec3<u32>,
    more: vec3<u32>,
}

fn pixel_of(pixel: u32, sums: Sums) -> u32 {
    if pixel >= frame.width * frame.height {
        return 0u;
    }
    let low = sums.low + sums.more;
    let high = sums.high + select(vec3<u32>(0u), vec3<u32>(1u), low < sums.more);
    var behind = frame.background.xyz;
    if GROUND {
        let ground = bitcast<vec4<f32>>(ground_pixels[pixel]);
        behind = ground.xyz * frame.exposure + behind * ground.w;
    }
    if PLANET {
        let planet = bitcast<vec4<f32>>(planet_pixels[pixel]);
        behind = planet.xyz * frame.exposure + behind * planet.w;
    }
    var cover = vec4<f32>(0.0f, 0.0f, 0.0f, 1.0f);
    if COVERS {
        cover = bitcast<vec4<f32>>(vec4<u32>(cover_rg[pixel], cover_bt[pixel]));
    }
    behind *= cover.w;
    if SURFACES {
        // What covers is behind it and before it: it is dimmed by that already.
        let surface = bitcast<vec4<f32>>(surface_pixels[pixel]);
        behind = surface.xyz * frame.exposure + behind * surface.w;
    }
    if COVERS {
        behind = cover.xyz * frame.exposure + behind;
    }
    let red = byte_of(low.x, high.x, behind.x);
    let green = byte_of(low.y, high.y, behind.y);
    let blue = byte_of(low.z, high.z, behind.z);
    return red | (green << 8u) | (blue << 16u) | 0xff000000u;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn resolve(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let four = linear_index(global_id, WORKGROUP_SIZE);
    let first = four * 4u;
    if first >= frame.width * frame.height {
        return;
    }
    let at = four * 3u;
    let low_a = light_low[at];
    let low_b = light_low[at + 1u];
    let low_c = light_low[at + 2u];
    let high_a = light_high[at];
    let high_b = light_high[at + 1u];
    let high_c = light_high[at + 2u];
    var more: array<vec3<u32>, 4>;
#if WIDE == true
    let words = light_packed[four];
    more = array<vec3<u32>, 4>(
        unpacked(words.x), unpacked(words.y), unpacked(words.z), unpacked(words.w),
    );
#endif
    let second = Sums(vec3<u32>(low_a.w, low_b.xy), vec3<u32>(high_a.w, high_b.xy), more[1]);
    let third = Sums(vec3<u32>(low_b.zw, low_c.x), vec3<u32>(high_b.zw, high_c.x), more[2]);
    image[four] = vec4<u32>(
        pixel_of(first, Sums(low_a.xyz, high_a.xyz, more[0])),
        pixel_of(first + 1u, second),
        pixel_of(first + 2u, third),
        pixel_of(first + 3u, Sums(low_c.yzw, high_c.yzw, more[3])),
    );
}
