// unpack: what packed pixels hold goes to the limbs of their channels.
//
// Only for whoever reads the limbs (motes::packed): resolve adds the packed fields by itself.
// One invocation a pixel. Reads and writes: light_packed, light_low, light_high.
// Invariant: the sum of fields and limbs stays; the fields are 0 afterwards.

#import motes::dispatch::linear_index
#import motes::layout::Frame
#import motes::packed::unpacked

const WORKGROUP_SIZE: u32 = #{WORKGROUP_SIZE}u;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read_write> light_low: array<u32>;
@group(0) @binding(2) var<storage, read_write> light_high: array<u32>;
@group(0) @binding(3) var<storage, read_write> light_packed: array<u64>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn unpack(@builtin(global_invocation_id) global_id: vec3<u32>) {
    let pixel = linear_index(global_id, WORKGROUP_SIZE);
    if pixel >= frame.width * frame.height {
        return;
    }
    let more = unpacked(light_packed[pixel]);
    light_packed[pixel] = 0lu;
    for (var channel = 0u; channel < 3u; channel += 1u) {
        let at = pixel * 3u + channel;
        let low = light_low[at] + more[channel];
        light_low[at] = low;
        light_high[at] += select(0u, 1u, low < more[channel]);
    }
}
