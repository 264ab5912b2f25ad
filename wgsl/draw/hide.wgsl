// hide: what the planet leaves of the light of particles behind it.
//
// Reeves 1983, section 3: stars and background fires, then the planet, then foreground fires.
// One invocation a pixel. Reads: frame, planet_pixels. Reads and writes: light_low, light_high,
// and light_packed, which is 0 afterwards.
// Invariant: each channel becomes its share of what it was, rounded down, in whole steps.

#import motes::dispatch::linear_index
#import motes::exact::to_i32
#import motes::layout::Frame
#import motes::packed::unpacked

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> planet_pixels: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> light_low: array<u32>;
@group(0) @binding(3) var<storage, read_write> light_high: array<u32>;
#if WIDE == true
@group(0) @binding(4) var<storage, read_write> light_packed: array<u64>;
#endif

@compute @workgroup_size(WORKGROUP_SIZE)
fn hide(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let pixel = linear_index(global_id, WORKGROUP_SIZE);
    if pixel >= frame.width * frame.height {
        return;
    }
    // In 65,536ths.
    let share = u32(to_i32(bitcast<f32>(planet_pixels[pixel].w) * 65536.0f + 0.5f));
    var more = vec3<u32>(0u);
#if WIDE == true
    more = unpacked(light_packed[pixel]);
    light_packed[pixel] = 0lu;
#endif
    for (var channel = 0u; channel < 3u; channel += 1u) {
        let at = pixel * 3u + channel;
        let low = light_low[at] + more[channel];
        let high = min(light_high[at] + select(0u, 1u, low < more[channel]), 0xffffu);
        // high share 2^16 + low share / 2^16.
        let of_high = high * min(share, 0xffffu) + select(0u, high, share > 0xffffu);
        let of_low = (low >> 16u) * share + (((low & 0xffffu) * min(share, 0xffffu)) >> 16u);
        let full = select(of_low, low, share > 0xffffu);
        let sum = full + (of_high << 16u);
        light_low[at] = sum;
        light_high[at] = (of_high >> 16u) + select(0u, 1u, sum < full);
    }
}
