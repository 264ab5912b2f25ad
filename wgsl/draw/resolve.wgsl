// resolve: the sums of light become pixels.
//
// Reeves 1983, 2.5: red, green and blue are clamped at the frame buffer's maximum.
// Byte = floor(clamp(v) 255 + 0.5) of the light plus the background.
// One invocation a pixel. Reads: frame, light_low, light_high. Writes: image (RGBA, red in the low
// byte, rows from the top).
// Invariant: each pixel depends on its own sums alone.

#import motes::dispatch::linear_index
#import motes::exact::{clamp_exact, to_i32}
#import motes::layout::Frame
#import motes::light::light_of

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> light_low: array<u32>;
@group(0) @binding(2) var<storage, read> light_high: array<u32>;
@group(0) @binding(3) var<storage, read_write> image: array<u32>;

fn byte_of(light: f32) -> u32 {
    return u32(to_i32(clamp_exact(light, 0.0f, 1.0f) * 255.0f + 0.5f));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn resolve(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let pixel = linear_index(global_id, WORKGROUP_SIZE);
    if pixel >= frame.width * frame.height {
        return;
    }
    let at = pixel * 3u;
    let red = byte_of(light_of(light_low[at], light_high[at]) + frame.background.x);
    let green = byte_of(light_of(light_low[at + 1u], light_high[at + 1u]) + frame.background.y);
    let blue = byte_of(light_of(light_low[at + 2u], light_high[at + 2u]) + frame.background.z);
    image[pixel] = red | (green << 8u) | (blue << 16u) | 0xff000000u;
}
